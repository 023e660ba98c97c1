#include "codecs.hpp"

#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <png.h>

#include "core/try.hpp"
#include "image/checks.hpp"

namespace cotan {

namespace {

// libpng reports errors by a callback, which must leave by longjmp, so the functions that call it have no local objects
// with destructors.

constexpr std::size_t kPngMessage = 128; // bytes of the message buffer at png_get_error_ptr

void onPngError(png_structp png, png_const_charp message)
{
    std::snprintf(static_cast<char*>(png_get_error_ptr(png)), kPngMessage, "%s", message);
    png_longjmp(png, 1);
}

void onPngWarning(png_structp, png_const_charp) {}

// ---- reading -------------------------------------------------------------------------------

struct PngReader {
    std::span<const std::byte> left;    // of a PNG in memory: bytes not yet consumed
    std::FILE* file = nullptr;          // or the open file, which the caller closes
    char message[kPngMessage] = "";     // set when a function returns false
    char frame[kMaxFrameText + 1] = ""; // Image::frame, from the chunks read so far
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, message, onPngError, onPngWarning);
    png_infop info = png ? png_create_info_struct(png) : nullptr; // null: out of memory

    explicit PngReader(std::span<const std::byte> bytes) : left(bytes) {}
    explicit PngReader(std::FILE* in) : file(in) {}
    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
};

void onRead(png_structp png, png_bytep target, std::size_t size)
{
    auto* reader = static_cast<PngReader*>(png_get_io_ptr(png));
    if (reader->file) {
        if (std::fread(target, 1, size, reader->file) != size)
            png_error(png, "the file ends too early");
        return;
    }
    if (size > reader->left.size())
        png_error(png, "the file ends too early");
    std::memcpy(target, reader->left.data(), size);
    reader->left = reader->left.subspan(size);
}

// The value of an uncompressed text chunk whose key is kFrameKey; empty for all other chunks.
std::string_view frameOfChunk(std::string_view type, std::string_view data)
{
    const std::size_t zero = data.find('\0');
    if (zero == data.npos || data.substr(0, zero) != kFrameKey)
        return {};
    data.remove_prefix(zero + 1);
    if (type == "tEXt")
        return data;
    // iTXt: compression flag, compression method, language, translated key.
    if (data.size() < 2 || data[0] != 0)
        return {};
    data.remove_prefix(2);
    for (int i = 0; i < 2; ++i) {
        const std::size_t end = data.find('\0');
        if (end == data.npos)
            return {};
        data.remove_prefix(end + 1);
    }
    return data;
}

// Called for every chunk that does not hold pixels. Returns 1: the chunk is handled.
int onChunk(png_structp png, png_unknown_chunkp chunk)
{
    auto* reader = static_cast<PngReader*>(png_get_user_chunk_ptr(png));
    const std::string_view type(reinterpret_cast<const char*>(chunk->name), 4);
    if (type == "tEXt" || type == "iTXt") {
        const std::string_view frame =
            frameText(frameOfChunk(type, {reinterpret_cast<const char*>(chunk->data), chunk->size}));
        if (!frame.empty())
            reader->frame[frame.copy(reader->frame, kMaxFrameText)] = '\0';
    }
    return 1;
}

struct PngHeader {
    png_uint_32 width = 0;
    png_uint_32 height = 0;
    PixelType type = PixelType::unorm8;
    int passes = 1;     // more than 1: interlaced
    bool alpha = false; // an alpha channel, or a transparent colour
    int channels = 4;   // Image::channels
};

// Reads up to the pixel data and requests RGBA.
bool readPngHeader(PngReader& reader, PngHeader& header)
{
    png_structp png = reader.png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_read_fn(png, &reader, onRead);
    // readPng checks the size; chunks that do not hold pixels are skipped.
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_read_user_chunk_fn(png, &reader, onChunk);
    png_read_info(png, reader.info);

    header.width = png_get_image_width(png, reader.info);
    header.height = png_get_image_height(png, reader.info);
    const bool wide = png_get_bit_depth(png, reader.info) == 16;
    header.type = wide ? PixelType::unorm16 : PixelType::unorm8;
    header.alpha = (png_get_color_type(png, reader.info) & PNG_COLOR_MASK_ALPHA) != 0
        || png_get_valid(png, reader.info, PNG_INFO_tRNS) != 0;
    const bool coloured = (png_get_color_type(png, reader.info) & PNG_COLOR_MASK_COLOR) != 0;
    header.channels = (coloured ? 3 : 1) + (header.alpha ? 1 : 0);

    png_set_expand(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xffff, PNG_FILLER_AFTER);
    header.passes = png_set_interlace_handling(png);
    if (wide && std::endian::native == std::endian::little)
        png_set_swap(png);
    return true;
}

// Starts on the pixels. Fails unless their rows have rowBytes.
bool startPngPixels(PngReader& reader, std::size_t rowBytes)
{
    png_structp png = reader.png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_read_update_info(png, reader.info);
    if (png_get_rowbytes(png, reader.info) != rowBytes)
        png_error(png, "unexpected row size");
    return true;
}

// Decodes `count` rows into `pixels`, rowBytes apart.
bool readPngRows(PngReader& reader, png_bytep pixels, std::size_t count, std::size_t rowBytes)
{
    png_structp png = reader.png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    for (std::size_t y = 0; y < count; ++y)
        png_read_row(png, pixels + y * rowBytes, nullptr);
    return true;
}

// Reads to the end of the file.
bool endPngPixels(PngReader& reader)
{
    if (setjmp(png_jmpbuf(reader.png)))
        return false;
    png_read_end(reader.png, nullptr);
    return true;
}

Error pngError(const std::string& name, const PngReader& reader)
{
    return inputError(
        fmt::format("{}: broken PNG: expected data that libpng can read, it found: {}", name, reader.message));
}

class PngRows : public RowReader {
public:
    explicit PngRows(OpenFile file) : file_(std::move(file)), reader_(file_.get()) {}

