// Digests of file contents, and detection of changed files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>

namespace cotan {

// The 128-bit XXH3 hash as 32 hexadecimal digits; as fast as memory. Two contents collide by chance with a probability
// of 3e-39, but collisions can be constructed on purpose.
std::string digestOf(std::string_view text);

// The state of a file at some time.
struct FileState {
    std::string file;   // relative to the folder of the jobs if it is inside
    std::string digest; // of the contents; else "missing", "folder", "special" or "unreadable"
    std::uint64_t bytes = 0;
    // These reveal a change without reading: nanoseconds since 1970, and the inode number.
    std::int64_t modified = 0, changed = 0;
    std::uint64_t number = 0;
};

// The present time in nanoseconds since 1970.
std::int64_t nowNanoseconds();

// The same by the clock of file systems, which advances in steps of a few milliseconds: files written later never have
// an earlier time of change, while they may have one before nowNanoseconds().
std::int64_t fileClockNanoseconds();

// Caches the states of files in a folder. A file is read once, and again only if its metadata has changed.
class FileStates {
public:
    explicit FileStates(std::filesystem::path folder) : folder_(std::move(folder)) {}

    FileState of(const std::string& file);

    // Whether a file has the same contents as when `recorded` was taken, at `at`. Reads the file only if its times are
    // inconclusive: within two seconds of a change, another may leave the times as they are.
    bool holds(const FileState& recorded, std::int64_t at);

private:
    struct Known {
        FileState state;
        std::int64_t at = 0;
    };
    std::filesystem::path folder_;
    std::unordered_map<std::string, Known> known_;
};

} // namespace cotan
