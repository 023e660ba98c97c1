# Finds xxHash as XxHash::xxhash. Debian ships it without a package file for CMake.
find_path(COTAN_XXHASH_INCLUDE_DIR xxhash.h)
find_library(COTAN_XXHASH_LIBRARY xxhash)
mark_as_advanced(COTAN_XXHASH_INCLUDE_DIR COTAN_XXHASH_LIBRARY)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(XxHash REQUIRED_VARS COTAN_XXHASH_LIBRARY COTAN_XXHASH_INCLUDE_DIR)
if(XxHash_FOUND AND NOT TARGET XxHash::xxhash)
  add_library(XxHash::xxhash UNKNOWN IMPORTED)
  set_target_properties(XxHash::xxhash PROPERTIES
    IMPORTED_LOCATION "${COTAN_XXHASH_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${COTAN_XXHASH_INCLUDE_DIR}")
endif()
