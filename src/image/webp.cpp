#include "codecs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <webp/decode.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include "image/checks.hpp"
#include "numbers.hpp"

namespace cotan {

// ---- reading -------------------------------------------------------------------------------

namespace {

struct WebpSize {
    std::int64_t width = 0, height = 0; // pixels
};

struct Chunk {
    std::uint64_t data = 0, size = 0; // bytes
};

// VP8's frame header: a 3-byte tag, whose lowest bit is 0 for key frames, a start code, and two sizes of 14 bits.
Result<WebpSize> lossySize(Numbers& file, const Chunk& chunk)
{
    if (chunk.size < 10)
        return inputError(fmt::format("its VP8 chunk has {} bytes, expected at least 10", chunk.size));
    const std::uint64_t tag = file.at(chunk.data, 3), firstPart = tag >> 5;
    if ((tag & 1) != 0 || file.at(chunk.data + 3, 3) != 0x2a019d)
        return inputError("its VP8 chunk does not begin with a key frame");
    if (firstPart > chunk.size - 10)
        return inputError(fmt::format("the first part of its image takes {} bytes, its chunk has {} after the header",
                                      firstPart, chunk.size - 10));
    return WebpSize{std::int64_t(file.at(chunk.data + 6, 2) & 0x3fff),
                    std::int64_t(file.at(chunk.data + 8, 2) & 0x3fff)};
}

// VP8L's header: a signature byte, two sizes of 14 bits minus one, a bit for alpha, and 3 bits of version.
Result<WebpSize> losslessSize(Numbers& file, const Chunk& chunk)
{
    if (chunk.size < 5)
        return inputError(fmt::format("its VP8L chunk has {} bytes, expected at least 5", chunk.size));
    const std::uint64_t bits = file.at(chunk.data + 1, 4);
    if (file.at(chunk.data, 1) != 0x2f || bits >> 29 != 0)
        return inputError("its VP8L chunk has an unknown signature or version");
    return WebpSize{std::int64_t(bits & 0x3fff) + 1, std::int64_t(bits >> 14 & 0x3fff) + 1};
}

// Checks that the chunks lie within the file (RFC 9649), and returns the size of the image.
// Errors: ErrorKind::input, without the file's name.
Result<WebpSize> checkWebp(std::span<const std::byte> bytes)
{
    Numbers file(bytes);
    const std::uint64_t end = 8 + file.at(4, 4);
    if (end > file.size())
        return inputError(fmt::format("its header announces {} bytes, the file has {}", end, file.size()));
    WebpSize canvas;
    for (std::uint64_t at = 12; at + 8 <= end;) {
        const Chunk chunk{at + 8, file.at(at + 4, 4)};
        if (chunk.size > end - chunk.data)
            return inputError(
                fmt::format("a chunk takes {} bytes from {}, the file has {}", chunk.size, chunk.data, end));
        const bool lossy = file.matches(at, "VP8 ");
        if (lossy || file.matches(at, "VP8L")) {
            auto size = lossy ? lossySize(file, chunk) : losslessSize(file, chunk);
            if (size && canvas.width > 0 && (size->width != canvas.width || size->height != canvas.height))
                return inputError(fmt::format("its canvas is {} x {}, its image {} x {}", canvas.width, canvas.height,
                                              size->width, size->height));
            return size;
        }
        if (file.matches(at, "VP8X")) {
            if (chunk.size < 10)
                return inputError(fmt::format("its VP8X chunk has {} bytes, expected 10", chunk.size));
            if ((file.at(chunk.data, 1) & 0x2) != 0)
                return inputError("expected one image, found an animation");
            canvas = {std::int64_t(file.at(chunk.data + 4, 3)) + 1, std::int64_t(file.at(chunk.data + 7, 3)) + 1};
        }
        at = chunk.data + chunk.size + chunk.size % 2;
    }
    return inputError("it has no image");
}

const char* reason(VP8StatusCode status)
{
    switch (status) {
    case VP8_STATUS_OUT_OF_MEMORY: return "not enough memory";
    case VP8_STATUS_SUSPENDED:
    case VP8_STATUS_NOT_ENOUGH_DATA: return "the data end too soon";
    default: return "the data are damaged";
    }
}

} // namespace

bool readsWebp() { return true; }

Result<Image> readWebp(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
{
    const auto broken = [&](std::string_view why) {
        return inputError(fmt::format("{}: broken webp image: {}", name, why));
    };
    const auto size = checkWebp(bytes);
    if (!size)
        return broken(size.error().message);
    if (auto error = checkImageSize(size->width, size->height, PixelType::unorm8, name, limits))
        return *error;
    WebPDecoderConfig config;
    if (!WebPInitDecoderConfig(&config))
        return unavailableError(fmt::format("{}: libwebp has a different version than at build time", name));
    Image image = makeImage(int(size->width), int(size->height), PixelType::unorm8, name);
    config.output.colorspace = MODE_RGBA; // not premultiplied
    config.output.is_external_memory = 1;
    config.output.u.RGBA.rgba = image.bytes8();
    config.output.u.RGBA.stride = image.width * 4;
    config.output.u.RGBA.size = image.data.size();
    const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    if (const VP8StatusCode status = WebPDecode(data, bytes.size(), &config); status != VP8_STATUS_OK)
        return broken(reason(status));
    return image;
}

// ---- animations ----------------------------------------------------------------------------

namespace {

constexpr float kQuality = 90;

struct Deleter {
    void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
};

// Encodes with libwebp, which keeps the compressed images in memory.
class WebpAnimation : public AnimationWriter {
public:
    WebpAnimation(OpenFile file, const AnimationFormat& format, std::string name)
        : file_(std::move(file)), format_(format), name_(std::move(name))
    {
        WebPAnimEncoderOptions options;
        WebPAnimEncoderOptionsInit(&options);
        options.allow_mixed = 1; // lossless is smaller and better for flat images
        encoder_.reset(WebPAnimEncoderNew(format.width, format.height, &options));
    }

    Status add(const Image& image) override
    {
        WebPConfig config;
        WebPPicture pixels;
        if (!encoder_ || !WebPConfigPreset(&config, WEBP_PRESET_PICTURE, kQuality) || !WebPPictureInit(&pixels))
            return failed("not enough memory");
        pixels.use_argb = 1;
        pixels.width = image.width;
        pixels.height = image.height;
        const bool added = WebPPictureImportRGBA(&pixels, image.bytes8(), image.width * 4)
            && WebPAnimEncoderAdd(encoder_.get(), &pixels, timeOf(count_), &config);
        WebPPictureFree(&pixels);
        if (!added)
            return failed(WebPAnimEncoderGetError(encoder_.get()));
        ++count_;
        return Done{};
    }

    Status finish() override
    {
        WebPData data;
        WebPDataInit(&data);
        const bool made = encoder_ && WebPAnimEncoderAdd(encoder_.get(), nullptr, timeOf(count_), nullptr)
            && WebPAnimEncoderAssemble(encoder_.get(), &data);
        const bool whole = made && std::fwrite(data.bytes, 1, data.size, file_.get()) == data.size
            && std::fclose(file_.release()) == 0;
        WebPDataClear(&data);
        return whole ? Status(Done{})
            : made   ? Status(failed("writing failed"))
                     : failed(encoder_ ? WebPAnimEncoderGetError(encoder_.get()) : "not enough memory");
    }

private:
    // Start of an image in milliseconds; rounding errors do not accumulate.
    int timeOf(std::size_t index) const { return int(std::lround(1000 * double(index) / format_.rate)); }

    Status failed(const char* why) const
    {
        return outputError(fmt::format("{}: libwebp: {}", name_, std::string(why).empty() ? "failed" : why));
    }

    OpenFile file_;
    AnimationFormat format_;
    std::string name_;
    std::unique_ptr<WebPAnimEncoder, Deleter> encoder_;
    std::size_t count_ = 0;
};

} // namespace

Result<std::unique_ptr<AnimationWriter>> createWebpAnimation(OpenFile file, const AnimationFormat& format,
                                                             const std::string& name)
{
    return std::unique_ptr<AnimationWriter>(new WebpAnimation(std::move(file), format, name));
}

// ---- encoding like another file ------------------------------------------------------------

namespace {

// The boolean decoder of RFC 6386, 7.3, over the first bytes of a frame; past their end it reads zeros.
class Bits {
public:
    explicit Bits(std::span<const std::byte> bytes) : bytes_(bytes)
    {
        value_ = next() << 8;
        value_ |= next();
    }

    bool flag()
    {
        constexpr unsigned kEven = 128; // probability of 0, of 256
        const unsigned split = 1 + (((range_ - 1) * kEven) >> 8), whole = split << 8;
        const bool one = value_ >= whole;
        if (one)
            value_ -= whole;
        range_ = one ? range_ - split : split;
        for (; range_ < 128; range_ <<= 1) {
            value_ <<= 1;
            if (++shifted_ == 8) {
                shifted_ = 0;
                value_ |= next();
            }
        }
        return one;
    }

    int number(int bits)
    {
        int value = 0;
        while (bits-- > 0)
            value = 2 * value + flag();
        return value;
    }

    int signedNumber(int bits)
    {
        const int value = number(bits);
        return flag() ? -value : value;
    }

    void skipOptional(int count, int bits, bool sign)
    {
        for (int i = 0; i < count; ++i)
            if (flag())
                number(bits + sign);
    }

private:
    unsigned next() { return at_ < bytes_.size() ? unsigned(bytes_[at_++]) : 0; }

    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
    unsigned value_ = 0, range_ = 255, shifted_ = 0;
};

// The quantiser index of a key frame, 0 to 127, from its header (RFC 6386, 9.2 to 9.6); the mean if its segments have
// indices of their own.
double quantiserOf(std::span<const std::byte> frame)
{
    constexpr std::size_t kBeforeBits = 10; // tag, start code and size
    Bits bits(frame.size() > kBeforeBits ? frame.subspan(kBeforeBits) : std::span<const std::byte>());
    bits.number(2); // colour space, clamping
    std::array<int, 4> segments{};
    bool absolute = false, segmented = false;
    if (bits.flag()) {
        const bool map = bits.flag(), data = bits.flag();
        if (data) {
            segmented = true;
            absolute = bits.flag();
            for (int& segment : segments)
                segment = bits.flag() ? bits.signedNumber(7) : 0;
            bits.skipOptional(4, 6, true); // of loop filter levels
        }
        if (map)
            bits.skipOptional(3, 8, false);
    }
    bits.number(1 + 6 + 3); // loop filter
    if (bits.flag() && bits.flag())
        bits.skipOptional(8, 6, true);
    bits.number(2); // partitions
    const double base = bits.number(7);
    const double mean = (segments[0] + segments[1] + segments[2] + segments[3]) / 4.0;
    return !segmented ? base : absolute ? mean : base + mean;
}

// The quality setting of libwebp's encoder that gives this quantiser: the inverse of libwebp's curve, a cube root.
int qualityFor(double quantiser)
{
    const double linear = std::pow(1 - quantiser / 127, 3);
    return int(std::lround(100 * (linear < 0.5 ? 1.5 * linear : (linear + 1) / 2)));
}

// The content of a chunk of a valid file; empty if absent.
std::span<const std::byte> chunkOf(std::span<const std::byte> file, const char* name)
{
    Numbers numbers(file);
    for (std::size_t at = 12; at + 8 <= file.size();) {
        const std::size_t length = std::min<std::size_t>(numbers.at(at + 4, 4), file.size() - at - 8);
        if (numbers.matches(at, name))
            return file.subspan(at + 8, length);
        at += 8 + length + length % 2;
    }
    return {};
}

struct Written {
    WebPPicture picture{};
    WebPMemoryWriter memory{};

    Written() { WebPMemoryWriterInit(&memory); }
    ~Written()
    {
        WebPPictureFree(&picture);
        WebPMemoryWriterClear(&memory);
    }
    Written(const Written&) = delete;
    Written& operator=(const Written&) = delete;
};

} // namespace

std::optional<Result<std::vector<std::byte>>> writeWebpLike(const Image& image, std::span<const std::byte> old,
                                                            int& quality)
{
    const auto lossy = chunkOf(old, "VP8 ");
    quality = lossy.empty() ? 0 : std::max(qualityFor(quantiserOf(lossy)), 1);
    const Error failed = outputError(image.name + ": not enough memory for its WebP file");
    WebPConfig config;
    Written written;
    if (!WebPConfigInit(&config) || !WebPPictureInit(&written.picture))
        return failed;
    config.lossless = lossy.empty();
    config.exact = 1; // keep the colours where alpha is 0
    config.quality = lossy.empty() ? 75 : float(quality);
    config.use_sharp_yuv = 1; // halved chroma loses less of the normals' directions
    written.picture.use_argb = 1;
    written.picture.width = image.width;
    written.picture.height = image.height;
    written.picture.writer = WebPMemoryWrite;
    written.picture.custom_ptr = &written.memory;
    if (!WebPPictureImportRGBA(&written.picture, image.bytes8(), image.width * 4)
        || !WebPEncode(&config, &written.picture))
        return failed;
    const auto* const bytes = reinterpret_cast<const std::byte*>(written.memory.mem);
    return std::vector<std::byte>(bytes, bytes + written.memory.size);
}

} // namespace cotan
