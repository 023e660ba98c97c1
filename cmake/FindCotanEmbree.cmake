# Finds Embree 4 or 3, the newer if both are installed: the target embree, and the global property COTAN_EMBREE_MAJOR.
# Embree's own package accepts requests for one major version only.
foreach(major 4 3)
  find_package(embree ${major} CONFIG QUIET)
  if(embree_FOUND)
    set_property(GLOBAL PROPERTY COTAN_EMBREE_MAJOR ${major})
    break()
  endif()
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CotanEmbree REQUIRED_VARS embree_DIR embree_FOUND VERSION_VAR embree_VERSION)
