#include "image_png.hpp"

#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <png.h>

#include "image_limits.hpp"

namespace cotan {

namespace {

// What libpng's callbacks share with us. libpng reports errors by calling back and leaves by
// longjmp, so the functions that call it hold nothing with a destructor.
struct Session {
    const png_byte* next = nullptr; // reading: the bytes not yet consumed
    std::size_t left = 0;
    std::FILE* out = nullptr; // writing
    char message[128] = "";
};

void onError(png_structp png, png_const_charp message)
{
    auto* session = static_cast<Session*>(png_get_error_ptr(png));
    std::snprintf(session->message, sizeof session->message, "%s", message);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

void onRead(png_structp png, png_bytep target, std::size_t size)
{
    auto* session = static_cast<Session*>(png_get_io_ptr(png));
    if (size > session->left)
        png_error(png, "the file ends too early");
    std::memcpy(target, session->next, size);
    session->next += size;
    session->left -= size;
}

void onWrite(png_structp png, png_bytep source, std::size_t size)
{
    auto* session = static_cast<Session*>(png_get_io_ptr(png));
    if (std::fwrite(source, 1, size, session->out) != size)
        png_error(png, "writing failed");
}

void onFlush(png_structp) {}

struct Reader {
    Session session;
    png_structp png = nullptr;
    png_infop info = nullptr;

    explicit Reader(std::span<const std::byte> bytes)
    {
        session.next = reinterpret_cast<const png_byte*>(bytes.data());
        session.left = bytes.size();
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &session, onError, onWarning);
        info = png ? png_create_info_struct(png) : nullptr;
    }
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
};

struct Header {
    png_uint_32 width = 0;
    png_uint_32 height = 0;
    PixelType type = PixelType::unorm8;
    bool interlaced = false;
};

// Reads up to the pixel data and asks for RGBA. False: Session::message says why.
bool readHeader(Reader& reader, Header& header)
{
    png_structp png = reader.png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_read_fn(png, &reader.session, onRead);
    // The size is checked by us; the chunks that are not about pixels are skipped.
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_read_info(png, reader.info);

    header.width = png_get_image_width(png, reader.info);
    header.height = png_get_image_height(png, reader.info);
    const bool wide = png_get_bit_depth(png, reader.info) == 16;
    header.type = wide ? PixelType::unorm16 : PixelType::unorm8;
    header.interlaced = png_get_interlace_type(png, reader.info) != PNG_INTERLACE_NONE;

    png_set_expand(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xffff, PNG_FILLER_AFTER);
    if (wide && std::endian::native == std::endian::little)
        png_set_swap(png);
    return true;
}

// Decodes all rows into `pixels`, `rowBytes` apart, and reads to the end of the file.
bool readPixels(Reader& reader, const Header& header, png_bytep pixels, std::size_t rowBytes)
{
    png_structp png = reader.png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    const int passes = header.interlaced ? png_set_interlace_handling(png) : 1;
    png_read_update_info(png, reader.info);
    if (png_get_rowbytes(png, reader.info) != rowBytes)
        png_error(png, "unexpected row size");
    for (int pass = 0; pass < passes; ++pass)
        for (png_uint_32 y = 0; y < header.height; ++y)
            png_read_row(png, pixels + y * rowBytes, nullptr);
    png_read_end(png, nullptr);
    return true;
}

Error pngError(const std::string& name, const Session& session)
{
    return inputError(fmt::format("{}: broken PNG: {}", name, session.message));
}

} // namespace

bool isPng(std::span<const std::byte> bytes)
{
    return bytes.size() >= 8
        && png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, 8) == 0;
}

