// How a normal map is stored, as a value that is passed along and printed in reports.
//
//     cotan::Convention unreal = *cotan::parseConvention("unreal");
//     cotan::Convention mine;
//     mine.greenUp = false;
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cotan/portable.hpp"
#include "cotan/result.hpp"

namespace cotan {

// Expansion and Channels have the numbers of COTAN_EXPAND_... and COTAN_CHANNELS_... in shaders/cotan/normal.h.
enum class Expansion {
    exact,        // zero is the middle code: (255c - 128)/127 of 8 bits; of others see expansionFor
    biased,       // 2c - 1
    signedValues, // stored signed (snorm, float)
    exact16,      // (65535c - 32768)/32767: exact of 16 bits, for readers that do not know the number of bits
};

enum class Channels {
    xyz,
    orthographic,  // two; z = sqrt(1 - x^2 - y^2)
    stereographic, // two; (x,y)/(1+z)
    slope,         // two; (dh/du, dh/dv)
};

// What the numbers mean.
enum class MapKind { tangentSpace, objectSpace, height };

// Which way the rows of the image run with v. It decides what "green up" means: whether green points along +v.
enum class VDirection {
    down, // v = 0 at the top row: glTF, Direct3D, Vulkan
    up,   // v = 0 at the bottom row: OBJ, OpenGL tutorials, Blender, Unity
};

// How a normal map is stored: the one value that presets, words, materials, reports and codecs share. The portable text
// takes it by toFormat.
struct Convention {
    MapKind kind = MapKind::tangentSpace;
    Expansion expansion = Expansion::exact;
    Channels channels = Channels::xyz;
    bool greenUp = true;             // green points up the picture
    VDirection v = VDirection::down; // of the uv that the map is used with

    friend bool operator==(const Convention&, const Convention&) = default;
};

// Whether green points along increasing v: the flag that decoding needs. Green up with v down
// points against it, and so on (docs/reference/conventions.md has the table of four).
constexpr bool greenAlongV(const Convention& c) { return c.greenUp == (c.v == VDirection::up); }

// How an engine or program wants the file that a person gives it. All have three channels.
struct ConventionPreset {
    std::string_view name;
    Convention convention;
    bool twoOnCard;        // the engine's importer keeps x and y alone, which is what its shaders sample
    std::string_view note; // one line: whose, and what is special
};

// gltf, opengl, directx, unity, unreal, blender, godot, maya, 3dsmax, source.
std::span<const ConventionPreset> conventionPresets();
std::optional<Convention> conventionFromName(std::string_view name);

// What the engine's shaders sample once the file is imported: orthographic where it keeps two channels. A shader that
// takes z from x and y also reads a map of unit vectors whose blue was kept.
Convention onCard(const ConventionPreset& preset);

// One line for reports, such as "tangent space, xyz, green up, v down, exact expansion".
std::string describe(const Convention& convention);

// The form of an expansion for components of so many bits, as codes of shaders/cotan/normal.h. Exact has its
// zero at the middle code, 128 or 32768; floats (32 bits) hold 0.5 as it is, so theirs is 2c - 1.
constexpr int expansionFor(Expansion expansion, int bits)
{
    if (expansion != Expansion::exact)
        return static_cast<int>(expansion);
    return bits == 8 ? COTAN_EXPAND_EXACT : bits == 16 ? COTAN_EXPAND_EXACT16 : COTAN_EXPAND_BIASED;
}

// The same value for the portable text, f32:: or f64::cotan_normal_format, which also has to know of what precision
// it reads. strength: factor on the slopes. bits: 8, 16 or 32 (floats) a component.
template<class Format> Format toFormat(const Convention& c, double strength = 1, int bits = 8)
{
    Format f;
    f.expansion = expansionFor(c.expansion, bits);
    f.channels = static_cast<int>(c.channels);
    f.green = greenAlongV(c) ? 1 : -1;
    f.strength = static_cast<decltype(f.strength)>(strength);
    return f;
}

// A convention in words separated by commas: a preset's name, then what differs from it, such as "unity,xy" or
// "opengl,biased". Errors (ErrorKind::usage): a word that is not known, or none.
Result<Convention> parseConvention(std::string_view text);

// What went wrong with the stored values of a map, and is undone when it is read.
struct Damage {
    // srgb: saved as a colour; linearised: the sRGB curve was undone on values that never had it.
    enum class Curve { none, srgb, linearised };
    enum class Order { rgb, bgr, grb }; // bgr: red and blue are exchanged; grb: red and green
    Curve curve = Curve::none;
    Order order = Order::rgb;

    bool any() const { return curve != Curve::none || order != Order::rgb; }
};

// A convention as somebody says it. What a preset says of channels is no more than what is usual: a file that stores
// two is believed.
struct StatedConvention {
    Convention convention{};
    bool channels = false; // they were said by a word of their own: a file that stores others contradicts
    Damage damage{};       // by the words srgb, linearised, bgr and grb

    StatedConvention() = default;
    StatedConvention(const Convention& c, bool said = false) : convention(c), channels(said) {}
};

// As parseConvention, with whether a word for the channels (xyz, xy and so on, or object) was among them. Takes the
// words of damageWords, too, which others refuse: nothing is to be written so.
Result<StatedConvention> parseStatedConvention(std::string_view text);

// The words for Damage, for help and completion: srgb, linearised, bgr, grb.
std::vector<std::string> damageWords();

// As parseConvention, for a shader: a preset without a word for its channels means what its engine samples
// (onCard).
Result<Convention> parseSampledConvention(std::string_view text);

// All words that it knows, for help texts.
std::string conventionWords();
std::vector<std::string> conventionWordList();

} // namespace cotan
