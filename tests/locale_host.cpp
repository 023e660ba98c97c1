// Loaded before a program: a host that has chosen the user's locale, as desktop programs do. With the variable
// COTAN_STREAMS_TOO it has chosen it for the streams of C++, too, by which many tests write their files. Programs that
// it starts, such as the command line, choose none.
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <locale>

namespace {

[[noreturn]] void stop(const char* why)
{
    std::fprintf(stderr, "locale_host: %s\n", why);
    std::abort();
}

[[gnu::constructor]] void chooseLocale()
{
    if (!std::setlocale(LC_ALL, ""))
        stop("the locale is not there");
    try {
        if (std::getenv("COTAN_STREAMS_TOO"))
            std::locale::global(std::locale(""));
    } catch (const std::exception& e) {
        stop(e.what());
    }
    ::unsetenv("LD_PRELOAD");
    char text[16];
    std::snprintf(text, sizeof text, "%.1f", 1.5);
    if (std::strcmp(text, "1.5") == 0)
        stop("expected a locale without a decimal point");
}

} // namespace
