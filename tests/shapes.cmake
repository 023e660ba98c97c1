cotan_test(shapes_test SOURCES shapes_test.cpp builtin_scene_test.cpp maps_test.cpp LIBRARIES cotan_model cotan_scene)
