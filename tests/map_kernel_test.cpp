// Every kernel against its formula, every border against an image padded by hand, and the inverse of each kernel.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "cotan/maps.hpp"
#include "map_cases.hpp"

namespace cotan::maps {
namespace {

using namespace cases;

constexpr Kernel kKernels[] = {Kernel::forward, Kernel::central, Kernel::sobel, Kernel::scharr};

template<class Height> Image heights(int width, int height, Height h)
{
    return floatMap(width, height, [&](int x, int y) { return glm::vec3(float(h(x, y))); });
}

Image normals(const Image& height, Kernel kernel, Wrap wrap, double scaleX = 1, double scaleY = 1)
{
    std::size_t invalid = 0;
    return normalsFromHeight(
        height,
        {.kernel = kernel, .wrap = wrap, .scaleX = scaleX, .scaleY = scaleY, .to = kFloats, .type = PixelType::float32},
        invalid);
}

TEST(Kernels, equal_their_formulas_on_a_cubic)
{
    // h = 0.01 x^3 - 0.02 y^3 + 0.015 x^2 y + 0.03 x y^2, y up. To the derivative, central adds h_xxx / 6, and kernels
    // that smooth across add h_xyy times half of their second moment: 1/4 (1 2 1), 3/16 (3 10 3).
    const auto h = [](double x, double y) {
        return 0.01 * x * x * x - 0.02 * y * y * y + 0.015 * x * x * y + 0.03 * x * y * y;
    };
    const int side = 9;
    const Image image = heights(side, side, [&](int x, int y) { return h(x - 4, 4 - y); });
    for (Kernel kernel : kKernels) {
        const Image map = normals(image, kernel, Wrap::clamp, 0.5, 0.25);
        for (int row = 1; row + 1 < side; ++row)
            for (int column = 1; column + 1 < side; ++column) {
                const double x = column - 4, y = 4 - row;
                double right = 0.03 * x * x + 0.03 * x * y + 0.03 * y * y,
                       up = -0.06 * y * y + 0.015 * x * x + 0.06 * x * y;
                if (kernel == Kernel::forward) {
                    right = h(x + 1, y) - h(x, y);
                    up = h(x, y + 1) - h(x, y);
                } else {
                    const double moment = kernel == Kernel::sobel ? 0.25 : kernel == Kernel::scharr ? 3.0 / 16 : 0;
                    right += 0.06 / 6 + moment * 0.06; // h_xyy = 2 x 0.03
                    up += -0.12 / 6 + moment * 0.03;   // h_yxx = 2 x 0.015
                }
                const glm::dvec2 found = slopesOf(texelAt(map, column, row));
                EXPECT_NEAR(found.x, 0.5 * right, 2e-6) << int(kernel); // float heights up to 4
                EXPECT_NEAR(found.y, 0.25 * up, 2e-6) << int(kernel);
            }
    }
}

int inside(int i, int size, Wrap wrap)
{
    if (wrap == Wrap::repeat)
        return (i + size) % size;
    return std::clamp(i, 0, size - 1); // one row beyond the border, mirroring repeats the border itself
}

TEST(Kernels, borders_equal_those_of_a_padded_image)
{
    Noise noise(3);
    const int width = 5, height = 4;
    std::array<std::array<double, 5>, 4> h{};
    for (auto& row : h)
        for (double& v : row)
            v = noise.next();
    const Image image = heights(width, height, [&](int x, int y) { return h[std::size_t(y)][std::size_t(x)]; });
    for (Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
        const Image padded = heights(width + 2, height + 2, [&](int x, int y) {
            return h[std::size_t(inside(y - 1, height, wrap))][std::size_t(inside(x - 1, width, wrap))];
        });
        for (Kernel kernel : kKernels) {
            const Image direct = normals(image, kernel, wrap), around = normals(padded, kernel, Wrap::clamp);
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    EXPECT_EQ(texelAt(direct, x, y), texelAt(around, x + 1, y + 1))
                        << int(wrap) << int(kernel) << ' ' << x << ' ' << y;
        }
    }
}

TEST(Kernels, strips_with_their_borders_equal_the_whole)
{
    Noise noise(4);
    const Image image = heights(6, 50, [&](int, int) { return noise.next(); });
    std::size_t invalid = 0;
    FromHeightSettings s{.kernel = Kernel::scharr,
                         .wrap = Wrap::repeat,
                         .scaleX = 1,
                         .scaleY = 1,
                         .to = {},
                         .type = PixelType::unorm8,
                         .dither = true};
    const Image whole = normalsFromHeight(image, s, invalid);
    s.bordered = true;
    s.firstRow = 17;
    const Image strip =
        normalsFromHeight(rowsBetween(image, 16, 40), s, invalid); // rows 17 to 38, plus one at either end
    EXPECT_EQ(strip.data, rowsBetween(whole, 17, 39).data);
}

TEST(ToHeight, free_borders_invert_the_kernel_too)
{
    // Heights that do not repeat and differ along x and y. Forward differences keep every frequency; the others remove
    // the highest, so they get a smooth relief: cosines that are flat at the borders.
    Noise noise(7);
    const int width = 21, height = 14;
    const Image rough = heights(width, height, [&](int, int) { return noise.next(); });
    const Image smooth = heights(width, height, [&](int x, int y) {
        const double u = 3.14159265358979 * (x + 0.5) / width, v = 3.14159265358979 * (y + 0.5) / height;
        return 2 * std::cos(u) + std::cos(3 * v) - 0.7 * std::cos(2 * u) * std::cos(v);
    });
    for (Kernel kernel : kKernels) {
        const Image map = normals(kernel == Kernel::forward ? rough : smooth, kernel, Wrap::clamp);
        const Heights solved = heightFromNormals(map, {.from = kFloats, .boundary = Boundary::free, .kernel = kernel});
        const Image again =
            normals(heights(width, height, [&](int x, int y) { return solved.texels[std::size_t(y * width + x)]; }),
                    kernel, Wrap::clamp);
        for (float degrees : anglesBetween(map, kFloats, again, kFloats))
            EXPECT_LT(degrees, 1e-3) << int(kernel); // float slopes and heights
        EXPECT_LT(solved.residual, 1e-5 * solved.slope) << int(kernel);
    }
}

TEST(ToHeight, free_borders_are_least_squares_for_slopes_with_curl)
{
    // At the least-squares solution, changing any single height increases the error of the slopes.
    Noise noise(9);
    const int width = 7, height = 6;
    const Image map =
        floatMap(width, height, [&](int, int) { return ofSlopes(noise.next() - 0.5, 0.6 * noise.next()); });
    const Heights solved =
        heightFromNormals(map, {.from = kFloats, .boundary = Boundary::free, .kernel = Kernel::forward});
    const auto misfit = [&](int changed, double by) {
        const auto h = [&](int x, int y) {
            return double(solved.texels[std::size_t(y * width + x)]) + (y * width + x == changed ? by : 0);
        };
        double sum = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const glm::dvec2 s =
                    slopesOf(texelAt(map, x, y)); // forward differences to the right and up; none across the border
                if (x + 1 < width)
                    sum += std::pow(h(x + 1, y) - h(x, y) - s.x, 2);
                if (y > 0)
                    sum += std::pow(h(x, y - 1) - h(x, y) - s.y, 2);
            }
        return sum;
    };
    const double least = misfit(-1, 0);
    EXPECT_NEAR(std::sqrt(least / (width * height)), solved.residual, 1e-5);
    for (int i = 0; i < width * height; ++i)
        for (double by : {1e-3, -1e-3})
            EXPECT_GT(misfit(i, by), least) << i;
}

TEST(ToHeight, rms_slope_residual_and_mean_tilt_are_those_of_the_map)
{
    // A constant slope is entirely mean tilt: free borders follow it exactly, repeating heights cannot.
    const Image map = floatMap(12, 9, [](int, int) { return ofSlopes(0.3, -0.4); });
    for (Kernel kernel : {Kernel::spectral, Kernel::forward}) {
        const Heights free = heightFromNormals(map, {.from = kFloats, .boundary = Boundary::free, .kernel = kernel});
        EXPECT_NEAR(free.slope, 0.5, 1e-6);
        EXPECT_NEAR(free.residual, 0, 1e-5);
        EXPECT_NEAR(free.meanTilt, 26.565, 1e-3); // atan(0.5)
        EXPECT_NEAR(double(free.texels[1] - free.texels[0]), 0.3, 1e-5);
        EXPECT_NEAR(double(free.texels[12] - free.texels[0]), 0.4, 1e-5); // one row down; the slope up is -0.4
        EXPECT_NEAR(free.highest - free.lowest, 11 * 0.3 + 8 * 0.4, 1e-4);
    }
    const Heights repeating = heightFromNormals(map, {.from = kFloats});
    EXPECT_NEAR(repeating.residual, 0.5, 1e-6);
    EXPECT_NEAR(repeating.meanTilt, 26.565, 1e-3);
    // Texels twice as high as wide: a slope down the image rises twice as much.
    const Heights tall = heightFromNormals(map, {.from = kFloats, .boundary = Boundary::free, .aspect = 2});
    EXPECT_NEAR(double(tall.texels[12] - tall.texels[0]), 0.8, 1e-5);
    EXPECT_NEAR(double(tall.texels[1] - tall.texels[0]), 0.3, 1e-5);
}

TEST(ToHeight, slopes_are_clamped_to_128)
{
    const Image map = floatMap(2, 1, [](int, int) { return glm::vec3(-1, 0, 1e-6f); });
    const Heights h = heightFromNormals(map, {.from = kFloats, .boundary = Boundary::free});
    EXPECT_NEAR(double(h.texels[1] - h.texels[0]), 128, 1e-3);
}

} // namespace
} // namespace cotan::maps
