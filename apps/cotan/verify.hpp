// Whether a converted model looks like the original: both drawn from several sides, normals compared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common.hpp"
#include "cotan/frame.hpp"
#include "cotan/surface/vertex_frames.hpp"
#include "memory_limit.hpp"

namespace cotan::app {

struct VerifyOptions {
    std::filesystem::path before, after; // models
    Frame from = Frame::mikktspace, to = Frame::cotangent;
    TangentOrigin fromTangents = TangentOrigin::stored; // of the original
    std::filesystem::path folder;        // for before-N.png, after-N.png, difference-N.png
    std::string device = "auto";
    int memory = kDefaultMemory;
};

// The names of the pictures that verifyConversion writes.
std::vector<std::string> verifyPictures();

// Draws both from five sides, writes the pictures, says the degrees, and returns them for a report.
// Errors: of loading, drawing and writing.
Result<nlohmann::ordered_json> verifyConversion(const VerifyOptions& options, const CommonOptions& common);

} // namespace cotan::app
