#include "texture_mips.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <glm/gtc/packing.hpp>

#include "core/large_array.hpp"
#include "cotan/portable.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

using glm::vec4;

// A level of decoded texels.
struct FloatLevel {
    int width = 0;
    int height = 0;
    std::vector<vec4> texels;

    vec4* row(int y) { return texels.data() + std::size_t(y) * std::size_t(width); }
};

// Green as stored: mips do not depend on its direction.
f32::cotan_normal_format portableFormat(const MipRequest& request)
{
    auto format = toFormat<f32::cotan_normal_format>(request.normalFormat, request.image->type);
    format.green = 1;
    return format;
}

// The unit direction and w = 1; all zeros if the texel has no direction.
vec4 decodedNormal(const vec4& texel, const f32::cotan_normal_format& format)
{
    const glm::vec3 unit = f32::cotan_normalize_or(f32::cotan_decode(glm::vec3(texel), format), glm::vec3(0));
    return vec4(unit, unit == glm::vec3(0) ? 0 : 1);
}

vec4 encodedNormal(const vec4& average, const f32::cotan_normal_format& format)
{
    const glm::vec3 unit = f32::cotan_normalize_or(glm::vec3(average), glm::vec3(0, 0, 1));
    const float length = average.w > 0 ? glm::length(glm::vec3(average)) / average.w : 1;
    return vec4(f32::cotan_encode_texel(unit, format), length);
}

// sRGB encoding by a table over the square root, whose 4096 steps are at most 0.16 of an 8-bit step there.
std::uint8_t srgbByte(float linear)
{
    constexpr std::size_t kSteps = 4096;
    static const std::array<std::uint8_t, kSteps> table = [] {
        std::array<std::uint8_t, kSteps> t{};
        for (std::size_t i = 0; i < kSteps; ++i) {
            const float root = float(i) / float(kSteps - 1);
            t[i] = std::uint8_t(std::lround(255.0f * f32::cotan_linear_to_srgb(root * root)));
        }
        return t;
    }();
    const float root = std::sqrt(f32::cotan_saturate(linear));
    return table[std::size_t(root * float(kSteps - 1) + 0.5f)];
}

// ---- reading the image ----------------------------------------------------------------------

// Reads an image row: colours become linear, normals stay encoded.
void readRow(const Image& image, int y, TextureKind kind, vec4* out)
{
    static const std::array<float, 256> linearOfByte = [] {
        std::array<float, 256> t{};
        for (std::size_t i = 0; i < t.size(); ++i)
            t[i] = f32::cotan_srgb_to_linear(float(i) / 255.0f);
        return t;
    }();
    const bool srgb = kind == TextureKind::color;
    const auto read = [&](const auto* components, const auto& texelOf) {
        const auto* p = components + std::size_t(y) * std::size_t(image.width) * 4;
        for (int x = 0; x < image.width; ++x, p += 4)
            out[x] = texelOf(p);
    };
    switch (image.type) {
    case PixelType::unorm8:
        return read(image.bytes8(), [srgb, &linear = linearOfByte](const std::uint8_t* p) {
            return srgb ? vec4(linear[p[0]], linear[p[1]], linear[p[2]], float(p[3]) / 255.0f)
                        : vec4(p[0], p[1], p[2], p[3]) * (1.0f / 255.0f);
        });
    case PixelType::unorm16:
        return read(image.words(), [srgb](const std::uint16_t* p) {
            vec4 t = vec4(p[0], p[1], p[2], p[3]) * (1.0f / 65535.0f);
            for (int c = 0; srgb && c < 3; ++c)
                t[c] = f32::cotan_srgb_to_linear(t[c]);
            return t;
        });
    case PixelType::float32:
        return read(image.floats(), [](const float* p) {
            vec4 t(0);
            for (int c = 0; c < 4; ++c) // NaN would spread to all levels
                t[c] = std::abs(p[c]) <= 1e30f ? p[c] : 0.0f;
            return t;
        });
    }
}

// ---- averaging ------------------------------------------------------------------------------

// The source texels that one target texel covers along one axis, and their fractions of its extent.
struct Taps {
    int first = 0;
    int count = 0;
    std::array<float, 3> weight{};
};

std::vector<Taps> makeTaps(int source, int target)
{
    std::vector<Taps> taps(static_cast<std::size_t>(target));
    const double ratio = double(source) / target;
    for (int i = 0; i < target; ++i) {
        Taps& t = taps[std::size_t(i)];
        const double low = i * ratio;
        const double high = (i + 1) * ratio;
        t.first = int(low);
        for (int s = t.first; s < source && t.count < 3; ++s) {
            const double covered = std::min(high, s + 1.0) - std::max(low, double(s));
            if (covered <= 1e-9)
                break;
            t.weight[std::size_t(t.count++)] = float(covered / ratio);
        }
    }
    return taps;
}

// rowOf(y) returns a row of decoded source texels; y never decreases between calls.
template<class RowOf> FloatLevel halved(int width, int height, RowOf rowOf)
{
    FloatLevel level{std::max(width / 2, 1), std::max(height / 2, 1), {}};
    level.texels = zeros<vec4>(std::size_t(level.width) * std::size_t(level.height));
    const std::vector<Taps> columns = makeTaps(width, level.width);
    const std::vector<Taps> rows = makeTaps(height, level.height);
    for (int y = 0; y < level.height; ++y) {
        const Taps& r = rows[std::size_t(y)];
        vec4* out = level.row(y);
        for (int j = 0; j < r.count; ++j) {
            const vec4* in = rowOf(r.first + j);
            const float weight = r.weight[std::size_t(j)];
            for (int x = 0; x < level.width; ++x) {
                const Taps& c = columns[std::size_t(x)];
                for (int i = 0; i < c.count; ++i)
                    out[x] += in[c.first + i] * (c.weight[std::size_t(i)] * weight);
            }
        }
    }
    return level;
}

