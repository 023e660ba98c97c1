// Every buffer that a function of cotan.h fills: its length is as documented there, nothing beyond it is written, and
// every number in it is right. The data are asymmetric: width and height, x and y, first and last element all differ.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "cotan.h"

namespace {

char message[512];

// `count` elements between guard elements that a call must not change.
template<class T> class Guarded {
public:
    explicit Guarded(std::size_t count) : all_(count + 2 * kAround, T(77)) {}
    ~Guarded()
    {
        for (std::size_t i = 0; i < kAround; ++i) {
            EXPECT_EQ(all_[i], T(77)) << "before the buffer";
            EXPECT_EQ(all_[all_.size() - 1 - i], T(77)) << "behind the buffer";
        }
    }
    T* data() { return all_.data() + kAround; }
    T operator[](std::size_t i) const { return all_[kAround + i]; }
    // Whether no element was written.
    bool untouched() const
    {
        for (const T& x : all_)
            if (x != T(77))
                return false;
        return true;
    }

private:
    static constexpr std::size_t kAround = 64;
    std::vector<T> all_;
};

template<class T> cotan_image_view pictureOf(T* pixels, int width, int height)
{
    return {sizeof(cotan_image_view), width, height, int(8 * sizeof(T)), pixels};
}

// A float image of one colour.
std::vector<float> filled(int width, int height, std::array<float, 3> c)
{
    std::vector<float> pixels;
    for (int i = 0; i < width * height; ++i)
        pixels.insert(pixels.end(), {c[0], c[1], c[2], 1});
    return pixels;
}

// The number that a float map stores for a component from -1 to 1.
float stored(double x) { return float(0.5 * x + 0.5); }

void expectPixel(const float* pixel, double x, double y, double z, double tolerance)
{
    EXPECT_NEAR(2 * double(pixel[0]) - 1, x, tolerance);
    EXPECT_NEAR(2 * double(pixel[1]) - 1, y, tolerance);
    EXPECT_NEAR(2 * double(pixel[2]) - 1, z, tolerance);
}

constexpr double kRounding = 1e-6; // of floats

// Two triangles that share an edge, without symmetry: u grows along 2 x, v along -3 y. No triangle uses vertex 4.
struct TwoTriangles {
    std::vector<float> positions{0, 0, 0, 2, 0, 0, 2, 3, 0, 0, 3, 0, 9, 9, 9};
    std::vector<float> normals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    std::vector<float> texcoords{0, 1, 1, 1, 1, 0, 0, 0, 0.5f, 0.5f};
    std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
    cotan_mesh mesh() const
    {
        return {sizeof(cotan_mesh), 5, positions.data(), normals.data(), texcoords.data(), 6, indices.data(), nullptr};
    }
};

} // namespace

TEST(CBuffers, tangentsHaveFourFloatsPerIndex)
{
    const TwoTriangles two;
    const cotan_mesh mesh = two.mesh();
    for (const char* kind : {"mikktspace", "vertex"}) {
        Guarded<float> tangents(4 * mesh.index_count);
        ASSERT_EQ(cotan_tangents(kind, &mesh, 1, tangents.data(), message, sizeof message), COTAN_OK) << message;
        for (std::size_t i = 0; i < mesh.index_count; ++i) {
            EXPECT_NEAR(tangents[4 * i], 1, kRounding);
            EXPECT_NEAR(tangents[4 * i + 1], 0, kRounding);
            EXPECT_NEAR(tangents[4 * i + 2], 0, kRounding);
            EXPECT_EQ(tangents[4 * i + 3], 1); // cross(n, t) = +y, towards smaller v
        }
    }
    Guarded<float> tangents(4 * mesh.index_count);
    EXPECT_EQ(cotan_tangents("tangent", &mesh, 1, tangents.data(), message, sizeof message), COTAN_USAGE);
    EXPECT_TRUE(tangents.untouched());
}

