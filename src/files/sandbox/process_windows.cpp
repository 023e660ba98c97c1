#include "files/sandbox/process_windows.hpp"

#include <algorithm>
#include <array>
#include <system_error>

namespace cotan {

namespace {

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
    PROCESS_INFORMATION started{};
    const BOOL fine = ::CreateProcessW(request.program.c_str(), line.data(), nullptr, nullptr, TRUE,
                                       EXTENDED_STARTUPINFO_PRESENT | CREATE_SUSPENDED | CREATE_NO_WINDOW
                                           | CREATE_NEW_PROCESS_GROUP, // so that Ctrl-C reaches only us
                                       nullptr, nullptr, &startup.StartupInfo, &started);
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
