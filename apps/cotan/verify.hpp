// --verify: what was made is drawn and compared, and the pictures go into a folder.
#pragma once

#include <filesystem>
#include <string>

#include "common.hpp"
#include "cotan/frame.hpp"
#include "inspect/verify/verify_bake.hpp"

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

// Draw, write the pictures, say the degrees, and return them for a report.
// Errors: of loading, drawing and writing.
Result<Json> verifyConversion(const VerifyOptions& options, const CommonOptions& common);
Result<Json> verifyBake(const BakeToVerify& bake, const std::string& device, const std::filesystem::path& folder,
                        const CommonOptions& common);

} // namespace cotan::app
