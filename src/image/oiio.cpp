// The module of image formats: the functions of formats.hpp by OpenImageIO. This file reads, oiio_write.cpp writes.
#include "oiio.hpp"

#include <algorithm>
#include <cstring>
#include <exception>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/named_values.hpp"
#include "core/one_line.hpp"
#include "formats.hpp"
#include "image/checks.hpp"
#include "image/component_types.hpp"
#include "image/format_table.hpp"

namespace cotan::oiio {

OIIO::TypeDesc typeDesc(PixelType type)
{
    if (type == PixelType::unorm8)
        return OIIO::TypeDesc::UINT8;
    return type == PixelType::unorm16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::FLOAT;
}

namespace {

Error broken(const std::string& name, const std::string& format, const std::string& why)
{
    return inputError(fmt::format("{}: broken {} image: {}", name, format, oneLine(why)));
}

// Wraps an OpenImageIO message in a sentence.
Error brokenToOiio(const std::string& name, const std::string& format, const std::string& words)
{
    return broken(name, format, "expected data that OpenImageIO can read, it found: " + words);
}

// OpenImageIO's name of the format of data that knownImage() accepted. The contents decide, as extensions are often
// wrong.
std::string formatOf(std::span<const std::byte> bytes)
{
    const ImageFormat* const known = imageFormatOf(bytes);
    return std::string(known ? known->openImageIo : kFormatWithoutMagic);
}

PixelType pixelType(OIIO::TypeDesc format)
{
    if (format == OIIO::TypeDesc::UINT8)
        return PixelType::unorm8;
    return format == OIIO::TypeDesc::UINT16 ? PixelType::unorm16 : PixelType::float32;
}

// Expands grey, grey and alpha, or RGB in the first `channels` components of every pixel to RGBA.
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

// Image::frame of a file: the attribute kFrameKey of OpenEXR.
std::string frameOf(const OIIO::ImageSpec& spec, const std::string& format)
{
    if (format != "openexr")
        return {};
    const std::string value = spec.get_string_attribute(std::string(kFrameKey));
    return std::string(frameText(value));
}

// Settings that make OpenImageIO return values as they are stored.
OIIO::ImageSpec readConfig()
{
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1); // do not premultiply
    config.attribute("oiio:reorient", 0);
    return config;
}

// ---- checks --------------------------------------------------------------------------------

// Compares what the headers of TIFF, OpenEXR, DDS and BMP files state with the size of the file: every strip, tile,
// attribute and level that will be read, and the blocks of OpenEXR with the limits. Their readers allocate by these
// numbers, or return uninitialised memory. format: as formatOf() returns it.
std::optional<Error> checkFileLayout(File& file, const std::string& name, const std::string& format,
                                     const LoadLimits& limits)
{
    using Check = Problem (*)(File&, const LoadLimits&);
    constexpr Named<Check> kChecks[] = {
        {"tiff", checkTiff}, {"openexr", checkExr}, {"dds", checkDds}, {"bmp", checkBmp}};
    const auto check = valueOf(kChecks, format);
    Problem problem = check ? (*check)(file, limits) : Problem();
    if (problem)
        problem->message = broken(name, format, problem->message).message;
    return problem;
}

// Checks what a header states besides its size.
std::optional<Error> checkLayers(const OIIO::ImageSpec& spec, const std::string& name)
{
    if (spec.depth > 1 || spec.deep)
        return inputError(fmt::format("{}: expected a flat image, found a volume", name));
    if (spec.nchannels < 1)
        return inputError(fmt::format("{}: the image has no channels", name));
    return std::nullopt;
}

// Checks the size of the image and of what the reader allocates for it, including unused channels and tiles.
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

// Checks the memory for one row, or one row of tiles.
std::optional<Error> checkRows(const OIIO::ImageSpec& spec, const std::string& name, const LoadLimits& limits)
{
    if (spec.width <= 0 || spec.height <= 0)
        return inputError(fmt::format("{}: the image size is {} x {}", name, spec.width, spec.height));
    if (auto error = checkLayers(spec, name))
        return error;
    const double rows = std::max(spec.tile_height, 1);
    const double stored = std::max(double(spec.width), double(spec.tile_width)) * rows
        * std::max(double(spec.pixel_bytes(/*native=*/true)), 16.0);
    if (spec.width > limits.imageSide || spec.height > limits.imageSide || stored > double(limits.imageBytes))
        return memoryError(
            fmt::format("{}: {} x {} pixels in rows of {:.0f} bytes, the limit is {} per side and {} bytes", name,
                        spec.width, spec.height, stored, limits.imageSide, limits.imageBytes));
    if (limits.expect)
        limits.expect(std::size_t(stored));
    return std::nullopt;
}

// ---- whole images --------------------------------------------------------------------------

// Blue and alpha of an 8-bit DDS with two channels (BC5): these are red and green, not grey and alpha.
void fillBlueAndAlpha(Image& image)
{
    for (std::size_t i = 0; i < image.pixelCount() && image.type == PixelType::unorm8; ++i) {
        image.bytes8()[4 * i + 2] = 128;
        image.bytes8()[4 * i + 3] = 255;
    }
}

// A file in memory. OpenImageIO's own class copies bytes from before the buffer if a reader asks for an offset past its
// end.
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

// Reads to.height rows of an untiled file from row `first` on: the first `channels` components of each pixel. If it
// returns false, input.geterror() says why. TIFF files are read row by row: in whole strips OpenImageIO does not notice
// errors of libtiff or zlib and returns uninitialised memory.
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

Result<Image> readWithOiio(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
try {
    const std::string format = formatOf(bytes);
    MemoryFile memory(bytes);
    if (auto error = checkFileLayout(memory, name, format, limits))
        return *error;
    if (const int channels = format == "dds" ? signedDdsChannels(memory) : 0)
        return readSignedDds(memory, channels, name, limits);
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
    const bool done = spec.tile_width > 0 ? input->read_image(0, 0, 0, channels, typeDesc(image.type),
                                                              image.data.data(), OIIO::stride_t(image.bytesPerPixel()))
                                          : readScanlines(*input, 0, channels, image);
    if (!done)
        return brokenToOiio(name, format, input->geterror());
    if (format == "dds" && channels == 2)
        fillBlueAndAlpha(image);
    else
        completeChannels(image, channels);
    image.frame = frameOf(spec, format);
    image.channels = channels;
    return image;
} catch (const std::exception& e) {
    return brokenToOiio(name, formatOf(bytes), e.what());
}

// ---- rows ----------------------------------------------------------------------------------

using Input = std::unique_ptr<OIIO::ImageInput>;

class Reader : public RowReader {
public:
    Reader(Input input, const OIIO::ImageSpec& spec, std::string format, const std::string& file)
        : input_(std::move(input)), spec_(spec), format_(std::move(format))
    {
        name = file;
        width = spec.width;
        height = spec.height;
        type = pixelType(spec.format);
        alpha = spec.nchannels == 2 || spec.nchannels >= 4;
        frame = frameOf(spec, format_);
        channels = std::min(spec.nchannels, 4);
    }

    Status read(Image& strip) override
    try {
        const bool done = spec_.tile_height > 0 ? fromTiles(strip) : readScanlines(*input_, next_, channels, strip);
        if (!done)
            return brokenToOiio(name, format_, input_->geterror());
        next_ += strip.height;
        completeChannels(strip, channels);
        return Done{};
    } catch (const std::exception& e) {
        return brokenToOiio(name, format_, e.what());
    }

private:
    // Reads from a tiled file; the current row of tiles is cached.
    bool fromTiles(Image& strip)
    {
        const std::size_t rowBytes = std::size_t(width) * strip.bytesPerPixel();
        for (int y = 0; y < strip.height; ++y) {
            const int row = next_ + y, first = row / spec_.tile_height * spec_.tile_height;
            if (first != tileRow_) {
                const int rows = std::min(spec_.tile_height, height - first);
                if (tiles_.height != rows)
                    tiles_ = makeImage(width, rows, type);
                if (!input_->read_tiles(0, 0, spec_.x, spec_.x + width, spec_.y + first, spec_.y + first + rows, 0, 1,
                                        0, channels, typeDesc(type), tiles_.data.data(),
                                        OIIO::stride_t(strip.bytesPerPixel())))
                    return false;
                tileRow_ = first;
            }
            std::memcpy(strip.data.data() + std::size_t(y) * rowBytes,
                        tiles_.data.data() + std::size_t(row - first) * rowBytes, rowBytes);
        }
        return true;
    }

    Input input_;
    OIIO::ImageSpec spec_;
    std::string format_;
    int next_ = 0;
    Image tiles_;
    int tileRow_ = -1;
};

Result<std::unique_ptr<RowReader>> openRows(const std::filesystem::path& file, std::span<const std::byte> head,
                                            const LoadLimits& limits)
try {
    const std::string name = file.string(), format = formatOf(head);
    OIIO::Filesystem::IOFile layout(name, OIIO::Filesystem::IOProxy::Read);
    if (auto error = checkFileLayout(layout, name, format, limits))
        return *error;
    Input input = OIIO::ImageInput::create(format);
    if (!input)
        return brokenToOiio(name, format, OIIO::geterror());
    OIIO::ImageSpec spec;
    if (!input->open(name, spec, readConfig()))
        return brokenToOiio(name, format, input->geterror());
    if (auto error = checkRows(spec, name, limits))
        return *error;
    return std::unique_ptr<RowReader>(std::make_unique<Reader>(std::move(input), spec, format, name));
} catch (const std::exception& e) {
    return brokenToOiio(file.string(), formatOf(head), e.what());
}

constexpr ImageFormats kFormats{COTAN_MODULE_VERSION, readWithOiio, write, openRows, createRows, createGif};

} // namespace
} // namespace cotan::oiio

extern "C" const void* cotanImageFormats() { return &cotan::oiio::kFormats; }
