// Whole files in, with checks before memory is taken.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "cotan/result.hpp"

namespace cotan {

// The size in bytes of a regular file that may be read.
// Errors (ErrorKind::input): missing, not a regular file, empty, over `limit` bytes; those of noteInput.
Result<std::size_t> usableFileSize(const std::filesystem::path& file, std::size_t limit);

// All bytes of a regular file of at most `limit` bytes.
// Errors (ErrorKind::input): missing, not a regular file, empty, too large, not readable; those of noteInput.
Result<std::vector<std::byte>> readFileBytes(const std::filesystem::path& file, std::size_t limit);

// The same of an older output, which the new one replaces: no input, so noteInput does not hear of it.
Result<std::vector<std::byte>> readReplacedBytes(const std::filesystem::path& file, std::size_t limit);

} // namespace cotan
