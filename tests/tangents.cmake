cotan_test(tangents_test
  SOURCES tangents_test.cpp tangents_groups_test.cpp cotangents_test.cpp tangents_oracle_test.cpp
          tangents_fans_test.cpp parallel_test.cpp
  LIBRARIES cotan_core)
cotan_test(tangents_gltf_test
  SOURCES tangents_gltf_test.cpp
  LIBRARIES cotan_asset)
