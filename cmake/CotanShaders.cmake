# cotan_shader(TARGET SOURCE SYMBOL [DEFINES ...]): compiles shaders/SOURCE to SPIR-V at build time
# and makes it SYMBOL.h, an array of words named SYMBOL, for the sources of TARGET.
# Every shader depends on all included text; there is little of it, and lists go stale.
file(GLOB COTAN_SHADER_INCLUDES CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/shaders/cotan/*.h ${PROJECT_SOURCE_DIR}/shaders/*.glsl ${PROJECT_SOURCE_DIR}/include/cotan/frames.inc)

function(cotan_shader target source symbol)
  cmake_parse_arguments(SHADER "" "" "DEFINES" ${ARGN})
  set(input ${PROJECT_SOURCE_DIR}/shaders/${source})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.h)
  list(TRANSFORM SHADER_DEFINES PREPEND -D)
  add_custom_command(OUTPUT ${output}
    COMMAND ${COTAN_GLSLANG} --quiet --target-env vulkan1.3 -I${PROJECT_SOURCE_DIR}/shaders -I${PROJECT_SOURCE_DIR}/include
      ${SHADER_DEFINES} --vn ${symbol} -o ${output} ${input}
    DEPENDS ${input} ${COTAN_SHADER_INCLUDES}
    COMMENT "Shader ${source} -> ${symbol}.h"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endfunction()
