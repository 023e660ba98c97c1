#include "batch/file_lock.hpp"
#include "files/sandbox/process_windows.hpp"

namespace cotan::app {

struct FileLock::System {
    Handle file;
};

FileLock::FileLock() = default;
FileLock::FileLock(FileLock&&) noexcept = default;
FileLock& FileLock::operator=(FileLock&&) noexcept = default;
FileLock::~FileLock() = default;

FileLock::FileLock(const std::filesystem::path& file, std::uint64_t byte, bool create)
    : system_(std::make_unique<System>())
{
    system_->file = Handle(::CreateFileW(file.c_str(), GENERIC_READ | GENERIC_WRITE,
                                         FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                                         create ? OPEN_ALWAYS : OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr));
    if (system_->file.get() == INVALID_HANDLE_VALUE)
        return;
    OVERLAPPED range{};
    range.Offset = DWORD(byte);
    range.OffsetHigh = DWORD(byte >> 32);
    if (::LockFileEx(system_->file.get(), LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &range) != 0)
        state_ = ours;
    else
        state_ = ::GetLastError() == ERROR_LOCK_VIOLATION || ::GetLastError() == ERROR_IO_PENDING ? elsewhere : unknown;
}

} // namespace cotan::app
