#include "terminal/screen.hpp"

#include <io.h>

#include "core/windows.hpp"

namespace cotan::app {

namespace {

bool describe(std::FILE* stream, CONSOLE_SCREEN_BUFFER_INFO& found)
{
    return ::GetConsoleScreenBufferInfo(reinterpret_cast<HANDLE>(::_get_osfhandle(::_fileno(stream))), &found) != 0;
}

} // namespace

// Not _isatty, which is also true of NUL and other devices.
bool isTerminal(std::FILE* stream)
{
    CONSOLE_SCREEN_BUFFER_INFO found{};
    return describe(stream, found);
}

std::size_t terminalWidth(std::FILE* stream)
{
    CONSOLE_SCREEN_BUFFER_INFO found{};
    return describe(stream, found) ? std::size_t(found.srWindow.Right - found.srWindow.Left + 1) : 0;
}

} // namespace cotan::app
