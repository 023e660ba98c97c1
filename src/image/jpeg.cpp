#include "codecs.hpp"

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>
// libjpeg's header needs <cstdio> before it.
#include <jerror.h>
#include <jpeglib.h>

#include "image/checks.hpp"

namespace cotan {

namespace {

// A progressive file may cover the whole image in any number of scans; real files have about ten. Each scan costs about
// a nanosecond per pixel, even if it is empty.
constexpr std::size_t kMaxScans = 100;
constexpr std::size_t kMaxScannedPixels = 4'000'000'000;

// libjpeg reports errors by a callback, which must leave by longjmp, so the functions that call it have no local
// objects with destructors.
struct Decoder {
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
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

// libjpeg conceals damage and continues; warnings about missing or wrong image data are errors here. It reports invalid
// Huffman codes in progressive files only, and at the end of others.
void onMessage(j_common_ptr common, int level)
{
    const int code = common->err->msg_code;
    if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE))
        onError(common);
}

void onOutput(j_common_ptr) {}

bool readHeader(Decoder& decoder, std::span<const std::byte> bytes)
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
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()),
                 static_cast<unsigned long>(std::min(bytes.size(), std::size_t(ULONG_MAX)))); // 32 bits on Windows
    jpeg_read_header(&jpeg, TRUE);
    return true;
}

bool isCmyk(J_COLOR_SPACE stored) { return stored == JCS_CMYK || stored == JCS_YCCK; }

// Converts a row in place. As Photoshop writes them, and other readers expect, 0 is full ink. Without a colour profile,
// each ink transmits its fraction of a colour, and black its fraction of all.
void cmykToRgba(unsigned char* row, std::size_t width)
{
    for (unsigned char* pixel = row; pixel != row + 4 * width; pixel += 4) {
        for (int c = 0; c < 3; ++c)
            pixel[c] = static_cast<unsigned char>((pixel[c] * pixel[3] + 127) / 255);
        pixel[3] = 255;
    }
}

bool readPixels(Decoder& decoder, unsigned char* pixels, std::size_t rowBytes)
{
    jpeg_decompress_struct& jpeg = decoder.jpeg;
    if (setjmp(decoder.escape))
        return false;
    jpeg.out_color_space = isCmyk(jpeg.jpeg_color_space) ? JCS_CMYK : JCS_EXT_RGBA; // both have 4 bytes per pixel
    jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row = pixels + jpeg.output_scanline * rowBytes;
        jpeg_read_scanlines(&jpeg, &row, 1);
        if (jpeg.out_color_space == JCS_CMYK)
            cmykToRgba(row, jpeg.output_width);
    }
    jpeg_finish_decompress(&jpeg);
    return true;
}

// Counts the scans by their markers. In entropy-coded data 0xff is followed by 0 or is a restart marker.
std::size_t countScans(std::span<const std::byte> bytes)
{
    const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
    std::size_t scans = 0;
    for (std::size_t at = 0; at + 1 < bytes.size();) {
        const void* const found = std::memchr(data + at, 0xff, bytes.size() - 1 - at);
        if (!found)
            break;
        at = std::size_t(static_cast<const unsigned char*>(found) - data) + 1;
        const unsigned char marker = data[at];
        if (marker == 0xda)
            ++scans;
        const bool bare = marker == 0 || marker == 0xff || marker == 1 || (marker >= 0xd0 && marker <= 0xd9);
        if (!bare && at + 2 < bytes.size()) // the length counts its own two bytes
            at += 1 + (std::size_t(data[at + 1]) << 8 | data[at + 2]);
    }
    return scans;
}

// Checks costs beyond those of the pixels: time for every scan and, for files of several scans, memory for all
// coefficients, 2 bytes each. jpeg: its header has been read. buffered: whether other files need that memory, too.
std::optional<Error> checkScans(const jpeg_decompress_struct& jpeg, std::span<const std::byte> bytes,
                                const std::string& name, const LoadLimits& limits, bool buffered = false)
{
    const std::size_t pixels = std::size_t(jpeg.image_width) * jpeg.image_height;
    const std::size_t scans = countScans(bytes);
    if (scans > kMaxScans || scans * pixels > kMaxScannedPixels)
        return inputError(
            fmt::format("{}: expected at most {} scans and {} pixels in all, found {} scans of {} x {} pixels", name,
                        kMaxScans, kMaxScannedPixels, scans, jpeg.image_width, jpeg.image_height));
    std::size_t coefficients = 0;
    for (int c = 0; c < jpeg.num_components; ++c)
        coefficients += std::size_t(jpeg.comp_info[c].width_in_blocks) * jpeg.comp_info[c].height_in_blocks * DCTSIZE2;
    buffered = buffered || jpeg.progressive_mode || scans > 1;
    if (buffered && coefficients * sizeof(JCOEF) > limits.imageBytes)
        return memoryError(fmt::format("{}: its {} scans of {} x {} pixels take {} bytes, the limit is {}", name, scans,
                                       jpeg.image_width, jpeg.image_height, coefficients * sizeof(JCOEF),
                                       limits.imageBytes));
    return std::nullopt;
}

} // namespace

