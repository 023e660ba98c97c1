// The module of image formats: OpenImageIO behind the functions of formats.hpp.
#include "oiio.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <exception>
#include <string_view>

#include <fmt/format.h>

#include "core/named_values.hpp"
#include "formats.hpp"
#include "image/checks.hpp"
#include "image/component_types.hpp"

namespace cotan {

namespace oiio {

namespace {

Error broken(const std::string& name, const std::string& format, const std::string& why)
{
    return inputError(fmt::format("{}: broken {} image: {}", name, format, oneLine(why)));
}

} // namespace

std::string oneLine(std::string text)
{
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
        text.pop_back();
    std::ranges::replace(text, '\n', ' ');
    return text;
}

std::string formatOf(std::span<const std::byte> bytes)
{
    const ImageFormat* const known = imageFormatOf(bytes);
    return std::string(known ? known->openImageIo : kNoStart);
}

PixelType pixelType(OIIO::TypeDesc format)
{
    if (format == OIIO::TypeDesc::UINT8)
        return PixelType::unorm8;
    return format == OIIO::TypeDesc::UINT16 ? PixelType::unorm16 : PixelType::float32;
}

OIIO::TypeDesc typeDesc(PixelType type)
{
    if (type == PixelType::unorm8)
        return OIIO::TypeDesc::UINT8;
    return type == PixelType::unorm16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::FLOAT;
}

void completeChannels(Image& image, int channels)
{
    withComponents(image, [count = image.pixelCount(), channels]<class T>(T* pixel, T, T one) {
        for (std::size_t i = 0; i < count; ++i, pixel += 4) {
            if (channels == 2)
                pixel[3] = pixel[1];
            if (channels <= 2)
                pixel[1] = pixel[2] = pixel[0];
            if (channels == 1 || channels == 3)
                pixel[3] = one;
        }
    });
}

std::optional<Error> checkLayers(const OIIO::ImageSpec& spec, const std::string& name)
{
    if (spec.depth > 1 || spec.deep)
        return inputError(fmt::format("{}: expected a flat picture, found a volume", name));
    if (spec.nchannels < 1)
        return inputError(fmt::format("{}: the image has no channels", name));
    return std::nullopt;
}

OIIO::ImageSpec readConfig()
{
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1); // as stored: not multiplied by alpha
    config.attribute("oiio:reorient", 0);
    return config;
}

OIIO::TypeDesc typeToWrite(const ImageFormat& format, PixelType type)
{
    if (!format.bits16 && !format.floats)
        return OIIO::TypeDesc::UINT8;
    return format.bits8 ? typeDesc(type) : OIIO::TypeDesc::FLOAT;
}

OIIO::ImageSpec outputSpec(int width, int height, int channels, OIIO::TypeDesc type, const ImageFormat& format,
                           const std::string& frame)
{
    OIIO::ImageSpec spec(width, height, channels, type);
    spec.attribute("oiio:UnassociatedAlpha", 1); // the values are written as they are
    // The same picture gives the same bytes: no time of writing.
    spec.attribute("DateTime", "1970:01:01 00:00:00");
    if (format.openImageIo == "openexr" || format.openImageIo == "tiff")
        spec.attribute("compression", "zip");
    if (format.openImageIo == "jpeg")
        spec.attribute("CompressionQuality", 95);
    if (format.frame && !frame.empty())
        spec.attribute(std::string(kFrameKey), frame);
    return spec;
}

std::string frameOf(const OIIO::ImageSpec& spec, const std::string& format)
{
    if (format != "openexr")
        return {};
    const std::string value = spec.get_string_attribute(std::string(kFrameKey));
    return std::string(frameText(value));
}

Error brokenToOiio(const std::string& name, const std::string& format, const std::string& words)
{
    return broken(name, format, "expected data that OpenImageIO can read, it found: " + words);
}

std::optional<Error> checkFileLayout(File& file, const std::string& name, const std::string& format,
                                     const LoadLimits& limits)
{
    using Check = Problem (*)(File&, const LoadLimits&);
    constexpr Named<Check> kChecks[] = {
        {"tiff", checkTiff}, {"openexr", checkExr}, {"dds", checkDds}, {"bmp", checkBmp}};
    const auto check = valueOf(kChecks, format);
    const Problem problem = check ? (*check)(file, limits) : Problem();
    if (!problem)
        return std::nullopt;
    Error error = broken(name, format, *problem);
    error.memory = problem.memory;
    return error;
}

// TIFF row by row: of a whole strip OpenImageIO does not notice what libtiff or zlib cannot decode, and hands out what
// its memory held.
bool readScanlines(OIIO::ImageInput& input, int first, int channels, Image& to)
{
    const OIIO::ImageSpec& spec = input.spec();
    const OIIO::TypeDesc type = typeDesc(to.type);
    const auto stride = OIIO::stride_t(to.bytesPerPixel());
    if (input.format_name() != std::string_view("tiff"))
        return input.read_scanlines(0, 0, spec.y + first, spec.y + first + to.height, 0, 0, channels, type,
                                    to.data.data(), stride);
    const std::size_t used = std::size_t(channels) * type.size(), each = std::size_t(spec.nchannels) * type.size();
    std::vector<std::byte> row(std::size_t(to.width) * each);
    std::byte* out = to.data.data();
    for (int y = 0; y < to.height; ++y) {
        if (!input.read_scanline(spec.y + first + y, 0, type, row.data()))
            return false;
        for (std::size_t x = 0; x < std::size_t(to.width); ++x, out += stride)
            std::copy_n(row.data() + x * each, used, out);
    }
    return true;
}

} // namespace oiio

