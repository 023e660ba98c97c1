# cotan_part(NAME [SOURCES ...] [PUBLIC ...] [PRIVATE ...])
# One part of the house: a library with its own include folder (src/NAME/include), so that only
# the parts it links can be included. Without SOURCES it is header-only.
add_library(cotan_warnings INTERFACE)
target_compile_options(cotan_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off
  $<$<BOOL:${COTAN_WARNINGS_AS_ERRORS}>:-Werror>)

function(cotan_part name)
  cmake_parse_arguments(PART "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  if(PART_SOURCES)
    add_library(cotan_${name} STATIC ${PART_SOURCES})
    target_include_directories(cotan_${name} PUBLIC
      $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>)
    target_link_libraries(cotan_${name} PUBLIC ${PART_PUBLIC}
      PRIVATE ${PART_PRIVATE} $<BUILD_INTERFACE:cotan_warnings>)
    set_target_properties(cotan_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  else()
    add_library(cotan_${name} INTERFACE)
    target_include_directories(cotan_${name} INTERFACE
      $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>)
    target_link_libraries(cotan_${name} INTERFACE ${PART_PUBLIC})
  endif()
endfunction()
