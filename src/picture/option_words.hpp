// The names and ranges of picture options, each defined once: for the command line, the viewer's settings and messages.
// In code the options are typed: PictureOptions.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/named_values.hpp"
#include "cotan/convention.hpp"
#include "cotan/frame.hpp"
#include "cotan/picture.hpp"

namespace cotan {

inline constexpr Named<Shading> kShadings[] = {{"pbr", Shading::pbr}, {"blinn-phong", Shading::blinnPhong}};
inline constexpr Named<ToneMapping> kToneMappings[] = {{"none", ToneMapping::none},
                                                       {"neutral", ToneMapping::neutral},
                                                       {"aces", ToneMapping::aces},
                                                       {"agx", ToneMapping::agx}};
inline constexpr Named<TangentOrigin> kTangentOrigins[] = {{"stored", TangentOrigin::stored},
                                                           {"generated", TangentOrigin::generated}};
inline constexpr Named<Up> kUps[] = {{"y", Up::y}, {"z", Up::z}};
inline constexpr Named<Expansion> kExpansions[] = {{"exact", Expansion::exact}, {"biased", Expansion::biased}};
inline constexpr Named<Edges> kEdges[] = {
    {"none", Edges::none}, {"triangles", Edges::triangles}, {"seams", Edges::seams}, {"all", Edges::all}};
inline constexpr Named<Background> kBackgrounds[] = {{"paper", Background::paper},
                                                     {"blur", Background::blurred},
                                                     {"environment", Background::sharp},
                                                     {"gradient", Background::gradient},
                                                     {"none", Background::none}};
inline constexpr Named<bool> kGrounds[] = {{"on", true}, {"off", false}}; // ground

inline constexpr Named<int> kSampleCounts[] = {{"1", 1}, {"4", 4}, {"16", 16}};
inline constexpr Named<std::string_view> kShapes[] = {
    {"plane", "plane"}, {"sphere", "sphere"}, {"torus", "torus"}, {"teapot", "teapot"}};

struct Bounded {
    double minimum, maximum;
};
inline constexpr Bounded kRotations = {-360, 360}; // degrees
inline constexpr Bounded kSoftnesses = {0, 60};    // degrees
inline constexpr Bounded kChoiceDegrees = {0, 180};
inline constexpr Bounded kHeightDepths = {0, 1e9};
inline constexpr Bounded kMoments = {0, 1e6}; // seconds
inline constexpr int kMaxMemory = 1 << 16;    // MiB; the minimum is 1
inline constexpr int kMaxMaterial = 100000;   // the minimum is -1: all

inline constexpr const char* kAutoExposure = "auto"; // or a factor above 0

std::string sizeWord(const PictureSize& size); // "640x480"

// What an error about a size says.
std::string expectedSize(const std::vector<std::string>& presets, const std::string& found);

// Parses "WxH", or one number for both, each 1..16384.
Result<PictureSize> parseSize(const std::string& text);

// Likewise, also accepting the presets: "1080p", "square" and others.
std::optional<PictureSize> parsePictureSize(const std::string& text);
std::vector<std::string> sizePresetWords();

// All frame names, as a list and separated by commas.
std::vector<std::string> frameWords();
std::string frameNames();

// Name of the frame choice that stands for the frame that the normal maps are for.
inline constexpr std::string_view kAutoFrame = "auto";

inline std::string nameOf(const FrameChoice& frame) { return std::string(frame ? name(*frame) : kAutoFrame); }

// Parses a frame's name, or kAutoFrame for none. The error lists all names and begins with `field`, the option or field
// that the text was given for.
Result<FrameChoice> parseFrameChoice(const std::string& text, std::string_view field = "frame");

} // namespace cotan
