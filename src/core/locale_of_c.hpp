// For libraries that read or write numbers by the locale of the host program.
#pragma once

#include <locale.h> // uselocale is not in <clocale>
#ifdef __APPLE__
#include <xlocale.h>
#endif

namespace cotan {

// While it exists, its thread has the locale of C. The rest of the host program is not affected.
class LocaleOfC {
#if defined(_WIN32) || defined(__EMSCRIPTEN__) // which have no locales of threads, or none at all
public:
    LocaleOfC() {}
#else
public:
    LocaleOfC() : own_(::newlocale(LC_ALL_MASK, "C", locale_t())), before_(own_ ? ::uselocale(own_) : locale_t()) {}
    ~LocaleOfC()
    {
        if (own_) {
            ::uselocale(before_);
            ::freelocale(own_);
        }
    }
    LocaleOfC(const LocaleOfC&) = delete;
    LocaleOfC& operator=(const LocaleOfC&) = delete;

private:
    locale_t own_, before_;
#endif
};

} // namespace cotan
