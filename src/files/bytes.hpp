// Files that are read: their kind by their name, their bytes with checks before memory is taken, and the only folder
// that a model may open files from.
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

// ".png" of "A.PNG".
inline std::string lowerExtension(const std::filesystem::path& file) { return lowerCase(file.extension().string()); }

// The folder that a file is in; "." of a bare name.
inline std::filesystem::path folderOf(const std::filesystem::path& file)
{
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

// The size in bytes of a regular file that may be read.
// isInput: false for an older output that the new one replaces: noteInput does not hear of it.
// Errors (ErrorKind::input): missing, not a regular file, empty, over `limit` bytes; those of noteInput.
Result<std::size_t> usableFileSize(const std::filesystem::path& file, std::size_t limit, bool isInput = true);

// All bytes of a regular file of at most `limit` bytes. isInput: as for usableFileSize.
// Errors (ErrorKind::input): missing, not a regular file, empty, too large, not readable; those of noteInput.
Result<std::vector<std::byte>> readFileBytes(const std::filesystem::path& file, std::size_t limit, bool isInput = true);

// The file that `request`, as a model writes it, stands for: relative to `folder` (canonical), with
// either slash. Nothing where it is missing or leads out of the folder, by an absolute path, by
// ".." or by a symbolic link; `outside` is set in the latter case.
std::optional<std::filesystem::path> findInFolder(const std::filesystem::path& folder, std::string request,
                                                  bool& outside);

} // namespace cotan
