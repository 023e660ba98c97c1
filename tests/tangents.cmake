cotan_test(tangents_test BATCH 4
  SOURCES tangents_test.cpp tangents_groups_test.cpp cotangents_test.cpp tangents_oracle_test.cpp
          tangents_fans_test.cpp parallel_test.cpp triangle_test.cpp adjacency_test.cpp
          meshlets_test.cpp tangents_progress_test.cpp gpu_meshes_test.cpp
  LIBRARIES cotan_core cotan_truth)
cotan_test(tangents_gltf_test
  SOURCES tangents_gltf_test.cpp
  LIBRARIES cotan_model cotan_scene)

# Loops on several threads, with a limit of the memory for starting them.
cotan_test(loops_test SOURCES loops_test.cpp LIBRARIES cotan_core)
target_include_directories(loops_test PRIVATE ${PROJECT_SOURCE_DIR}/apps/cotan)

# Tests with a size_t of 32 bits.
add_test(NAME Core.isRightWith32BitSizes
  COMMAND ${CMAKE_COMMAND} -DCXX=${CMAKE_CXX_COMPILER} "-DFLAGS=-m32 -idirafter /usr/include/${CMAKE_LIBRARY_ARCHITECTURE}"
    -DSOURCE=${PROJECT_SOURCE_DIR} -DOUT=${CMAKE_CURRENT_BINARY_DIR}/core_32bit
    -P ${CMAKE_CURRENT_SOURCE_DIR}/core_32bit.cmake)
set_tests_properties(Core.isRightWith32BitSizes PROPERTIES SKIP_REGULAR_EXPRESSION "skipped:" TIMEOUT 300)
cotan_slow(Core.isRightWith32BitSizes)
