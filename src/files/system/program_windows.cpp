#include "files/system/program.hpp"

#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <io.h>

#include "core/windows.hpp"
// After windows.h.
#include <shellapi.h>

namespace cotan {

namespace fs = std::filesystem;

// The words of main() are in the code page of this machine, which cannot hold all names of files.
std::vector<std::string> beginProgram(int, char**)
{
    for (const int stream : {0, 1, 2})
        ::_setmode(stream, _O_BINARY); // the same bytes as on other systems
    ::SetConsoleOutputCP(CP_UTF8);
    int count = 0;
    wchar_t** const wide = ::CommandLineToArgvW(::GetCommandLineW(), &count);
    std::vector<std::string> words;
    for (int i = 0; i < count; ++i)
        words.push_back(fs::path(wide[i]).string());
    ::LocalFree(wide);
    return words;
}

// Windows cannot replace a process: this one waits for the other and ends as it does.
std::string becomeProgram(const fs::path& program)
{
    std::wstring line = ::GetCommandLineW();
    STARTUPINFOW startup{};
    startup.cb = sizeof startup;
    PROCESS_INFORMATION started{};
    if (::CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE, 0, nullptr, nullptr, &startup, &started)
        == 0)
        return std::system_category().message(int(::GetLastError()));
    DWORD code = 1;
    ::WaitForSingleObject(started.hProcess, INFINITE);
    ::GetExitCodeProcess(started.hProcess, &code);
    std::exit(int(code));
}

fs::path programFile()
{
    std::wstring name(32768, L'\0');
    name.resize(::GetModuleFileNameW(nullptr, name.data(), DWORD(name.size())));
    return name;
}

fs::path sameProgram() { return programFile(); }

} // namespace cotan
