// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string>

#include "cotan/result.hpp"

namespace cotan::app {

// Writes text to a file: beside its place first, then renamed; pipes and devices are written to. Errors: ErrorKind::output.
Status writeFileWhole(const std::filesystem::path& file, const std::string& text);

// Whether the folder that a file is to be written to is there; for a look before long work. Errors: ErrorKind::output.
Status checkFolderOf(const std::filesystem::path& file);

} // namespace cotan::app