// Two triangles at the origin whose directions of u are opposite, and one without area in uv between them, which is
// averaged with both (the mesh of MikktspaceTangents.equalThoseOfMikktspaceWithoutADirection).
TEST(CBuffers, onlyMikktspaceTangentsAreZeroWhereDirectionsCancel)
{
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0.5f, 0.9f, 0, -0.5f, 0.9f, 0, -1, 0, 0};
    const std::vector<float> normals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    const std::vector<float> texcoords{0, 0, 1, 0, 0, -1, 0, 1, 1, 0};
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3, 0, 3, 4};
    const cotan_mesh mesh{sizeof(cotan_mesh), 5, positions.data(), normals.data(),
                          texcoords.data(),   9, indices.data(),   nullptr};
    for (const bool mikktspace : {true, false}) {
        Guarded<float> tangents(4 * mesh.index_count);
        ASSERT_EQ(
            cotan_tangents(mikktspace ? "mikktspace" : "vertex", &mesh, 1, tangents.data(), message, sizeof message),
            COTAN_OK)
            << message;
        int zeros = 0;
        for (std::size_t i = 0; i < mesh.index_count; ++i) {
            const float* t = tangents.data() + 4 * i;
            const float length = std::hypot(t[0], t[1], t[2]);
            EXPECT_TRUE(length == 0 || std::abs(length - 1) < kRounding) << i;
            EXPECT_EQ(std::abs(t[3]), 1);
            zeros += length == 0;
        }
        EXPECT_EQ(zeros, mikktspace ? 1 : 0);
        EXPECT_EQ(tangents[4 * 3] == 0 && tangents[4 * 3 + 3] == 1, mikktspace) << "at the corner of the flat triangle";
    }
}

TEST(CBuffers, outOfRangeIndicesAndIncompleteTrianglesAreRefused)
{
    TwoTriangles two;
    Guarded<float> out(4 * 6);
    cotan_mesh mesh = two.mesh();
    mesh.index_count = 5;
    EXPECT_EQ(cotan_tangents("mikktspace", &mesh, 1, out.data(), message, sizeof message), COTAN_USAGE) << message;
    two.indices[5] = 5; // equal to the number of vertices
    mesh = two.mesh();
    EXPECT_EQ(cotan_tangents("mikktspace", &mesh, 1, out.data(), message, sizeof message), COTAN_INPUT) << message;
    EXPECT_NE(std::strstr(message, "indices[5]"), nullptr) << message;
    two.indices[5] = 4;
    two.positions[13] = std::numeric_limits<float>::infinity();
    mesh = two.mesh();
    EXPECT_EQ(cotan_tangents("mikktspace", &mesh, 1, out.data(), message, sizeof message), COTAN_INPUT) << message;
    EXPECT_NE(std::strstr(message, "positions[4]"), nullptr) << message;
    EXPECT_TRUE(out.untouched());
}

TEST(CBuffers, cotangentsHaveThreeFloatsPerVertex)
{
    const TwoTriangles two;
    const cotan_mesh mesh = two.mesh();
    Guarded<float> u(3 * 5), v(3 * 5);
    ASSERT_EQ(cotan_smooth_cotangents(&mesh, u.data(), v.data(), message, sizeof message), COTAN_OK) << message;
    for (std::size_t i = 0; i < 4; ++i) { // u grows by 1 over 2 units, v falls by 1 over 3: |u| / |v| is 3 / 2
        EXPECT_GT(u[3 * i], 0);
        EXPECT_GT(-v[3 * i + 1], 0);
        EXPECT_NEAR(u[3 * i] / -v[3 * i + 1], 1.5f, 1e-5);
        EXPECT_NEAR(u[3 * i + 1], 0, kRounding);
        EXPECT_NEAR(v[3 * i], 0, kRounding);
    }
}

TEST(CBuffers, triangleVectorsHaveOneFloatPerIndexAndPackIntoThreeWords)
{
    const TwoTriangles two;
    const cotan_mesh mesh = two.mesh();
    Guarded<float> u(mesh.index_count), v(mesh.index_count);
    ASSERT_EQ(cotan_triangle_vectors(&mesh, 1, u.data(), v.data(), message, sizeof message), COTAN_OK) << message;
    for (std::size_t t = 0; t < 2; ++t) { // cross(n, u) points along u of the texture, cross(n, v) along its v
        EXPECT_GT(-u[3 * t + 1], 0);
        EXPECT_NEAR(-u[3 * t + 1] / -v[3 * t], 1.5f, 1e-5);
        for (const float none : {u[3 * t], u[3 * t + 2], v[3 * t + 1], v[3 * t + 2]})
            EXPECT_NEAR(none, 0, kRounding);
    }
    Guarded<std::uint32_t> words(3 * 2);
    ASSERT_EQ(cotan_pack_triangles(2, u.data(), v.data(), words.data(), message, sizeof message), COTAN_OK) << message;
    const auto half = [&](std::size_t i) { // treats -0 as 0
        const std::uint32_t h = words[i / 2] >> (16 * (i % 2)) & 0xffff;
        return h == 0x8000 ? 0 : h;
    };
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_EQ(half(i), half(6 + i)) << i; // both triangles have the same vectors
    EXPECT_NE(half(1), 0u);                   // u.y
    EXPECT_NE(half(3), 0u);                   // v.x
}

