cotan_test(convert_test FIXTURE npm SLOW ConvertCommand.real* ConvertCommand.conversionsMake*
  SOURCES convert_test.cpp convert_command_test.cpp convert_jobs_test.cpp convert_layers_test.cpp
    convert_choose_test.cpp convert_compress_test.cpp convert_model_test.cpp convert_notes_test.cpp convert_provoking_test.cpp model_faults_test.cpp texture_transform_test.cpp
  LIBRARIES cotan_bake cotan_model cotan_scene cotan_render cotan_gltf_json fmt::fmt ZLIB::ZLIB)
target_compile_definitions(convert_test PRIVATE
  COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_NPM="${PROJECT_BINARY_DIR}/npm")
add_dependencies(convert_test cotan)
