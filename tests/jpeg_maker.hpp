// JPEG files for tests, encoded by libjpeg itself.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <vector>

#include <jpeglib.h>

#include "cotan/scene.hpp"

namespace cotan::test {

struct JpegSettings {
    int quality = 75;
    bool halved = false;       // chroma at half the width and height
    bool halvedAcross = false; // chroma at half the width
    bool progressive = false;
    bool rgb = false;  // stored as RGB, not as luma and chroma
    bool grey = false; // luma only
};

// image: of type unorm8; its alpha is dropped.
inline std::vector<std::byte> jpegOf(const Image& image, const JpegSettings& settings = {})
{
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = JDIMENSION(image.width);
    jpeg.image_height = JDIMENSION(image.height);
    jpeg.input_components = 4;
    jpeg.in_color_space = JCS_EXT_RGBA;
    jpeg_set_defaults(&jpeg);
    jpeg_set_colorspace(&jpeg, settings.grey ? JCS_GRAYSCALE : settings.rgb ? JCS_RGB : JCS_YCbCr);
    jpeg_set_quality(&jpeg, settings.quality, TRUE);
    jpeg.comp_info[0].h_samp_factor = settings.halved || settings.halvedAcross ? 2 : 1;
    jpeg.comp_info[0].v_samp_factor = settings.halved ? 2 : 1;
    if (settings.progressive)
        jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    while (jpeg.next_scanline < jpeg.image_height) {
        auto* row = const_cast<JSAMPROW>(image.bytes8()) + 4 * jpeg.next_scanline * jpeg.image_width;
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    const auto* const first = reinterpret_cast<const std::byte*>(bytes);
    std::vector<std::byte> made(first, first + size);
    std::free(bytes);
    return made;
}

} // namespace cotan::test
