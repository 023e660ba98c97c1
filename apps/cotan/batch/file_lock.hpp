// Locks of files that end with their object, and with the process: file_lock_posix.cpp, file_lock_windows.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

namespace cotan::app {

class FileLock {
public:
    enum State {
        missing,   // the file cannot be opened
        elsewhere, // another object has the lock
        unknown,   // the file system has no locks
        ours
    };

    FileLock();
    // Locks one byte of a file, which may be past its end. create: creates the file if it is missing.
    FileLock(const std::filesystem::path& file, std::uint64_t byte, bool create);
    FileLock(FileLock&&) noexcept;
    FileLock& operator=(FileLock&&) noexcept;
    ~FileLock();

    State state() const { return state_; }

private:
    struct System; // the open file
    std::unique_ptr<System> system_;
    State state_ = missing;
};

} // namespace cotan::app
