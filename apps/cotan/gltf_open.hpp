// Shared by the commands that rewrite glTF files.
#pragma once

#include <string>
#include <vector>

#include "common.hpp"
#include "cotan/gltf.hpp"

namespace cotan::app {

// Whether the extension is .gltf or .glb, in any case.
bool namedAsGltf(const std::filesystem::path& file);

// Checks that MODEL, and -o if given, have a glTF extension. Errors: ErrorKind::usage.
Status checkGltfNames(const std::string& model, const std::filesystem::path& output);

struct OpenedGltf {
    GltfDocument document;
    std::vector<std::string> warnings; // of loading, already printed
};

// Opens a model for editing. The whole file is checked, except the pixels of its images: models that cannot be drawn
// are not rewritten. Errors: ErrorKind::input.
Result<OpenedGltf> openGltfToEdit(const std::string& model, const CommonOptions& common);

// Writes the document to -o and prints its notes as warnings. Errors: as writeGltf.
Result<GltfWritten> writeGltfWithProgress(const GltfDocument& document, const CommonOptions& common);

// The names of the written files, for a report.
std::vector<std::string> fileNames(const GltfWritten& written);

} // namespace cotan::app
