# cotan_header_library(NAME TARGET HEADER [DEFINITIONS...]): a library that is headers only, by a link to its folder: the
# whole of /usr/include would take the place of what belongs to the compiler.
include(FindPackageHandleStandardArgs)
macro(cotan_header_library name target header)
  find_path(${name}_INCLUDE_DIR ${header} PATHS /usr/include /usr/local/include NO_CMAKE_FIND_ROOT_PATH)
  mark_as_advanced(${name}_INCLUDE_DIR)
  find_package_handle_standard_args(${name} REQUIRED_VARS ${name}_INCLUDE_DIR)
  if(${name}_FOUND AND NOT TARGET ${target})
    string(REGEX REPLACE "/.*" "" folder ${header})
    set(links ${PROJECT_BINARY_DIR}/headers/${name})
    file(MAKE_DIRECTORY ${links})
    file(CREATE_LINK ${${name}_INCLUDE_DIR}/${folder} ${links}/${folder} SYMBOLIC)
    add_library(${target} INTERFACE IMPORTED)
    set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${links}
      INTERFACE_COMPILE_DEFINITIONS "${ARGN}")
  endif()
endmacro()
