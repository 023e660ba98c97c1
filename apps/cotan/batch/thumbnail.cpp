#include "batch/record.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <jpeglib.h>

#include "cotan/image.hpp"
#include "files/bytes.hpp"
#include "html.hpp"

namespace cotan {

namespace {

constexpr int kSide = 64, kQuality = 80; // pixels; JPEG quality in percent
constexpr double kBackgroundGrey = 0.5;  // grey behind transparent pixels

double valueOf(const Image& strip, std::size_t pixel, int channel)
{
    switch (strip.type) {
    case PixelType::unorm8: return strip.bytes8()[pixel * 4 + std::size_t(channel)] / 255.0;
    case PixelType::unorm16: return strip.words()[pixel * 4 + std::size_t(channel)] / 65535.0;
    default: {
        const double value = double(strip.floats()[pixel * 4 + std::size_t(channel)]);
        return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0;
    }
    }
}

// The mean colour of the input pixels that fall on each pixel.
struct Means {
    int width, height;
    std::vector<std::array<double, 4>> sums; // red, green, blue, count

    void add(const Image& strip, int row, int fromWidth, int fromHeight, bool alpha)
    {
        const int y = int(std::int64_t(row) * height / fromHeight);
        for (int x = 0; x < fromWidth; ++x) {
            auto& sum = sums[std::size_t(y) * std::size_t(width) + std::size_t(std::int64_t(x) * width / fromWidth)];
            const double a = alpha ? valueOf(strip, std::size_t(x), 3) : 1;
            for (int c = 0; c < 3; ++c)
                sum[std::size_t(c)] += a * valueOf(strip, std::size_t(x), c) + (1 - a) * kBackgroundGrey;
            sum[3] += 1;
        }
    }

    std::vector<unsigned char> pixels() const
    {
        std::vector<unsigned char> all;
        for (const auto& sum : sums)
            for (std::size_t c = 0; c < 3; ++c)
                all.push_back(static_cast<unsigned char>(255 * sum[c] / std::max(sum[3], 1.0) + 0.5));
        return all;
    }
};

// Makes libjpeg return on errors; by default it ends the program.
struct Errors {
    jpeg_error_mgr manager{};
    std::jmp_buf escape{};
};

void onError(j_common_ptr common) { std::longjmp(reinterpret_cast<Errors*>(common->err)->escape, 1); }
void onMessage(j_common_ptr) {}

// Has no local objects with destructors, since errors leave the function by longjmp.
bool encode(const unsigned char* pixels, int width, int height, unsigned char** bytes, unsigned long* size)
{
    jpeg_compress_struct jpeg{};
    Errors errors;
    jpeg.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = onError;
    errors.manager.output_message = onMessage;
    if (setjmp(errors.escape)) {
        jpeg_destroy_compress(&jpeg);
        return false;
    }
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, bytes, size);
    jpeg.image_width = JDIMENSION(width);
    jpeg.image_height = JDIMENSION(height);
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, kQuality, TRUE);
    jpeg.optimize_coding = TRUE;
    jpeg_start_compress(&jpeg, TRUE);
    while (jpeg.next_scanline < jpeg.image_height) {
        JSAMPROW row = const_cast<JSAMPROW>(pixels) + std::size_t(jpeg.next_scanline) * std::size_t(width) * 3;
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    return true;
}

} // namespace

std::optional<Thumbnail> thumbnailOf(const std::filesystem::path& image)
{
    auto rows = openRows(image);
    if (!rows || (*rows)->width < 1 || (*rows)->height < 1)
        return std::nullopt;
    RowReader& reader = **rows;
    const double factor = std::min({1.0, double(kSide) / reader.width, double(kSide) / reader.height});
    Means means{std::max(1, int(std::lround(factor * reader.width))),
                std::max(1, int(std::lround(factor * reader.height))),
                {}};
    means.sums.resize(std::size_t(means.width) * std::size_t(means.height));
    Image strip = makeImage(reader.width, 1, reader.type, reader.name);
    for (int row = 0; row < reader.height; ++row) {
        if (!reader.read(strip))
            return std::nullopt;
        means.add(strip, row, reader.width, reader.height, reader.alpha);
    }
    const std::vector<unsigned char> pixels = means.pixels();
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    std::optional<Thumbnail> thumbnail;
    if (encode(pixels.data(), means.width, means.height, &bytes, &size))
        thumbnail = Thumbnail{means.width, means.height, toBase64({reinterpret_cast<const char*>(bytes), size})};
    std::free(bytes);
    return thumbnail;
}

} // namespace cotan
