// How libpng says what is wrong: it calls back and leaves by longjmp, so the functions that call it hold nothing with a
// destructor.
#pragma once

#include <cstddef>
#include <cstdio>

#include <png.h>

namespace cotan {

inline constexpr std::size_t kPngMessage = 128; // bytes where the error pointer of a session points to

inline void onPngError(png_structp png, png_const_charp message)
{
    std::snprintf(static_cast<char*>(png_get_error_ptr(png)), kPngMessage, "%s", message);
    png_longjmp(png, 1);
}

inline void onPngWarning(png_structp, png_const_charp) {}

} // namespace cotan
