// What files hold, as short texts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>

namespace cotan {

// 32 hexadecimal digits: XXH3 of 128 bits, as fast as memory. Two contents meet by chance with a probability of 3e-39;
// somebody who wants them to meet can do so.
std::string digestOf(std::string_view text);

// What a file was found to be.
struct FileState {
    std::string file;   // relative to the folder of the jobs where it is within
    std::string digest; // of its contents; "missing", "folder", "special" or "unreadable" for what has none
    std::uint64_t bytes = 0;
    // How a change is noticed without reading: nanoseconds since 1970, the number of the file in its file system.
    std::int64_t modified = 0, changed = 0;
    std::uint64_t number = 0;
};

// Nanoseconds since 1970, now.
std::int64_t nowNanoseconds();

// The same by the clock of file systems, which goes in steps of some milliseconds: a file that is written later is
// never changed earlier than that, but it can be changed earlier than nowNanoseconds().
std::int64_t fileClockNanoseconds();

// The states of files in a folder. A file is read once, and again only where the system says that it was touched.
class FileStates {
public:
    explicit FileStates(std::filesystem::path folder) : folder_(std::move(folder)) {}

    FileState of(const std::string& file);

    // Whether a file still holds what it held at `at`, when `recorded` was taken. Reads it only where the system's
    // times leave room for doubt: what changed less than two seconds before it was looked at may change unnoticed.
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
