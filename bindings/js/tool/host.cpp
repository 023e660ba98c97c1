// What the tool asks of the system and emscripten's C library only pretends to know.
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstring>
#include <string>

#include <emscripten.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "terminal/file_words.hpp"

EM_JS(int, cotanHostProcess, (), { return process.pid; });
EM_JS(int, cotanHostIsRunning, (int number), {
    try {
        process.kill(number, 0);
        return 1;
    } catch (error) {
        return error.code != "ESRCH" ? 1 : 0; // a formatter of C++ breaks the operator of three signs
    }
});
EM_JS(double, cotanHostMemory, (), { return process.resourceUsage().maxRSS; });
EM_JS(void, cotanHostName, (char* text, int size), { stringToUTF8(Module["machineName"], text, size); });
EM_JS(void, cotanHostSystem, (char* text, int size), { stringToUTF8(Module["systemName"], text, size); });
EM_JS(int, cotanHostWidth, (), { return Module["columns"]; });
EM_JS(void, cotanHostFile, (const char* word, char* file, int size),
      { stringToUTF8(Module["names"].fileOf(UTF8ToString(word)), file, size); });

namespace {

const bool systemFileIsHosts = [] {
    cotan::app::systemFileOf = [](const std::string& word) {
        std::string file(word.size() + 100'000, '\0'); // a drive's current folder may be added
        cotanHostFile(word.c_str(), file.data(), int(file.size()));
        file.resize(std::strlen(file.c_str()));
        return file;
    };
    return true;
}();

} // namespace

extern "C" {

pid_t getpid() { return cotanHostProcess(); }

int kill(pid_t process, int)
{
    if (cotanHostIsRunning(process))
        return 0;
    errno = ESRCH;
    return -1;
}

pid_t wait4(pid_t, int*, int, rusage*) // there are no children
{
    errno = ECHILD;
    return -1;
}

int gethostname(char* text, std::size_t size)
{
    cotanHostName(text, int(size));
    return 0;
}

int uname(utsname* name)
{
    std::memset(name, 0, sizeof *name);
    cotanHostSystem(name->sysname, int(sizeof name->sysname));
    std::strcpy(name->machine, "wasm32");
    return 0;
}

int getrusage(int, rusage* usage)
{
    std::memset(usage, 0, sizeof *usage);
    usage->ru_maxrss = long(cotanHostMemory()); // KiB
    return 0;
}

// The width of the terminal, and nothing else.
int ioctl(int, int request, ...)
{
    const int width = cotanHostWidth();
    if (request != TIOCGWINSZ || width == 0)
        return -1;
    va_list words;
    va_start(words, request);
    va_arg(words, winsize*)->ws_col = static_cast<unsigned short>(width);
    va_end(words);
    return 0;
}

} // extern "C"