using namespace oiio;

namespace {

// What a header may claim beyond the size of the picture: channels that we do not use and the
// blocks that a reader allocates.
std::optional<Error> checkSpec(const OIIO::ImageSpec& spec, const std::string& name, const LoadLimits& limits)
{
    if (auto error = checkImageSize(spec.width, spec.height, pixelType(spec.format), name, limits))
        return error;
    if (auto error = checkLayers(spec, name))
        return error;
    const double tile = double(spec.tile_width) * double(spec.tile_height);
    const double stored =
        std::max(double(spec.width) * double(spec.height), tile) * double(spec.pixel_bytes(/*native=*/true));
    if (stored > double(limits.imageBytes))
        return memoryError(fmt::format("{}: the pixels take {:.0f} bytes as stored, the limit is {}", name, stored,
                                       limits.imageBytes));
    return std::nullopt;
}

// Two channels of a DDS (BC5) are red and green, not grey and alpha. They are 8 bits.
void spreadTwo(Image& image)
{
    for (std::size_t i = 0; i < image.pixelCount() && image.type == PixelType::unorm8; ++i) {
        image.bytes8()[4 * i + 2] = 128;
        image.bytes8()[4 * i + 3] = 255;
    }
}

// A file in memory. OpenImageIO's own copies what lies in front of the bytes where a reader asks for a place behind
// them.
class MemoryFile : public OIIO::Filesystem::IOProxy {
public:
    explicit MemoryFile(std::span<const std::byte> bytes) : IOProxy("", Read), bytes_(bytes) {}

    const char* proxytype() const override { return "memory"; }
    std::size_t size() const override { return bytes_.size(); }

    std::size_t read(void* to, std::size_t count) override
    {
        count = pread(to, count, m_pos);
        m_pos += std::int64_t(count);
        return count;
    }

    std::size_t pread(void* to, std::size_t count, std::int64_t offset) override
    {
        if (offset < 0 || std::uint64_t(offset) >= bytes_.size())
            return 0;
        const auto from = bytes_.subspan(std::size_t(offset));
        count = std::min(count, from.size());
        std::copy_n(from.begin(), count, static_cast<std::byte*>(to));
        return count;
    }

private:
    std::span<const std::byte> bytes_;
};

Result<Image> readWithOiio(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
{
    const std::string format = formatOf(bytes);
    try {
        MemoryFile memory(bytes);
        if (auto error = checkFileLayout(memory, name, format, limits))
            return *error;
        const auto input = OIIO::ImageInput::create(format);
        if (!input)
            return brokenToOiio(name, format, OIIO::geterror());
        input->threads(1); // callers decode images side by side
        input->set_ioproxy(&memory);
        OIIO::ImageSpec spec;
        if (!input->open("image." + format, spec, readConfig()))
            return brokenToOiio(name, format, input->geterror());
        if (auto error = checkSpec(spec, name, limits))
            return *error;

        Image image = makeImage(spec.width, spec.height, pixelType(spec.format), name);
        const int channels = std::min(spec.nchannels, 4);
        const bool done = spec.tile_width > 0
            ? input->read_image(0, 0, 0, channels, typeDesc(image.type), image.data.data(),
                                OIIO::stride_t(image.bytesPerPixel()))
            : readScanlines(*input, 0, channels, image);
        if (!done)
            return brokenToOiio(name, format, input->geterror());
        if (format == "dds" && channels == 2)
            spreadTwo(image);
        else
            completeChannels(image, channels);
        image.frame = frameOf(spec, format);
        image.channels = channels;
        return image;
    } catch (const std::exception& e) {
        return brokenToOiio(name, format, e.what());
    }
}

Status writeWithOiio(const std::filesystem::path& file, const Image& image, const std::string& name)
{
    const ImageFormat& format = *imageFormatOf(name); // which checkImageName accepted
    const OIIO::TypeDesc type = typeToWrite(format, image.type);
    if (type == OIIO::TypeDesc::UINT8 && image.type != PixelType::unorm8)
        return writeWithOiio(file, toUnorm8(image), name);
    try {
        const auto output = OIIO::ImageOutput::create(std::string(format.openImageIo));
        if (!output)
            return notWritten(name, OIIO::geterror());
        output->threads(1);
        CheckedFile checked(file);
        output->set_ioproxy(&checked);
        const OIIO::ImageSpec spec =
            outputSpec(image.width, image.height, format.alpha ? 4 : 3, type, format, image.frame);
        const bool done = output->open(file.string(), spec)
            && output->write_image(typeDesc(image.type), image.data.data(), OIIO::stride_t(image.bytesPerPixel()))
            && output->close();
        if (Status whole = checked.finish(name); !whole)
            return whole;
        if (!done)
            return notWritten(name, output->geterror());
    } catch (const std::exception& e) {
        return notWritten(name, e.what());
    }
    return Done{};
}

constexpr ImageFormats kFormats{COTAN_MODULE_VERSION, readWithOiio, writeWithOiio, openRows, createRows, createGif};

} // namespace
} // namespace cotan

extern "C" const void* cotanImageFormats() { return &cotan::kFormats; }
