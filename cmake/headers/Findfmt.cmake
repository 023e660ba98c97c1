include(${CMAKE_CURRENT_LIST_DIR}/header_library.cmake)
cotan_header_library(fmt fmt::fmt fmt/format.h FMT_HEADER_ONLY)
