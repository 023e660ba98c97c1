# cotan_part(NAME [SOURCES ...] [PUBLIC ...] [PRIVATE ...])
# One part of the house: a library with its own include folder (src/NAME/include), so that only
# the parts it links can be included. Without SOURCES it is header-only.
add_library(cotan_warnings INTERFACE)
target_compile_options(cotan_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off
  $<$<BOOL:${COTAN_WARNINGS_AS_ERRORS}>:-Werror>)

# Several files of a target compiled as one: what they include is read, and what they instantiate is made, once.
function(cotan_unity target batch)
  if(COTAN_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${batch})
    # Files that are included look like headers, whose types must not hold types of one file.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# Where headers of a part are found here and once installed, and what find_package(cotan COMPONENTS name) needs for it:
# the parts and packages that it links, privately or not, since the libraries are static.
function(cotan_component target name)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY COTAN_COMPONENTS ${name})
  set_property(GLOBAL PROPERTY COTAN_LINKS_${name} ${ARGN})
endfunction()

function(cotan_part name)
  cmake_parse_arguments(PART "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(includes $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  if(PART_SOURCES)
    add_library(cotan_${name} STATIC ${PART_SOURCES})
    target_include_directories(cotan_${name} PUBLIC ${includes})
    target_link_libraries(cotan_${name} PUBLIC ${PART_PUBLIC}
      PRIVATE ${PART_PRIVATE} $<BUILD_INTERFACE:cotan_warnings>)
    set_target_properties(cotan_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    cotan_unity(cotan_${name} 8)
  else()
    add_library(cotan_${name} INTERFACE)
    target_include_directories(cotan_${name} INTERFACE ${includes})
    target_link_libraries(cotan_${name} INTERFACE ${PART_PUBLIC})
  endif()
  cotan_component(cotan_${name} ${name} ${PART_PUBLIC} ${PART_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY COTAN_INCLUDES ${CMAKE_CURRENT_SOURCE_DIR}/include/cotan)
endfunction()
