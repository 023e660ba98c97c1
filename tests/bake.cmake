# The baker: its raster, frames and results; and `cotan bake` as users run it.
cotan_test(bake_test BATCH 4 # the four files of a row are compiled at once; rows may repeat file-local names
  SOURCES bake_curved_test.cpp bake_model_test.cpp bake_raster_test.cpp bake_store_test.cpp
    bake_bilinear_test.cpp bake_high_map_test.cpp bake_test.cpp bake_first_test.cpp
    bake_rays_test.cpp bake_crowded_test.cpp low_tree_test.cpp bake_starts_test.cpp
    bake_bounds_test.cpp name_pairs_test.cpp bake_maps_test.cpp bake_hard_edges_test.cpp bake_materials_test.cpp
    bake_verdict_test.cpp bake_hints_test.cpp
  LIBRARIES cotan_app cotan_bake cotan_model cotan_scene cotan_truth cotan_core)
cotan_test(bake_command_test BATCH 1
  SOURCES bake_command_test.cpp bake_features_test.cpp bake_high_map_command_test.cpp bake_objects_command_test.cpp bake_messages_test.cpp
  LIBRARIES cotan_model cotan_scene cotan_truth cotan_core nlohmann_json::nlohmann_json fmt::fmt)
target_compile_definitions(bake_command_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(bake_command_test cotan)
cotan_test(not_built_test
  SOURCES not_built_test.cpp ${PROJECT_SOURCE_DIR}/src/bake/no_rays.cpp ${PROJECT_SOURCE_DIR}/src/model/no_assimp.cpp
  LIBRARIES cotan_core cotan_scene cotan_files)
foreach(part bake model gltf)
  target_include_directories(not_built_test PRIVATE ${PROJECT_SOURCE_DIR}/src/${part}/include)
endforeach()
