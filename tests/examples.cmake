# The integration examples, run as they are shipped.
cotan_test(examples_test FIXTURE npm
  SOURCES examples_browser_test.cpp
  LIBRARIES nlohmann_json::nlohmann_json)
target_compile_definitions(examples_test PRIVATE
  COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_NPM="${PROJECT_BINARY_DIR}/npm")
add_dependencies(examples_test cotan)

# As its own CMakeLists.txt builds it, but within this build.
find_package(embree 3 CONFIG QUIET)
if(embree_FOUND)
  add_executable(example_raytracing ${PROJECT_SOURCE_DIR}/examples/raytracing/main.cpp)
  target_compile_features(example_raytracing PRIVATE cxx_std_17)
  target_link_libraries(example_raytracing PRIVATE embree cotan_warnings)
  target_sources(examples_test PRIVATE examples_raytracing_test.cpp)
  target_compile_definitions(examples_test PRIVATE COTAN_RAYTRACING="$<TARGET_FILE:example_raytracing>")
  add_dependencies(examples_test example_raytracing)
endif()
