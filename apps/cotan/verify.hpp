// --verify: draws the result, compares it, and writes the images into a folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common.hpp"
#include "cotan/frame.hpp"
#include "cotan/picture.hpp"
#include "verify_bake.hpp"

namespace cotan::app {

// A converted model and the original.
struct VerifyOptions {
    std::filesystem::path before, after; // models
    Frame from = Frame::mikktspace;
    std::optional<Frame> to = Frame::cotangent;         // none: those that the primitives of `after` name
    TangentOrigin fromTangents = TangentOrigin::stored; // of the original
    std::filesystem::path folder;                       // for before-N.png, after-N.png, difference-N.png
    std::string device = "auto";
    int memory = kDefaultMemory;
};

// Name parts of a view's images: NAME-0.png, NAME-1.png etc.
struct ViewNames {
    const char *expected, *drawn, *difference;
};

inline constexpr ViewNames kConversionNames = {"before", "after", "difference"}, kBakeNames = {"high", "low", "error"};

// The file names of the images of `views` views.
std::vector<std::string> imageNames(const ViewNames& names, std::size_t views);

// Both draw, write the images, print the degrees, and return them for a report.
// Errors: those of loading, drawing and writing.
Result<Json> verifyConversion(const VerifyOptions& options, const CommonOptions& common);
Result<Json> verifyBake(const BakeToVerify& bake, const std::string& device, const std::filesystem::path& folder,
                        const CommonOptions& common);

} // namespace cotan::app
