// What the commands that rewrite glTF files have in common.
#pragma once

#include <string>
#include <vector>

#include "common.hpp"
#include "cotan/gltf.hpp"

namespace cotan::app {

// Whether a file is named as glTF, .gltf or .glb in any case.
bool namedAsGltf(const std::filesystem::path& file);

// Whether MODEL is named as glTF. Errors: ErrorKind::usage, also for an -o that is not .gltf or .glb in
// lower case. No -o is no error here.
Status checkGltfNames(const std::string& model, const std::filesystem::path& output);

struct OpenedGltf {
    GltfDocument document;
    std::vector<std::string> warnings; // of loading; the user has been told
};

// Opens a model to change it. Everything in the file is looked at but the pixels of its images: what cannot be
// shown is not rewritten. Errors: ErrorKind::input.
Result<OpenedGltf> openGltfToEdit(const std::string& model, const CommonOptions& common);

// Writes it where -o says, and warns of what the user should know. Errors: as writeGltf.
Result<GltfWritten> writeGltfWithProgress(const GltfDocument& document, const CommonOptions& common);

// The files that were written, for a report.
std::vector<std::string> fileNames(const GltfWritten& written);

} // namespace cotan::app
