#include "batch/record.hpp"
#include "files/sandbox/process_windows.hpp"

namespace cotan::app {

namespace {

constexpr std::int64_t kUntil1970 = 116'444'736'000'000'000; // units of 100 ns from 1601, where its clock begins

std::int64_t nanoseconds(std::int64_t time) { return (time - kUntil1970) * 100; }

} // namespace

std::int64_t fileClockNanoseconds()
{
    FILETIME now{};
    ::GetSystemTimeAsFileTime(&now);
    return nanoseconds(std::int64_t(std::uint64_t(now.dwHighDateTime) << 32 | now.dwLowDateTime));
}

FileState statusOf(const std::filesystem::path& path, const std::string& file)
{
    Handle handle(::CreateFileW(path.c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                                OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr));
    BY_HANDLE_FILE_INFORMATION found{};
    FILE_BASIC_INFO times{};
    if (handle.get() == INVALID_HANDLE_VALUE)
        return {.file = file, .digest = "missing"};
    if (::GetFileType(handle.get()) != FILE_TYPE_DISK || ::GetFileInformationByHandle(handle.get(), &found) == 0
        || ::GetFileInformationByHandleEx(handle.get(), FileBasicInfo, &times, sizeof times) == 0)
        return {.file = file, .digest = "special"};
    if ((found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0) // the files within have states of their own
        return {.file = file, .digest = "folder"};
    FileState state{.file = file, .digest = {}, .bytes = std::uint64_t(found.nFileSizeHigh) << 32 | found.nFileSizeLow};
    state.modified = nanoseconds(times.LastWriteTime.QuadPart);
    state.changed = nanoseconds(times.ChangeTime.QuadPart);
    state.number = std::uint64_t(found.nFileIndexHigh) << 32 | found.nFileIndexLow;
    return state;
}

} // namespace cotan::app
