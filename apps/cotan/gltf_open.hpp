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

// Opens a model for editing, and prints the warnings of its scene. The whole file is checked, except images that
// `limits` leaves out: models that cannot be drawn are not rewritten. Errors: those of openGltf.
Result<OpenGltf> openGltfToEdit(const std::string& model, const LoadLimits& limits, const CommonOptions& common);

// The option --compress of commands that write models: a word of modelCompressionWords; and its check, as
// checkModelCompression.
void addModelCompress(Arguments& command, std::string& compress);
Status checkModelCompress(const std::string& compress);

// The names of the written files, for a report.
std::vector<std::string> fileNames(const GltfWritten& written);

} // namespace cotan::app
