# Runs the output of `cotan shader --lang godot`, and examples/godot, in Godot 3 and 4 on a display, with all drivers.
if(TARGET shader_test)
  add_executable(godot_test godot_test.cpp godot_relief_test.cpp godot_draw.cpp godot_parity.cpp shader_cases.cpp shader_light.cpp)
  target_link_libraries(godot_test PRIVATE cotan_shader_text cotan_scene cotan_truth cotan_image
    nlohmann_json::nlohmann_json fmt::fmt GTest::gtest cotan_warnings)
  cotan_unity(godot_test 4)
  target_compile_definitions(godot_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_GLSLANG_PATH="${COTAN_GLSLANG}"
    COTAN_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  add_dependencies(godot_test cotan)
  foreach(driver GLES3 GLES2)
    cotan_door(Godot.${driver} COMMAND godot_test --gtest_filter=*/${driver})
  endforeach()
  foreach(driver opengl3 vulkan)
    cotan_door(Godot4.${driver} COMMAND godot_test --gtest_filter=*Godot4.*/${driver})
  endforeach()
endif()
