#include "cotan/convention_words.hpp"

#include <algorithm>
#include <optional>

namespace cotan {

namespace {

struct Word {
    const char* name;
    void (*apply)(Convention&);
};

constexpr Word kWords[] = {
    {"green-up", [](Convention& c) { c.greenUp = true; }},
    {"green-down", [](Convention& c) { c.greenUp = false; }},
    {"exact", [](Convention& c) { c.expansion = Expansion::exact; }},
    {"biased", [](Convention& c) { c.expansion = Expansion::biased; }},
    {"signed", [](Convention& c) { c.expansion = Expansion::signedValues; }},
    {"xyz", [](Convention& c) { c.channels = Channels::xyz; }},
    {"orthographic", [](Convention& c) { c.channels = Channels::orthographic; }},
    {"stereographic", [](Convention& c) { c.channels = Channels::stereographic; }},
    {"slope", [](Convention& c) { c.channels = Channels::slope; }},
    // Axes of a mesh: all three are needed, and green has no picture to be turned against.
    {"object", [](Convention& c) { c.kind = MapKind::objectSpace, c.channels = Channels::xyz, c.greenUp = true; }},
};

bool applyWord(std::string_view text, Convention& convention)
{
    const auto word = std::ranges::find_if(kWords, [&](const Word& w) { return text == w.name; });
    if (word == std::end(kWords))
        return false;
    word->apply(convention);
    return true;
}

Error unknownWord(std::string_view word)
{
    const std::string found = word.empty() ? "nothing" : "'" + std::string(word) + "'";
    std::string message = "expected ";
    message += conventionWords(); // gcc 12 warns wrongly where a string is put before one that is moved
    return {ErrorKind::usage, message + "; found " + found};
}

} // namespace

std::string conventionWords()
{
    std::string words;
    for (const ConventionPreset& p : conventionPresets())
        words += (words.empty() ? "" : " ") + std::string(p.name);
    words += "; then, after commas,";
    for (const Word& w : kWords)
        words += std::string(" ") + w.name;
    return words;
}

std::vector<std::string> conventionWordList()
{
    std::vector<std::string> words;
    for (const ConventionPreset& p : conventionPresets())
        words.emplace_back(p.name);
    for (const Word& w : kWords)
        words.emplace_back(w.name);
    return words;
}

Result<Convention> conventionFromWords(std::string_view text)
{
    if (text.empty())
        return unknownWord(text);
    Convention convention;
    for (bool first = true; !text.empty(); first = false) {
        const std::string_view word = text.substr(0, text.find(','));
        const auto preset = first ? conventionFromName(word) : std::nullopt;
        if (preset)
            convention = *preset;
        else if (!applyWord(word, convention))
            return unknownWord(word);
        text.remove_prefix(std::min(word.size() + 1, text.size()));
    }
    return convention;
}

} // namespace cotan
