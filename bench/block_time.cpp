// Compares BC5 of normal maps with libnvtt and libsquish, then BC7 with libsquish's BC1 and BC3 and with libastcenc's
// ASTC 4x4: the mean and maximum error in degrees, and the time on one core. Without libnvtt and libsquish, and for EAC
// RG11 and UASTC, Cotan's encoders alone.
//   block_time FILE...
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <functional>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#ifdef COTAN_OTHER_ENCODERS
#include <nvtt/nvtt.h>
#include <squish.h>
#endif

#include "core/loops.hpp"
#include "cotan/image.hpp"
#include "image/astc.hpp"
#include "image/dds.hpp"
#include "image/etc.hpp"
#include "image/uastc.hpp"
#include "maps/blocks/block.hpp"

namespace {

using cotan::Image;
using Bytes = std::vector<std::byte>;

// Decodes half a BC5 block to values of 0 to 255, unrounded, as GPUs do.
void decodeHalf(const std::byte* block, double* to)
{
    const double a = double(std::to_integer<int>(block[0])), b = double(std::to_integer<int>(block[1]));
    double levels[8] = {a, b};
    for (int i = 1; i < 7; ++i)
        levels[i + 1] = a > b ? ((7 - i) * a + i * b) / 7 : i < 5 ? ((5 - i) * a + i * b) / 5 : i == 5 ? 0 : 255;
    std::uint64_t bits = 0;
    for (int i = 7; i >= 2; --i)
        bits = bits << 8 | std::to_integer<std::uint64_t>(block[i]);
    for (int i = 0; i < 16; ++i)
        to[i] = levels[bits >> 3 * i & 7];
}

struct Figures {
    double mean = 0, maximum = 0;
};

Figures errorOf(const std::vector<glm::dvec3>& normals, int width, int height, const Bytes& blocks)
{
    Figures f;
    const int across = (width + 3) / 4;
    for (int by = 0; by < (height + 3) / 4; ++by)
        for (int bx = 0; bx < across; ++bx) {
            double x[16], y[16];
            const std::byte* const block = blocks.data() + std::size_t(by * across + bx) * 16;
            decodeHalf(block, x);
            decodeHalf(block + 8, y);
            for (int i = 0; i < 16; ++i) {
                const int px = bx * 4 + i % 4, py = by * 4 + i / 4;
                if (px >= width || py >= height)
                    continue;
                glm::dvec3 n((x[i] - 128) / 127, (y[i] - 128) / 127, 0);
                n.z = std::sqrt(std::max(0.0, 1 - n.x * n.x - n.y * n.y));
                n = glm::normalize(n);
                const glm::dvec3& to = normals[std::size_t(py) * std::size_t(width) + std::size_t(px)];
                const double degrees = glm::degrees(std::atan2(glm::length(glm::cross(n, to)), glm::dot(n, to)));
                f.mean += degrees;
                f.maximum = std::max(f.maximum, degrees);
            }
        }
    f.mean /= double(width) * double(height);
    return f;
}

#ifdef COTAN_OTHER_ENCODERS
struct ByteCollector : nvtt::OutputHandler {
    Bytes bytes;
    void beginImage(int, int, int, int, int, int) override {}
    bool writeData(const void* data, int size) override
    {
        const auto* const from = static_cast<const std::byte*>(data);
        bytes.insert(bytes.end(), from, from + size);
        return true;
    }
};

Bytes byNvtt(const std::vector<std::uint8_t>& rgba, int width, int height, nvtt::Quality quality)
{
    std::vector<std::uint8_t> bgra = rgba;
    for (std::size_t i = 0; i < bgra.size(); i += 4)
        std::swap(bgra[i], bgra[i + 2]);
    nvtt::InputOptions in;
    in.setTextureLayout(nvtt::TextureType_2D, width, height);
    in.setMipmapData(bgra.data(), width, height);
    in.setMipmapGeneration(false);
    in.setNormalMap(false);
    in.setGamma(1, 1);
    nvtt::CompressionOptions how;
    how.setFormat(nvtt::Format_BC5);
    how.setQuality(quality);
    ByteCollector collector;
    nvtt::OutputOptions out;
    out.setOutputHeader(false);
    out.setOutputHandler(&collector);
    nvtt::Compressor compressor;
    compressor.enableCudaAcceleration(false);
    compressor.process(in, how, out);
    return collector.bytes;
}

Bytes bySquish(const std::vector<std::uint8_t>& rgba, int width, int height)
{
    Bytes bytes(std::size_t(squish::GetStorageRequirements(width, height, squish::kBc5)));
    squish::CompressImage(rgba.data(), width, height, bytes.data(), squish::kBc5);
    return bytes;
}
#endif

// image: three channels of 8 bits, or two of 16.
Figures errorOfImage(const std::vector<glm::dvec3>& normals, const Image& image)
{
    Figures f;
    for (std::size_t i = 0; i < std::min(normals.size(), image.pixelCount()); ++i) {
        glm::dvec3 n(0, 0, 1);
        for (int c = 0; c < 3; ++c)
            n[c] = image.type == cotan::PixelType::unorm16
                ? (image.words()[4 * i + std::size_t(c)] / 65535.0 * 255 - 128) / 127
                : (image.bytes8()[4 * i + std::size_t(c)] - 128.0) / 127;
        if (image.type == cotan::PixelType::unorm16)
            n.z = std::sqrt(std::max(0.0, 1 - n.x * n.x - n.y * n.y));
        n = glm::normalize(n);
        const double degrees =
            glm::degrees(std::atan2(glm::length(glm::cross(n, normals[i])), glm::dot(n, normals[i])));
        f.mean += degrees / double(normals.size());
        f.maximum = std::max(f.maximum, degrees);
    }
    return f;
}

// Blocks with three channels, decoded by OpenImageIO.
Image decodedDds(const cotan::DdsCode& code, int width, int height, const Bytes& blocks)
{
    Bytes dds = cotan::ddsHeader(code, width, height, 1);
    dds.insert(dds.end(), blocks.begin(), blocks.end());
    return *cotan::decodeImage(dds, "blocks.dds");
}

Image decodedAstc(int width, int height, const Bytes& blocks)
{
    Image image = cotan::makeImage(width, height, cotan::PixelType::unorm8, "astc");
    return cotan::decodeAstc(4, 4, blocks, image) ? image : Image{};
}

Bytes byCotan(const Image& map)
{
    return cotan::withThreads(1, [&] { return cotan::maps::encodeBc5(map, {}); });
}

Image decodedEac(int width, int height, const Bytes& blocks)
{
    Image image = cotan::makeImage(width, height, cotan::PixelType::unorm16, "eac");
    cotan::decodeEtc(cotan::EtcCode::rg11, blocks, image);
    return image;
}

Image decodedUastc(int width, int height, const Bytes& blocks)
{
    Image image = cotan::makeImage(width, height, cotan::PixelType::unorm8, "uastc");
    return cotan::decodeUastc(blocks, image) ? image : Image{};
}

} // namespace