std::optional<Result<Image>> readJpeg(std::span<const std::byte> bytes, const std::string& name,
                                      const LoadLimits& limits)
{
    Decoder decoder;
    const auto broken = [&] {
        return inputError(
            fmt::format("{}: broken JPEG: expected data that libjpeg can read, it found: {}", name, decoder.message));
    };
    if (!readHeader(decoder, bytes))
        return broken();
    if (auto error = checkScans(decoder.jpeg, bytes, name, limits))
        return *error;
    const J_COLOR_SPACE stored = decoder.jpeg.jpeg_color_space;
    if (stored != JCS_GRAYSCALE && stored != JCS_YCbCr && stored != JCS_RGB && !isCmyk(stored))
        return inputError(
            fmt::format("{}: expected a grey, colour or CMYK JPEG, found {} components of unknown meaning", name,
                        decoder.jpeg.num_components));
    const int width = int(decoder.jpeg.image_width), height = int(decoder.jpeg.image_height);
    if (auto error = checkImageSize(width, height, PixelType::unorm8, name, limits))
        return *error;
    Image image = makeImage(width, height, PixelType::unorm8, name);
    image.channels = stored == JCS_GRAYSCALE ? 1 : 3;
    if (!readPixels(decoder, image.bytes8(), std::size_t(width) * 4))
        return broken();
    return image;
}

namespace {

// Places the units in the image, whose header has been read.
JpegBlocks placeUnits(const jpeg_decompress_struct& jpeg, std::size_t maxUnits)
{
    JpegBlocks blocks{.unitWidth = jpeg.max_h_samp_factor * DCTSIZE, .unitHeight = jpeg.max_v_samp_factor * DCTSIZE};
    blocks.rgb = jpeg.jpeg_color_space == JCS_RGB;
    const std::size_t across = jpeg.image_width / std::size_t(blocks.unitWidth);
    const std::size_t all = across * (jpeg.image_height / std::size_t(blocks.unitHeight));
    constexpr double kGolden =
        0.618033988749895; // fractions of its multiples are spread evenly, at no regular distance
    for (std::size_t i = 0; i < std::min(all, maxUnits); ++i) {
        const double whole = double(i) * kGolden;
        const std::size_t unit = all <= maxUnits ? i : std::size_t((whole - std::floor(whole)) * double(all));
        blocks.units.push_back({int(unit % across) * blocks.unitWidth, int(unit / across) * blocks.unitHeight});
    }
    for (std::size_t c = 0; c < blocks.components.size(); ++c) {
        JpegBlocks::Component& component = blocks.components[c];
        component.across = jpeg.comp_info[c].h_samp_factor;
        component.down = jpeg.comp_info[c].v_samp_factor;
        component.coefficients.resize(blocks.units.size() * std::size_t(component.across * component.down) * DCTSIZE2);
    }
    return blocks;
}

bool readUnits(Decoder& decoder, JpegBlocks& blocks)
{
    jpeg_decompress_struct& jpeg = decoder.jpeg;
    if (setjmp(decoder.escape))
        return false;
    jvirt_barray_ptr* const arrays = jpeg_read_coefficients(&jpeg);
    for (std::size_t c = 0; c < blocks.components.size(); ++c) {
        JpegBlocks::Component& component = blocks.components[c];
        if (!jpeg.comp_info[c].quant_table)
            return false;
        std::copy_n(jpeg.comp_info[c].quant_table->quantval, DCTSIZE2, component.steps.data());
        std::int16_t* out = component.coefficients.data();
        for (const auto& [left, top] : blocks.units)
            for (int row = 0; row < component.down; ++row, out += component.across * DCTSIZE2) {
                const int y = top / blocks.unitHeight * component.down + row;
                const JBLOCK* const blockRow = jpeg.mem->access_virt_barray(reinterpret_cast<j_common_ptr>(&jpeg),
                                                                            arrays[c], JDIMENSION(y), 1, FALSE)[0];
                std::copy_n(blockRow[left / blocks.unitWidth * component.across], component.across * DCTSIZE2, out);
            }
    }
    return true;
}

} // namespace

std::optional<JpegBlocks> readJpegBlocks(std::span<const std::byte> bytes, const LoadLimits& limits,
                                         std::size_t maxUnits)
{
    Decoder decoder;
    if (!readHeader(decoder, bytes) || checkScans(decoder.jpeg, bytes, {}, limits, /*buffered*/ true)
        || (decoder.jpeg.jpeg_color_space != JCS_YCbCr && decoder.jpeg.jpeg_color_space != JCS_RGB)
        || checkImageSize(int(decoder.jpeg.image_width), int(decoder.jpeg.image_height), PixelType::unorm8, {}, limits))
        return std::nullopt;
    JpegBlocks blocks = placeUnits(decoder.jpeg, maxUnits);
    return readUnits(decoder, blocks) ? std::optional(std::move(blocks)) : std::nullopt;
}

