# What turns a scene into an image: environment light, tone curves, framing.
cotan_test(environment_test BATCH 4 SLOW Environment.* Facets.keep*
  SOURCES tone_test.cpp environment_test.cpp specular_antialiasing_test.cpp front_camera_test.cpp ground_test.cpp soft_shadows_test.cpp
    albedo_test.cpp exposure_test.cpp samples_test.cpp
  LIBRARIES cotan_render cotan_truth cotan_inspect cotan_scene)
