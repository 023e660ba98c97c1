// What a picture of a model is to show, in words: those of `cotan render` and of its window.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cotan/files/limits.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/image.hpp"

namespace cotan {

inline constexpr int kDefaultMemory = 640; // MiB, of one picture

// The limits of reading with so many MiB for one picture, and as much for all of a model together where that is more
// than is usual.
LoadLimits limitsFor(int memory, Pixels pixels = Pixels::all);

// The up of a word, "y" or "z".
inline Up upFrom(std::string_view word) { return word == "z" ? Up::z : Up::y; }

// "WxH", or one number for both, each 1..16384.
Result<std::pair<int, int>> parseSize(const std::string& text);

// The same of a picture, which may also have the size of a preset: "1080p", "square" and others.
Result<std::pair<int, int>> parsePictureSize(const std::string& text);
std::vector<std::string> sizePresetWords();

// Pictures of one's own on a model: --normal-map, and for models that come without --base-color, --metallic-roughness
// and --occlusion.
struct OwnMaps { // files; empty: what the model has
    std::string normal, baseColor, metallicRoughness, occlusion;
    std::string convention; // of the normal map, gltf where it is empty; without one: how the model's own are read, as
                            // the model says where it is empty
    int material = -1;      // number of the only material that gets them; -1: all
};

// What becomes of a picture.
enum class PictureUse {
    shown,    // light, for people to look at
    radiance, // light, as it is
    data,     // no light
};

struct PictureOptions {
    PictureUse use = PictureUse::shown; // for the command to say
    std::string show = "shaded";        // of showNames; for the command to declare
    std::string model;                  // empty: the built-in scene, or the shape
    std::string shape;                  // plane, sphere, torus or teapot
    OwnMaps maps;
    std::string up = "y"; // or z: of the model's file
    std::string variant;
    std::string animation;
    double time = 0;
    bool turntable = false; // for the command to say: cameras frame all that the model covers as it turns
    std::string size = "1280x720";
    std::string camera; // empty: the built-in scene's own, front for a model
    std::string device = "auto";
    std::string edges = "none"; // or triangles, seams, all
    std::string shading = "pbr";
    std::string lighting = "world";
    std::string normalMapping = "shading";
    std::string tangents = "stored";
    std::string environment = "studio"; // or none
    double environmentRotation = 0;     // degrees
    float environmentIntensity = 1;
    std::string background; // empty: by the environment
    std::string toneMapping = "neutral";
    std::string exposure = "auto"; // or a factor
    std::string ground = "on";
    double shadowSoftness = -1; // degrees that the light covers; negative: those of the lamp of the surroundings
    std::string rows = "down";
    std::string derivatives = "fine";
    int memory = kDefaultMemory;
    int samples = 4;
    bool noShadows = false;
    bool noNormalMaps = false;
    bool pointSampled = false;
    bool specularAntialiasing = false;

    // A model that is not in files, as LoadLimits has it; may be empty.
    std::function<Result<std::vector<std::byte>>(const std::string& name)> readFile;
    std::function<Result<Image>(std::span<const std::byte> bytes, const std::string& name)> decode;
};

} // namespace cotan
