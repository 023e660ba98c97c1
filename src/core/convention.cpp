#include "cotan/convention.hpp"

#include <algorithm>
#include <array>

#include "core/named_values.hpp"

namespace cotan {

namespace {

using enum MapKind;

// Zero is the middle code in all of them: where every baker puts a flat texel, whatever engines expand with.
// Three channels: every importer is given blue, also where it drops it.
constexpr Convention tangent(bool greenUp, VDirection v)
{
    return {tangentSpace, Expansion::exact, Channels::xyz, greenUp, v};
}

// What a person gives to each importer, by the documents and sources of the engines:
// glTF: specification 2.0, 3.9.3: "+X is right and +Y is up"; uv begin at the top left.
// Unity: manual, "Normal map": "Unity uses Y+ normal maps, sometimes known as OpenGL format"; the texture type Normal
//   map makes two channels of the file (DXT5nm: x in alpha, y in green; or BC5).
// Unreal: its exporter of glTF, whose maps are Y+, flips green (GLTFExportOptions.adjust_normalmaps); TC_Normalmap is
//   BC5. NormalMapIdentification.cpp tells a normal map by texels near (0, 0, 1), blue included: without blue it is
//   taken for a picture of colours.
// Godot: "Godot requires the normal map to use the X+, Y+ and Z+ coordinates, which is known as an OpenGL-style normal
//   map"; "only the red and green channels of normal maps are used for better compression";
//   resource_importer_texture.cpp compresses it so (COMPRESS_SOURCE_NORMAL) where compress/normal_map says or detects
//   it.
// Blender: manual, Normal Map node: OpenGL by default, green up.
// Maya: green up, by the table of conventions of Verge3D, an exporter for it; Autodesk's own pages do not say.
// 3ds Max: help, Normal Bump Map: "green indicates down (larger values) versus up".
// Source: Valve Developer Community, Bump map: "vector directions X+ Y- Z+".
constexpr std::array kPresets = {
    ConventionPreset{"gltf", tangent(true, VDirection::down), false, "glTF 2.0: green up, v down"},
    ConventionPreset{"opengl", tangent(true, VDirection::up), false, "green up, v up"},
    ConventionPreset{"directx", tangent(false, VDirection::down), false, "green down, v down"},
    ConventionPreset{"unity", tangent(true, VDirection::up), true, "green up, v up; two channels on the card"},
    ConventionPreset{"unreal", tangent(false, VDirection::down), true, "green down, v down; two channels on the card"},
    ConventionPreset{"blender", tangent(true, VDirection::up), false, "green up, v up"},
    ConventionPreset{"godot", tangent(true, VDirection::down), true, "green up, v down; two channels on the card"},
    ConventionPreset{"maya", tangent(true, VDirection::up), false, "green up, v up"},
    ConventionPreset{"3dsmax", tangent(false, VDirection::up), false, "green down, v up"},
    ConventionPreset{"source", tangent(false, VDirection::down), false, "green down, v down"},
};

// In the order of MapKind, Channels and Expansion.
constexpr std::string_view kKindTexts[] = {"tangent space", "object space", "height"};
constexpr std::string_view kChannelTexts[] = {"xyz", "two channels (orthographic)", "two channels (stereographic)",
                                              "slopes"};
constexpr std::string_view kExpansionTexts[] = {"exact expansion", "biased expansion", "signed",
                                                "exact expansion of 16 bits"};

// What is said after a preset's name, or without one.
using Said = Named<void (*)(StatedConvention&)>;

template<Channels channels> void say(StatedConvention& s)
{
    s.convention.channels = channels;
    s.channels = true;
}

constexpr Said kWords[] = {
    {"green-up", [](StatedConvention& s) { s.convention.greenUp = true; }},
    {"green-down", [](StatedConvention& s) { s.convention.greenUp = false; }},
    {"exact", [](StatedConvention& s) { s.convention.expansion = Expansion::exact; }},
    {"biased", [](StatedConvention& s) { s.convention.expansion = Expansion::biased; }},
    {"signed", [](StatedConvention& s) { s.convention.expansion = Expansion::signedValues; }},
    {"xyz", say<Channels::xyz>},
    {"xy", say<Channels::orthographic>},
    {"orthographic", say<Channels::orthographic>}, // the same
    {"stereographic", say<Channels::stereographic>},
    {"slope", say<Channels::slope>},
    // Axes of a mesh: all three are needed, and green has no picture to be turned against.
    {"object",
     [](StatedConvention& s) {
         say<Channels::xyz>(s);
         s.convention.kind = objectSpace;
         s.convention.greenUp = true;
     }},
};

constexpr Said kDamageWords[] = {
    {"srgb", [](StatedConvention& s) { s.damage.curve = Damage::Curve::srgb; }},
    {"linearised", [](StatedConvention& s) { s.damage.curve = Damage::Curve::linearised; }},
    {"bgr", [](StatedConvention& s) { s.damage.order = Damage::Order::bgr; }},
    {"grb", [](StatedConvention& s) { s.damage.order = Damage::Order::grb; }},
};

Error unknownWord(std::string_view word, bool damages)
{
    const std::string found = word.empty() ? "nothing" : "'" + std::string(word) + "'";
    std::string message = "expected ";
    message += conventionWords(); // gcc 12 warns wrongly where a string is put before one that is moved
    if (damages)
        for (const Said& w : kDamageWords)
            message.append(" ").append(w.word);
    return {ErrorKind::usage, message + "; found " + found};
}

Result<StatedConvention> parsed(std::string_view text, bool damages)
{
    if (text.empty())
        return unknownWord(text, damages);
    StatedConvention stated;
    for (bool first = true; !text.empty(); first = false) {
        const std::string_view word = text.substr(0, text.find(','));
        if (const auto preset = first ? conventionFromName(word) : std::nullopt)
            stated.convention = *preset;
        else if (const auto say = valueOf(kWords, word))
            (*say)(stated);
        else if (const auto damage = valueOf(kDamageWords, word))
            (*damage)(stated);
        else
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

std::span<const ConventionPreset> conventionPresets() { return kPresets; }

std::optional<Convention> conventionFromName(std::string_view name)
{
    const auto found = std::ranges::find(kPresets, name, &ConventionPreset::name);
    return found != kPresets.end() ? std::optional(found->convention) : std::nullopt;
}

Convention onCard(const ConventionPreset& preset)
{
    Convention c = preset.convention;
    if (preset.twoOnCard)
        c.channels = Channels::orthographic;
    return c;
}

std::string describe(const Convention& c)
{
    std::string text(textAt(kKindTexts, c.kind));
    for (std::string_view part :
         {textAt(kChannelTexts, c.channels), std::string_view(c.greenUp ? "green up" : "green down"),
          std::string_view(c.v == VDirection::up ? "v up" : "v down"), textAt(kExpansionTexts, c.expansion, 2)})
        text.append(", ").append(part);
    return text;
}

std::string conventionWords()
{
    std::string words;
    for (const ConventionPreset& p : kPresets)
        words += (words.empty() ? "" : " ") + std::string(p.name);
    words += "; then, after commas,";
    for (const Said& w : kWords)
        words.append(" ").append(w.word);
    return words;
}

std::vector<std::string> conventionWordList()
{
    std::vector<std::string> words;
    for (const ConventionPreset& p : kPresets)
        words.emplace_back(p.name);
    for (const Said& w : kWords)
        words.emplace_back(w.word);
    return words;
}

std::vector<std::string> damageWords() { return wordsOf(kDamageWords); }

Result<Convention> parseConvention(std::string_view text)
{
    const auto stated = undamaged(text);
    return stated ? Result<Convention>(stated->convention) : stated.error();
}

Result<Convention> parseSampledConvention(std::string_view text)
{
    const auto stated = undamaged(text);
    if (!stated)
        return stated.error();
    Convention convention = stated->convention;
    for (const ConventionPreset& p : kPresets)
        if (!stated->channels && p.name == text.substr(0, text.find(',')))
            convention.channels = onCard(p).channels;
    return convention;
}

Result<StatedConvention> parseStatedConvention(std::string_view text) { return parsed(text, true); }

} // namespace cotan
