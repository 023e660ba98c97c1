# The functions of the part maps, and `cotan map` as users run it.
cotan_test(map_test BATCH 4 # files of a row are compiled at once; rows may repeat file-local names
  SOURCES blend_formula_test.cpp map_blend_test.cpp map_charts_test.cpp map_kernel_test.cpp
    map_detect_test.cpp map_height_test.cpp map_small_test.cpp map_zero_test.cpp
    map_mips_test.cpp map_recode_test.cpp map_block_test.cpp map_messages_test.cpp
    map_lines_test.cpp map_green_test.cpp
  LIBRARIES cotan_map_files cotan_maps cotan_model cotan_scene)
find_package(JPEG REQUIRED)
find_package(ZLIB REQUIRED)
cotan_test(map_command_test FIXTURE npm SLOW JpegCost.isEstimated* MapChoice.* MapHostile.memory* MapCommand.degenerate* TextureBytes.aMapInParts*
  SOURCES four_colours_test.cpp jpeg_cost_test.cpp map_choice_test.cpp map_command_test.cpp map_faults_test.cpp map_files_test.cpp map_frame_test.cpp map_hostile_test.cpp map_ktx2_test.cpp map_many_test.cpp map_file_channels_test.cpp
    map_stated_test.cpp map_stored_test.cpp map_strips_test.cpp texture_bytes_test.cpp
  LIBRARIES cotan_map_files cotan_gltf cotan_model cotan_scene JPEG::JPEG nlohmann_json::nlohmann_json ZLIB::ZLIB)
target_compile_definitions(map_command_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_NPM="${PROJECT_BINARY_DIR}/npm")
add_dependencies(map_command_test cotan)
