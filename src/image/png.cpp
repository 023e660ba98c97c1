// PNG: reading.
#include "codecs.hpp"

#include <bit>
#include <csetjmp>
#include <cstring>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "image/checks.hpp"
#include "png_errors.hpp"

namespace cotan {

namespace {

struct PngReader {
    std::span<const std::byte> left;    // of a PNG in memory: the bytes not yet consumed
    std::FILE* file = nullptr;          // or its file, which stays open
    char message[kPngMessage] = "";     // the error of what returned false
    char frame[kMaxFrameText + 1] = ""; // Image::frame, of chunks met so far
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

// The value of a text chunk whose key is kFrameKey; empty for others, and where it is compressed.
std::string_view frameOfChunk(std::string_view type, std::string_view data)
{
    const std::size_t zero = data.find('\0');
    if (zero == data.npos || data.substr(0, zero) != kFrameKey)
        return {};
    data.remove_prefix(zero + 1);
    if (type == "tEXt")
        return data;
    // iTXt: compressed or not, the method, a language, the key in that language.
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

// Every chunk that is not about pixels, one at a time. 1: nothing else is to be done with it.
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
    int passes = 1;     // more: interlaced
    bool alpha = false; // of its own, or a transparent colour
    int channels = 4;   // Image::channels
};

// Reads up to the pixel data and asks for RGBA.
bool readPngHeader(PngReader& reader, PngHeader& header)
{
    png_structp png = reader.png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_read_fn(png, &reader, onRead);
    // The size is checked by us; the chunks that are not about pixels are skipped.
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

// Begins with the pixels: their rows have rowBytes.
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

// Decodes all rows into `pixels`, `rowBytes` apart, and reads to the end of the file.
bool readPixels(PngReader& reader, const PngHeader& header, png_bytep pixels, std::size_t rowBytes)
{
    if (!startPngPixels(reader, rowBytes))
        return false;
    for (int pass = 0; pass < header.passes; ++pass)
        if (!readPngRows(reader, pixels, header.height, rowBytes))
            return false;
    return endPngPixels(reader);
}

Error pngError(const std::string& name, const PngReader& reader)
{
    return inputError(
        fmt::format("{}: broken PNG: expected data that libpng can read, it found: {}", name, reader.message));
}

class PngRows : public RowReader {
public:
    explicit PngRows(File file) : file_(std::move(file)), reader_(file_.get()) {}

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
    File file_;
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
    if (!readPixels(reader, header, image.bytes8(), rowBytes))
        return pngError(name, reader);
    return image;
}

std::optional<Result<std::unique_ptr<RowReader>>> openPngRows(const std::filesystem::path& file, File stream,
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
        return inputError(fmt::format("{}: the image size is {} x {}, the limit is {} a side", file.string(),
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

} // namespace cotan
