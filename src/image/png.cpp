#include "png.hpp"

#include <cstdio>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

#include "image/size.hpp"
#include "png_session.hpp"

namespace cotan {

namespace {

// Decodes all rows into `pixels`, `rowBytes` apart, and reads to the end of the file.
bool readPixels(PngReader& reader, const PngHeader& header, png_bytep pixels, std::size_t rowBytes)
{
    int passes = 1;
    if (!startPngPixels(reader, rowBytes, header.interlaced, passes))
        return false;
    for (int pass = 0; pass < passes; ++pass)
        if (!readPngRows(reader, pixels, header.height, rowBytes))
            return false;
    return endPngPixels(reader);
}

Error pngError(const std::string& name, const PngSession& session)
{
    return inputError(
        fmt::format("{}: broken PNG: expected data that libpng can read, it found: {}", name, session.message));
}

} // namespace

Result<Image> readPng(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
{
    PngReader reader(bytes);
    if (!reader.info)
        return inputError(fmt::format("{}: out of memory", name));
    PngHeader header;
    if (!readPngHeader(reader, header))
        return pngError(name, reader.session);
    if (auto error = checkImageSize(header.width, header.height, header.type, name, limits))
        return *error;

    Image image = makeImage(int(header.width), int(header.height), header.type, name);
    image.frame = reader.session.frame;
    image.channels = header.channels;
    const std::size_t rowBytes = std::size_t(header.width) * image.bytesPerPixel();
    if (!readPixels(reader, header, image.bytes8(), rowBytes))
        return pngError(name, reader.session);
    return image;
}

namespace {

bool writePixels(PngWriter& writer, const Image& image, PngEffort effort)
{
    const std::size_t rowBytes = std::size_t(image.width) * image.bytesPerPixel();
    return startPng(writer, {image.width, image.height, image.type, !isOpaque(image), image.frame.c_str()}, effort)
        && writePngRows(writer, image.bytes8(), std::size_t(image.height), rowBytes) && endPng(writer);
}

// Closes the stream whatever happens.
Status writeTo(std::FILE* out, const Image& image, const std::string& name, PngEffort effort)
{
    bool written = false;
    std::string why = "out of memory";
    {
        PngWriter writer(out);
        if (writer.info) {
            written = writePixels(writer, image, effort);
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
    return writeTo(out, image, name, kQuickPng);
}

Result<std::vector<std::byte>> encodePng(const Image& image)
{
    char* bytes = nullptr;
    std::size_t size = 0;
    std::FILE* out = ::open_memstream(&bytes, &size);
    if (!out)
        return outputError(fmt::format("{}: out of memory", image.name));
    const Status written = writeTo(out, image, image.name, kSmallPng);
    const auto* first = reinterpret_cast<const std::byte*>(bytes);
    std::vector<std::byte> result(first, first + (written ? size : 0));
    std::free(bytes);
    if (!written)
        return written.error();
    return result;
}

} // namespace cotan