TEST(CBuffers, packedCotangentsAndTangentsHaveTheirSizes)
{
    const std::vector<float> normals{0, 0, 1, 0, 1, 0, 1, 0, 0}, u{1, 0, 0, 2, 0, 0, 0, 3, 0},
        v{0, -1, 0, 0, 0, -2, 0, 0, 1};
    Guarded<std::int16_t> eight(4 * 3);
    Guarded<std::uint32_t> four(3);
    ASSERT_EQ(cotan_pack_smooth8(3, normals.data(), u.data(), v.data(), eight.data(), message, sizeof message),
              COTAN_OK);
    ASSERT_EQ(cotan_pack_smooth4(3, normals.data(), u.data(), v.data(), four.data(), message, sizeof message),
              COTAN_OK);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NE(four[i], 77u);
    const std::vector<float> tangents{1, 0, 0, 1, 1, 0, 0, -1, 0, 1, 0, 1};
    Guarded<std::uint16_t> two(3);
    ASSERT_EQ(cotan_pack_tangents(3, normals.data(), tangents.data(), two.data(), message, sizeof message), COTAN_OK);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NE(two[i], 77u);
}

// The corners at the shared edge differ in w: its two vertices are copied, the others are not.
TEST(CBuffers, splitVerticesFillsIndicesAndTheReportedNumberOfSources)
{
    const TwoTriangles two;
    std::vector<float> corners;
    for (const float w : {1.0f, 1.0f, 1.0f, -1.0f, -1.0f, -1.0f})
        corners.insert(corners.end(), {1, 0, 0, w});
    Guarded<std::uint32_t> indices(6), sources(5 + 6);
    std::size_t count = 0;
    ASSERT_EQ(cotan_split_vertices(5, 6, two.indices.data(), corners.data(), indices.data(), sources.data(), &count,
                                   message, sizeof message),
              COTAN_OK);
    ASSERT_EQ(count, 7u);
    for (std::uint32_t i = 0; i < 5; ++i)
        EXPECT_EQ(sources[i], i); // the original vertices come first
    std::array<int, 5> used{};
    for (std::size_t i = 0; i < 6; ++i) {
        ASSERT_LT(indices[i], count);
        EXPECT_EQ(sources[indices[i]], two.indices[i]);
        ++used[sources[indices[i]]];
    }
    EXPECT_NE(indices[0], indices[3]);
    EXPECT_NE(indices[2], indices[4]);
    EXPECT_EQ(used, (std::array<int, 5>{2, 1, 2, 1, 0}));
    EXPECT_EQ(sources[7], 77u) << "beyond the count";
}

TEST(CBuffers, provokingNumbersTrianglesByTheirFirstOrLastCorner)
{
    const TwoTriangles two;
    for (const int last : {0, 1}) {
        Guarded<std::uint32_t> indices(6), sources(5 + 6), corners(6);
        std::size_t count = 0;
        ASSERT_EQ(cotan_provoking(5, 6, two.indices.data(), last, indices.data(), sources.data(), &count,
                                  corners.data(), message, sizeof message),
                  COTAN_OK)
            << message;
        for (std::uint32_t t = 0; t < 2; ++t) {
            EXPECT_EQ(indices[3 * t + (last != 0 ? 2 : 0)], t);
            EXPECT_EQ(corners[3 * t], sources[t]) << "the provoking corner comes first";
            for (std::uint32_t k = 0; k < 3; ++k)
                ASSERT_LT(indices[3 * t + k], count);
        }
    }
}

