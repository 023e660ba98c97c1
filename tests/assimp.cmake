cotan_test(geometry_test SOURCES geometry_test.cpp LIBRARIES cotan_asset)
cotan_test(assimp_test SOURCES assimp_test.cpp LIBRARIES cotan_asset cotan_core)
