// --verify: what was made is drawn and compared, and the pictures go into a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common.hpp"
#include "cotan/frame.hpp"
#include "verify_bake.hpp"

namespace cotan::app {

// A converted model and the original.
struct VerifyOptions {
    std::filesystem::path before, after; // models
    Frame from = Frame::mikktspace, to = Frame::cotangent;
    TangentOrigin fromTangents = TangentOrigin::stored; // of the original
    std::filesystem::path folder;                       // for before-N.png, after-N.png, difference-N.png
    std::string device;
    int memory = 0;
};

// What the pictures of a view are called: NAME-0.png, NAME-1.png and so on.
struct ViewNames {
    const char *expected, *drawn, *difference;
};

inline constexpr ViewNames kConversionNames = {"before", "after", "difference"}, kBakeNames = {"high", "low", "error"};

// The files of so many views.
std::vector<std::string> picturesOf(const ViewNames& names, std::size_t views);

// Draw, write the pictures, say the degrees, and return them for a report.
// Errors: of loading, drawing and writing.
Result<Json> verifyConversion(const VerifyOptions& options, const CommonOptions& common);
Result<Json> verifyBake(const BakeToVerify& bake, const std::string& device, const std::filesystem::path& folder,
                        const CommonOptions& common);

} // namespace cotan::app
