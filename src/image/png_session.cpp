#include "png_session.hpp"

#include <bit>
#include <csetjmp>
#include <cstring>
#include <string_view>

namespace cotan {

namespace {

void onError(png_structp png, png_const_charp message)
{
    auto* session = static_cast<PngSession*>(png_get_error_ptr(png));
    std::snprintf(session->message, sizeof session->message, "%s", message);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

void onRead(png_structp png, png_bytep target, std::size_t size)
{
    auto* session = static_cast<PngSession*>(png_get_io_ptr(png));
    if (session->in) {
        if (std::fread(target, 1, size, session->in) != size)
            png_error(png, "the file ends too early");
        return;
    }
    if (size > session->left)
        png_error(png, "the file ends too early");
    std::memcpy(target, session->next, size);
    session->next += size;
    session->left -= size;
}

void onWrite(png_structp png, png_bytep source, std::size_t size)
{
    auto* session = static_cast<PngSession*>(png_get_io_ptr(png));
    if (std::fwrite(source, 1, size, session->out) != size)
        png_error(png, "writing failed");
}

void onFlush(png_structp) {}

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
    auto* session = static_cast<PngSession*>(png_get_user_chunk_ptr(png));
    const std::string_view type(reinterpret_cast<const char*>(chunk->name), 4);
    if (type == "tEXt" || type == "iTXt") {
        const std::string_view frame =
            frameText(frameOfChunk(type, {reinterpret_cast<const char*>(chunk->data), chunk->size}));
        if (!frame.empty())
            session->frame[frame.copy(session->frame, kMaxFrameText)] = '\0';
    }
    return 1;
}

} // namespace

PngReader::PngReader(const PngSession& from)
    : session(from), png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &session, onError, onWarning)),
      info(png ? png_create_info_struct(png) : nullptr)
{
}

PngReader::~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }

bool readPngHeader(PngReader& reader, PngHeader& header)
{
    png_structp png = reader.png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_read_fn(png, &reader.session, onRead);
    // The size is checked by us; the chunks that are not about pixels are skipped.
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_read_user_chunk_fn(png, &reader.session, onChunk);
    png_read_info(png, reader.info);

    header.width = png_get_image_width(png, reader.info);
    header.height = png_get_image_height(png, reader.info);
    const bool wide = png_get_bit_depth(png, reader.info) == 16;
    header.type = wide ? PixelType::unorm16 : PixelType::unorm8;
    header.interlaced = png_get_interlace_type(png, reader.info) != PNG_INTERLACE_NONE;
    header.alpha = (png_get_color_type(png, reader.info) & PNG_COLOR_MASK_ALPHA) != 0
        || png_get_valid(png, reader.info, PNG_INFO_tRNS) != 0;
    const bool coloured = (png_get_color_type(png, reader.info) & PNG_COLOR_MASK_COLOR) != 0;
    header.channels = (coloured ? 3 : 1) + (header.alpha ? 1 : 0);

    png_set_expand(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xffff, PNG_FILLER_AFTER);
    if (wide && std::endian::native == std::endian::little)
        png_set_swap(png);
    return true;
}

bool startPngPixels(PngReader& reader, std::size_t rowBytes, bool interlaced, int& passes)
{
    png_structp png = reader.png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    passes = interlaced ? png_set_interlace_handling(png) : 1;
    png_read_update_info(png, reader.info);
    if (png_get_rowbytes(png, reader.info) != rowBytes)
        png_error(png, "unexpected row size");
    return true;
}

bool readPngRows(PngReader& reader, png_bytep pixels, std::size_t count, std::size_t rowBytes)
{
    png_structp png = reader.png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    for (std::size_t y = 0; y < count; ++y)
        png_read_row(png, pixels + y * rowBytes, nullptr);
    return true;
}

bool endPngPixels(PngReader& reader)
{
    if (setjmp(png_jmpbuf(reader.png)))
        return false;
    png_read_end(reader.png, nullptr);
    return true;
}

PngWriter::PngWriter(std::FILE* out)
{
    session.out = out;
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &session, onError, onWarning);
    info = png ? png_create_info_struct(png) : nullptr;
}

PngWriter::~PngWriter() { png_destroy_write_struct(&png, &info); }

bool startPng(PngWriter& writer, const RowFormat& format, PngEffort effort)
{
    png_structp png = writer.png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    const bool wide = format.type == PixelType::unorm16;
    png_set_write_fn(png, &writer.session, onWrite, onFlush);
    // libpng's own limit is 1,000,000 a side.
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_compression_level(png, effort.level);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, effort.filters);
    png_set_IHDR(png, writer.info, png_uint_32(format.width), png_uint_32(format.height), wide ? 16 : 8,
                 format.alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (format.frame.c_str()[0] != '\0') {
        png_text text = {};
        text.compression = PNG_TEXT_COMPRESSION_NONE;
        text.key = const_cast<png_charp>(kFrameKey.data()); // libpng copies both
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

} // namespace cotan
