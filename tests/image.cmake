find_package(JPEG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(zstd CONFIG REQUIRED)
find_library(COTAN_WEBPDEMUX webpdemux REQUIRED) # an independent reader of animations
mark_as_advanced(COTAN_WEBPDEMUX)
cotan_test(image_test BATCH 1 SOURCES image_test.cpp image_tiff_test.cpp image_tiff_entries_test.cpp image_exr_test.cpp image_dds_test.cpp image_signed_test.cpp image_bmp_test.cpp image_jpeg_test.cpp image_webp_test.cpp image_ktx2_test.cpp image_ktx2_messages_test.cpp image_basis_test.cpp image_animation_test.cpp image_format_table_test.cpp image_frame_test.cpp image_encode_like_test.cpp image_messages_test.cpp image_png_rows_test.cpp LIBRARIES cotan_model cotan_scene ZLIB::ZLIB zstd::libzstd_shared JPEG::JPEG WebP::webp fmt::fmt ${COTAN_WEBPDEMUX})
