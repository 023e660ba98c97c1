# The integration examples, run as they are shipped.
cotan_test(examples_test FIXTURE npm
  SOURCES examples_browser_test.cpp
  LIBRARIES nlohmann_json::nlohmann_json)
target_compile_definitions(examples_test PRIVATE
  COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_NPM="${PROJECT_BINARY_DIR}/npm")
add_dependencies(examples_test cotan)