TEST(CBuffers, framesFillThreeFloatsPerSample)
{
    const std::vector<float> normals{0, 0, 1, 0, 1, 0}, dpdx{1, 0, 0, 1, 0, 0}, dpdy{0, 1, 0, 0, 0, -1};
    const std::vector<float> duvdx{1, 0, 1, 0}, duvdy{0, 1, 0, 1}, texels{0.6f, 0, 0.8f, 0, 0.6f, 0.8f};
    cotan_surface_points points = {sizeof points, 2,           normals.data(), dpdx.data(), dpdy.data(),
                                   duvdx.data(),  duvdy.data()};
    Guarded<float> out(6), back(6);
    ASSERT_EQ(cotan_frame_apply("orthonormal", &points, texels.data(), out.data(), message, sizeof message), COTAN_OK);
    const std::array<float, 6> expected{0.6f, 0, 0.8f, 0, 0.8f, -0.6f}; // u along x; v along y, then along -z
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_NEAR(out[i], expected[i], kRounding) << i;
    ASSERT_EQ(cotan_frame_encode("orthonormal", &points, out.data(), back.data(), message, sizeof message), COTAN_OK);
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_NEAR(back[i], texels[i], kRounding) << i;
    points.count = 0;
    Guarded<float> none(6);
    EXPECT_EQ(cotan_frame_apply("orthonormal", &points, texels.data(), none.data(), message, sizeof message), COTAN_OK);
    EXPECT_EQ(cotan_frame_encode("orthonormal", &points, texels.data(), none.data(), message, sizeof message),
              COTAN_OK);
    EXPECT_TRUE(none.untouched());
    const cotan_surface_points nowhere = {sizeof nowhere, 0, nullptr, nullptr, nullptr, nullptr, nullptr};
    EXPECT_EQ(cotan_frame_apply("orthonormal", &nowhere, texels.data(), none.data(), message, sizeof message), COTAN_OK)
        << message;
    EXPECT_EQ(cotan_frame_encode("orthonormal", &nowhere, texels.data(), none.data(), message, sizeof message),
              COTAN_OK)
        << message;
    cotan_surface_points lacking = nowhere;
    lacking.count = 1;
    EXPECT_EQ(cotan_frame_apply("orthonormal", &lacking, texels.data(), none.data(), message, sizeof message),
              COTAN_USAGE);
}

TEST(CBuffers, namesOfFramesEndWithTheirCount)
{
    const int count = cotan_frame_count();
    ASSERT_GT(count, 10);
    EXPECT_STREQ(cotan_frame_name(0), "cotangent");
    EXPECT_NE(cotan_frame_name(count - 1), nullptr);
    EXPECT_EQ(cotan_frame_name(count), nullptr);
    EXPECT_EQ(cotan_frame_name(-1), nullptr);
}

TEST(CBuffers, mapsAreConvertedWithinTheirBufferAndDirectXFlipsOnlyGreen)
{
    constexpr int kWidth = 5, kHeight = 3;
    const auto pixels = filled(kWidth, kHeight, {stored(0.6), stored(0.48), stored(0.64)});
    cotan_image_view map = pictureOf(const_cast<float*>(pixels.data()), kWidth, kHeight);
    Guarded<float> floats(4 * kWidth * kHeight);
    cotan_image_view out = pictureOf(floats.data(), kWidth, kHeight);
    ASSERT_EQ(cotan_map_convert(&map, "opengl", "directx", &out, message, sizeof message), COTAN_OK) << message;
    for (int i = 0; i < kWidth * kHeight; ++i)
        expectPixel(floats.data() + 4 * i, 0.6, -0.48, 0.64, kRounding);
    Guarded<std::uint8_t> bytes(4 * kWidth * kHeight);
    out = pictureOf(bytes.data(), kWidth, kHeight);
    ASSERT_EQ(cotan_map_convert(&map, "opengl", "opengl", &out, message, sizeof message), COTAN_OK) << message;
    for (std::size_t i = 0; i < std::size_t(kWidth * kHeight); ++i) {
        EXPECT_NEAR(bytes[4 * i], 128 + 0.6 * 127, 1); // zero is 128, one is 255
        EXPECT_NEAR(bytes[4 * i + 1], 128 + 0.48 * 127, 1);
        EXPECT_NEAR(bytes[4 * i + 2], 128 + 0.64 * 127, 1);
        EXPECT_EQ(bytes[4 * i + 3], 255);
    }
}

