include(${CMAKE_CURRENT_LIST_DIR}/header_library.cmake)
# A fixed thousands separator, which no text uses: otherwise {fmt} adds std::locale, 77 KB of the npm module.
cotan_header_library(fmt fmt::fmt fmt/format.h FMT_HEADER_ONLY FMT_STATIC_THOUSANDS_SEPARATOR=44)
