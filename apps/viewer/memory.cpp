#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>

#include "commands.hpp"
#include "core/parse_number.hpp"
#include "session.hpp"
#include "settings.hpp"

namespace cotan::viewer {

namespace {

constexpr std::array<const char*, 5> kKeptSettings = {"environment", "tone-mapping", "ground", "background",
                                                      "shadow-softness"};

struct Switch {
    const char* name;
    bool State::*field;
};
constexpr std::array<Switch, 4> kKeptSwitches = {{{"dark", &State::dark},
                                                  {"settings", &State::settingsShown},
                                                  {"card", &State::cardShown},
                                                  {"statistics", &State::statisticsShown}}};

} // namespace

std::string memoryOf(const State& state)
{
    std::string text = fmt::format("size {} {}\nscale {}\n", state.size.x, state.size.y, state.scale);
    for (const Switch& s : kKeptSwitches)
        text += fmt::format("{} {}\n", s.name, state.*s.field ? "on" : "off");
    for (const char* name : kKeptSettings)
        text += fmt::format("set {} {}\n", name, valueOf(*findSetting(name), state.picture));
    for (const std::string& file : state.recent)
        if (file.find('\n') == std::string::npos)
            text += "recent " + file + "\n";
    return text;
}

void remember(const std::string& text, State& state)
{
    if (text.empty()) // nothing was stored: the first start
        state.message = "H: keys";
    const PictureOptions defaults;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string first, second;
        words >> first >> second;
        if (first == "recent" && line.size() > 7 && state.recent.size() < kMaxRecent)
            state.recent.push_back(line.substr(7));
        else if (first == "scale")
            (void)perform(state, line); // a scale that this version refuses stays as it is
        else if (first == "size" && state.picture.size == defaults.size) {
            glm::ivec2 size{0};
            std::string height;
            words >> height;
            if (parseNumber(second, size.x) && parseNumber(height, size.y) && size.x >= 160 && size.y >= 120
                && size.x <= 8192 && size.y <= 8192)
                state.size = size;
        } else if (first == "set") {
            const Setting* setting = findSetting(second);
            const std::size_t start = line.find(second) + second.size() + 1;
            if (setting && std::ranges::find(kKeptSettings, second) != kKeptSettings.end()
                && valueOf(*setting, state.picture) == valueOf(*setting, defaults))
                (void)setValue(*setting, line.substr(std::min(start, line.size())), state.picture);
        } else
            for (const Switch& s : kKeptSwitches)
                if (first == s.name)
                    state.*s.field = second == "on";
    }
}

std::filesystem::path memoryFile()
{
    const char* stateHome = std::getenv("XDG_STATE_HOME");
    const char* home = std::getenv("HOME");
    const char* local = std::getenv("LOCALAPPDATA"); // of Windows
    std::filesystem::path folder = stateHome && *stateHome == '/' ? std::filesystem::path(stateHome)
        : home && *home                                           ? std::filesystem::path(home) / ".local" / "state"
        : local && *local                                         ? std::filesystem::path(local)
                                                                  : std::filesystem::path();
    return folder.empty() ? folder : folder / "cotan" / "view.txt";
}

} // namespace cotan::viewer
