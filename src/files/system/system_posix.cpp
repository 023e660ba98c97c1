#include <cerrno>
#include <csignal>
#include <fstream>
#include <string_view>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "files/system/system.hpp"

namespace cotan {

namespace fs = std::filesystem;

std::FILE* openStream(const fs::path& file, const char* mode)
{
    return std::fopen(file.c_str(), (std::string(mode) + "e").c_str());
}

std::ptrdiff_t writeSome(std::FILE* file, const void* bytes, std::size_t size)
{
    return ::write(::fileno(file), bytes, size); // fwrite ends at a signal
}

bool meansFull(int number) { return number == ENOSPC || number == EDQUOT; }

bool mayWrite(const fs::path& file)
{
    std::error_code ignored;
    return ::access(file.c_str(), fs::is_directory(file, ignored) ? W_OK | X_OK : W_OK) == 0;
}

FileKind fileNumber(const fs::path& file, FileNumber& number)
{
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0)
        return FileKind::missing;
    number = {status.st_dev, status.st_ino};
    return S_ISREG(status.st_mode) || S_ISDIR(status.st_mode) ? FileKind::file : FileKind::special;
}

bool isNameOfDevice(const fs::path& file)
{
    std::error_code ignored;
    return (file.native().starts_with("/dev/") || file.native().starts_with("/proc/")) && fs::is_symlink(file, ignored);
}

// WebAssembly has this code too. Node.js on Windows runs it under the name of that system.
bool onWindows()
{
    utsname name{};
    return ::uname(&name) == 0 && std::string_view(name.sysname) == "Windows_NT";
}

pid_t thisProcess() { return ::getpid(); }

bool isRunning(pid_t process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

std::string machineName()
{
    char text[512] = "";
    ::gethostname(text, 255);
    const std::size_t length = std::string_view(text).size();
    if (::readlink("/proc/self/ns/pid", text + length, sizeof text - length - 1) < 0) // other systems have none
        text[length] = '\0';
    return text;
}

std::string systemName()
{
    utsname name{};
    ::uname(&name);
    std::string system = name.sysname;
    std::ifstream release("/etc/os-release");
    for (std::string line; std::getline(release, line);)
        if (line.starts_with("PRETTY_NAME="))
            system = line.substr(line.find('=') + 1);
    std::erase(system, '"');
    return system + ", " + name.machine;
}

double machineMemory()
{
#ifdef _SC_PHYS_PAGES
    const double pages = double(::sysconf(_SC_PHYS_PAGES)), bytes = double(::sysconf(_SC_PAGESIZE));
    return pages > 0 && bytes > 0 ? pages * bytes : 0;
#else
    return 0;
#endif
}

double peakMemory()
{
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * double(usage.ru_maxrss);
}

} // namespace cotan
