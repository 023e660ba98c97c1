#include "cotan/convention.hpp"

#include <algorithm>
#include <optional>

namespace cotan {

namespace {

struct Word {
    const char* name;
    void (*apply)(Convention&);
    bool channels = false; // says them
};

constexpr Word kWords[] = {
    {"green-up", [](Convention& c) { c.greenUp = true; }},
    {"green-down", [](Convention& c) { c.greenUp = false; }},
    {"exact", [](Convention& c) { c.expansion = Expansion::exact; }},
    {"biased", [](Convention& c) { c.expansion = Expansion::biased; }},
    {"signed", [](Convention& c) { c.expansion = Expansion::signedValues; }},
    {"xyz", [](Convention& c) { c.channels = Channels::xyz; }, true},
    {"xy", [](Convention& c) { c.channels = Channels::orthographic; }, true},
    {"orthographic", [](Convention& c) { c.channels = Channels::orthographic; }, true}, // the same
    {"stereographic", [](Convention& c) { c.channels = Channels::stereographic; }, true},
    {"slope", [](Convention& c) { c.channels = Channels::slope; }, true},
    // Axes of a mesh: all three are needed, and green has no picture to be turned against.
    {"object", [](Convention& c) { c.kind = MapKind::objectSpace, c.channels = Channels::xyz, c.greenUp = true; },
     true},
};

struct DamageWord {
    const char* name;
    void (*apply)(Damage&);
};

constexpr DamageWord kDamageWords[] = {
    {"srgb", [](Damage& d) { d.curve = Damage::Curve::srgb; }},
    {"linearised", [](Damage& d) { d.curve = Damage::Curve::linearised; }},
    {"bgr", [](Damage& d) { d.order = Damage::Order::bgr; }},
    {"grb", [](Damage& d) { d.order = Damage::Order::grb; }},
};

bool applyWord(std::string_view text, StatedConvention& stated)
{
    const auto word = std::ranges::find_if(kWords, [&](const Word& w) { return text == w.name; });
    if (word == std::end(kWords)) {
        const auto damage = std::ranges::find_if(kDamageWords, [&](const DamageWord& w) { return text == w.name; });
        if (damage == std::end(kDamageWords))
            return false;
        damage->apply(stated.damage);
        return true;
    }
    word->apply(stated.convention);
    stated.channels = stated.channels || word->channels;
    return true;
}

Error unknownWord(std::string_view word, bool damages)
{
    const std::string found = word.empty() ? "nothing" : "'" + std::string(word) + "'";
    std::string message = "expected ";
    message += conventionWords(); // gcc 12 warns wrongly where a string is put before one that is moved
    for (const DamageWord& w : kDamageWords)
        message += damages ? std::string(" ") + w.name : std::string();
    return {ErrorKind::usage, message + "; found " + found};
}

Result<StatedConvention> parsed(std::string_view text, bool damages)
{
    if (text.empty())
        return unknownWord(text, damages);
    StatedConvention stated;
    for (bool first = true; !text.empty(); first = false) {
        const std::string_view word = text.substr(0, text.find(','));
        const auto preset = first ? conventionFromName(word) : std::nullopt;
        if (preset)
            stated.convention = *preset;
        else if (!applyWord(word, stated))
            return unknownWord(word, damages);
        text.remove_prefix(std::min(word.size() + 1, text.size()));
    }
    return stated;
}

// For what is to be written, or read by a shader.
Result<StatedConvention> undamaged(std::string_view text)
{
    auto stated = parsed(text, false);
    if (stated && stated->damage.any())
        return usageError("srgb, linearised, bgr and grb say how a broken map is stored; expected a convention without "
                          "them, found '"
                          + std::string(text) + "'");
    return stated;
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

std::vector<std::string> damageWords()
{
    std::vector<std::string> words;
    for (const DamageWord& w : kDamageWords)
        words.emplace_back(w.name);
    return words;
}

Result<Convention> parseConvention(std::string_view text)
{
    const auto stated = undamaged(text);
    return stated ? Result<Convention>(stated->convention) : stated.error();
}

Result<Convention> parseSampledConvention(std::string_view text)
{
    const auto stated = undamaged(text);
    if (!stated || stated->channels)
        return stated ? Result<Convention>(stated->convention) : stated.error();
    Convention convention = stated->convention;
    for (const ConventionPreset& p : conventionPresets())
        if (p.name == text.substr(0, text.find(',')))
            convention.channels = onCard(p).channels;
    return convention;
}

Result<StatedConvention> parseStatedConvention(std::string_view text) { return parsed(text, true); }

} // namespace cotan