// The slopes of two waves, of heights 0.3 and 0.17 by their number; green down: about 128, the exact zero, or 127.5.
TEST(CBuffers, autoFindsHowAMapIsStored)
{
    constexpr int kSide = 128;
    constexpr std::size_t kBytes = 4 * kSide * kSide;
    const auto relief = [](bool greenUp, double zero) {
        std::vector<std::uint8_t> map(kBytes, 255);
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const double a = std::cos((3 * x - 5 * y) * 2 * std::numbers::pi / kSide + 1),
                             b = std::cos((7 * x + 2 * y) * 2 * std::numbers::pi / kSide);
                const double nx = -0.9 * a - 1.19 * b, ny = 1.5 * a - 0.34 * b, length = std::hypot(nx, ny, 1);
                std::uint8_t* const texel = map.data() + 4 * (std::size_t(y) * kSide + std::size_t(x));
                const double unit[] = {nx / length, (greenUp ? -ny : ny) / length, 1 / length};
                for (int c = 0; c < 3; ++c)
                    texel[c] = std::uint8_t(std::lround(zero + unit[c] * (zero == 128 ? 127 : 127.5)));
            }
        return map;
    };
    const auto converted = [&](std::vector<std::uint8_t> pixels, const char* from, const char* to) {
        const cotan_image_view map = pictureOf(pixels.data(), kSide, kSide);
        Guarded<std::uint8_t> bytes(kBytes);
        cotan_image_view out = pictureOf(bytes.data(), kSide, kSide);
        EXPECT_EQ(cotan_map_convert(&map, from, to, &out, message, sizeof message), COTAN_OK) << message;
        return std::vector<std::uint8_t>(bytes.data(), bytes.data() + kBytes);
    };
    const auto up = relief(true, 128), down = relief(false, 128), biased = relief(false, 127.5);
    EXPECT_EQ(converted(up, "auto", "opengl"), up);
    EXPECT_EQ(converted(down, "auto", "opengl"), converted(down, "directx", "opengl"));
    EXPECT_NE(converted(down, "auto", "opengl"), down);
    // A zero of 127.5 stays, unless the words name another.
    EXPECT_EQ(converted(biased, "auto", "opengl"), converted(biased, "directx,biased", "opengl,biased"));
    EXPECT_EQ(converted(biased, "auto", "opengl,exact"), converted(biased, "directx,biased", "opengl,exact"));
    for (std::vector<std::uint8_t> pixels : {up, down}) {
        const cotan_image_view map = pictureOf(pixels.data(), kSide, kSide);
        std::vector<float> found(kSide * kSide), stated(found);
        const char* const words = pixels == up ? "gltf,exact" : "gltf,exact,green-down";
        ASSERT_EQ(cotan_map_to_height(&map, "auto", found.data(), message, sizeof message), COTAN_OK) << message;
        ASSERT_EQ(cotan_map_to_height(&map, words, stated.data(), message, sizeof message), COTAN_OK) << message;
        EXPECT_EQ(found, stated);
        cotan_texture_options options{};
        options.size = sizeof options;
        std::string files[2];
        for (int i = 0; i < 2; ++i) {
            options.from = i == 0 ? "auto" : words;
            cotan_bytes* made = nullptr;
            ASSERT_EQ(cotan_map_texture(&map, &options, nullptr, &made, message, sizeof message), COTAN_OK) << message;
            files[i].assign(static_cast<const char*>(cotan_bytes_data(made)), cotan_bytes_size(made));
            cotan_bytes_free(made);
        }
        EXPECT_TRUE(files[0] == files[1]);
    }
    std::vector<std::uint8_t> flat(kBytes, 128);
    const cotan_image_view map = pictureOf(flat.data(), kSide, kSide);
    cotan_image_view out = map;
    EXPECT_EQ(cotan_map_convert(&map, "auto", "opengl", &out, message, sizeof message), COTAN_INPUT);
    EXPECT_NE(std::string(message).find("from: auto: expected a normal map whose green can be told"), std::string::npos)
        << message;
}

TEST(CBuffers, imagesOfWrongSizeOrDepthAreRefused)
{
    const auto pixels = filled(5, 3, {0.5f, 0.5f, 1});
    cotan_image_view map = pictureOf(const_cast<float*>(pixels.data()), 5, 3);
    Guarded<float> floats(4 * 6 * 4);
    for (const auto& [width, height] : {std::pair{5, 4}, {4, 3}, {6, 3}, {5, 2}, {3, 5}}) {
        cotan_image_view out = pictureOf(floats.data(), width, height);
        EXPECT_EQ(cotan_map_convert(&map, "gltf", "gltf", &out, message, sizeof message), COTAN_USAGE)
            << width << height;
        EXPECT_EQ(cotan_map_from_height(&map, 1, 1, "gltf", &out, message, sizeof message), COTAN_USAGE);
        EXPECT_EQ(cotan_map_blend(&map, &map, "gltf", "udn", 1, &out, message, sizeof message), COTAN_USAGE);
    }
    cotan_green green = {};
    green.size = sizeof green;
    for (const auto& [width, height] : {std::pair{0, 3}, {5, 0}, {-1, 3}, {65537, 1}, {1, 65537}}) {
        cotan_image_view wrong = pictureOf(floats.data(), width, height);
        EXPECT_EQ(cotan_map_green(&wrong, &green, message, sizeof message), COTAN_USAGE) << width << " " << height;
    }
    for (const int bits : {0, 7, 9, 15, 24, 64}) {
        cotan_image_view wrong = map;
        wrong.bits = bits;
        EXPECT_EQ(cotan_map_green(&wrong, &green, message, sizeof message), COTAN_USAGE) << bits;
    }
    std::vector<std::uint8_t> row(4 * 65536, 128);
    for (const auto& [width, height] : {std::pair{65536, 1}, {1, 65536}}) {
        cotan_image_view longest = pictureOf(row.data(), width, height);
        EXPECT_EQ(cotan_map_green(&longest, &green, message, sizeof message), COTAN_OK) << message;
    }
    EXPECT_TRUE(floats.untouched());
}

