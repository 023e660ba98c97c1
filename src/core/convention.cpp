#include "cotan/convention.hpp"

#include <array>

namespace cotan {

namespace {

using enum MapKind;

// Zero is the middle code in all of them: where every baker puts a flat texel, whatever engines expand with.
constexpr Convention tangent(Channels c, bool greenUp, VDirection v)
{
    return {tangentSpace, Expansion::exact, c, greenUp, v};
}

constexpr std::array kPresets = {
    ConventionPreset{"gltf", tangent(Channels::xyz, true, VDirection::down), "glTF 2.0: green up, v down"},
    ConventionPreset{"opengl", tangent(Channels::xyz, true, VDirection::up), "green up, v up"},
    ConventionPreset{"directx", tangent(Channels::xyz, false, VDirection::down), "green down, v down"},
    ConventionPreset{"unity", tangent(Channels::orthographic, true, VDirection::up),
                     "green up, v up; two channels after import"},
    ConventionPreset{"unreal", tangent(Channels::orthographic, false, VDirection::down),
                     "green down, v down; two channels (BC5) after import"},
    ConventionPreset{"blender", tangent(Channels::xyz, true, VDirection::up), "green up, v up"},
    ConventionPreset{"godot", tangent(Channels::orthographic, true, VDirection::down),
                     "green up, v down; two channels after import"},
    ConventionPreset{"maya", tangent(Channels::xyz, true, VDirection::up), "green up, v up"},
    ConventionPreset{"3dsmax", tangent(Channels::xyz, false, VDirection::up), "green down, v up"},
    ConventionPreset{"source", tangent(Channels::xyz, false, VDirection::down), "green down, v down"},
};

std::string_view word(Expansion e)
{
    switch (e) {
    case Expansion::exact: return "exact expansion";
    case Expansion::exact16: return "exact expansion of 16 bits";
    case Expansion::biased: return "biased expansion";
    case Expansion::signedValues: break;
    }
    return "signed";
}

std::string_view word(Channels c)
{
    switch (c) {
    case Channels::xyz: return "xyz";
    case Channels::orthographic: return "two channels (orthographic)";
    case Channels::stereographic: return "two channels (stereographic)";
    case Channels::slope: break;
    }
    return "slopes";
}

std::string_view word(MapKind k)
{
    return k == tangentSpace ? "tangent space" : k == objectSpace ? "object space" : "height";
}

} // namespace

std::span<const ConventionPreset> conventionPresets() { return kPresets; }

std::optional<Convention> conventionFromName(std::string_view name)
{
    for (const ConventionPreset& p : kPresets)
        if (p.name == name)
            return p.convention;
    return std::nullopt;
}

std::string describe(const Convention& c)
{
    std::string s(word(c.kind));
    for (std::string_view part : {word(c.channels), std::string_view(c.greenUp ? "green up" : "green down"),
                                  std::string_view(c.v == VDirection::up ? "v up" : "v down"), word(c.expansion)}) {
        s += ", ";
        s += part;
    }
    return s;
}

} // namespace cotan
