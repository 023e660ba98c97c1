#include "maps/texels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/loops.hpp"
#include "cotan/vector.hpp"

namespace cotan::maps {

namespace {

// A channel whose range is at most three 8-bit codes counts as constant.
constexpr float kMaxConstantRange = 3.0f / 255;
constexpr float kShortestTexel = 1e-3f;

// A format for cotan_decode whose second axis is up the image instead of along v.
f32::cotan_normal_format imageFormat(const Convention& c, PixelType type)
{
    f32::cotan_normal_format format = toFormat<f32::cotan_normal_format>(c, 1, bitsPerComponent(type));
    format.green = c.greenUp ? 1.0f : -1.0f;
    return format;
}

glm::vec3 decode(const glm::vec4& t, const f32::cotan_normal_format& format)
{
    const bool two = format.channels != COTAN_CHANNELS_XYZ;
    const glm::vec3 stored(t.x, t.y, two ? 0.5f : t.z);
    if (!isFinite(stored))
        return glm::vec3(0);
    const glm::vec3 m = f32::cotan_decode(stored, format);
    const float length2 = glm::dot(m, m); // must neither underflow nor overflow
    return length2 >= kShortestTexel * kShortestTexel && length2 < 1e30f ? m : glm::vec3(0);
}

// Loads the stored components of consecutive texels, starting with texel `first`.
void loadTexels(const Image& image, std::size_t first, std::span<glm::vec4> texels)
{
    const std::size_t start = first * 4, count = texels.size() * 4;
    float* out = &texels[0].x;
    const auto load = [&](const auto* codes, float unit) {
        std::transform(codes, codes + count, out, [unit](auto code) { return float(code) * unit; });
    };
    if (image.type == PixelType::unorm8)
        load(image.bytes8() + start, 1.0f / 255);
    else if (image.type == PixelType::unorm16)
        load(image.words() + start, 1.0f / 65535);
    else
        std::copy_n(image.floats() + start, count, out);
}

} // namespace

void ChannelRange::add(const glm::vec4& t)
{
    lowest = glm::min(lowest, t);
    highest = glm::max(highest, t);
    grey = grey && t.x == t.y && t.x == t.z;
}

void ChannelRange::add(const ChannelRange& o)
{
    lowest = glm::min(lowest, o.lowest);
    highest = glm::max(highest, o.highest);
    grey = grey && o.grey;
}

void ChannelRange::add(const Image& image)
{
    std::vector<glm::vec4> row(std::size_t(image.width));
    for (int y = 0; y < image.height; ++y) {
        loadRow(image, y, row);
        for (const glm::vec4& t : row)
            add(t);
    }
}

Swizzle ChannelRange::swizzle() const
{
    const glm::vec4 range = highest - lowest;
    if (!(range.w > kMaxConstantRange))
        return Swizzle::rg;
    if (grey)
        return Swizzle::greyAlpha;
    return range.x <= kMaxConstantRange && range.y > kMaxConstantRange ? Swizzle::alphaGreen : Swizzle::rg;
}

Swizzle swizzleOf(const Image& image)
{
    ChannelRange range;
    range.add(image);
    return range.swizzle();
}

bool lacksZ(const Image& image)
{
    ChannelRange range;
    range.add(image);
    return !range.grey && range.lowest.z == range.highest.z && std::lround(255 * range.lowest.z) == 128
        && range.lowest.w == 1;
}

void unswizzle(Image& image, Swizzle from)
{
    if (from == Swizzle::rg)
        return;
    changeTexels(image, [&](glm::vec4& t) {
        t = from == Swizzle::greyAlpha ? glm::vec4(t.x, t.w, 0.5f, 1) : glm::vec4(t.w, t.y, 0.5f, 1);
    });
}

void swizzle(Image& image, Swizzle to)
{
    if (to == Swizzle::rg)
        return;
    changeTexels(image, [&](glm::vec4& t) {
        t = to == Swizzle::greyAlpha ? glm::vec4(t.x, t.x, t.x, t.y) : glm::vec4(1, t.y, 1, t.x);
    });
}

void loadRow(const Image& image, int row, std::span<glm::vec4> texels)
{
    loadTexels(image, std::size_t(row) * std::size_t(image.width), texels);
}

void storeRow(Image& image, int row, std::span<const glm::vec4> texels)
{
    const std::size_t start = std::size_t(row) * std::size_t(image.width) * 4;
    const std::span<const float> in(&texels[0].x, texels.size() * 4);
    const auto store = [&]<class T>(T* to, float maximum) {
        std::ranges::transform(
            in, to, [maximum](float x) { return x > 0 ? T(std::min(settled(x), 1.0f) * maximum + 0.5f) : T(0); });
    };
    if (image.type == PixelType::unorm8)
        store(image.bytes8() + start, 255);
    else if (image.type == PixelType::unorm16)
        store(image.words() + start, 65535);
    else
        std::ranges::transform(in, image.floats() + start, [](float x) { return std::isfinite(x) ? x : 0.0f; });
}

glm::vec3 decodeTexel(const glm::vec4& texel, const Convention& convention, PixelType type)
{
    return decode(texel, imageFormat(convention, type));
}

void decodeRow(const Image& image, int row, const Convention& convention, std::span<glm::vec3> normals)
{
    std::array<glm::vec4, 64> texels;
    const auto format = imageFormat(convention, image.type);
    const std::size_t start = std::size_t(row) * std::size_t(image.width);
    for (std::size_t x = 0; x < normals.size(); x += texels.size()) {
        const std::size_t count = std::min(texels.size(), normals.size() - x);
        loadTexels(image, start + x, {texels.data(), count});
        for (std::size_t i = 0; i < count; ++i)
            normals[x + i] = decode(texels[i], format);
    }
}

glm::vec4 encodeTexel(glm::vec3 normal, const Convention& convention, PixelType type, bool keepLength)
{
    if (!isFinite(normal) || glm::dot(normal, normal) < kShortestTexel * kShortestTexel)
        normal = glm::vec3(0, 0, 1);
    const auto format = imageFormat(convention, type);
    if (keepLength && convention.channels == Channels::xyz) {
        const int e = format.expansion;
        return {f32::cotan_compress(normal.x, e), f32::cotan_compress(normal.y * format.green, e),
                f32::cotan_compress(normal.z, e), 1.0f};
    }
    return {f32::cotan_encode_texel(glm::normalize(normal), format), 1.0f};
}

void forRowBands(int width, int height, const std::function<void(int first, int last)>& work)
{
    constexpr int kBand = 16;
    constexpr std::size_t kWorthAThread = 4096; // texels: fewer take less time than starting one
    withThreads(int(threadsFor(std::size_t(width) * std::size_t(height), kWorthAThread)), [&] {
        parallelFor(0, (height + kBand - 1) / kBand,
                    [&](int band) { work(band * kBand, std::min(height, (band + 1) * kBand)); });
    });
}

std::vector<float> anglesBetween(const Image& a, const Convention& conventionA, const Image& b,
                                 const Convention& conventionB)
{
    std::vector<float> degrees(a.pixelCount());
    const std::size_t width = std::size_t(a.width);
    forRowBands(a.width, a.height, [&](int first, int last) {
        std::vector<glm::vec3> rowA(width), rowB(width);
        for (int y = first; y < last; ++y) {
            decodeRow(a, y, conventionA, rowA);
            decodeRow(b, y, conventionB, rowB);
            float* out = degrees.data() + std::size_t(y) * width;
            for (std::size_t x = 0; x < width; ++x) {
                const glm::vec3 m = rowA[x], n = rowB[x];
                const bool both = glm::dot(m, m) > 0 && glm::dot(n, n) > 0;
                out[x] = both ? angleBetween(m, n) * float(180 / std::numbers::pi) : -1.0f;
            }
        }
    });
    return degrees;
}

Image rowsOf(const Image& image, int first, int count)
{
    Image rows = makeImage(image.width, count, image.type, image.name);
    const std::size_t bytes = std::size_t(image.width) * image.bytesPerPixel();
    std::copy_n(image.data.data() + std::size_t(first) * bytes, std::size_t(count) * bytes, rows.data.data());
    return rows;
}

} // namespace cotan::maps
