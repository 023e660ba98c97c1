cotan_test(lint_test SLOW LintCommand.prediction* LintCommand.sketchfabCat* Scans.*
  SOURCES lint_test.cpp lint_command_test.cpp scale_test.cpp
  LIBRARIES cotan_bake cotan_model cotan_scene cotan_truth nlohmann_json::nlohmann_json fmt::fmt)
target_compile_definitions(lint_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(lint_test cotan)
# The parts of lint and convert on their own: builds and runs in seconds.
cotan_test(judgement_test BATCH 1
  SOURCES lint_recommend_test.cpp lint_check_test.cpp lint_parts_test.cpp map_fit_test.cpp convert_parts_test.cpp
    convert_points_test.cpp mapped_surface_test.cpp
          lint_bounds_test.cpp lint_scene_test.cpp lint_visibility_test.cpp
  LIBRARIES cotan_bake)
target_include_directories(judgement_test PRIVATE ${PROJECT_SOURCE_DIR}/src/bake/lint ${PROJECT_SOURCE_DIR}/src/bake/convert)
cotan_test(judgement_command_test
  SOURCES judgement_command_test.cpp
  LIBRARIES cotan_model cotan_scene nlohmann_json::nlohmann_json fmt::fmt)
target_compile_definitions(judgement_command_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(judgement_command_test cotan)
# Commands without an option for the frame.
cotan_test(auto_frame_test SLOW AutoFrame.tangentsThatReverse*
  SOURCES auto_frame_command_test.cpp
  LIBRARIES cotan_model cotan_scene nlohmann_json::nlohmann_json fmt::fmt)
target_compile_definitions(auto_frame_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(auto_frame_test cotan)
