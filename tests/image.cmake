find_package(ZLIB REQUIRED)
cotan_test(image_test SOURCES image_test.cpp LIBRARIES cotan_asset ZLIB::ZLIB)
