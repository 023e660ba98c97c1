// The array functions of cotan.h in a stand-alone program, which c_api.cmake runs and core_32bit.cmake builds where
// size_t has 32 bits. Returns the number of facts that do not hold.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

#include "cotan.h"

namespace {

int failures = 0;
char message[256];

void expect(bool fact, const char* what)
{
    if (!fact)
        std::printf("does not hold: %s (%s)\n", what, message);
    failures += !fact;
}

bool near(const float* a, float x, float y, float z)
{
    return std::abs(a[0] - x) < 1e-5f && std::abs(a[1] - y) < 1e-5f && std::abs(a[2] - z) < 1e-5f;
}

// A square grid in z = 0; u grows along -x, and v along -y as in images.
struct Grid {
    std::vector<float> positions, normals, uv;
    std::vector<std::uint32_t> indices;

    explicit Grid(std::uint32_t side)
    {
        for (std::uint32_t y = 0; y <= side; ++y)
            for (std::uint32_t x = 0; x <= side; ++x) {
                const float u = float(x) / float(side), v = float(y) / float(side);
                positions.insert(positions.end(), {u, v, 0});
                normals.insert(normals.end(), {0, 0, 1});
                uv.insert(uv.end(), {1 - u, 1 - v});
            }
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                const std::uint32_t a = y * (side + 1) + x, b = a + 1, c = a + side + 1, d = c + 1;
                indices.insert(indices.end(), {a, b, c, b, d, c});
            }
    }

    cotan_mesh mesh() const
    {
        return {sizeof(cotan_mesh), positions.size() / 3, positions.data(), normals.data(),
                uv.data(),          indices.size(),       indices.data(),   nullptr};
    }
};

void tangentsAndWhatTheyMake()
{
    const Grid grid(200);
    const cotan_mesh mesh = grid.mesh();
    for (const char* kind : {"mikktspace", "vertex"}) {
        std::vector<float> tangents(4 * mesh.index_count);
        expect(cotan_tangents(kind, &mesh, 3, tangents.data(), message, sizeof message) == COTAN_OK, kind);
        bool right = true;
        for (std::size_t i = 0; i < mesh.index_count; ++i)
            right = right && near(&tangents[4 * i], -1, 0, 0)
                && tangents[4 * i + 3] == -1; // cross(n, t) = -y, and v falls with y
        expect(right, "every corner of a mirrored plane");
        const float normal[] = {0, 0, 2}, texel[] = {0.6f, 0, 0.8f};
        const cotan_interpolated_points point = {sizeof point, 1, normal, tangents.data(), nullptr, nullptr};
        float out[3], back[3];
        expect(cotan_vertex_frame_apply(kind, &point, texel, out, message, sizeof message) == COTAN_OK, kind);
        if (std::strcmp(kind, "vertex") == 0) // mikktspace does not normalise the normal
            expect(near(out, -0.6f, 0, 0.8f), "a texel towards +u");
        expect(cotan_vertex_frame_encode(kind, &point, out, back, message, sizeof message) == COTAN_OK
                   && near(back, 0.6f, 0, 0.8f),
               "and back");
    }
    std::vector<float> u(3 * mesh.vertex_count), v(3 * mesh.vertex_count);
    expect(cotan_smooth_cotangents(&mesh, u.data(), v.data(), message, sizeof message) == COTAN_OK, "smooth");
    const float normal[] = {0, 0, 1}, texel[] = {0, 0.6f, 0.8f};
    const cotan_interpolated_points point = {sizeof point, 1, normal, nullptr, u.data(), v.data()};
    float out[3];
    expect(cotan_vertex_frame_apply("smooth", &point, texel, out, message, sizeof message) == COTAN_OK
               && near(out, 0, -0.6f, 0.8f),
           "a texel towards +v, which falls with y");
    expect(cotan_vertex_frame_apply("vertex", &point, texel, out, message, sizeof message) == COTAN_USAGE,
           "vertex wants tangents");
    expect(cotan_vertex_frame_apply("exact", &point, texel, out, message, sizeof message) == COTAN_USAGE,
           "exact is from differences");
}

void mapsOfAWave()
{
    const int side = 64;
    const double frequency = 2 * std::acos(-1.0) / side;
    std::vector<float> heights, pixels, again(side * side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            heights.push_back(float(std::sin(frequency * x) * std::cos(2 * frequency * y)));
            pixels.insert(pixels.end(), 4, heights.back());
        }
    std::vector<std::uint16_t> made(4 * side * side);
    const cotan_image_view picture = {sizeof picture, side, side, 32, pixels.data()};
    cotan_image_view map = {sizeof map, side, side, 16, made.data()};
    expect(cotan_map_from_height(&picture, 2, 2, "gltf", &map, message, sizeof message) == COTAN_OK, "from height");
    cotan_green green{};
    green.size = sizeof green;
    expect(cotan_map_green(&map, &green, message, sizeof message) == COTAN_OK && green.direction == 1,
           "green points up");
    cotan_map_info info{};
    info.size = sizeof info;
    expect(cotan_map_describe(&map, &info, message, sizeof message) == COTAN_OK
               && std::strcmp(info.content, "tangent space") == 0 && std::abs(info.mean_length - 1) < 1e-3
               && info.invalid == 0 && info.below_horizon == 0 && info.srgb == 0,
           "a map of tangent space");
    expect(cotan_map_to_height(&map, "gltf", again.data(), message, sizeof message) == COTAN_OK, "to height");
    double worst = 0;
    for (std::size_t i = 0; i < heights.size(); ++i)
        worst = std::max(worst, std::abs(double(again[i]) - 2 * double(heights[i])));
    expect(
        worst < 0.04,
        "the height again, but for what central differences take of a wave of 32 texels"); // 0.6 % of 2, and rounding
    int levels = 0;
    const auto count = [](void* user, int, const cotan_image_view*, const cotan_image_view*) {
        return ++*static_cast<int*>(user), 0;
    };
    expect(cotan_map_mips(&map, "gltf", 0.5, count, &levels, message, sizeof message) == COTAN_OK && levels == 7,
           "seven levels");
    expect(cotan_map_blend(&map, &map, "gltf", "udn", 0, &map, message, sizeof message) == COTAN_OK, "blend");
    if (sizeof(std::size_t) == 4) { // 65536 x 65536 x 4 wraps around to 0
        cotan_image_view large = {sizeof large, 65536, 65536, 8, made.data()};
        expect(cotan_map_green(&large, &green, message, sizeof message) == COTAN_UNAVAILABLE,
               "a picture larger than memory");
    }
}

} // namespace

int main()
{
    tangentsAndWhatTheyMake();
    mapsOfAWave();
    std::printf("size_t has %zu bits, %d facts of the C API do not hold\n", 8 * sizeof(std::size_t), failures);
    return failures;
}
