#include <algorithm>
#include <cerrno>
#include <string_view>

#include <fcntl.h>
#include <io.h>

#include "core/windows.hpp"
#include "files/system/system.hpp"
// After windows.h.
#include <psapi.h>

namespace cotan {

namespace fs = std::filesystem;

std::FILE* openStream(const fs::path& file, const char* mode)
{
    const std::string_view narrow(mode);
    return ::_wfopen(file.c_str(), (std::wstring(narrow.begin(), narrow.end()) + L"N").c_str());
}

std::ptrdiff_t writeSome(std::FILE* file, const void* bytes, std::size_t size)
{
    constexpr std::size_t kMost = 1u << 30; // _write takes an unsigned and returns an int
    return ::_write(::_fileno(file), bytes, unsigned(std::min(size, kMost)));
}

bool meansFull(int number) { return number == ENOSPC; }

// Access lists are not asked for: creating the file tells.
bool mayWrite(const fs::path& file)
{
    const DWORD attributes = ::GetFileAttributesW(file.c_str());
    const bool writable = attributes != INVALID_FILE_ATTRIBUTES
        && ((attributes & FILE_ATTRIBUTE_DIRECTORY) != 0 || (attributes & FILE_ATTRIBUTE_READONLY) == 0);
    if (!writable)
        errno = attributes == INVALID_FILE_ATTRIBUTES ? ENOENT : EACCES;
    return writable;
}

FileKind fileNumber(const fs::path& file, FileNumber& number)
{
    const HANDLE handle = ::CreateFileW(file.c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                        nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    if (handle == INVALID_HANDLE_VALUE)
        return FileKind::missing;
    BY_HANDLE_FILE_INFORMATION found{};
    const bool disk = ::GetFileType(handle) == FILE_TYPE_DISK;
    const bool known = disk && ::GetFileInformationByHandle(handle, &found) != 0;
    ::CloseHandle(handle);
    if (!disk)
        return FileKind::special;
    if (!known)
        return FileKind::missing;
    number = {found.dwVolumeSerialNumber, std::uint64_t(found.nFileIndexHigh) << 32 | found.nFileIndexLow};
    return FileKind::file;
}

bool isNameOfDevice(const fs::path&) { return false; }

bool onWindows() { return true; }

pid_t thisProcess() { return pid_t(::GetCurrentProcessId()); }

bool isRunning(pid_t process)
{
    const HANDLE handle = ::OpenProcess(SYNCHRONIZE, FALSE, DWORD(process));
    if (handle == nullptr)
        return ::GetLastError() != ERROR_INVALID_PARAMETER;
    const bool running = ::WaitForSingleObject(handle, 0) == WAIT_TIMEOUT;
    ::CloseHandle(handle);
    return running;
}

std::string machineName()
{
    wchar_t text[256] = L"";
    DWORD size = 256;
    ::GetComputerNameW(text, &size);
    return fs::path(text).string();
}

std::string systemName()
{
    // The only call that tells the version to programs whose manifest names another.
    using GetVersion = LONG(WINAPI*)(OSVERSIONINFOW*);
    OSVERSIONINFOW v{};
    v.dwOSVersionInfoSize = sizeof v;
    if (const auto call = ::GetProcAddress(::GetModuleHandleW(L"ntdll.dll"), "RtlGetVersion"))
        reinterpret_cast<GetVersion>(reinterpret_cast<void*>(call))(&v);
    const auto number = [](DWORD n) { return std::to_string(n); };
    return "Windows " + number(v.dwMajorVersion) + "." + number(v.dwMinorVersion) + "." + number(v.dwBuildNumber)
        + ", x86_64";
}

double machineMemory()
{
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof status;
    return ::GlobalMemoryStatusEx(&status) != 0 ? double(status.ullTotalPhys) : 0;
}

double peakMemory()
{
    PROCESS_MEMORY_COUNTERS counters{};
    return ::K32GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof counters) != 0
        ? double(counters.PeakWorkingSetSize)
        : 0;
}

} // namespace cotan
