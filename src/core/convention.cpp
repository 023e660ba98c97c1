#include "cotan/convention.hpp"

#include <algorithm>
#include <array>

#include "core/named_values.hpp"
#include "core/try.hpp"

namespace cotan {

namespace {

using enum MapKind;

// All presets have three channels: every importer accepts blue, even if it drops it.
constexpr Convention tangent(bool greenUp, VDirection v, Expansion expansion = Expansion::exact)
{
    return {tangentSpace, expansion, Channels::xyz, greenUp, v};
}

// The files that each importer expects, according to documentation and source of the engines:
// glTF: specification 2.0, 3.9.3: "+X is right and +Y is up"; uv begin at the top left.
// Unity: manual, "Normal map": "Unity uses Y+ normal maps, sometimes known as OpenGL format"; the texture type Normal
//   map makes two channels of the file (DXT5nm: x in alpha, y in green; or BC5).
// Unreal: its glTF exporter, whose maps are Y+, flips green (GLTFExportOptions.adjust_normalmaps); TC_Normalmap is BC5.
//   NormalMapIdentification.cpp detects a normal map by texels near (0, 0, 1), including blue; without blue it imports
//   the file as a colour texture.
// Godot: "Godot requires the normal map to use the X+, Y+ and Z+ coordinates, which is known as an OpenGL-style normal
//   map"; "only the red and green channels of normal maps are used for better compression";
//   resource_importer_texture.cpp compresses that way (COMPRESS_SOURCE_NORMAL) if compress/normal_map is set or detects
//   a normal map.
// Blender: manual, Normal Map node: OpenGL by default, green up.
// Maya: green up, according to the table of conventions of Verge3D, an exporter for it; Autodesk's pages do not say.
// 3ds Max: help, Normal Bump Map: "green indicates down (larger values) versus up".
// Source: Valve Developer Community, Bump map: "vector directions X+ Y- Z+".
//
// Zero is where the reader has it. These expand with 2c - 1:
// glTF: specification 2.0, material.normalTextureInfo.scale: "<sampled normal texture value> * 2.0 - 1.0".
// Unity: UnpackNormalAG and UnpackNormalRGB, Packing.hlsl of com.unity.render-pipelines.core: "* 2.0 - 1.0".
// Unreal: UnpackNormalMap, Engine/Shaders/Private/Common.ush: "NormalXY * 2 - 1".
// Godot: scene_forward_clustered.glsl: "normal_map.xy * 2.0 - 1.0"; scene.glsl of Godot 3 does the same.
// Blender: svm_node_normal_map, intern/cycles/kernel/svm/tex_coord.h: "2.0f * (color.x - 0.5f)"; bakes are the inverse.
// Of the others no such source is known, so their zero is the middle code, where bakers and painters store flat.
constexpr std::array kPresets = {
    ConventionPreset{"gltf", tangent(true, VDirection::down, Expansion::biased), false, "glTF 2.0: green up, v down"},
    ConventionPreset{"opengl", tangent(true, VDirection::up), false, "green up, v up"},
    ConventionPreset{"directx", tangent(false, VDirection::down), false, "green down, v down"},
    ConventionPreset{"unity", tangent(true, VDirection::up, Expansion::biased), true,
                     "green up, v up; two channels on the GPU"},
    ConventionPreset{"unreal", tangent(false, VDirection::down, Expansion::biased), true,
                     "green down, v down; two channels on the GPU"},
    ConventionPreset{"blender", tangent(true, VDirection::up, Expansion::biased), false, "green up, v up"},
    ConventionPreset{"godot", tangent(true, VDirection::down, Expansion::biased), true,
                     "green up, v down; two channels on the GPU"},
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

// The words that may follow a preset's name, or be used without one.
using ConventionWord = Named<void (*)(StatedConvention&)>;

template<Channels channels> void setChannels(StatedConvention& s)
{
    s.convention.channels = channels;
    s.channels = true;
}

constexpr ConventionWord kWords[] = {
    {"green-up", [](StatedConvention& s) { s.convention.greenUp = true; }},
    {"green-down", [](StatedConvention& s) { s.convention.greenUp = false; }},
    {"exact", [](StatedConvention& s) { s.convention.expansion = Expansion::exact, s.expansion = true; }},
    {"biased", [](StatedConvention& s) { s.convention.expansion = Expansion::biased, s.expansion = true; }},
    {"signed", [](StatedConvention& s) { s.convention.expansion = Expansion::signedValues, s.expansion = true; }},
    {"xyz", setChannels<Channels::xyz>},
    {"xy", setChannels<Channels::orthographic>},
    {"orthographic", setChannels<Channels::orthographic>}, // the same
    {"stereographic", setChannels<Channels::stereographic>},
    {"slope", setChannels<Channels::slope>},
    // Object space needs all three axes, and green has no image direction that could be flipped.
    {"object",
     [](StatedConvention& s) {
         setChannels<Channels::xyz>(s);
         s.convention.kind = objectSpace;
         s.convention.greenUp = true;
     }},
};

constexpr ConventionWord kDamageWords[] = {
    {"srgb", [](StatedConvention& s) { s.damage.curve = Damage::Curve::srgb; }},
    {"linearised", [](StatedConvention& s) { s.damage.curve = Damage::Curve::linearised; }},
    {"bgr", [](StatedConvention& s) { s.damage.order = Damage::Order::bgr; }},
    {"grb", [](StatedConvention& s) { s.damage.order = Damage::Order::grb; }},
};

Error unknownWord(std::string_view word, bool withDamage)
{
    const std::string found = word.empty() ? "nothing" : "'" + std::string(word) + "'";
    std::string message = "expected ";
    message += conventionWords(); // false warning of gcc 12 for a string inserted before a moved one
    if (withDamage)
        for (const ConventionWord& w : kDamageWords)
            message.append(" ").append(w.word);
    return {ErrorKind::usage, message + "; found " + found};
}

Result<StatedConvention> parsed(std::string_view text, bool withDamage)
{
    if (text.empty())
        return unknownWord(text, withDamage);
    StatedConvention stated;
    for (bool first = true; !text.empty(); first = false) {
        const std::string_view word = text.substr(0, text.find(','));
        if (const auto preset = first ? conventionFromName(word) : std::nullopt)
            stated.convention = *preset;
        else if (const auto apply = valueOf(kWords, word))
            (*apply)(stated);
        else if (const auto damage = valueOf(kDamageWords, word))
            (*damage)(stated);
        else
            return unknownWord(word, withDamage);
        text.remove_prefix(std::min(word.size() + 1, text.size()));
    }
    return stated;
}

} // namespace

std::span<const ConventionPreset> conventionPresets() { return kPresets; }

std::optional<Convention> conventionFromName(std::string_view name)
{
    const auto found = std::ranges::find(kPresets, name, &ConventionPreset::name);
    return found != kPresets.end() ? std::optional(found->convention) : std::nullopt;
}

Convention onGpu(const ConventionPreset& preset)
{
    Convention c = preset.convention;
    if (preset.twoOnGpu)
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
    for (const ConventionWord& w : kWords)
        words.append(" ").append(w.word);
    return words;
}

std::vector<std::string> conventionWordList()
{
    std::vector<std::string> words;
    for (const ConventionPreset& p : kPresets)
        words.emplace_back(p.name);
    for (const ConventionWord& w : kWords)
        words.emplace_back(w.word);
    return words;
}

std::vector<std::string> damageWords() { return wordsOf(kDamageWords); }

Result<Convention> parseConvention(std::string_view text)
{
    const auto stated = parseWrittenConvention(text);
    return stated ? Result<Convention>(stated->convention) : stated.error();
}

Result<Convention> parseSampledConvention(std::string_view text)
{
    COTAN_TRY(stated, parseWrittenConvention(text));
    Convention convention = stated->convention;
    for (const ConventionPreset& p : kPresets)
        if (!stated->channels && p.name == text.substr(0, text.find(',')))
            convention.channels = onGpu(p).channels;
    return convention;
}

Result<StatedConvention> parseStatedConvention(std::string_view text) { return parsed(text, true); }

Result<StatedConvention> parseWrittenConvention(std::string_view text)
{
    auto stated = parsed(text, false);
    if (stated && stated->damage.any())
        return usageError("srgb, linearised, bgr and grb describe broken maps; expected a convention without them, "
                          "found '"
                          + std::string(text) + "'");
    return stated;
}

} // namespace cotan
