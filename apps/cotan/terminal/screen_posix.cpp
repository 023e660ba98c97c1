#include "terminal/screen.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

namespace cotan::app {

bool isTerminal(std::FILE* stream) { return ::isatty(::fileno(stream)) == 1; }

std::size_t terminalWidth(std::FILE* stream)
{
    winsize size{};
    return ::ioctl(::fileno(stream), TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

} // namespace cotan::app