// ---- storing --------------------------------------------------------------------------------

template<class Word> std::array<Word, 4> unorms(const vec4& t)
{
    const auto word = [](float x) {
        return Word(f32::cotan_saturate(x) * float(std::numeric_limits<Word>::max()) + 0.5f);
    };
    return {word(t.x), word(t.y), word(t.z), word(t.w)};
}

void storeTexel(const vec4& t, TexelFormat format, std::byte* out)
{
    const auto store = [&](const auto& texel) { std::memcpy(out, &texel, sizeof texel); };
    switch (format) {
    case TexelFormat::srgb8:
        store(std::array{srgbByte(t.x), srgbByte(t.y), srgbByte(t.z), unorms<std::uint8_t>(t)[3]});
        break;
    case TexelFormat::unorm8: store(unorms<std::uint8_t>(t)); break;
    case TexelFormat::unorm16: store(unorms<std::uint16_t>(t)); break;
    case TexelFormat::float16: store(glm::packHalf4x16(t)); break;
    case TexelFormat::float32: store(t); break;
    }
}

bool storedUnchanged(const MipRequest& request)
{
    const PixelType type = request.image->type;
    if (request.kind == TextureKind::normal && !isOpaque(*request.image))
        return false; // each texel of the file is one direction, regardless of its alpha
    return (type == PixelType::unorm8
            && (request.format == TexelFormat::srgb8 || request.format == TexelFormat::unorm8))
        || (type == PixelType::unorm16 && request.format == TexelFormat::unorm16 && request.kind != TextureKind::color);
}

void addFinestLevel(MipChain& chain, const MipRequest& request)
{
    const Image& image = *request.image;
    if (storedUnchanged(request)) {
        const std::size_t size = image.pixelCount() * image.bytesPerPixel();
        chain.levels.push_back({image.width, image.height, std::span(image.data).first(size)});
        return;
    }
    std::vector<vec4> row(static_cast<std::size_t>(image.width));
    const std::size_t size = bytesPerTexel(chain.format);
    std::vector<std::byte>& data = chain.own.emplace_back(image.pixelCount() * size);
    for (int y = 0; y < image.height; ++y) {
        readRow(image, y, request.kind, row.data());
        if (request.kind == TextureKind::normal)
            for (vec4& texel : row)
                texel.w = 1;
        std::byte* out = data.data() + std::size_t(y) * row.size() * size;
        for (std::size_t x = 0; x < row.size(); ++x)
            storeTexel(row[x], chain.format, out + x * size);
    }
    chain.levels.push_back({image.width, image.height, data});
}

FloatLevel firstHalf(const MipRequest& request)
{
    const Image& image = *request.image;
    const f32::cotan_normal_format format = portableFormat(request);
    std::vector<vec4> row(static_cast<std::size_t>(image.width));
    int loaded = -1; // for odd heights two target rows share a source row
    return halved(image.width, image.height, [&](int y) {
        if (y != loaded) {
            readRow(image, y, request.kind, row.data());
            if (request.kind == TextureKind::normal)
                for (vec4& texel : row)
                    texel = decodedNormal(texel, format);
            loaded = y;
        }
        return row.data();
    });
}

void addSmallerLevel(MipChain& chain, const MipRequest& request, const FloatLevel& level)
{
    const f32::cotan_normal_format format = portableFormat(request);
    const std::size_t size = bytesPerTexel(chain.format);
    std::vector<std::byte>& data = chain.own.emplace_back(level.texels.size() * size);
    for (std::size_t i = 0; i < level.texels.size(); ++i) {
        const vec4& texel = level.texels[i];
        storeTexel(request.kind == TextureKind::normal ? encodedNormal(texel, format) : texel, chain.format,
                   data.data() + i * size);
    }
    chain.levels.push_back({level.width, level.height, data});
}

} // namespace

std::size_t bytesPerTexel(TexelFormat format)
{
    if (format == TexelFormat::srgb8 || format == TexelFormat::unorm8)
        return 4;
    return format == TexelFormat::unorm16 || format == TexelFormat::float16 ? 8 : 16;
}

TexelFormat texelFormat(PixelType type, TextureKind kind, bool filterable16, bool filterable32)
{
    if (type == PixelType::unorm8)
        return kind == TextureKind::color ? TexelFormat::srgb8 : TexelFormat::unorm8;
    if (type == PixelType::unorm16 && filterable16)
        return TexelFormat::unorm16;
    return filterable32 ? TexelFormat::float32 : TexelFormat::float16;
}

MipChain buildMips(const MipRequest& request)
{
    MipChain chain;
    chain.format = request.format;
    int width = request.image->width;
    int height = request.image->height;
    const auto fits = [&] { return width <= request.largest && height <= request.largest; };
    if (fits())
        addFinestLevel(chain, request);
    FloatLevel level;
    while (width > 1 || height > 1) {
        level =
            level.texels.empty() ? firstHalf(request) : halved(width, height, [&level](int y) { return level.row(y); });
        width = level.width;
        height = level.height;
        if (fits())
            addSmallerLevel(chain, request, level);
    }
    return chain;
}

} // namespace cotan