int main(int count, char** files)
{
    for (int f = 1; f < count; ++f) {
        const auto map = cotan::readImage(files[f]);
        if (!map) {
            fmt::print(stderr, "block_time: {}\n", map.error().message);
            return 2;
        }
        const int width = map->width, height = map->height;
        std::vector<glm::dvec3> normals;
        std::vector<std::uint8_t> rgba;
        Image target = cotan::makeImage(width, height, cotan::PixelType::float32, "target"),
              codes = target; // the 8-bit input of the other encoders
        for (std::size_t i = 0; i < map->pixelCount(); ++i) {
            glm::dvec3 n;
            for (int c = 0; c < 3; ++c)
                n[c] = map->type == cotan::PixelType::unorm16 ? (map->words()[4 * i + std::size_t(c)] - 32768.0) / 32767
                                                              : (map->bytes8()[4 * i + std::size_t(c)] - 128.0) / 127;
            n.z = std::max(n.z, 0.0);
            n = glm::length(n) > 0 ? glm::normalize(n) : glm::dvec3(0, 0, 1);
            normals.push_back(n);
            for (int c = 0; c < 4; ++c) {
                const double code = c == 3 ? 255 : 128 + 127 * n[c];
                target.floats()[4 * i + std::size_t(c)] = c == 3 ? 1.0f : float((n[c] + 1) / 2);
                rgba.push_back(std::uint8_t(std::lround(code)));
                codes.floats()[4 * i + std::size_t(c)] = float((double(rgba.back()) - 128) / 127 + 1) / 2;
            }
        }
        const std::pair<const char*, std::function<Bytes()>> encoders[] = {
            {"cotan", [&] { return byCotan(target); }},
            {"cotan, 8 bits", [&] { return byCotan(codes); }},
#ifdef COTAN_OTHER_ENCODERS
            {"nvtt fastest", [&] { return byNvtt(rgba, width, height, nvtt::Quality_Fastest); }},
            {"nvtt normal", [&] { return byNvtt(rgba, width, height, nvtt::Quality_Normal); }},
            {"nvtt production", [&] { return byNvtt(rgba, width, height, nvtt::Quality_Production); }},
            {"squish", [&] { return bySquish(rgba, width, height); }},
#endif
        };
        const auto print = [&](const char* by, const Figures& error, double seconds) {
            fmt::print("{}\t{} x {}\t{}\t{:.4f}\t{:.2f}\t{:.3f}\n", files[f], width, height, by, error.mean,
                       error.maximum, seconds);
        };
        // Encodes, and returns the processor time of all threads.
        const auto timed = [](const auto& encode, auto& made) {
            const std::clock_t start = std::clock();
            made = encode();
            return double(std::clock() - start) / CLOCKS_PER_SEC;
        };
        Bytes blocks;
        for (const auto& [by, encode] : encoders) {
            const double seconds = timed(encode, blocks);
            print(by, errorOf(normals, width, height, blocks), seconds);
        }
#ifdef COTAN_OTHER_ENCODERS
        const auto squish = [&](int format) {
            Bytes bytes(std::size_t(squish::GetStorageRequirements(width, height, format)));
            squish::CompressImage(rgba.data(), width, height, bytes.data(),
                                  format | squish::kColourIterativeClusterFit);
            return bytes;
        };
#endif
        const std::tuple<const char*, cotan::DdsCode, std::function<Bytes()>> wide[] = {
            {"cotan, BC7",
             {"DX10", 98, 16},
             [&] { return cotan::withThreads(1, [&] { return cotan::maps::encodeBc7(target, {}); }); }},
#ifdef COTAN_OTHER_ENCODERS
            {"squish, BC1", {"DXT1", 0, 8}, [&] { return squish(squish::kDxt1); }},
            {"squish, BC3", {"DXT5", 0, 16}, [&] { return squish(squish::kDxt5); }}
#endif
        };
        for (const auto& [by, code, encode] : wide) {
            const double seconds = timed(encode, blocks);
            print(by, errorOfImage(normals, decodedDds(code, width, height, blocks)), seconds);
        }
        const cotan::maps::CodeScale eleven{128 * 2047 / 255.0f, 127 * 2047 / 255.0f};
        double seconds = timed(
            [&] { return cotan::withThreads(1, [&] { return cotan::maps::encodeEacRg11(target, eleven); }); }, blocks);
        print("cotan, EAC RG11", errorOfImage(normals, decodedEac(width, height, blocks)), seconds);
        seconds =
            timed([&] { return cotan::withThreads(1, [&] { return cotan::maps::encodeUastc(target, {}); }); }, blocks);
        print("cotan, UASTC", errorOfImage(normals, decodedUastc(width, height, blocks)), seconds);
        Image scaled = target; // ASTC takes codes, 0 to 1
        for (std::size_t i = 0; i < 4 * map->pixelCount(); ++i)
            if (i % 4 != 3)
                scaled.floats()[i] = (128 + 127 * (2 * scaled.floats()[i] - 1)) / 255;
        seconds = timed(
            [&] {
                return cotan::withThreads(1,
                                          [&] { return *cotan::encodeAstc(4, 4, scaled, cotan::AstcChannels::all); });
            },
            blocks);
        print("astcenc, ASTC 4x4", errorOfImage(normals, decodedAstc(width, height, blocks)), seconds);
    }
    return 0;
}
