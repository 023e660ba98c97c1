// WebP files as another one is.
#include <array>
#include <cmath>
#include <cstring>

#include <webp/encode.h>

#include "webp.hpp"

namespace cotan {

namespace {

// The boolean decoder of RFC 6386, 7.3, over the bytes at the beginning of a frame; past their end it reads zeros.
class Bits {
public:
    explicit Bits(std::span<const std::byte> bytes) : bytes_(bytes)
    {
        value_ = next() << 8;
        value_ |= next();
    }

    bool flag()
    {
        constexpr unsigned kEven = 128; // of 256
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

// The quantiser index of a key frame, 0 to 127, as its header has it (RFC 6386, 9.2 to 9.6): where its segments have
// their own, their mean.
double quantiserOf(std::span<const std::byte> frame)
{
    constexpr std::size_t kBeforeBits = 10; // tag, start code, size
    Bits bits(frame.size() > kBeforeBits ? frame.subspan(kBeforeBits) : std::span<const std::byte>());
    bits.number(2); // colours, clamping
    std::array<int, 4> segments{};
    bool absolute = false, segmented = false;
    if (bits.flag()) {
        const bool map = bits.flag(), data = bits.flag();
        if (data) {
            segmented = true;
            absolute = bits.flag();
            for (int& segment : segments)
                segment = bits.flag() ? bits.signedNumber(7) : 0;
            bits.skipOptional(4, 6, true); // of the loop filter
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

// The quality that libwebp's encoder takes for that quantiser; the other way round than its own curve, a cube root.
int qualityFor(double quantiser)
{
    const double linear = std::pow(1 - quantiser / 127, 3);
    return int(std::lround(100 * (linear < 0.5 ? 1.5 * linear : (linear + 1) / 2)));
}

// The content of a chunk of a file that was found sound; empty where there is none.
std::span<const std::byte> chunkOf(std::span<const std::byte> file, const char* name)
{
    for (std::size_t at = 12; at + 8 <= file.size();) {
        std::uint32_t size = 0;
        for (int i = 3; i >= 0; --i)
            size = size << 8 | std::uint32_t(file[at + 4 + std::size_t(i)]);
        const std::size_t length = std::min<std::size_t>(size, file.size() - at - 8);
        if (std::memcmp(&file[at], name, 4) == 0)
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
    config.exact = 1; // red, green and blue stay where alpha is 0
    config.quality = lossy.empty() ? 75 : float(quality);
    config.use_sharp_yuv = 1; // halved colours lose less of the directions
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
