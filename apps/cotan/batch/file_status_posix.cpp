#include <sys/stat.h>

#include "batch/record.hpp"

namespace cotan::app {

namespace {

std::int64_t nanoseconds(const timespec& time) { return std::int64_t(time.tv_sec) * 1'000'000'000 + time.tv_nsec; }

} // namespace

std::int64_t fileClockNanoseconds()
{
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME_COARSE, &now);
    return nanoseconds(now);
}

FileState statusOf(const std::filesystem::path& path, const std::string& file)
{
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0)
        return {.file = file, .digest = "missing"};
    if (!S_ISREG(status.st_mode)) // the files within a folder have states of their own
        return {.file = file, .digest = S_ISDIR(status.st_mode) ? "folder" : "special"};
    FileState state{.file = file, .digest = {}, .bytes = std::uint64_t(status.st_size)};
    state.modified = nanoseconds(status.st_mtim);
    state.changed = nanoseconds(status.st_ctim);
    state.number = status.st_ino;
    return state;
}

} // namespace cotan::app
