// Heights to normals and back, on reliefs with known slopes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "cotan/maps.hpp"
#include "cotan/scene.hpp"
#include "maps/texels.hpp"

namespace cotan::maps {
namespace {

constexpr Convention kSigned{.expansion = Expansion::signedValues};

template<class Height> Image heightImage(int width, int height, Height h)
{
    Image image = makeImage(width, height, PixelType::float32);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                image.floats()[4 * (y * width + x) + c] = float(h(x, y));
    return image;
}

// A float map from slopes per texel, rightwards and down the image.
template<class Slopes> Image normalImage(int width, int height, Slopes slopes)
{
    Image image = makeImage(width, height, PixelType::float32);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec2 s = slopes(x, y);
            const glm::vec3 n(glm::normalize(glm::dvec3(-s.x, s.y, 1)));
            std::copy_n(&n.x, 3, image.floats() + 4 * (y * width + x));
            image.floats()[4 * (y * width + x) + 3] = 1;
        }
    return image;
}

double largestAngle(const Image& a, const Image& b, int border)
{
    const auto degrees = anglesBetween(a, kSigned, b, kSigned);
    double largest = 0;
    for (int y = border; y < a.height - border; ++y)
        for (int x = border; x < a.width - border; ++x)
            largest = std::max(largest, double(degrees[std::size_t(y * a.width + x)]));
    return largest;
}

Image normals(const Image& height, Kernel kernel, Wrap wrap = Wrap::clamp, double scale = 1)
{
    std::size_t invalid = 0;
    return normalsFromHeight(
        height,
        {.kernel = kernel, .wrap = wrap, .scaleX = scale, .scaleY = scale, .to = kSigned, .type = PixelType::float32},
        invalid);
}

double bowl(int x, int y) { return 0.004 * x * x - 0.003 * y * y + 0.002 * x * y; }
glm::dvec2 bowlSlopes(double x, double y) { return {0.008 * x + 0.002 * y, -0.006 * y + 0.002 * x}; }

TEST(FromHeight, symmetric_kernels_are_exact_on_quadratics)
{
    const Image truth = normalImage(40, 30, [](int x, int y) { return bowlSlopes(x, y); });
    for (Kernel kernel : {Kernel::central, Kernel::sobel, Kernel::scharr})
        EXPECT_LT(largestAngle(normals(heightImage(40, 30, bowl), kernel), truth, 1), 1e-4); // float heights up to 6
}

TEST(FromHeight, the_forward_kernel_is_shifted_by_half_a_texel)
{
    // Forward differences measure half a texel to the right for x, half a texel up for y.
    const Image truth = normalImage(
        40, 30, [](int x, int y) { return glm::dvec2(bowlSlopes(x + 0.5, y).x, bowlSlopes(x, y - 0.5).y); });
    EXPECT_LT(largestAngle(normals(heightImage(40, 30, bowl), Kernel::forward), truth, 1), 1e-4);
}

TEST(FromHeight, borders_follow_the_wrap_mode)
{
    const Image ramp = heightImage(8, 8, [](int x, int) { return 0.5 * x; });
    const auto slopeAt = [](const Image& n, int x) {
        return -n.floats()[4 * (3 * 8 + x)] / n.floats()[4 * (3 * 8 + x) + 2];
    };
    EXPECT_NEAR(slopeAt(normals(ramp, Kernel::central, Wrap::clamp), 0), 0.25, 1e-6);  // one difference at half scale
    EXPECT_NEAR(slopeAt(normals(ramp, Kernel::central, Wrap::repeat), 0), -1.5, 1e-5); // (0.5 - 3.5)/2
    EXPECT_NEAR(slopeAt(normals(ramp, Kernel::central, Wrap::mirror), 0), 0.25, 1e-6); // the edge is its own neighbour
    EXPECT_NEAR(slopeAt(normals(ramp, Kernel::central, Wrap::mirror), 4), 0.5, 1e-6);
}

TEST(FromHeight, slopes_follow_width_and_range_in_metres)
{
    // 2 m across in 64 texels, white 0.5 m above black, black to white over 16 texels: 45 degrees.
    const Image ramp = heightImage(64, 8, [](int x, int) { return std::clamp((x - 24) / 16.0, 0.0, 1.0); });
    const Image n = normals(ramp, Kernel::central, Wrap::clamp, 0.5 * 64 / 2);
    EXPECT_NEAR(n.floats()[4 * 32], -std::sqrt(0.5), 1e-6);
}

TEST(FromHeight, non_finite_heights_become_flat)
{
    Image h = heightImage(5, 5, [](int x, int) { return 0.1 * x; });
    h.floats()[4 * 12] = std::numeric_limits<float>::quiet_NaN();
    std::size_t invalid = 0;
    const Image n = normalsFromHeight(h, {.to = kSigned, .type = PixelType::float32}, invalid);
    EXPECT_EQ(invalid, 4u); // its neighbours right, left, above, below
    for (std::size_t i = 0; i < n.pixelCount() * 4; ++i)
        EXPECT_TRUE(std::isfinite(n.floats()[i]));
}

// Maximum error of the heights, in texels, against a periodic relief without its mean.
double largestHeightError(const Heights& h, int width, int height, const std::function<double(double, double)>& truth)
{
    double mean = 0, largest = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            mean += truth(x, y) / (double(width) * height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            largest = std::max(largest, std::abs(double(h.texels[std::size_t(y * width + x)]) - (truth(x, y) - mean)));
    return largest;
}

TEST(ToHeight, smooth_periodic_reliefs_are_exact_for_any_size)
{
    // 64: radix 2; 60 and 45: chirp transforms, even and odd; 37: a prime.
    for (auto [width, height] : {std::pair(64, 64), {60, 45}, {37, 64}}) {
        const double w = width, h = height;
        // relief() is in uv units; along y the image covers h/w of a unit square's side.
        const auto sample = [=](double x, double y) { return relief(Relief::waves, (x + 0.5) / w, (y + 0.5) / h); };
        const Image map = normalImage(width, height, [&](int x, int y) {
            const HeightSample s = sample(x, y);
            return glm::dvec2(s.hu, s.hv * w / h);
        });
        const Heights solved = heightFromNormals(map, {.from = kSigned});
        // Slopes and the grid between transforms are floats: 1e-6 of heights of about 2 texels.
        EXPECT_LT(largestHeightError(solved, width, height, [&](double x, double y) { return sample(x, y).h * w; }),
                  2e-5);
        EXPECT_LT(solved.residual, 1e-5 * solved.slope);
    }
}

TEST(ToHeight, the_kernel_of_the_map_is_inverted)
{
    // Forward differences keep every frequency, so even white noise is restored. The others remove the highest ones:
    // waves of at most 5 periods in 24 texels are far below those.
    unsigned state = 7;
    const Image noise = heightImage(32, 24, [&](int, int) {
        state = state * 1664525u + 1013904223u;
        return double(state >> 8) / 16777216.0;
    });
    const Image waves =
        heightImage(32, 24, [](int x, int y) { return 10 * relief(Relief::waves, x / 32.0, y / 24.0).h; });
    for (Kernel kernel : {Kernel::forward, Kernel::central, Kernel::sobel, Kernel::scharr}) {
        const Image map = normals(kernel == Kernel::forward ? noise : waves, kernel, Wrap::repeat);
        const Heights solved = heightFromNormals(map, {.from = kSigned, .kernel = kernel});
        const Image again =
            normals(heightImage(32, 24, [&](int x, int y) { return solved.texels[std::size_t(y * 32 + x)]; }), kernel,
                    Wrap::repeat);
        EXPECT_LT(largestAngle(map, again, 0), 1e-3) << int(kernel); // float slopes and heights: 1e-6 radians
    }
}

TEST(ToHeight, free_borders_are_exact_on_quadratics)
{
    const Image map = normalImage(33, 20, [](int x, int y) { return bowlSlopes(x, y); });
    const Heights solved = heightFromNormals(map, {.from = kSigned, .boundary = Boundary::free});
    EXPECT_LT(largestHeightError(solved, 33, 20,
                                 [](double x, double y) { return 0.004 * x * x - 0.003 * y * y + 0.002 * x * y; }),
              1e-4);
    EXPECT_LT(solved.residual, 1e-5);
}

TEST(ToHeight, curl_is_reported_as_residual)
{
    // Slopes cos(x + y) along x only: half of the field is the gradient of a height, half is curl.
    const Image map = normalImage(64, 64, [](int x, int y) {
        const double k = 2 * 3.14159265358979 / 64;
        return glm::dvec2(0.3 * std::cos(k * (x + y)), 0.0);
    });
    const Heights solved = heightFromNormals(map, {.from = kSigned});
    EXPECT_NEAR(solved.residual / solved.slope, std::sqrt(0.5), 1e-4); // (1,0) projected onto (1,1)/sqrt 2
}

TEST(ToHeight, degenerate_images_give_finite_heights)
{
    for (auto [width, height] : {std::pair(1, 1), {7, 1}, {1, 6}, {2, 3}})
        for (Boundary boundary : {Boundary::periodic, Boundary::free}) {
            Image map = makeImage(width, height, PixelType::float32);
            std::fill_n(map.floats(), map.pixelCount() * 4, std::numeric_limits<float>::quiet_NaN());
            const Heights solved = heightFromNormals(map, {.from = kSigned, .boundary = boundary});
            EXPECT_EQ(solved.invalid, map.pixelCount());
            EXPECT_EQ(solved.lowest, 0);
            EXPECT_EQ(solved.highest, 0);
        }
}

} // namespace
} // namespace cotan::maps
