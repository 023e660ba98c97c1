# cotan_part(NAME [SOURCES ...] [PUBLIC ...] [PRIVATE ...] [INSIDE ...])
# One part: a library with installed public headers in src/NAME/include/cotan. The rest of src/NAME is internal: code
# here includes it by its path in src, "scene/geometry.hpp". ArchitectureTest (tests/architecture_test.py) checks that a
# part includes only parts that it links. Without SOURCES it is header-only. INSIDE: header libraries that only its own
# sources include; users of the installed part do not need them. A part that links a missing library is left out,
# without a target cotan_NAME, and find_package(cotan) can give the reason.
add_library(cotan_warnings INTERFACE)
target_compile_options(cotan_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict> # false positive, GCC bug 105651
  $<$<BOOL:${COTAN_WARNINGS_AS_ERRORS}>:-Werror>)
# GLM's vectors without unions (x, y, z only): compilers keep them in registers and vectorise loops over them. Only for
# code built here: the layout is the same, but users may want .rgb of their own vectors.
target_compile_definitions(cotan_warnings INTERFACE GLM_FORCE_XYZW_ONLY)
if(MINGW)
  target_compile_options(cotan_warnings INTERFACE "SHELL:-include ${PROJECT_SOURCE_DIR}/cmake/windows/utf8_paths.hpp")
endif()
# Internal headers, by their paths in src; also only for code built here.
target_include_directories(cotan_warnings INTERFACE ${PROJECT_SOURCE_DIR}/src)

# Records something missing, the reason, and the cost, each without a semicolon. The configuration ends with a list of
# them, and fails with COTAN_REQUIRE_ALL.
function(cotan_without what reason cost)
  set_property(GLOBAL APPEND PROPERTY COTAN_WITHOUT "${what} (${reason}): ${cost}")
endfunction()

# With COTAN_UNITY, compiles up to `batch` files of a target as one, so that common headers are read and common
# templates instantiated once.
function(cotan_unity target batch)
  if(COTAN_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    # Only files of one folder: file-local names may occur again in another folder.
    get_target_property(sources ${target} SOURCES)
    foreach(source ${sources})
      get_filename_component(folder ${source} DIRECTORY)
      if(IS_ABSOLUTE "${source}")
        set(folder elsewhere)
      endif()
      string(MAKE_C_IDENTIFIER "files_${folder}" group)
      if(NOT DEFINED count_${group})
        set(count_${group} 0)
      endif()
      math(EXPR part "${count_${group}} / ${batch}")
      math(EXPR count_${group} "${count_${group}} + 1")
      set_property(SOURCE ${source} PROPERTY UNITY_GROUP ${group}_${part})
    endforeach()
    # GCC takes included files for headers, whose types must not have members of file-local types.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# Properties of the parts' static and shared libraries. The objects of both are the same: no definition distinguishes
# them.
function(cotan_library target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON DEFINE_SYMBOL ""
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} INSTALL_RPATH "$ORIGIN")
  if(EMSCRIPTEN)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  endif()
endfunction()

# WebAssembly for pages is compiled for size, except the given sources, which are time-critical. Set per source, because the
# compiler's driver accepts only one such option.
function(cotan_fast_sources target)
  if(COTAN_FOR_PAGES)
    get_target_property(sources ${target} SOURCES)
    foreach(source ${sources})
      set(level -Oz)
      if(source IN_LIST ARGN)
        set(level -O2)
      endif()
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS ${level})
    endforeach()
  endif()
endfunction()

# Makes a target available as cotan::name, here and once installed. ARGN: what find_package(cotan COMPONENTS name)
# needs, the parts and packages that it links, even privately: static libraries need them, and shared ones may.
function(cotan_component target name)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  add_library(cotan::${name} ALIAS ${target})
  set_property(GLOBAL APPEND PROPERTY COTAN_COMPONENTS ${name})
  set_property(GLOBAL PROPERTY COTAN_LINKS_${name} ${ARGN})
endfunction()