Result<Image> readPng(std::span<const std::byte> bytes, const std::string& name,
                      const LoadLimits& limits)
{
    Reader reader(bytes);
    if (!reader.info)
        return inputError(fmt::format("{}: out of memory", name));
    Header header;
    if (!readHeader(reader, header))
        return pngError(name, reader.session);
    if (auto error = checkImageSize(header.width, header.height, header.type, name, limits))
        return *error;

    Image image = makeImage(int(header.width), int(header.height), header.type, name);
    const std::size_t rowBytes = std::size_t(header.width) * image.bytesPerPixel();
    if (!readPixels(reader, header, image.bytes8(), rowBytes))
        return pngError(name, reader.session);
    return image;
}

namespace {

// Measured on 2048 x 2048 maps: a third larger than with libpng's defaults, in a fifth of the
// time (180 ms).
struct Effort {
    int level, filters;
};
constexpr Effort kQuick{2, PNG_FILTER_UP};
constexpr Effort kSmall{6, PNG_ALL_FILTERS}; // libpng's defaults

struct Writer {
    Session session;
    png_structp png = nullptr;
    png_infop info = nullptr;

    explicit Writer(std::FILE* out)
    {
        session.out = out;
        png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &session, onError, onWarning);
        info = png ? png_create_info_struct(png) : nullptr;
    }
    ~Writer() { png_destroy_write_struct(&png, &info); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
};

bool opaque(const Image& image)
{
    const std::size_t count = image.pixelCount();
    if (image.type == PixelType::unorm16) {
        for (std::size_t i = 0; i < count; ++i)
            if (image.words()[4 * i + 3] != 0xffff)
                return false;
        return true;
    }
    for (std::size_t i = 0; i < count; ++i)
        if (image.bytes8()[4 * i + 3] != 0xff)
            return false;
    return true;
}

bool writePixels(Writer& writer, const Image& image, bool withAlpha, Effort effort)
{
    png_structp png = writer.png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    const bool wide = image.type == PixelType::unorm16;
    png_set_write_fn(png, &writer.session, onWrite, onFlush);
    png_set_compression_level(png, effort.level);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, effort.filters);
    png_set_IHDR(png, writer.info, png_uint_32(image.width), png_uint_32(image.height),
                 wide ? 16 : 8, withAlpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, writer.info);
    if (!withAlpha)
        png_set_filler(png, 0, PNG_FILLER_AFTER);
    if (wide && std::endian::native == std::endian::little)
        png_set_swap(png);
    const std::size_t rowBytes = std::size_t(image.width) * image.bytesPerPixel();
    for (int y = 0; y < image.height; ++y)
        png_write_row(png, image.bytes8() + std::size_t(y) * rowBytes);
    png_write_end(png, nullptr);
    return true;
}

// Closes the stream whatever happens.
Status writeTo(std::FILE* out, const Image& image, const std::string& name, Effort effort)
{
    bool written = false;
    std::string why = "out of memory";
    {
        Writer writer(out);
        if (writer.info) {
            written = writePixels(writer, image, !opaque(image), effort);
            why = writer.session.message;
        }
    }
    if (std::fclose(out) != 0 && written) {
        written = false;
        why = "writing failed";
    }
    if (!written)
        return outputError(fmt::format("{}: {}", name, why));
    return Done{};
}

} // namespace

Status writePng(const std::filesystem::path& file, const Image& image, const std::string& name)
{
    std::FILE* out = std::fopen(file.c_str(), "wb");
    if (!out)
        return outputError(fmt::format("{}: cannot be opened for writing", name));
    return writeTo(out, image, name, kQuick);
}

Result<std::vector<std::byte>> encodePng(const Image& image)
{
    char* bytes = nullptr;
    std::size_t size = 0;
    std::FILE* out = ::open_memstream(&bytes, &size);
    if (!out)
        return outputError(fmt::format("{}: out of memory", image.name));
    const Status written = writeTo(out, image, image.name, kSmall);
    const auto* first = reinterpret_cast<const std::byte*>(bytes);
    std::vector<std::byte> result(first, first + (written ? size : 0));
    std::free(bytes);
    if (!written)
        return written.error();
    return result;
}

} // namespace cotan
