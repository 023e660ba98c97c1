// Whole files in and out, with checks before memory is taken.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "cotan/result.hpp"

namespace cotan {

// The size in bytes of a regular file that may be read.
// Errors (ErrorKind::input): missing, not a regular file, empty, over `limit` bytes.
Result<std::size_t> usableFileSize(const std::filesystem::path& file, std::size_t limit);

// All bytes of a regular file of at most `limit` bytes.
// Errors (ErrorKind::input): missing, not a regular file, empty, too large, not readable.
Result<std::vector<std::byte>> readFileBytes(const std::filesystem::path& file, std::size_t limit);

// Calls `write` with a fresh name in the folder of `file` and with its extension, and renames the
// result to `file`. Whatever fails, nothing is left behind and an older `file` stays as it was.
// Errors: those of `write`; ErrorKind::output where the folder is missing or renaming fails.
Status writeBeside(const std::filesystem::path& file,
                   const std::function<Status(const std::filesystem::path&)>& write);

// The same in steps: a fresh name beside `file`, to be written to and then committed. What is not
// committed is removed.
class BesideFile {
public:
    // Errors: ErrorKind::output where the folder is missing or `file` is a folder.
    static Result<BesideFile> begin(const std::filesystem::path& file);

    BesideFile(BesideFile&& other) noexcept;
    BesideFile& operator=(BesideFile&&) = delete;
    ~BesideFile();
    const std::filesystem::path& path() const { return beside_; }
    Status commit(); // renames; errors: ErrorKind::output

private:
    explicit BesideFile(std::filesystem::path file);
    std::filesystem::path file_, beside_; // beside_ is empty once it is gone
};

} // namespace cotan
