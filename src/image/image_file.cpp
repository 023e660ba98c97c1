#include "cotan/image.hpp"

#include <algorithm>
#include <new>

#include <fmt/format.h>

#include "codecs.hpp"
#include "core/try.hpp"
#include "files/bytes.hpp"
#include "files/output.hpp"
#include "files/sandbox/reader_process.hpp"
#include "files/sandbox/scene_wire.hpp"
#include "formats.hpp"
#include "image/checks.hpp"
#include "image/component_types.hpp"
#include "image/format_table.hpp"
#include "image/pending.hpp"

namespace cotan {

std::string imageFormatName(std::span<const std::byte> bytes)
{
    const ImageFormat* const format = imageFormatOf(bytes);
    return format && !format->mime.empty() ? std::string(format->name) : "";
}

bool isPng(std::span<const std::byte> bytes) { return imageFormatName(bytes) == "PNG"; }

std::string unreadableFormat(std::span<const std::byte> bytes, const LoadLimits& limits)
{
    const std::string format = imageFormatName(bytes);
    if (format == "KTX2") {
        const std::string foreign = foreignKtx2(bytes), what = foreign.empty() ? lackedByKtx2(bytes) : foreign;
        return what.empty() ? "" : "KTX2 with " + what;
    }
    const bool foreign = !limits.decode
        && (format == "AVIF" || (format == "WebP" && !readsWebp()) || (format == "DDS" && !readsOtherFormats()));
    return foreign ? format : "";
}

namespace {

// Whether the bytes, or the extension of `name`, are of a format that the module reads. Unknown data is refused without
// loading the module.
bool knownImage(std::span<const std::byte> bytes, const std::string& name)
{
    if (const ImageFormat* const format = imageFormatOf(bytes))
        return !format->openImageIo.empty();
    const ImageFormat* const named = imageFormatOf(std::filesystem::path(name));
    return named && named->openImageIo == kFormatWithoutMagic && !bytes.empty();
}

Status checkPicture(const Image& image, const std::string& file, const LoadLimits& limits)
{
    if (auto error = checkImageSize(image.width, image.height, image.type, file, limits))
        return *error;
    if (image.channels < 1 || image.channels > 4)
        return inputError(fmt::format("{}: expected 1 to 4 channels, found {}", file, image.channels));
    if (image.data.size() != image.pixelCount() * image.bytesPerPixel())
        return inputError(fmt::format("{}: expected the bytes of {} x {} pixels, found {}", file, image.width,
                                      image.height, image.data.size()));
    return Done{};
}

// Decodes in a child process: limits.sandbox.program.
Result<Image> decodeSandboxed(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
{
    COTAN_TRY(process,
              ReaderProcess::start({.kind = ReaderKind::image,
                                    .name = name,
                                    .bytes = {bytes.begin(), bytes.end()},
                                    .fileBytes = bytes.size(),
                                    .limits = limits}));
    Image image;
    exchangeImage((*process)->answer(), image);
    image.frame = std::string(frameText(image.frame));
    if (!(*process)->answer().good())
        return (*process)->failure();
    COTAN_CHECK(checkPicture(image, name, limits));
    return image;
}

Result<Image> decode(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
{
    const std::string format = imageFormatName(bytes);
    if (format == "PNG")
        return readPng(bytes, name, limits);
    if (format == "JPEG")
        if (auto image = readJpeg(bytes, name, limits))
            return *std::move(image);
    if (format == "AVIF")
        return unavailableError(fmt::format("{}: AVIF images are not supported", name));
    if (const std::string payload = format == "KTX2" ? foreignKtx2(bytes) : ""; !payload.empty())
        return unavailableError(fmt::format("{}: {} is not supported", name, payload));
    if (format.empty() && !knownImage(bytes, name))
        return inputError(fmt::format("{}: expected an image ({}), found other data", name, readableFormatNames()));
    if (!limits.sandbox.program.empty())
        return decodeSandboxed(bytes, name, limits);
    if (format == "WebP")
        return readWebp(bytes, name, limits);
    if (format == "KTX2")
        return readKtx2(bytes, name, limits);
    return readOther(bytes, name, limits);
}

Status write(const OutputFile& output, const Image& image, const std::string& name)
{
    const bool png = writesItself(output.destination());
    const Result<const ImageFormats*> formats = png ? nullptr : imageFormats(name);
    if (!formats)
        return formats.error();
    COTAN_TRY(file, output.open(/*reads*/ !png));
    if (!png)
        return (*formats)->write(*std::move(file), image, name);
    if (image.type == PixelType::float32)
        return writePng(*std::move(file), toUnorm8(image), name);
    return writePng(*std::move(file), image, name);
}

Result<EncodedLike> asPng(const Image& image, std::string reason)
{
    COTAN_TRY(png, encodePng(image));
    return EncodedLike{*std::move(png), "PNG", "image/png", 0, std::move(reason)};
}

} // namespace

Result<Image> decodeImage(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
try {
    if (limits.decode && imageFormatName(bytes) != "KTX2")
        return limits.decode(bytes, name);
    LoadLimits own = limits;
    own.imageBytes = std::min(limits.imageBytes, imageBudget(limits, bytes.size()));
    Result<Image> image = decode(bytes, name, own);
    if (image)
        image->blocks = blockName(bytes);
    if (image && limits.keepsJpeg && imageFormatName(bytes) == "JPEG")
        image->jpeg.assign(bytes.begin(), bytes.end());
    return image;
} catch (const std::bad_alloc&) {
    return inputError(fmt::format("{}: not enough memory for the image", name));
}

Result<Image> readImage(const std::filesystem::path& file, const LoadLimits& limits)
try {
    COTAN_TRY(bytes, readFileBytes(file, limits.fileBytes));
    return decodeImage(*bytes, file.string(), limits);
} catch (const std::bad_alloc&) {
    return inputError(fmt::format("{}: not enough memory for the file", file.string()));
}

Result<OutputFile> writePending(const std::filesystem::path& file, const Image& image)
{
    const std::string name = file.string();
    COTAN_CHECK(checkImageName(file));
    if (image.width <= 0 || image.height <= 0 || image.data.size() != image.pixelCount() * image.bytesPerPixel())
        return usageError(fmt::format("{}: there is no image to write ({} x {}, {} bytes)", name, image.width,
                                      image.height, image.data.size()));
    auto output = OutputFile::begin(file);
    if (output)
        if (Status written = write(*output, image, name); !written)
            return output->failed(written.error());
    return output;
}

Status writeImage(const std::filesystem::path& file, const Image& image)
{
    auto output = writePending(file, image);
    return output ? output->commit() : output.error();
}

Result<EncodedLike> encodeLike(const Image& image, std::span<const std::byte> old)
{
    const ImageFormat* const format = imageFormatOf(old);
    if (!format || format->name == "PNG")
        return asPng(image, {});
    const std::string name(format->name);
    if (name != "JPEG" && name != "WebP")
        return asPng(image, fmt::format("{} cannot be written", name));
    if (image.type != PixelType::unorm8)
        return asPng(image, fmt::format("{} has 8 bits, but 16 are required", name));
    if (name == "JPEG" && !isOpaque(image))
        return asPng(image, "JPEG has no alpha");
    int quality = 0;
    auto bytes = name == "JPEG" ? writeJpegLike(image, old, quality) : writeWebpLike(image, old, quality);
    if (!bytes)
        return asPng(image,
                     name == "JPEG" ? "a grey or CMYK JPEG holds no normals, or this build has no libjpeg"
                                    : "this build has no libwebp");
    if (!*bytes)
        return bytes->error();
    return EncodedLike{**std::move(bytes), name, std::string(format->mime), quality};
}

} // namespace cotan
