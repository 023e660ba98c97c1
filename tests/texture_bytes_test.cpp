// Compares texture files byte by byte with the definitions of KTX 2.0 and DDS.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "cotan/convention.hpp"
#include "image/codecs.hpp"
#include "map_files/mips.hpp"
#include "maps/texels.hpp"
#include "maps/textures/make_texture.hpp"
#include "maps/textures/texel_code.hpp"

namespace cotan::maps {

namespace {

// Access to little-endian numbers of a file.
class BytesOfFile {
public:
    explicit BytesOfFile(std::string text) : text_(std::move(text)) {}
    std::uint64_t number(std::size_t at, std::size_t size) const
    {
        std::uint64_t value = 0;
        for (std::size_t i = size; i-- > 0;)
            value = value << 8 | static_cast<unsigned char>(text_.at(at + i));
        return value;
    }
    std::uint64_t word(std::size_t at) const { return number(at, 4); }
    std::string text(std::size_t at, std::size_t size) const { return text_.substr(at, size); }
    std::size_t size() const { return text_.size(); }

private:
    std::string text_;
};

struct Format {
    TexelCode code;
    std::uint32_t vulkan, dxgi, bytes, model;
    std::vector<std::uint32_t> channels;
};

TexelCode twoOf(TexelCode code)
{
    code.two = true;
    code.swizzle = Swizzle::greyAlpha;
    return code;
}

// VkFormat, DXGI_FORMAT (0: not in DDS), bytes of a pixel or block, KHR_DF_MODEL, KHR_DF_CHANNEL.
const std::vector<Format> kFormats = {{TexelCode::rgba8, 37, 28, 4, 1, {0, 1, 2, 15}},
                                      {TexelCode::bc5, 141, 83, 16, 132, {0, 1}},
                                      {TexelCode::bc5Signed, 142, 84, 16, 132, {0 | 0x40, 1 | 0x40}},
                                      {TexelCode::bc7, 145, 98, 16, 134, {0}},
                                      {TexelCode::bc4, 139, 80, 8, 131, {0}},
                                      {TexelCode::eacRg11, 155, 0, 16, 161, {0, 1}},
                                      {TexelCode::eacR11, 153, 0, 8, 161, {0}},
                                      {TexelCode(4, 4), 157, 0, 16, 162, {0}},
                                      {TexelCode(6, 5), 163, 0, 16, 162, {0}},
                                      {twoOf(TexelCode(8, 8)), 171, 0, 16, 162, {0}}};

// Levels of 6 x 5, 3 x 2 and 1 x 1 texels in which no two adjacent bytes are equal.
std::vector<TextureLevel> levelsOf(const Format& format)
{
    std::vector<TextureLevel> levels{{6, 5, {}}, {3, 2, {}}, {1, 1, {}}};
    for (TextureLevel& level : levels) {
        const bool blocks = format.code != TexelCode::rgba8;
        const int across = format.code.width, down = format.code.height;
        const int units = blocks ? (level.width + across - 1) / across * ((level.height + down - 1) / down)
                                 : level.width * level.height;
        for (std::size_t i = 0; i < std::size_t(units) * format.bytes; ++i)
            level.texels.push_back(std::byte((i * 7 + std::size_t(level.width)) & 0xff));
    }
    return levels;
}

std::string textOf(const std::vector<std::byte>& bytes)
{
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// The reader's table of numbers is another one than the writer's.
TEST(TextureBytes, ofEachWordAreKnownByIt)
{
    std::size_t files = 0;
    for (const std::string& word : compressionWords()) {
        const auto code = codeNamed(word);
        ASSERT_TRUE(code) << word;
        const bool blocks = word != "none";
        const std::vector<TextureLevel> levels{
            {blocks ? code->width : 2, blocks ? code->height : 2, std::vector<std::byte>(16)}};
        for (const char* const name : {"map.ktx2", "map.dds"}) {
            if (name == std::string_view("map.dds") && blocks && !word.starts_with("bc"))
                continue; // KTX2 alone has it
            const std::string bytes = textureBytes(name, *code, levels);
            EXPECT_EQ(blockName(std::as_bytes(std::span(bytes))), blocks ? word : "") << name << " of " << word;
            ++files;
        }
    }
    EXPECT_GT(files, 15u);
}

// Blocks have 4, 5, 6 and 8 rows; parts of a map end between blocks of all of them, and the last part has fewer rows.
TEST(TextureBytes, aMapInPartsGivesTheBlocksOfTheWholeMap)
{
    Image map = makeImage(9000, 126, PixelType::float32);
    std::mt19937 random(3);
    for (std::size_t i = 0; i < map.pixelCount(); ++i) { // flat, but for some columns
        const auto value = [&] { return i % 9000 < 40 ? 0.3f + 0.4f * float(random() % 1000) / 1000 : 0.5f; };
        const std::array<float, 4> texel{value(), value(), 1, 1};
        std::memcpy(map.data.data() + i * sizeof texel, texel.data(), sizeof texel);
    }
    for (const std::string word : {"none", "bc5", "astc-5x5", "astc-6x6", "astc-8x8"}) {
        const TexelCode code = *codeNamed(word);
        const Convention taken = codeConvention(code, {});
        const PixelType type = word == "none" ? PixelType::unorm8 : PixelType::float32;
        RecodeCounts counts;
        const Image stored = recode(map, {.from = {}, .to = taken, .type = type}, counts);
        std::vector<TextureLevel> levels;
        for (const MipLevel& level : mipChain(stored, {.from = taken, .to = taken, .type = type})) {
            const auto made = levelOf(levels.empty() ? stored : level.normals, code, {});
            if (!made && made.error().kind == ErrorKind::unavailable)
                break; // a build without libastcenc
            ASSERT_TRUE(made) << made.error().message;
            levels.push_back(*made);
        }
        if (levels.empty())
            continue;
        TextureRows texture(map.width, map.height, code, taken, {.from = taken, .to = {}});
        for (int y = 0, atOnce = rowsAtOnce(map.width); y < map.height; y += atOnce)
            ASSERT_TRUE(texture.add(rowsOf(stored, y, std::min(atOnce, map.height - y)), nullptr));
        const MadeTexture made = texture.finish({});
        EXPECT_EQ(made.levels, int(levels.size()));
        EXPECT_EQ(textOf(made.bytes), textureBytes("map.ktx2", code, levels)) << word;
    }
}

TEST(TextureBytes, ktx2FollowsItsSpecification)
{
    for (const Format& format : kFormats)
        for (const std::string frame : {"", "smooth"}) {
            const auto levels = levelsOf(format);
            const BytesOfFile file(textureBytes("a.ktx2", format.code, levels, frame));
            EXPECT_EQ(file.text(0, 12), "\xabKTX 20\xbb\r\n\x1a\n");
            const bool blocks = format.code != TexelCode::rgba8;
            const std::size_t channels = format.channels.size(), described = 4 + 24 + 16 * channels;
            std::size_t at = 12;
            for (const std::uint64_t word :
                 {std::uint64_t(format.vulkan), std::uint64_t(1), std::uint64_t(6), std::uint64_t(5), std::uint64_t(0),
                  std::uint64_t(0), std::uint64_t(1), std::uint64_t(3), std::uint64_t(0), std::uint64_t(80 + 3 * 24),
                  std::uint64_t(described), std::uint64_t(80 + 3 * 24 + described)}) {
                EXPECT_EQ(file.word(at), word) << at;
                at += 4;
            }
            const std::size_t keysAt = file.word(56), keysSize = file.word(60);
            EXPECT_EQ(file.number(64, 8), 0u); // no supercompression global data
            EXPECT_EQ(file.number(72, 8), 0u);
            // The data format descriptor.
            at = 152;
            EXPECT_EQ(file.word(at), described);
            EXPECT_EQ(file.word(at + 4), 0u);
            EXPECT_EQ(file.word(at + 8), 2u | (described - 4) << 16);
            EXPECT_EQ(file.word(at + 12), format.model | 1u << 8 | 1u << 16); // BT.709, linear, no flags
            const auto block = std::uint64_t(format.code.width - 1 + 256 * (format.code.height - 1));
            EXPECT_EQ(file.word(at + 16), blocks ? block : 0u);
            EXPECT_EQ(file.number(at + 20, 8), format.bytes);
            const std::size_t bits = format.bytes * 8 / channels;
            for (std::size_t c = 0; c < channels; ++c) {
                const std::size_t sample = at + 28 + 16 * c;
                EXPECT_EQ(file.word(sample), c * bits | (bits - 1) << 16 | std::uint64_t(format.channels[c]) << 24);
                const bool isSigned =
                    (format.channels[c] & 0x40) != 0; // KHR_DF_SAMPLE_DATATYPE_SIGNED: -2^31 to 2^31 - 1
                EXPECT_EQ(file.word(sample + 4), 0u);
                EXPECT_EQ(file.word(sample + 8), isSigned ? 0x80000000u : 0u);
                EXPECT_EQ(file.word(sample + 12), isSigned ? 0x7fffffffu : blocks ? 0xffffffffu : 255u);
            }
            // Keys with their values in the order of the keys, each pair starting at a multiple of four.
            std::vector<std::string> keys;
            for (at = keysAt; at < keysAt + keysSize;) {
                const std::size_t size = file.word(at);
                keys.push_back(file.text(at + 4, size));
                for (std::size_t i = size; i % 4 != 0; ++i)
                    EXPECT_EQ(file.number(at + 4 + i, 1), 0u);
                at += 4 + (size + 3) / 4 * 4;
            }
            EXPECT_EQ(at, keysAt + keysSize);
            std::vector<std::string> expected = {std::string("KTXorientation\0rd", 17) + '\0',
                                                 std::string("KTXwriter\0cotan", 15) + '\0'};
            if (format.code.two)
                expected.insert(expected.begin() + 1, std::string("KTXswizzle\0ra01", 15) + '\0');
            if (!frame.empty())
                expected.push_back(std::string("cotanFrame\0smooth", 17) + '\0');
            EXPECT_EQ(keys, expected);
            // The levels, smallest first, each aligned to its block size.
            std::size_t end = keysAt + keysSize;
            for (std::size_t i = 3; i-- > 0;) {
                const std::size_t offset = file.number(80 + 24 * i, 8), size = levels[i].texels.size();
                EXPECT_EQ(offset, (end + format.bytes - 1) / format.bytes * format.bytes) << i;
                EXPECT_EQ(file.number(88 + 24 * i, 8), size);
                EXPECT_EQ(file.number(96 + 24 * i, 8), size);
                EXPECT_EQ(file.text(offset, size), textOf(levels[i].texels)) << i;
                for (; end < offset; ++end)
                    EXPECT_EQ(file.number(end, 1), 0u);
                end = offset + size;
            }
            EXPECT_EQ(file.size(), end);
        }
}

TEST(TextureBytes, ddsIsAHeaderAndTheLevelsFromTheLargest)
{
    for (const Format& format : kFormats) {
        if (format.dxgi == 0)
            continue;
        const auto levels = levelsOf(format);
        const BytesOfFile file(textureBytes("a.DDS", format.code, levels, "smooth"));
        EXPECT_EQ(file.text(0, 4), "DDS ");
        EXPECT_EQ(file.word(12), 5u);
        EXPECT_EQ(file.word(16), 6u);
        EXPECT_EQ(file.word(28), 3u);
        std::size_t at = 128;
        if (format.code != TexelCode::rgba8) {
            EXPECT_EQ(file.word(20), 2u * 2 * format.bytes); // four blocks
            EXPECT_EQ(file.text(84, 4), "DX10");
            EXPECT_EQ(file.word(128), format.dxgi);
            at = 148;
        }
        for (const TextureLevel& level : levels) {
            EXPECT_EQ(file.text(at, level.texels.size()), textOf(level.texels));
            at += level.texels.size();
        }
        EXPECT_EQ(file.size(), at);
    }
}

// x and y of one direction, with the codes for zero and one that shaders of each expansion assume.
TEST(TextureBytes, blocksHaveTheCodesOfTheirExpansion)
{
    const double x = 0.3, y = -0.55;
    Image image = makeImage(5, 9, PixelType::float32);
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        float* const p = image.floats() + 4 * i;
        p[0] = float((x + 1) / 2), p[1] = float((y + 1) / 2), p[2] = 0.9f, p[3] = 1;
    }
    const auto decoded = [](const std::byte* block, std::size_t texel) { // BC4 whose first endpoint is larger
        const int a = std::to_integer<int>(block[0]), b = std::to_integer<int>(block[1]);
        std::uint64_t bits = 0;
        std::memcpy(&bits, block + 2, 6);
        const int code = int(bits >> 3 * texel & 7);
        return code == 0 ? double(a) : code == 1 ? double(b) : ((8 - code) * a + (code - 1) * b) / 7.0;
    };
    for (const auto& [expansion, zero, unit] : {std::tuple(Expansion::exact, 128.0, 127.0),
                                                {Expansion::biased, 127.5, 127.5},
                                                {Expansion::exact16, 255 * 32768 / 65535.0, 255 * 32767 / 65535.0}}) {
        Convention to;
        to.expansion = expansion;
        const TextureLevel level = *levelOf(image, TexelCode::bc5, to);
        EXPECT_EQ(level.width, 5);
        EXPECT_EQ(level.height, 9);
        ASSERT_EQ(level.texels.size(), 2u * 3 * 16);
        for (std::size_t texel : {0u, 7u, 15u}) {
            EXPECT_NEAR(decoded(level.texels.data() + 80, texel), zero + unit * x, 0.5 / 7 + 1e-3);
            EXPECT_NEAR(decoded(level.texels.data() + 88, texel), zero + unit * y, 0.5 / 7 + 1e-3);
        }
        EXPECT_EQ(levelOf(image, TexelCode::bc7, to)->texels.size(), 2u * 3 * 16);
        EXPECT_EQ(levelOf(image, TexelCode::eacRg11, to)->texels.size(), 2u * 3 * 16);
        EXPECT_EQ(levelOf(image, TexelCode(4, 4), to)->texels.size(), 2u * 3 * 16);
        EXPECT_EQ(levelOf(image, TexelCode(5, 5), to)->texels.size(), 2u * 16);
    }
    EXPECT_EQ(levelOf(image, TexelCode::rgba8, {})->texels, image.data);
    const TextureLevel one = app::greyLevel(image, TexelCode::bc4);
    EXPECT_EQ(one.width, 5);
    EXPECT_EQ(one.height, 9);
    ASSERT_EQ(one.texels.size(), 2u * 3 * 8);
    EXPECT_NEAR(decoded(one.texels.data() + 40, 5), 255 * (x + 1) / 2, 0.5 / 7 + 1e-3);
}

} // namespace
} // namespace cotan::maps