namespace {

struct Encoder {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    std::jmp_buf escape{};
    unsigned char* bytes = nullptr;
    unsigned long size = 0;

    Encoder() = default;
    ~Encoder()
    {
        jpeg_destroy_compress(&jpeg);
        std::free(bytes);
    }
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;
};

void onEncoderError(j_common_ptr common) { std::longjmp(static_cast<Encoder*>(common->client_data)->escape, 1); }

// Calls configure(jpeg) after the defaults are set. Returns false if there is not enough memory.
template<class Configure> bool writePixels(Encoder& encoder, const Image& image, const Configure& configure)
{
    jpeg_compress_struct& jpeg = encoder.jpeg;
    jpeg.err = jpeg_std_error(&encoder.errors);
    encoder.errors.error_exit = onEncoderError;
    encoder.errors.output_message = onOutput;
    jpeg.client_data = &encoder;
    if (setjmp(encoder.escape))
        return false;
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &encoder.bytes, &encoder.size);
    jpeg.image_width = JDIMENSION(image.width);
    jpeg.image_height = JDIMENSION(image.height);
    jpeg.input_components = 4;
    jpeg.in_color_space = JCS_EXT_RGBA;
    jpeg_set_defaults(&jpeg);
    jpeg.optimize_coding = TRUE;
    configure(jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    while (jpeg.next_scanline < jpeg.image_height) {
        auto* row = const_cast<JSAMPROW>(image.bytes8()) + std::size_t(jpeg.next_scanline) * jpeg.image_width * 4;
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    return true;
}

// Copies the settings of a JPEG whose header has been read.
void copySettings(const jpeg_decompress_struct& like, jpeg_compress_struct& jpeg)
{
    jpeg_set_colorspace(&jpeg, like.jpeg_color_space);
    for (int slot = 0; slot < NUM_QUANT_TBLS; ++slot)
        if (const JQUANT_TBL* const table = like.quant_tbl_ptrs[slot]) {
            unsigned int steps[DCTSIZE2];
            for (int k = 0; k < DCTSIZE2; ++k)
                steps[k] = table->quantval[k];
            jpeg_add_quant_table(&jpeg, slot, steps, 100, TRUE);
        }
    for (int c = 0; c < 3; ++c) {
        jpeg.comp_info[c].h_samp_factor = like.comp_info[c].h_samp_factor;
        jpeg.comp_info[c].v_samp_factor = like.comp_info[c].v_samp_factor;
        jpeg.comp_info[c].quant_tbl_no = like.comp_info[c].quant_tbl_no;
    }
    if (like.progressive_mode)
        jpeg_simple_progression(&jpeg);
}

// The quality setting of libjpeg's encoder that gives this table. Quality 50 gives the steps of the standard.
int qualityOf(const JQUANT_TBL& table)
{
    constexpr int kStandard = 3688; // sum of the luminance steps: ITU-T T.81, table K.1
    int sum = 0;
    for (const UINT16 step : table.quantval)
        sum += step;
    const double scale = 100.0 * sum / kStandard;
    return std::clamp(int(std::lround(scale <= 100 ? (200 - scale) / 2 : 5000 / scale)), 1, 100);
}

} // namespace

std::optional<Result<std::vector<std::byte>>> writeJpegLike(const Image& image, std::span<const std::byte> old,
                                                            int& quality)
{
    Decoder decoder;
    if (!readHeader(decoder, old))
        return std::nullopt;
    const jpeg_decompress_struct& like = decoder.jpeg;
    if (like.jpeg_color_space != JCS_YCbCr && like.jpeg_color_space != JCS_RGB)
        return std::nullopt;
    for (int c = 0; c < 3; ++c)
        if (!like.quant_tbl_ptrs[like.comp_info[c].quant_tbl_no])
            return std::nullopt;
    quality = qualityOf(*like.quant_tbl_ptrs[like.comp_info[0].quant_tbl_no]);
    Encoder encoder;
    if (!writePixels(encoder, image, [&](jpeg_compress_struct& jpeg) { copySettings(like, jpeg); }))
        return outputError(image.name + ": not enough memory for its JPEG file");
    const auto* const bytes = reinterpret_cast<const std::byte*>(encoder.bytes);
    return std::vector<std::byte>(bytes, bytes + encoder.size);
}

std::string writeJpeg(const Image& image, int quality)
{
    Encoder encoder;
    if (!writePixels(encoder, image, [&](jpeg_compress_struct& jpeg) { jpeg_set_quality(&jpeg, quality, TRUE); }))
        return {};
    return {reinterpret_cast<const char*>(encoder.bytes), encoder.size};
}

} // namespace cotan
