# Default values of the structs of all parts.
cotan_test(defaults_test
  SOURCES defaults_options_test.cpp defaults_results_test.cpp
  LIBRARIES cotan_bake cotan_batch cotan_figures cotan_files cotan_gltf cotan_gltf_json cotan_image cotan_inspect
    cotan_map_files cotan_maps cotan_picture cotan_app cotan_scene cotan_shader_text cotan_inspect cotan_core)
