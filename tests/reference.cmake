cotan_test(reference_test BATCH 4 # the four files of a row are compiled at once; rows may repeat file-local names
  SOURCES reference_exact_test.cpp reference_hostile_test.cpp reference_layers_test.cpp reference_shading_test.cpp
    clip_test.cpp reference_frame_test.cpp reference_raster_test.cpp reference_texture_test.cpp
  LIBRARIES cotan_render)
