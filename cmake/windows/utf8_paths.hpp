// Included first in every file of the builds for Windows. libstdc++ reads the char of a file's name as Latin-1 there;
// in Cotan, and in the words that its programs get, all text is UTF-8. Bytes that are not UTF-8 become U+FFFD, as in
// Windows itself, instead of an exception. Only for GCC 12 to 14: it specialises a function inside std::filesystem.
#pragma once

#include <filesystem>
#include <string>

extern "C" __declspec(dllimport) int __stdcall MultiByteToWideChar(unsigned, unsigned long, const char*, int, wchar_t*,
                                                                   int);

template<> inline auto std::filesystem::path::_S_convert<char>(const char* first, const char* last)
{
    constexpr unsigned kUtf8 = 65001;
    const int size = int(last - first);
    std::wstring wide(std::size_t(size), L'\0');
    wide.resize(std::size_t(size == 0 ? 0 : ::MultiByteToWideChar(kUtf8, 0, first, size, wide.data(), size)));
    return wide;
}
