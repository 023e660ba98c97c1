# Installs the npm packages of tests/npm in the build folder. If that is not possible, this is skipped, and the tests
# that need them skip and say so.
add_test(NAME npm_packages
  COMMAND ${PROJECT_SOURCE_DIR}/scripts/npm-packages ${PROJECT_BINARY_DIR}/npm)
set_tests_properties(npm_packages PROPERTIES
  FIXTURES_SETUP npm SKIP_RETURN_CODE 3 TIMEOUT 300)
cotan_test(gltf_edit_test
  SOURCES gltf_edit_test.cpp gltf_edit_provoking_test.cpp gltf_edit_random_test.cpp
    gltf_edit_split_test.cpp gltf_edit_write_test.cpp gltf_edit_files_test.cpp gltf_edit_layout_test.cpp
    gltf_edit_vertices_test.cpp gltf_lookup_test.cpp gltf_from_scene_test.cpp
  LIBRARIES cotan_model cotan_scene cotan_gltf_json ZLIB::ZLIB)
cotan_test(tangents_command_test BATCH 1 FIXTURE npm SLOW TangentsCommand.saysWhichPrimitives* MikktspacePairing.matchesThreeOnModels*
  SOURCES tangents_command_test.cpp tangents_written_test.cpp tangents_three_test.cpp
  LIBRARIES cotan_model cotan_scene cotan_inspect cotan_gltf_json fmt::fmt)
target_compile_definitions(tangents_command_test PRIVATE
  COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_NPM="${PROJECT_BINARY_DIR}/npm")
add_dependencies(tangents_command_test cotan)
