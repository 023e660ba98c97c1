#include "batch/file_lock.hpp"

#include <cerrno>

#include <fcntl.h>

#include "files/sandbox/process.hpp"

namespace cotan::app {

struct FileLock::System {
    Descriptor file;
};

FileLock::FileLock() = default;
FileLock::FileLock(FileLock&&) noexcept = default;
FileLock& FileLock::operator=(FileLock&&) noexcept = default;
FileLock::~FileLock() = default;

FileLock::FileLock(const std::filesystem::path& file, std::uint64_t byte, bool create)
    : system_(std::make_unique<System>())
{
    system_->file = Descriptor(::open(file.c_str(), O_RDWR | O_CLOEXEC | (create ? O_CREAT : 0), 0666));
    if (system_->file.get() < 0)
        return;
    struct flock range {};
    range.l_type = F_WRLCK;
    range.l_whence = SEEK_SET;
    range.l_start = off_t(byte);
    range.l_len = 1;
    if (::fcntl(system_->file.get(), F_OFD_SETLK, &range) == 0)
        state_ = ours;
    else
        state_ = errno == EAGAIN || errno == EACCES ? elsewhere : unknown;
}

} // namespace cotan::app
