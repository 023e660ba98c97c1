cotan_test(lint_test
  SOURCES lint_test.cpp lint_command_test.cpp
  LIBRARIES cotan_lint cotan_asset cotan_truth nlohmann_json::nlohmann_json fmt::fmt)
target_compile_definitions(lint_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(lint_test cotan)
