# Drawing and verification through the C++ interface, without files and processes.
cotan_test(draw_test
  SOURCES draw_test.cpp draw_random_test.cpp height_map_test.cpp scene_check_test.cpp scene_parts_test.cpp scene_parts_bounds_test.cpp
    exposure_meter_test.cpp
    verify_frames_test.cpp verify_test.cpp
  LIBRARIES cotan_app cotan_render cotan_inspect cotan_bake cotan_gltf cotan_scene)
