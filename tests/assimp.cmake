cotan_test(geometry_test SOURCES geometry_test.cpp vector_test.cpp LIBRARIES cotan_model cotan_scene)
cotan_test(assimp_test SOURCES assimp_test.cpp LIBRARIES cotan_model cotan_scene cotan_core)
cotan_test(obj_test
  SOURCES obj_test.cpp model_collada_test.cpp model_materials_test.cpp
  LIBRARIES cotan_model cotan_scene fmt::fmt)
