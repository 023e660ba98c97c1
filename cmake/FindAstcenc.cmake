# Finds libastcenc as Astcenc::astcenc. Its package files for CMake name other targets in each version.
find_path(COTAN_ASTCENC_INCLUDE_DIR astcenc.h)
find_library(COTAN_ASTCENC_LIBRARY astcenc)
mark_as_advanced(COTAN_ASTCENC_INCLUDE_DIR COTAN_ASTCENC_LIBRARY)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Astcenc REQUIRED_VARS COTAN_ASTCENC_LIBRARY COTAN_ASTCENC_INCLUDE_DIR)
if(Astcenc_FOUND AND NOT TARGET Astcenc::astcenc)
  add_library(Astcenc::astcenc UNKNOWN IMPORTED)
  set_target_properties(Astcenc::astcenc PROPERTIES
    IMPORTED_LOCATION "${COTAN_ASTCENC_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${COTAN_ASTCENC_INCLUDE_DIR}"
    INTERFACE_COMPILE_DEFINITIONS ASTCENC_DYNAMIC_LIBRARY) # its names then are those of C
endif()
