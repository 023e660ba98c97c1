cotan_test(reference_test BATCH 4 # four in a line are compiled at once; names of two lines may be the same
  SOURCES reference_exact_test.cpp reference_hostile_test.cpp reference_layers_test.cpp reference_shading_test.cpp
    clip_test.cpp reference_frame_test.cpp reference_raster_test.cpp reference_texture_test.cpp
  LIBRARIES cotan_render)
