find_package(ZLIB REQUIRED)
cotan_test(gltf_bad_test
  SOURCES gltf_bad_test.cpp gltf_bounds_test.cpp gltf_hostile_test.cpp gltf_shape_test.cpp
          gltf_container_test.cpp gltf_messages_test.cpp
  LIBRARIES cotan_model cotan_scene cotan_gltf_json ZLIB::ZLIB)
cotan_test(gltf_test
  SOURCES gltf_test.cpp gltf_accessor_test.cpp gltf_mesh_test.cpp gltf_scene_test.cpp gltf_material_test.cpp gltf_unpack_test.cpp gltf_animation_test.cpp
          gltf_packed_test.cpp gltf_packed_views_test.cpp
          stored_green_test.cpp auto_frame_choice_test.cpp gltf_pose_test.cpp gltf_vertices_test.cpp gltf_images_test.cpp
  LIBRARIES cotan_model cotan_scene cotan_gltf_json ZLIB::ZLIB draco::draco meshoptimizer::meshoptimizer)
cotan_test(gltf_models_test
  SOURCES gltf_models_test.cpp deforming_models_test.cpp
  LIBRARIES cotan_model cotan_scene cotan_gltf_json ZLIB::ZLIB)
