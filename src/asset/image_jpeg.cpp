#include "image_jpeg.hpp"

#include <csetjmp>
#include <cstdio>
#include <cstring>

#include <fmt/format.h>
// libjpeg's header needs <cstdio> before it.
#include <jerror.h>
#include <jpeglib.h>

#include "image_limits.hpp"

namespace cotan {

namespace {

// A progressive file may repeat the whole picture in any number of scans; real ones have about ten.
constexpr int kMostScans = 100;

// libjpeg reports errors by calling back and must be left by longjmp, so the functions that call
// it hold nothing with a destructor.
struct Decoder {
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf escape{};
    char message[JMSG_LENGTH_MAX] = "";

    Decoder() = default;
    ~Decoder() { jpeg_destroy_decompress(&jpeg); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
};

void onError(j_common_ptr common)
{
    auto* decoder = static_cast<Decoder*>(common->client_data);
    common->err->format_message(common, decoder->message);
    std::longjmp(decoder->escape, 1);
}

// libjpeg paints over damage and goes on; where picture data is missing or wrong, we do not.
void onMessage(j_common_ptr common, int level)
{
    const int code = common->err->msg_code;
    if (level < 0
        && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE))
        onError(common);
}

void onOutput(j_common_ptr) {}

void onProgress(j_common_ptr common)
{
    auto* decoder = static_cast<Decoder*>(common->client_data);
    if (decoder->jpeg.input_scan_number <= kMostScans)
        return;
    std::snprintf(decoder->message, sizeof decoder->message, "more than %d scans", kMostScans);
    std::longjmp(decoder->escape, 1);
}

bool readHeader(Decoder& decoder, const unsigned char* data, unsigned long size)
{
    jpeg_decompress_struct& jpeg = decoder.jpeg;
    jpeg.err = jpeg_std_error(&decoder.errors);
    decoder.errors.error_exit = onError;
    decoder.errors.emit_message = onMessage;
    decoder.errors.output_message = onOutput;
    jpeg.client_data = &decoder;
    if (setjmp(decoder.escape))
        return false;
    jpeg_create_decompress(&jpeg); // keeps err and client_data
    decoder.progress.progress_monitor = onProgress;
    jpeg.progress = &decoder.progress;
    jpeg_mem_src(&jpeg, data, size);
    jpeg_read_header(&jpeg, TRUE);
    return true;
}

bool readPixels(Decoder& decoder, unsigned char* pixels, std::size_t rowBytes)
{
    jpeg_decompress_struct& jpeg = decoder.jpeg;
    if (setjmp(decoder.escape))
        return false;
    jpeg.out_color_space = JCS_EXT_RGBA;
    jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row = pixels + jpeg.output_scanline * rowBytes;
        jpeg_read_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_decompress(&jpeg);
    return true;
}

} // namespace

bool isJpeg(std::span<const std::byte> bytes)
{
    return bytes.size() >= 3 && std::memcmp(bytes.data(), "\xff\xd8\xff", 3) == 0;
}

std::optional<Result<Image>> readJpeg(std::span<const std::byte> bytes, const std::string& name,
                                      const LoadLimits& limits)
{
    Decoder decoder;
    const auto broken = [&] {
        return inputError(fmt::format("{}: broken JPEG: {}", name, decoder.message));
    };
    if (!readHeader(decoder, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()))
        return broken();
    const J_COLOR_SPACE stored = decoder.jpeg.jpeg_color_space;
    if (stored != JCS_GRAYSCALE && stored != JCS_YCbCr && stored != JCS_RGB)
        return std::nullopt;
    const int width = int(decoder.jpeg.image_width), height = int(decoder.jpeg.image_height);
    if (auto error = checkImageSize(width, height, PixelType::unorm8, name, limits))
        return *error;
    Image image = makeImage(width, height, PixelType::unorm8, name);
    if (!readPixels(decoder, image.bytes8(), std::size_t(width) * 4))
        return broken();
    return image;
}

} // namespace cotan
