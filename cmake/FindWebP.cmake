# Finds libwebp and, for animations, libwebpmux as WebP::webp. Debian ships them without a package file for CMake.
find_path(COTAN_WEBP_INCLUDE_DIR webp/mux.h)
find_library(COTAN_WEBP_LIBRARY webp)
find_library(COTAN_WEBP_MUX_LIBRARY webpmux)
mark_as_advanced(COTAN_WEBP_INCLUDE_DIR COTAN_WEBP_LIBRARY COTAN_WEBP_MUX_LIBRARY)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(WebP REQUIRED_VARS COTAN_WEBP_LIBRARY COTAN_WEBP_MUX_LIBRARY COTAN_WEBP_INCLUDE_DIR)
if(WebP_FOUND AND NOT TARGET WebP::webp)
  add_library(WebP::webp UNKNOWN IMPORTED)
  set_target_properties(WebP::webp PROPERTIES
    IMPORTED_LOCATION "${COTAN_WEBP_MUX_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${COTAN_WEBP_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${COTAN_WEBP_LIBRARY}")
endif()
