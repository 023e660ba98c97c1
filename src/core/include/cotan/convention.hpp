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

// Expansion and Channels use the numbers of COTAN_EXPAND_... and COTAN_CHANNELS_... in shaders/cotan/normal.h.
enum class Expansion {
    exact,        // zero is the middle code: (255c - 128)/127 in 8 bits; for other depths see expansionFor
    biased,       // 2c - 1
    signedValues, // stored signed (snorm, float)
    exact16,      // (65535c - 32768)/32767: exact for 16 bits, for readers that do not know the number of bits
};

enum class Channels {
    xyz,
    orthographic,  // two channels; z = sqrt(1 - x^2 - y^2)
    stereographic, // two channels; (x,y)/(1+z)
    slope,         // two channels; (dh/du, dh/dv)
};

// The meaning of the components.
enum class MapKind { tangentSpace, objectSpace, height };

// Whether v increases down or up the image. It determines whether "green up" means green along +v.
enum class VDirection {
    down, // v = 0 at the top row: glTF, Direct3D, Vulkan
    up,   // v = 0 at the bottom row: OBJ, OpenGL tutorials, Blender, Unity
};

// How a normal map is stored. Presets, words, materials, reports and codecs all use this type; toFormat converts it for
// the portable text.
struct Convention {
    MapKind kind = MapKind::tangentSpace;
    Expansion expansion = Expansion::exact;
    Channels channels = Channels::xyz;
    bool greenUp = true;             // green points up in the image
    VDirection v = VDirection::down; // of the uv that the map is used with

    friend bool operator==(const Convention&, const Convention&) = default;
};

// Whether green points along increasing v, the flag that decoding needs. For example, green up with v down points
// against it (docs/reference/conventions.md has all four cases).
constexpr bool greenAlongV(const Convention& c) { return c.greenUp == (c.v == VDirection::up); }

// The files that an engine or program expects from its users. All have three channels.
struct ConventionPreset {
    std::string_view name;
    Convention convention;
    bool twoOnGpu;         // the engine's importer keeps only x and y, which its shaders sample
    std::string_view note; // one line: the program, and its peculiarities
};

// gltf, opengl, directx, unity, unreal, blender, godot, maya, 3dsmax, source.
std::span<const ConventionPreset> conventionPresets();
std::optional<Convention> conventionFromName(std::string_view name);

// Returns what the engine's shaders sample after import: orthographic if the importer keeps two channels. A shader that
// derives z from x and y also reads a map of unit vectors whose blue was kept.
Convention onGpu(const ConventionPreset& preset);

// Returns one line for reports, such as "tangent space, xyz, green up, v down, exact expansion".
std::string describe(const Convention& convention);

// Returns the expansion for components of `bits` bits, as a code of shaders/cotan/normal.h. The zero of `exact` is the
// middle code, 128 or 32768; floats (32 bits) represent 0.5 exactly, so they use 2c - 1.
constexpr int expansionFor(Expansion expansion, int bits)
{
    if (expansion != Expansion::exact)
        return static_cast<int>(expansion);
    return bits == 8 ? COTAN_EXPAND_EXACT : bits == 16 ? COTAN_EXPAND_EXACT16 : COTAN_EXPAND_BIASED;
}

// Converts a convention for the portable text to f32:: or f64::cotan_normal_format, which also needs the precision of
// the stored components. strength: factor on the slopes. bits: 8, 16 or 32 (floats) per component.
template<class Format> Format toFormat(const Convention& c, double strength = 1, int bits = 8)
{
    Format f;
    f.expansion = expansionFor(c.expansion, bits);
    f.channels = static_cast<int>(c.channels);
    f.green = greenAlongV(c) ? 1 : -1;
    f.strength = static_cast<decltype(f.strength)>(strength);
    return f;
}

// Parses words separated by commas: a preset's name, then differences from it, such as "unity,xy" or "opengl,biased".
// Errors (ErrorKind::usage): an unknown word, or no word.
Result<Convention> parseConvention(std::string_view text);

// Damage to the stored values of a map, which is reverted when the map is read.
struct Damage {
    // srgb: saved as a colour; linearised: an inverse sRGB curve was applied to values without the curve.
    enum class Curve { none, srgb, linearised };
    enum class Order { rgb, bgr, grb }; // bgr: red and blue are exchanged; grb: red and green
    Curve curve = Curve::none;
    Order order = Order::rgb;

    bool any() const { return curve != Curve::none || order != Order::rgb; }
};

// A convention as a user states it. A preset's channels are only a default: a file that stores two channels overrides
// them.
struct StatedConvention {
    Convention convention{};
    bool channels = false;  // stated by a word of their own, so a file that stores others contradicts them
    bool expansion = false; // stated by exact, biased or signed
    Damage damage{};        // from the words srgb, linearised, bgr and grb

    StatedConvention() = default;
    StatedConvention(const Convention& c, bool said = false) : convention(c), channels(said) {}
};

// Like parseConvention; also returns whether a word stated the channels (xyz, xy and so on, or object). Accepts the
// words of damageWords, too, which the other functions refuse because no map should be written that way.
Result<StatedConvention> parseStatedConvention(std::string_view text);

// The same for maps that are written, which have no damage.
Result<StatedConvention> parseWrittenConvention(std::string_view text);

// The words of Damage, for help and completion: srgb, linearised, bgr, grb.
std::vector<std::string> damageWords();

// Like parseConvention, for a shader: a preset without a word for channels means those that the engine's shaders sample
// (onGpu).
Result<Convention> parseSampledConvention(std::string_view text);

// All words that parseConvention knows, for help texts.
std::string conventionWords();
std::vector<std::string> conventionWordList();

} // namespace cotan