# Leaves a target out and records which of the targets that it needs are missing.
function(cotan_leave_out name missing)
  set(libraries "")
  foreach(target ${missing})
    get_property(word GLOBAL PROPERTY COTAN_WORD_${target})
    if(target MATCHES "^cotan_(.+)$")
      get_property(word GLOBAL PROPERTY COTAN_MISSES_${CMAKE_MATCH_1})
    endif()
    list(APPEND libraries ${word})
  endforeach()
  list(REMOVE_DUPLICATES libraries)
  set_property(GLOBAL APPEND PROPERTY COTAN_LEFT_OUT ${name})
  set_property(GLOBAL PROPERTY COTAN_MISSES_${name} ${libraries})
endfunction()

# Whether a target exists and is wanted: one that is switched off may exist because another package defines it.
function(cotan_has result target)
  get_property(reason GLOBAL PROPERTY COTAN_REASON_${target})
  set(${result} FALSE PARENT_SCOPE)
  if(TARGET ${target} AND NOT reason)
    set(${result} TRUE PARENT_SCOPE)
  endif()
endfunction()

# Records that an existing part lacks the features of a library.
function(cotan_lacks name target)
  cotan_has(there ${target})
  if(TARGET cotan_${name} AND NOT there)
    get_property(word GLOBAL PROPERTY COTAN_WORD_${target})
    set_property(GLOBAL APPEND PROPERTY COTAN_MISSES_${name} ${word})
  endif()
endfunction()

# Returns the targets of a list that are missing.
function(cotan_missing result)
  set(missing "")
  foreach(target ${ARGN})
    cotan_has(there ${target})
    if(NOT there AND NOT target IN_LIST CMAKE_DL_LIBS)
      list(APPEND missing ${target})
    endif()
  endforeach()
  set(${result} "${missing}" PARENT_SCOPE)
endfunction()

function(cotan_part name)
  cmake_parse_arguments(PART "" "" "SOURCES;PUBLIC;PRIVATE;INSIDE" ${ARGN})
  cotan_missing(missing ${PART_PUBLIC} ${PART_PRIVATE} ${PART_INSIDE})
  if(missing)
    cotan_leave_out(${name} "${missing}")
    return()
  endif()
  set(includes $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  if(PART_SOURCES)
    add_library(cotan_${name} ${PART_SOURCES})
    target_include_directories(cotan_${name} PUBLIC ${includes})
    target_link_libraries(cotan_${name} PUBLIC ${PART_PUBLIC}
      PRIVATE ${PART_PRIVATE} $<BUILD_INTERFACE:cotan_warnings>)
    foreach(target ${PART_INSIDE})
      target_link_libraries(cotan_${name} PRIVATE $<BUILD_INTERFACE:${target}>)
    endforeach()
    cotan_library(cotan_${name})
    if(COTAN_FOR_PAGES)
      target_compile_options(cotan_${name} PRIVATE -Oz)
    endif()
    cotan_unity(cotan_${name} 24)
  else()
    add_library(cotan_${name} INTERFACE)
    target_include_directories(cotan_${name} INTERFACE ${includes})
    target_link_libraries(cotan_${name} INTERFACE ${PART_PUBLIC})
  endif()
  cotan_component(cotan_${name} ${name} ${PART_PUBLIC} ${PART_PRIVATE})
  if(IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/include)
    set_property(GLOBAL APPEND PROPERTY COTAN_INCLUDES ${CMAKE_CURRENT_SOURCE_DIR}/include/cotan)
  endif()
endfunction()

# cotan_app_library(NAME FOLDER [SOURCES ...] [PUBLIC ...] [PRIVATE ...]): a library that only programs link. Not
# installed. Left out like a part. FOLDER: its include folder.
function(cotan_app_library name folder)
  cmake_parse_arguments(PART "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  cotan_missing(missing ${PART_PUBLIC} ${PART_PRIVATE})
  if(missing)
    cotan_leave_out(${name} "${missing}")
    return()
  endif()
  add_library(cotan_${name} STATIC ${PART_SOURCES})
  target_include_directories(cotan_${name} PUBLIC ${folder})
  target_link_libraries(cotan_${name} PUBLIC ${PART_PUBLIC} PRIVATE ${PART_PRIVATE} cotan_warnings)
  cotan_unity(cotan_${name} 24)
endfunction()
