// The result of a job, its storage format, and the detection of changed files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace cotan::app {

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

// Everything but the digest of the contents, unless there are none: file_status_posix.cpp, file_status_windows.cpp.
FileState statusOf(const std::filesystem::path& path, const std::string& file);

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

// Ordered from good to bad.
enum class JobState {
    done,
    limit,   // done, but a limit of its command was exceeded: exit code 5
    notRun,  // no run yet, or none with the present inputs
    skipped, // a job it depends on failed
    failed,  // any other exit code
    late,    // exceeded its time limit
    memory,  // needed more memory than its limit
    crashed, // killed by a signal
};

// "done", "over limit", "not run", "skipped", "failed", "too slow", "out of memory", "crashed".
std::string_view name(JobState state);

struct Degrees {
    double mean = 0;
    std::string of; // what they measure, in a few words
};

struct Thumbnail {
    int width = 0, height = 0; // pixels
    std::string jpeg;          // the file in base64; empty: none
};

struct JobRecord {
    JobState state = JobState::notRun;
    std::optional<int> code;   // exit code; none if it did not run or a signal ended it
    std::optional<int> signal; // the signal that ended it
    int runs = 0;              // number of runs so far
    std::string reason;        // one line: why it is not done
    std::string output;        // beginning and end of its output
    double seconds = 0, processorSeconds = 0;
    double megabytes = 0; // maximum memory in use, in MiB
    std::optional<Degrees> degrees;
    Thumbnail thumbnail;
    std::vector<FileState> inputs, outputs;
    std::int64_t at = 0; // when the states of the files were taken: nanoseconds since 1970
};

inline bool isGood(const JobRecord& record)
{
    return record.state == JobState::done || record.state == JobState::limit;
}

// Whether a repeated run with the same inputs would end the same way; not if a limit, a signal or the machine ended it.
bool repeatable(const JobRecord& record);

// One line of JSON, with the words and the version for people who inspect a store.
std::string toText(const JobRecord& record, const std::vector<std::string>& words, const std::string& version);

// Returns nullopt for damaged records and other formats.
std::optional<JobRecord> parseRecord(std::string_view text);

// The degrees in a command's JSON report; nullopt if it has none.
std::optional<Degrees> degreesIn(std::string_view report);

// A JPEG of at most 64 x 64 pixels and about two kilobytes, with transparent pixels over grey. Only a few rows of the
// image are in memory at a time. Returns nullopt for files that are not images.
std::optional<Thumbnail> thumbnailOf(const std::filesystem::path& image);

} // namespace cotan::app
