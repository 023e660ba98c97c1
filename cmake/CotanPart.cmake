# cotan_part(NAME [SOURCES ...] [PUBLIC ...] [PRIVATE ...] [INSIDE ...])
# One part: a library, and its public headers in src/NAME/include/cotan, which are what is installed. Everything else of
# src/NAME is internal: our own code includes it by its path in src, "scene/geometry.hpp"; ArchitectureTest
# (tests/architecture_test.py) holds that a part includes only those that it links. Without SOURCES it is header-only.
# INSIDE: headers that only its own sources read, so that who links it once installed need not have them. A part that
# links something which is not there is left out: there is no target cotan_NAME then, and find_package(cotan) can say why.
add_library(cotan_warnings INTERFACE)
target_compile_options(cotan_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict> # of std::string, GCC bug 105651
  $<$<BOOL:${COTAN_WARNINGS_AS_ERRORS}>:-Werror>)
# GLM's vectors without unions (x, y, z only): compilers keep those in registers and take several at a time in loops. For
# what is built here and nobody else: layouts are the same, but a program may want .rgb of its own vectors.
target_compile_definitions(cotan_warnings INTERFACE GLM_FORCE_XYZW_ONLY)
# Internal headers, by their paths in src: for what is built here and nobody else, too.
target_include_directories(cotan_warnings INTERFACE ${PROJECT_SOURCE_DIR}/src)

# Something that is not there, why, and what that costs, each without a semicolon: the end of the configuration says so, and
# with COTAN_REQUIRE_ALL it fails.
function(cotan_without what reason cost)
  set_property(GLOBAL APPEND PROPERTY COTAN_WITHOUT "${what} (${reason}): ${cost}")
endfunction()

# With COTAN_UNITY, up to `batch` files of a target are compiled as one: what they include is read, and what they
# instantiate is made, once.
function(cotan_unity target batch)
  if(COTAN_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    # Files of one folder only: names that are local to a file may occur again in another folder.
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
    # Files that are included look like headers, whose types must not hold types of one file.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# What static and shared libraries of parts have in common. Objects are the same for both: no definition says which.
function(cotan_library target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON DEFINE_SYMBOL ""
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} INSTALL_RPATH "$ORIGIN")
  if(EMSCRIPTEN)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  endif()
endfunction()

# WebAssembly is compiled for size, but for the sources given, where time is spent. By source: the compiler's driver takes
# one such option only.
function(cotan_fast_sources target)
  if(EMSCRIPTEN)
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

# A part as cotan::name, here and once installed, and what find_package(cotan COMPONENTS name) needs for it:
# the parts and packages that it links, privately or not, since static libraries need them and shared ones may.
function(cotan_component target name)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  add_library(cotan::${name} ALIAS ${target})
  set_property(GLOBAL APPEND PROPERTY COTAN_COMPONENTS ${name})
  set_property(GLOBAL PROPERTY COTAN_LINKS_${name} ${ARGN})
endfunction()

# Leaves a target out, and remembers which of the targets that it needs are missing.
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

# Whether a target is there to be used: one that was left alone on purpose may be there all the same, brought by another.
function(cotan_has result target)
  get_property(reason GLOBAL PROPERTY COTAN_REASON_${target})
  set(${result} FALSE PARENT_SCOPE)
  if(TARGET ${target} AND NOT reason)
    set(${result} TRUE PARENT_SCOPE)
  endif()
endfunction()

# A part that is there, but lacks what a library would give it.
function(cotan_lacks name target)
  cotan_has(there ${target})
  if(TARGET cotan_${name} AND NOT there)
    get_property(word GLOBAL PROPERTY COTAN_WORD_${target})
    set_property(GLOBAL APPEND PROPERTY COTAN_MISSES_${name} ${word})
  endif()
endfunction()

# Those of some targets that are not there.
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
    if(EMSCRIPTEN)
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

# cotan_app_library(NAME FOLDER [SOURCES ...] [PUBLIC ...] [PRIVATE ...]): what only programs link. Not installed. Left out
# as a part is. FOLDER: where its includes begin.
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
