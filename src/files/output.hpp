// Atomic output files: written to a temporary file (a part) beside their destination, then renamed. All files are
// written in this way: nothing else opens files for writing, so that nothing can replace an input (a test checks it).
// On failure or interruption nothing is left behind and an older file is unchanged; only SIGKILL leaves a part, which
// leftParts() finds.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "cotan/result.hpp"
#include "files/bytes.hpp"
#include "files/interrupt.hpp"

namespace cotan {

// A file to write: open it, write, then commit. It has a temporary name beside its destination, and is removed unless
// it is committed. Pipes and devices are written to directly.
class OutputFile {
public:
    // Follows symbolic links. Errors: ErrorKind::output for a missing folder or if `file` is one; those of beginOutput.
    static Result<OutputFile> begin(const std::filesystem::path& file);

    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&&) = delete;
    ~OutputFile();

    // Opens the file, empty, in binary mode. reads: also for reading. The only function that opens files for writing.
    // Errors: ErrorKind::output with the system's reason.
    Result<OpenFile> open(bool reads = false) const;

    const std::filesystem::path& path() const { return part_; } // the temporary name; it keeps the file's extension
    const std::filesystem::path& destination() const { return file_; }
    // Renames the temporary file to its destination. Errors: ErrorKind::output; those of mayAppear.
    Status commit();
    // Rewords a writer's error for the user: the destination replaces the temporary name, and a test write adds the
    // system's reason, such as a full disk.
    Error failed(const Error& error) const;

private:
    OutputFile(std::filesystem::path file, std::filesystem::path part, bool special);

    std::filesystem::path file_, part_;
    bool special_; // a pipe or a device
    bool gone_ = false;
    GuardedPart guard_;
};

// Commits all files or, as far as possible, none; the last one last. Interrupts are delayed. If a file cannot be
// renamed, those committed before it are removed if they were new; those that replaced a file stay. Errors:
// ErrorKind::output.
Status commitTogether(std::span<OutputFile> files);

using ByteBlocks = std::vector<std::span<const std::byte>>;

// Writes the whole content of a file, block after block, without committing it. Errors: ErrorKind::output with the
// system's reason.
Status writeBytes(const OutputFile& file, const ByteBlocks& blocks);

// Writes text through an OutputFile.
Status writeFileWhole(const std::filesystem::path& file, std::string_view text);

// Checks before long work whether a file can be created: it is not a folder, and its folder exists and is writable.
// makesFolder: a missing folder will be created. Errors: ErrorKind::output.
Status checkWritable(const std::filesystem::path& file, bool makesFolder = false);

// Temporary files in a folder whose processes no longer exist, after SIGKILL or a crash.
std::vector<std::filesystem::path> leftParts(const std::filesystem::path& folder);

// Removes the temporary files of a process of this machine that has ended.
void removeParts(const std::filesystem::path& folder, pid_t process);

// The system's reason for an errno: "no space left on the device", "permission denied".
std::string reasonOf(int number);

// Creates a folder and its parents. Errors: ErrorKind::output.
Status makeFolder(const std::filesystem::path& folder);

} // namespace cotan
