// Reading files: type by extension, bytes with checks before memory is allocated, and lookup confined to a folder.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/named_values.hpp"
#include "cotan/result.hpp"

namespace cotan {

// The lower-case extension: ".png" for "A.PNG".
inline std::string lowerExtension(const std::filesystem::path& file) { return lowerCase(file.extension().string()); }

// The folder of a file; "." for a bare name.
inline std::filesystem::path folderOf(const std::filesystem::path& file)
{
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

// Returns the size in bytes of a regular file.
// isInput: false for an old output that will be replaced; it is not reported to noteInput.
// Errors: ErrorKind::input for a missing, not regular or empty file, or one over `limit` bytes; those of noteInput.
Result<std::size_t> usableFileSize(const std::filesystem::path& file, std::size_t limit, bool isInput = true);

// Returns all bytes of a regular file of at most `limit` bytes. isInput: as for usableFileSize.
// Errors: those of usableFileSize; ErrorKind::input if the file cannot be read.
Result<std::vector<std::byte>> readFileBytes(const std::filesystem::path& file, std::size_t limit, bool isInput = true);

// Returns the text of a file or a pipe, which may be empty. isInput: as for usableFileSize.
// Errors: ErrorKind::input if it cannot be read or has more than `limit` bytes; those of noteInput.
Result<std::string> readText(const std::filesystem::path& file, bool isInput = true,
                             std::size_t limit = std::size_t(64) << 20);

// Resolves a file name from a model, with either kind of slash, relative to `folder` (canonical). Returns nothing if
// the file is missing or leads out of the folder by an absolute path, ".." or a symbolic link, which sets `outside`.
std::optional<std::filesystem::path> findInFolder(const std::filesystem::path& folder, std::string request,
                                                  bool& outside);

} // namespace cotan