    PngReader& reader() { return reader_; }

    Status read(Image& strip) override
    {
        const std::size_t rowBytes = std::size_t(width) * strip.bytesPerPixel();
        bool fine = started_ || startPngPixels(reader_, rowBytes);
        started_ = true;
        fine = fine && readPngRows(reader_, strip.bytes8(), std::size_t(strip.height), rowBytes);
        next_ += strip.height;
        if (fine && next_ == height)
            fine = endPngPixels(reader_);
        return fine ? Status(Done{}) : pngError(name, reader_);
    }

private:
    OpenFile file_;
    PngReader reader_;
    bool started_ = false;
    int next_ = 0;
};

} // namespace

Result<Image> readPng(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
{
    PngReader reader(bytes);
    if (!reader.info)
        return inputError(fmt::format("{}: out of memory", name));
    PngHeader header;
    if (!readPngHeader(reader, header))
        return pngError(name, reader);
    if (auto error = checkImageSize(header.width, header.height, header.type, name, limits))
        return *error;

    Image image = makeImage(int(header.width), int(header.height), header.type, name);
    image.frame = reader.frame;
    image.channels = header.channels;
    const std::size_t rowBytes = std::size_t(header.width) * image.bytesPerPixel();
    bool fine = startPngPixels(reader, rowBytes);
    for (int pass = 0; fine && pass < header.passes; ++pass)
        fine = readPngRows(reader, image.bytes8(), header.height, rowBytes);
    if (!fine || !endPngPixels(reader))
        return pngError(name, reader);
    return image;
}

std::optional<Result<std::unique_ptr<RowReader>>> openPngRows(const std::filesystem::path& file, OpenFile stream,
                                                              const LoadLimits& limits)
{
    std::rewind(stream.get());
    auto rows = std::make_unique<PngRows>(std::move(stream));
    PngHeader header;
    if (!rows->reader().info)
        return inputError(fmt::format("{}: out of memory", file.string()));
    if (!readPngHeader(rows->reader(), header))
        return pngError(file.string(), rows->reader());
    if (header.passes > 1)
        return std::nullopt;
    if (header.width > png_uint_32(limits.imageSide) || header.height > png_uint_32(limits.imageSide))
        return inputError(fmt::format("{}: the image size is {} x {}, the limit is {} per side", file.string(),
                                      header.width, header.height, limits.imageSide));
    rows->name = file.string();
    rows->width = int(header.width);
    rows->height = int(header.height);
    rows->type = header.type;
    rows->alpha = header.alpha;
    rows->channels = header.channels;
    rows->frame = rows->reader().frame;
    return std::unique_ptr<RowReader>(std::move(rows));
}

// ---- writing -------------------------------------------------------------------------------

namespace {

struct PngWriter {
    std::vector<std::byte> bytes;   // of the file
    char message[kPngMessage] = ""; // set when a function returns false
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, message, onPngError, onPngWarning);
    png_infop info = png ? png_create_info_struct(png) : nullptr; // null: out of memory

    PngWriter() = default;
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
};

// No exception may pass through libpng.
bool append(std::span<const std::byte> more, std::vector<std::byte>& bytes)
try {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return true;
} catch (const std::bad_alloc&) {
    return false;
}

void onWrite(png_structp png, png_bytep source, std::size_t size)
{
    auto* const bytes = static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
    if (!append({reinterpret_cast<const std::byte*>(source), size}, *bytes))
        png_error(png, "out of memory");
}

void onFlush(png_structp) {}

// Writes the header, for unorm8 or unorm16. Without format.alpha, the alpha of the rows is dropped.
bool startPng(PngWriter& writer, const RowFormat& format)
{
    png_structp png = writer.png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    const bool wide = format.type == PixelType::unorm16;
    png_set_write_fn(png, &writer.bytes, onWrite, onFlush);
    // libpng's default limit is 1,000,000 pixels per side.
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_IHDR(png, writer.info, png_uint_32(format.width), png_uint_32(format.height), wide ? 16 : 8,
                 format.alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (format.frame.c_str()[0] != '\0') {
        png_text text = {};
        text.compression = PNG_TEXT_COMPRESSION_NONE;
        text.key = const_cast<png_charp>(kFrameKey.data()); // libpng copies key and text
        text.text = const_cast<png_charp>(format.frame.c_str());
        text.text_length = std::strlen(format.frame.c_str());
        png_set_text(png, writer.info, &text, 1);
    }
    png_write_info(png, writer.info);
    if (!format.alpha)
        png_set_filler(png, 0, PNG_FILLER_AFTER);
    if (wide && std::endian::native == std::endian::little)
        png_set_swap(png);
    return true;
}

bool writePngRows(PngWriter& writer, png_const_bytep pixels, std::size_t count, std::size_t rowBytes)
{
    png_structp png = writer.png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    for (std::size_t y = 0; y < count; ++y)
        png_write_row(png, pixels + y * rowBytes);
    return true;
}

bool endPng(PngWriter& writer)
{
    if (setjmp(png_jmpbuf(writer.png)))
        return false;
    png_write_end(writer.png, nullptr);
    return true;
}

} // namespace

Result<std::vector<std::byte>> encodePng(const Image& image)
{
    PngWriter writer;
    const RowFormat format = {image.width, image.height, image.type, !isOpaque(image), false, image.frame};
    if (!writer.info)
        return outputError(fmt::format("{}: out of memory", image.name));
    if (!startPng(writer, format)
        || !writePngRows(writer, image.bytes8(), std::size_t(image.height),
                         std::size_t(image.width) * image.bytesPerPixel())
        || !endPng(writer))
        return outputError(fmt::format("{}: {}", image.name, writer.message));
    return std::move(writer.bytes);
}

} // namespace cotan