// Four domes in a row, two in a column. On round domes, exchanging red and green only mirrors the domes about their
// diagonal.
TEST(CBuffers, greenDetectionFillsEveryNumber)
{
    constexpr int kSide = 32;
    for (const int up : {1, -1}) {
        std::vector<float> pixels;
        for (int y = 0; y < 2 * kSide; ++y)
            for (int x = 0; x < 4 * kSide; ++x) {
                const double dx = (x % kSide + 0.5) / kSide * 2 - 1, dy = 1 - (y % kSide + 0.5) / kSide * 2;
                const double inside = dx * dx + dy * dy < 0.8 ? 0.7 : 0, nx = inside * dx, ny = inside * dy * up;
                pixels.insert(pixels.end(), {stored(nx), stored(ny), stored(std::sqrt(1 - nx * nx - ny * ny)), 1});
            }
        cotan_image_view map = pictureOf(pixels.data(), 4 * kSide, 2 * kSide);
        cotan_green green = {};
        green.size = sizeof green;
        ASSERT_EQ(cotan_map_green(&map, &green, message, sizeof message), COTAN_OK) << message;
        EXPECT_EQ(green.direction, up) << green.reason;
        EXPECT_EQ(green.swapped, -1);
        EXPECT_EQ(green.confidence, 2);
        EXPECT_GT(green.agreement * up, 0.5); // correlation of green with what red implies: signed
        EXPECT_LE(std::abs(green.agreement), 1);
        EXPECT_GT(std::strlen(green.reason), 10u);
    }
}

TEST(CBuffers, mapInfoFillsEveryNumber)
{
    std::vector<float> pixels = filled(8, 5, {stored(0.6), stored(0.2), stored(std::sqrt(1 - 0.36 - 0.04))});
    for (int i = 0; i < 8; ++i) // the last row is below the horizon
        pixels[std::size_t(4 * (32 + i) + 2)] = stored(-std::sqrt(1 - 0.36 - 0.04));
    pixels[0] = std::numeric_limits<float>::quiet_NaN();
    cotan_image_view map = pictureOf(pixels.data(), 8, 5);
    cotan_map_info info = {};
    info.size = sizeof info;
    ASSERT_EQ(cotan_map_describe(&map, &info, message, sizeof message), COTAN_OK) << message;
    EXPECT_NEAR(info.invalid, 1.0 / 40, 1e-9);
    EXPECT_NEAR(info.below_horizon, 8.0 / 39, 1.0 / 39 / 40 * 8); // as a fraction of all texels or of the valid ones
    EXPECT_NEAR(info.mean_length, 1, 1e-5);
    EXPECT_NEAR(info.mean[0], 0.6, 1e-5);
    EXPECT_NEAR(info.mean[1], 0.2, 1e-5);
    const double z = std::sqrt(0.6);
    EXPECT_NEAR(info.mean[2], z * (31.0 - 8) / 39, 1e-5);
    const double tilt = std::acos(z) * 180 / std::numbers::pi;
    EXPECT_NEAR(info.mean_tilt, (31 * tilt + 8 * (180 - tilt)) / 39, 1e-3);
    EXPECT_EQ(info.background, 0);
    EXPECT_EQ(info.srgb, 0);
    EXPECT_GT(std::strlen(info.content), 3u);
}

// A ramp whose stored height rises by 0.1 per texel along x and falls by 0.05 along y.
TEST(CBuffers, slopesOfHeightsHaveAFactorForEachAxis)
{
    constexpr int kWidth = 7, kHeight = 6;
    std::vector<float> pixels;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            pixels.insert(pixels.end(), {0.1f * float(x) - 0.05f * float(y), 9, 9, 1}); // only red is read
    cotan_image_view height = pictureOf(pixels.data(), kWidth, kHeight);
    Guarded<float> made(4 * kWidth * kHeight);
    cotan_image_view map = pictureOf(made.data(), kWidth, kHeight);
    ASSERT_EQ(cotan_map_from_height(&height, 2, 3, "gltf", &map, message, sizeof message), COTAN_OK) << message;
    const double sx = -2 * 0.1, sy = -3 * 0.05, length = std::sqrt(1 + sx * sx + sy * sy); // rises up the image
    for (int y = 1; y + 1 < kHeight; ++y) // heights wrap around at the borders
        for (int x = 1; x + 1 < kWidth; ++x)
            expectPixel(made.data() + 4 * (y * kWidth + x), sx / length, sy / length, 1 / length, 1e-5);
    for (const double bad : {double(NAN), double(INFINITY)}) {
        EXPECT_EQ(cotan_map_from_height(&height, bad, 1, "gltf", &map, message, sizeof message), COTAN_USAGE);
        EXPECT_EQ(cotan_map_from_height(&height, 1, bad, "gltf", &map, message, sizeof message), COTAN_USAGE);
    }
}

