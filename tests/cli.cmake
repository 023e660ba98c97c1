# The tool itself, run as a user would run it.
cotan_test(cli_test
  SOURCES cli_test.cpp cli_bad_input_test.cpp normal_map_option_test.cpp
  LIBRARIES cotan_asset cotan_report nlohmann_json::nlohmann_json fmt::fmt)
target_compile_definitions(cli_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(cli_test cotan)
