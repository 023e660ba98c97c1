cotan_test(shader_text_test SOURCES shader_text_test.cpp shader_rules_test.cpp shader_simplified_test.cpp LIBRARIES cotan_shader_text)
target_include_directories(shader_text_test PRIVATE ${PROJECT_SOURCE_DIR}/src/shader_text) # for the preprocessor
# Reports what a new frame still lacks.
cotan_test(frame_table_test SOURCES frame_table_test.cpp LIBRARIES cotan_shader_text)
# Compiles and runs the printed shader text in every language that this machine supports.
if(COTAN_GLSLANG)
  cotan_test(shader_test SLOW ShaderParity.*
    SOURCES shader_test.cpp shader_godot_test.cpp shader_cases.cpp shader_light.cpp shader_draw.cpp shader_compute.cpp shader_run_cpp.cpp shader_run_browser.cpp
    LIBRARIES cotan_shader_text cotan_scene cotan_truth nlohmann_json::nlohmann_json fmt::fmt)
  target_compile_definitions(shader_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>"
    COTAN_CXX="${CMAKE_CXX_COMPILER}" COTAN_GLSLANG_PATH="${COTAN_GLSLANG}")
  add_dependencies(shader_test cotan)
  if(TARGET cotan_cost)
    # Uses devices and buffers of the cost measurements.
    target_sources(shader_test PRIVATE shader_run_vulkan.cpp shader_draw_vulkan.cpp)
    target_include_directories(shader_test PRIVATE ${PROJECT_SOURCE_DIR}/apps/lab/cost)
    target_link_libraries(shader_test PRIVATE cotan_cost Vulkan::Headers)
    target_compile_definitions(shader_test PRIVATE COTAN_WITH_VULKAN)
  endif()
endif()
