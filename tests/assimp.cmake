cotan_test(geometry_test SOURCES geometry_test.cpp vector_test.cpp LIBRARIES cotan_model cotan_scene)
find_package(assimp REQUIRED)
cotan_test(assimp_test
  SOURCES assimp_test.cpp assimp_convert_test.cpp
  LIBRARIES cotan_model cotan_scene cotan_core assimp::assimp fmt::fmt)
target_include_directories(assimp_test PRIVATE ${PROJECT_SOURCE_DIR}/src/model) # for its conversion
cotan_test(obj_test
  SOURCES obj_test.cpp model_collada_test.cpp model_materials_test.cpp
  LIBRARIES cotan_model cotan_scene fmt::fmt)
