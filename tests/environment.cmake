# Light from surroundings, and tone curves.
cotan_test(environment_test
  SOURCES tone_test.cpp environment_test.cpp
  LIBRARIES cotan_environment cotan_draw cotan_shapes cotan_parallel)
