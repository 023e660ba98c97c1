cotan_test(shader_text_test SOURCES shader_text_test.cpp shader_rules_test.cpp shader_simplified_test.cpp LIBRARIES cotan_shader_text)
target_include_directories(shader_text_test PRIVATE ${PROJECT_SOURCE_DIR}/src/shader_text) # for the preprocessor
# Reports what a new frame still lacks.
cotan_test(frame_table_test SOURCES frame_table_test.cpp LIBRARIES cotan_shader_text)
# Compiles and runs the printed shader text in every language that this machine supports.
if(COTAN_GLSLANG)
  add_library(cotan_shader_cases STATIC shader_parity.cpp shader_cases.cpp shader_light.cpp shader_draw.cpp shader_compute.cpp)
  cotan_unity(cotan_shader_cases 12)
  target_include_directories(cotan_shader_cases PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(cotan_shader_cases
    PUBLIC cotan_shader_text cotan_scene cotan_truth GTest::gtest_main fmt::fmt PRIVATE cotan_warnings)
  target_compile_definitions(cotan_shader_cases PUBLIC COTAN_TOOL="$<TARGET_FILE:cotan>"
    COTAN_CXX="${CMAKE_CXX_COMPILER}" COTAN_GLSLANG_PATH="${COTAN_GLSLANG}" COTAN_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  cotan_test(shader_test SLOW ShaderParity.*
    SOURCES shader_test.cpp shader_godot_test.cpp shader_run_cpp.cpp shader_run_browser.cpp
    LIBRARIES cotan_shader_cases nlohmann_json::nlohmann_json)
  add_dependencies(shader_test cotan)
  if(TARGET cotan_cost)
    # Uses devices and buffers of the cost measurements.
    target_sources(shader_test PRIVATE shader_run_vulkan.cpp shader_draw_vulkan.cpp)
    target_include_directories(shader_test PRIVATE ${PROJECT_SOURCE_DIR}/apps/lab/cost)
    target_link_libraries(shader_test PRIVATE cotan_cost Vulkan::Headers)
    target_compile_definitions(shader_test PRIVATE COTAN_WITH_VULKAN)
  endif()
  # The same cases by Microsoft's compilers and Direct3D 11, under Wine.
  add_executable(direct3d_test direct3d_test.cpp)
  target_link_libraries(direct3d_test PRIVATE cotan_shader_cases cotan_warnings)
  target_compile_definitions(direct3d_test PRIVATE COTAN_DIRECT3D="${PROJECT_BINARY_DIR}/direct3d")
  cotan_door(Direct3D.runsThePrintedText COMMAND direct3d_test)
  set_tests_properties(Direct3D.runsThePrintedText PROPERTIES TIMEOUT 1500)
endif()
