# cotan_shader(TARGET SOURCE SYMBOL [DEFINES...]): compiles shaders/SOURCE, or any file given by its absolute path, to
# SPIR-V at build time, and writes SYMBOL.h with an array of words named SYMBOL, for the sources of TARGET. The property
# COTAN_SHADERS of the target lists these headers.
# spirv-opt -O, if installed, makes most shaders half as long; a driver then takes an eighth of the time for them. Every
# shader depends on all included text: there is little of it, and exact lists become outdated.
find_program(COTAN_SPIRV_OPT spirv-opt)
if(COTAN_GLSLANG AND NOT COTAN_SPIRV_OPT)
  cotan_without(spirv-opt "not found: install spirv-tools" "drivers take longer for shaders")
endif()
file(GLOB COTAN_SHADER_INCLUDES CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/shaders/cotan/*.h ${PROJECT_SOURCE_DIR}/shaders/*.glsl ${PROJECT_SOURCE_DIR}/shaders/cost/*.h
  ${PROJECT_SOURCE_DIR}/shaders/cost/*.glsl ${PROJECT_SOURCE_DIR}/examples/deforming/*.glsl
  ${PROJECT_SOURCE_DIR}/src/core/include/cotan/frames.inc)
set(COTAN_SPIRV_HEADER ${CMAKE_CURRENT_LIST_DIR}/spirv_header.cmake)

function(cotan_shader target source symbol)
  cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/shaders OUTPUT_VARIABLE input)
  set(spirv ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.spv)
  set(header ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.h)
  set(optimise "")
  if(COTAN_SPIRV_OPT)
    set(optimise COMMAND ${COTAN_SPIRV_OPT} -O ${spirv} -o ${spirv})
  endif()
  list(TRANSFORM ARGN PREPEND -D)
  add_custom_command(OUTPUT ${header}
    COMMAND ${COTAN_GLSLANG} --quiet --target-env vulkan1.3 -I${PROJECT_SOURCE_DIR}/shaders -I${PROJECT_SOURCE_DIR}/src/core/include
      ${ARGN} -o ${spirv} ${input}
    ${optimise}
    COMMAND ${CMAKE_COMMAND} -DSPIRV=${spirv} -DHEADER=${header} -DSYMBOL=${symbol} -P ${COTAN_SPIRV_HEADER}
    DEPENDS ${input} ${COTAN_SHADER_INCLUDES} ${COTAN_SPIRV_HEADER}
    COMMENT "Shader ${symbol}"
    VERBATIM)
  target_sources(${target} PRIVATE ${header})
  set_property(TARGET ${target} APPEND PROPERTY COTAN_SHADERS ${symbol}.h)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endfunction()
