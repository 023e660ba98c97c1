#include "files/sandbox/process_windows.hpp"

#include <algorithm>
#include <array>
#include <system_error>

// After windows.h.
#include <psapi.h>

namespace cotan {

namespace {

constexpr double kMegabyte = 1 << 20;

// Ours with these changes, as CreateProcessW takes it: sorted, and case does not distinguish names.
std::wstring environmentWith(const std::map<std::string, std::string>& changes)
{
    const auto less = [](const std::wstring& a, const std::wstring& b) {
        return ::CompareStringOrdinal(a.data(), int(a.size()), b.data(), int(b.size()), TRUE) == CSTR_LESS_THAN;
    };
    std::map<std::wstring, std::wstring, decltype(less)> all(less);
    wchar_t* const ours = ::GetEnvironmentStringsW();
    for (std::wstring_view rest = ours; !rest.empty(); rest = rest.data() + rest.size() + 1) {
        const std::size_t sign = rest.find(L'=', 1); // names of folders of drives begin with it
        all[std::wstring(rest.substr(0, sign))] = sign == rest.npos ? L"" : rest.substr(sign + 1);
    }
    ::FreeEnvironmentStringsW(ours);
    for (const auto& [name, value] : changes)
        all[std::filesystem::path(name).native()] = std::filesystem::path(value).native();
    std::wstring block;
    for (const auto& [name, value] : all)
        block += name + L"=" + value + L'\0';
    return block + L'\0';
}

// As the C runtime of the child takes a word apart again:
// https://learn.microsoft.com/cpp/c-language/parsing-c-command-line-arguments
std::wstring quoted(const std::wstring& word)
{
    std::wstring text = L"\"";
    std::size_t backslashes = 0;
    for (const wchar_t letter : word) {
        if (letter == L'"')
            text.append(backslashes + 1, L'\\'); // doubles those before a quotation mark, and escapes it
        backslashes = letter == L'\\' ? backslashes + 1 : 0;
        text += letter;
    }
    return text.append(backslashes, L'\\') + L"\"";
}

} // namespace

std::string lastReason() { return std::system_category().message(int(::GetLastError())); }

Handle endingJob()
{
    Handle job(::CreateJobObjectW(nullptr, nullptr));
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
    ::SetInformationJobObject(job.get(), JobObjectExtendedLimitInformation, &limits, sizeof limits);
    return job;
}

double processorSeconds(HANDLE process)
{
    FILETIME created{}, ended{}, kernel{}, user{};
    ::GetProcessTimes(process, &created, &ended, &kernel, &user);
    const auto seconds = [](const FILETIME& t) { return 1e-7 * (4294967296.0 * t.dwHighDateTime + t.dwLowDateTime); };
    return seconds(kernel) + seconds(user);
}

double megabytesOf(HANDLE process)
{
    PROCESS_MEMORY_COUNTERS counters{};
    ::K32GetProcessMemoryInfo(process, &counters, sizeof counters);
    return double(std::max(counters.PagefileUsage, counters.WorkingSetSize)) / kMegabyte;
}

double peakMegabytesOf(HANDLE job)
{
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION found{};
    ::QueryInformationJobObject(job, JobObjectExtendedLimitInformation, &found, sizeof found, nullptr);
    return double(found.PeakProcessMemoryUsed) / kMegabyte;
}

bool Pipe::open(bool childReads)
{
    HANDLE read = nullptr, write = nullptr;
    if (::CreatePipe(&read, &write, nullptr, 1 << 16) == 0)
        return false;
    ours = Handle(childReads ? write : read);
    childs = Handle(childReads ? read : write);
    return ::SetHandleInformation(childs.get(), HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT) != 0;
}

std::size_t readPipe(HANDLE pipe, std::span<std::byte> bytes)
{
    DWORD got = 0;
    const DWORD most = DWORD(std::min<std::size_t>(bytes.size(), 1u << 30));
    return ::ReadFile(pipe, bytes.data(), most, &got, nullptr) != 0 ? got : 0;
}

std::string spawn(const SpawnRequest& request, Handle& process)
{
    std::wstring line = quoted(request.program.native());
    for (const std::string& argument : request.arguments)
        line += L" " + quoted(std::filesystem::path(argument).native());

    // The child inherits its standard streams and nothing else. The list holds each handle once.
    std::vector<HANDLE> inherited;
    for (const HANDLE handle : {request.input, request.output, request.error})
        if (handle != nullptr && std::ranges::find(inherited, handle) == inherited.end())
            inherited.push_back(handle);
    SIZE_T size = 0;
    ::InitializeProcThreadAttributeList(nullptr, 1, 0, &size);
    std::vector<std::byte> attributes(size);
    STARTUPINFOEXW startup{};
    startup.lpAttributeList = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(attributes.data());
    startup.StartupInfo.cb = sizeof startup;
    startup.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
    startup.StartupInfo.hStdInput = request.input;
    startup.StartupInfo.hStdOutput = request.output;
    startup.StartupInfo.hStdError = request.error;
    if (::InitializeProcThreadAttributeList(startup.lpAttributeList, 1, 0, &size) == 0
        || ::UpdateProcThreadAttribute(startup.lpAttributeList, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, inherited.data(),
                                       inherited.size() * sizeof(HANDLE), nullptr, nullptr)
            == 0)
        return lastReason();
    std::wstring environment = request.environment.empty() ? L"" : environmentWith(request.environment);
    PROCESS_INFORMATION started{};
    const BOOL fine =
        ::CreateProcessW(request.program.c_str(), line.data(), nullptr, nullptr, TRUE,
                         EXTENDED_STARTUPINFO_PRESENT | CREATE_SUSPENDED | CREATE_NO_WINDOW | CREATE_UNICODE_ENVIRONMENT
                             | CREATE_NEW_PROCESS_GROUP, // so that Ctrl-C reaches only us
                         request.environment.empty() ? nullptr : environment.data(),
                         request.folder.empty() ? nullptr : request.folder.c_str(), &startup.StartupInfo, &started);
    const std::string why = fine ? std::string() : lastReason();
    ::DeleteProcThreadAttributeList(startup.lpAttributeList);
    if (!fine)
        return why;
    process = Handle(started.hProcess);
    ::AssignProcessToJobObject(request.job, process.get()); // fails inside of jobs before Windows 8: then without
    ::ResumeThread(started.hThread);
    ::CloseHandle(started.hThread);
    return {};
}

} // namespace cotan