TEST(CBuffers, heightsHaveOneFloatPerTexelAndMeanZero)
{
    constexpr int kWidth = 6, kHeight = 4;
    std::vector<float> pixels;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const double slope = 0.3 * std::sin(2 * std::numbers::pi * (x + 0.5) / kWidth);
            pixels.insert(pixels.end(), {stored(slope), stored(0), stored(std::sqrt(1 - slope * slope)), 1});
        }
    cotan_image_view map = pictureOf(pixels.data(), kWidth, kHeight);
    Guarded<float> heights(kWidth * kHeight);
    ASSERT_EQ(cotan_map_to_height(&map, "gltf", heights.data(), message, sizeof message), COTAN_OK) << message;
    double sum = 0, differing = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            sum += double(heights[std::size_t(y * kWidth + x)]);
            differing =
                std::max(differing, std::abs(double(heights[std::size_t(y * kWidth + x)] - heights[std::size_t(x)])));
        }
    EXPECT_NEAR(sum, 0, 1e-5);
    EXPECT_LT(differing, 1e-5);        // all rows are equal
    EXPECT_GT(heights[0], heights[3]); // normals point to +x first, so the height falls there
}

// In the mode "slopes" the slopes add up, those of the detail multiplied by its strength.
TEST(CBuffers, detailIsBlendedOverTheBaseWithItsStrength)
{
    const auto leaning = [](double x, double y) {
        const double z = 1 / std::sqrt(1 + x * x + y * y);
        return filled(3, 2, {stored(x * z), stored(y * z), stored(z)});
    };
    auto base = leaning(0.3, 0.1), detail = leaning(0, 0.2);
    const cotan_image_view under = pictureOf(base.data(), 3, 2), over = pictureOf(detail.data(), 3, 2);
    for (const double strength : {0.0, 0.5, 2.0}) {
        Guarded<float> made(4 * 3 * 2);
        cotan_image_view map = pictureOf(made.data(), 3, 2);
        ASSERT_EQ(cotan_map_blend(&under, &over, "gltf", "slopes", strength, &map, message, sizeof message), COTAN_OK)
            << message;
        const double sy = 0.1 + strength * 0.2, z = 1 / std::sqrt(1 + 0.09 + sy * sy);
        for (int i = 0; i < 6; ++i)
            expectPixel(made.data() + 4 * i, 0.3 * z, sy * z, z, 1e-5);
    }
    Guarded<float> made(4 * 3 * 2);
    cotan_image_view map = pictureOf(made.data(), 3, 2);
    EXPECT_EQ(cotan_map_blend(&under, &over, "gltf", "slope", 1, &map, message, sizeof message), COTAN_USAGE);
    EXPECT_EQ(cotan_map_blend(&under, &over, "gltf", "slopes", NAN, &map, message, sizeof message), COTAN_USAGE);
    EXPECT_TRUE(made.untouched());
}

TEST(CBuffers, levelsHalveEachSideAndANonzeroReturnStops)
{
    auto pixels = filled(12, 5, {0.5f, 0.5f, 1});
    const cotan_image_view map = pictureOf(pixels.data(), 12, 5);
    struct Seen {
        std::vector<std::array<int, 5>> levels;
        int stopAt = -1;
    } seen;
    const auto take = [](void* user, int level, const cotan_image_view* normals, const cotan_image_view* rough) {
        Seen& s = *static_cast<Seen*>(user);
        s.levels.push_back({level, normals->width, normals->height, rough->width, rough->height});
        EXPECT_NEAR(static_cast<const float*>(rough->pixels)[0], 0.25, 0.01);
        return level == s.stopAt ? 1 : 0;
    };
    ASSERT_EQ(cotan_map_mips(&map, "gltf", 0.25, take, &seen, message, sizeof message), COTAN_OK) << message;
    ASSERT_EQ(seen.levels.size(), 4u);
    for (int i = 0; i < 4; ++i) {
        const int width = std::max(1, 12 >> i), height = std::max(1, 5 >> i);
        EXPECT_EQ(seen.levels[std::size_t(i)], (std::array<int, 5>{i, width, height, width, height}));
    }
    seen = {{}, 1};
    EXPECT_EQ(cotan_map_mips(&map, "gltf", 0.25, take, &seen, message, sizeof message), COTAN_STOPPED);
    EXPECT_EQ(seen.levels.size(), 2u);
    for (const double bad : {-0.01, 1.01, double(NAN)})
        EXPECT_EQ(cotan_map_mips(&map, "gltf", bad, take, &seen, message, sizeof message), COTAN_USAGE) << bad;
}

