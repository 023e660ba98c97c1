// Files that appear whole or not at all: written beside their place first, then renamed. The one way in which files are
// written here. Whatever fails or interrupts, nothing is left behind and an older file stays as it was; only SIGKILL
// leaves a part, which leftParts() finds.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "cotan/result.hpp"
#include "files/interrupt.hpp"

namespace cotan {

// A fresh name beside a file, to be written to and then committed. What is not committed is removed. Pipes and devices
// have no name beside them: they are written to.
class OutputFile {
public:
    // A symbolic link stays, and what it leads to is written. Errors: ErrorKind::output where the folder is missing or
    // `file` is a folder; those of beginOutput.
    static Result<OutputFile> begin(const std::filesystem::path& file);

    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&&) = delete;
    ~OutputFile();

    const std::filesystem::path& path() const { return part_; }  // keeps the file's extension
    const std::filesystem::path& place() const { return file_; } // where it will be
    // Puts it in its place. Errors: ErrorKind::output.
    Status commit();
    // A writer's error in the user's words: the name that he gave for that of the part, and the system's reason, such
    // as a full disk, where a trial finds it.
    Error failed(const Error& error) const;

private:
    OutputFile(std::filesystem::path file, std::filesystem::path part, bool special);

    std::filesystem::path file_, part_;
    bool special_; // a pipe or a device
    bool gone_ = false;
    GuardedPart guard_;
};

// All of them or none; the last is put in its place last. Interrupts wait. Where one cannot be renamed, those before it
// that were new are removed; those that replaced a file stay. Errors: ErrorKind::output.
Status commitTogether(std::span<OutputFile> files);

// Writes bytes to a name as it is, in place. Errors: ErrorKind::output with the system's reason.
Status writeBytes(const std::filesystem::path& file, std::span<const std::byte> bytes);

// The same whole or not at all.
Status writeFileWhole(const std::filesystem::path& file, std::string_view text);

// Whether a file can come to be there: no folder in the way, the folder there and open to writing; for a look before
// long work. makesFolder: the folder will be made where it is missing. Errors: ErrorKind::output.
Status checkWritable(const std::filesystem::path& file, bool makesFolder = false);

// Parts in a folder whose processes are no more: what SIGKILL or a crash left.
std::vector<std::filesystem::path> leftParts(const std::filesystem::path& folder);

// Removes the parts of one process of this machine, which has ended.
void removeParts(const std::filesystem::path& folder, pid_t process);

// "no space left on the device", "permission denied": the system's reason for an errno.
std::string reasonOf(int number);

// Makes a folder and those above it. Errors: ErrorKind::output.
Status makeFolder(const std::filesystem::path& folder);

} // namespace cotan
