include(${CMAKE_CURRENT_LIST_DIR}/header_library.cmake)
# Commas for thousands, which no text here has: else {fmt} brings std::locale, 77 KB of the npm package's module.
cotan_header_library(fmt fmt::fmt fmt/format.h FMT_HEADER_ONLY FMT_STATIC_THOUSANDS_SEPARATOR=44)