TEST(CBuffers, shaderTextFillsOnlyASufficientBuffer)
{
    std::size_t size = 0;
    ASSERT_EQ(cotan_shader_text("glsl", "orthonormal", "gltf", nullptr, &size, message, sizeof message), COTAN_OK);
    ASSERT_GT(size, 100u);
    const std::size_t needed = size;
    Guarded<char> exact(needed), small(needed);
    ASSERT_EQ(cotan_shader_text("glsl", "orthonormal", "gltf", exact.data(), &size, message, sizeof message), COTAN_OK);
    EXPECT_EQ(size, needed);
    EXPECT_EQ(std::strlen(exact.data()) + 1, needed);
    size = needed - 1;
    EXPECT_EQ(cotan_shader_text("glsl", "orthonormal", "gltf", small.data(), &size, message, sizeof message), COTAN_OK);
    EXPECT_EQ(size, needed);
    EXPECT_TRUE(small.untouched());
}

// Callers built with another version have only the fields of the first version, or some unknown to this library.
TEST(CBuffers, resultsAreWrittenUpToTheStatedAndKnownSize)
{
    constexpr std::size_t kWord = sizeof(std::uint64_t), kMore = 16;
    const float positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, uvs[] = {0, 1, 1, 1, 1, 0, 0, 0};
    const float normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    const std::uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    const cotan_mesh mesh = {sizeof(cotan_mesh), 4, positions, normals, uvs, 6, indices, nullptr};
    Guarded<std::uint8_t> pixels(8 * 8 * 4);
    cotan_image_view map = pictureOf(pixels.data(), 8, 8);
    for (const std::size_t size :
         {offsetof(cotan_bake_result, further), sizeof(cotan_bake_result), sizeof(cotan_bake_result) + kMore}) {
        Guarded<std::uint64_t> words((sizeof(cotan_bake_result) + kMore) / kWord);
        auto* const result = reinterpret_cast<cotan_bake_result*>(words.data());
        result->size = size;
        const cotan_status baked = cotan_bake(&mesh, &mesh, nullptr, &map, result, message, sizeof message);
        if (baked == COTAN_UNAVAILABLE)
            GTEST_SKIP() << message;
        ASSERT_EQ(baked, COTAN_OK) << message;
        EXPECT_EQ(result->size, size);
        EXPECT_EQ(result->covered, 64u);
        EXPECT_EQ(result->missed, 0u);
        EXPECT_GT(result->ray_distance, 0);
        const std::size_t written = std::min(size, sizeof(cotan_bake_result)) / kWord;
        EXPECT_NE(words[written - 1], 77u) << "the last that it has";
        for (std::size_t i = written; i < (sizeof(cotan_bake_result) + kMore) / kWord; ++i)
            EXPECT_EQ(words[i], 77u) << size << ": word " << i;
    }
    const auto longer = [&](auto kind, const auto& work) {
        using Result = decltype(kind);
        Guarded<std::uint64_t> words((sizeof(Result) + kMore) / kWord);
        auto* const result = reinterpret_cast<Result*>(words.data());
        result->size = sizeof(Result) + kMore;
        EXPECT_EQ(work(result), COTAN_OK) << message;
        for (std::size_t i = sizeof(Result) / kWord; i < (sizeof(Result) + kMore) / kWord; ++i)
            EXPECT_EQ(words[i], 77u) << "word " << i;
    };
    longer(cotan_green{}, [&](auto* green) { return cotan_map_green(&map, green, message, sizeof message); });
    longer(cotan_map_info{}, [&](auto* info) { return cotan_map_describe(&map, info, message, sizeof message); });
}

TEST(CBuffers, messagesAreTruncatedToTheirBuffer)
{
    for (const std::size_t size : {std::size_t(1), std::size_t(2), std::size_t(10)}) {
        Guarded<char> text(size);
        EXPECT_EQ(cotan_frame_apply("nothing", nullptr, nullptr, nullptr, text.data(), size), COTAN_USAGE);
        EXPECT_EQ(text[size - 1], '\0');
        EXPECT_EQ(std::strlen(text.data()), size - 1);
    }
    EXPECT_EQ(cotan_frame_apply("nothing", nullptr, nullptr, nullptr, nullptr, 0), COTAN_USAGE);
}
