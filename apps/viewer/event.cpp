#include "event.hpp"

#include <array>
#include <sstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/parse_number.hpp"

namespace cotan::viewer {

namespace {

enum class Holds { nothing, position, word };

struct KindWord {
    EventKind kind;
    std::string_view word;
    Holds holds;
};

constexpr std::array<KindWord, 12> kKinds = {{{EventKind::move, "move", Holds::position},
                                              {EventKind::press, "press", Holds::word},
                                              {EventKind::release, "release", Holds::word},
                                              {EventKind::scroll, "scroll", Holds::position},
                                              {EventKind::key, "key", Holds::word},
                                              {EventKind::keyUp, "keyup", Holds::word},
                                              {EventKind::text, "text", Holds::word},
                                              {EventKind::drop, "drop", Holds::word},
                                              {EventKind::resize, "resize", Holds::position},
                                              {EventKind::close, "close", Holds::nothing},
                                              {EventKind::command, "do", Holds::word},
                                              {EventKind::wait, "wait", Holds::nothing}}};

// Parses a line that is not a comment. Returns an error message, or "" if it is valid.
std::string read(std::string_view line, double before, Event& event)
{
    std::string rest(line);
    event.seconds = before;
    std::string word = nextWord(rest);
    if (double seconds = 0; parseNumber(std::string_view(word), seconds)) {
        if (!(seconds >= before))
            return fmt::format("expected a time of at least {}; found '{}'", before, word);
        event.seconds = seconds;
        word = nextWord(rest);
    }
    for (const KindWord& kind : kKinds) {
        if (kind.word != word)
            continue;
        event.kind = kind.kind;
        if (kind.holds == Holds::position) {
            const std::string x = nextWord(rest), y = nextWord(rest);
            if (!parseNumber(std::string_view(x), event.x) || !parseNumber(std::string_view(y), event.y))
                return fmt::format("{}: expected two numbers; found '{} {}'", word, x, y);
        } else if (kind.holds == Holds::word) {
            event.word = rest;
            if (event.word.empty())
                return fmt::format("{}: expected a word after it; found none", word);
            return {};
        }
        return rest.find_first_not_of(' ') == std::string_view::npos
            ? std::string()
            : fmt::format("{}: expected nothing more; found '{}'", word, rest);
    }
    std::string known;
    for (const KindWord& kind : kKinds)
        known += (known.empty() ? "" : ", ") + std::string(kind.word);
    return fmt::format("expected one of {}; found '{}'", known, word);
}

} // namespace

std::string nextWord(std::string& rest)
{
    const std::size_t start = std::min(rest.find_first_not_of(' '), rest.size());
    const std::size_t end = std::min(rest.find(' ', start), rest.size());
    std::string word = rest.substr(start, end - start);
    rest.erase(0, end + 1);
    return word;
}

std::string toText(const Event& event)
{
    for (const KindWord& kind : kKinds)
        if (kind.kind == event.kind) {
            std::string text = fmt::format("{:.3f} {}", event.seconds, kind.word);
            if (kind.holds == Holds::position)
                text += fmt::format(" {} {}", event.x, event.y);
            else if (kind.holds == Holds::word)
                text += " " + event.word;
            return text;
        }
    return {};
}

Result<std::vector<Event>> eventsOf(const std::string& text, const std::string& name)
{
    std::vector<Event> events;
    std::istringstream lines(text);
    double before = 0;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (!line.empty() && line.back() == '\r')
            line.pop_back();
        const std::size_t start = line.find_first_not_of(' ');
        if (start == std::string::npos || line[start] == '#')
            continue;
        Event event;
        if (const std::string wrong = read(line, before, event); !wrong.empty())
            return inputError(fmt::format("{}: line {}: {}", name, number, wrong));
        before = event.seconds;
        events.push_back(std::move(event));
    }
    return events;
}

bool holds(const Event& event, const char* modifier)
{
    const std::string word = "+" + event.word;
    return word.find("+" + std::string(modifier) + "+") != std::string::npos;
}

std::string bareWord(const Event& event)
{
    if (event.word.size() < 2)
        return event.word;
    const std::size_t plus = event.word.rfind('+', event.word.size() - 2);
    return plus == std::string::npos ? event.word : event.word.substr(plus + 1);
}

} // namespace cotan::viewer
