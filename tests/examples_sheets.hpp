// The analytic sheets that the examples draw, and their exact normals.
#pragma once

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "run_tool.hpp"

namespace cotan::test {

// A program that was built here, or the one with its name in the folder COTAN_PROGRAMS, where bench/on-gpu copies it.
inline std::string programAt(const std::filesystem::path& built)
{
    const char* folder = std::getenv("COTAN_PROGRAMS");
    return (folder ? folder / built.filename() : built).string();
}

using Vec = std::array<double, 3>;

inline double dot(Vec a, Vec b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double degreesBetween(Vec a, Vec b)
{
    const Vec c{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return std::atan2(std::sqrt(dot(c, c)), dot(a, b)) * 180 / M_PI;
}

// The texel along (+u, +v, outwards) of the map with four domes; z = 0 near a dome's rim, where rounding decides.
inline Vec domes(double u, double v)
{
    const double x = std::fmod(u * 4, 2) - 1, y = std::fmod(v * 4, 2) - 1;
    const double z2 = 1 - x * x - y * y;
    if (std::abs(z2 - 0.36) < 1e-3)
        return {0, 0, 0};
    return z2 > 0.36 ? Vec{x, y, std::sqrt(z2)} : Vec{0, 0, 1};
}

// The frames whose exact result on the sheet is worked out in `truth`.
enum class SheetFrame {
    cotangent,
    gradient,
    orthonormal, // tangent first
};

// Intersection of a ray from the eye with the plane of a sheet, in the sheet's own axes from its centre.
inline std::array<double, 2> onSheet(Vec ray, double middle, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    const Vec normal{s, 0, c}, along{c, 0, -s}, toMiddle{middle, 0, -4};
    const double depth = dot(normal, toMiddle) / dot(normal, ray);
    const Vec hit{ray[0] * depth - toMiddle[0], ray[1] * depth, ray[2] * depth - toMiddle[2]};
    return {dot(hit, along), hit[1]};
}

// The exact normal for u = |x| + (1 - y)/2, v = 1 - y, where x and y are the sheet's axes. By hand: grad u = (sign x,
// -1/2) is the longer with sqrt(5)/2, grad v = (0, -1), and u grows along (sign x, 0). Zero where the ray misses, or
// near a rim or an edge.
inline Vec truth(Vec ray, double middle, double angle, SheetFrame frame = SheetFrame::cotangent,
                 Vec (*map)(double, double) = domes)
{
    const double c = std::cos(angle), s = std::sin(angle);
    const Vec normal{s, 0, c}, along{c, 0, -s};
    const auto [x, y] = onSheet(ray, middle, angle);
    if (!(std::abs(x) < 0.999 && std::abs(y) < 0.999 && std::abs(x) > 1e-3))
        return {0, 0, 0};
    const Vec m = map(std::abs(x) + (1 - y) / 2, 1 - y);
    const double longest = frame == SheetFrame::cotangent ? std::sqrt(1.25) : 1;
    const double onX = m[0] * (x < 0 ? -1 : 1) / longest;
    const double onY = frame == SheetFrame::orthonormal ? -m[1] : (-0.5 * m[0] - m[1]) / longest;
    const double side = dot(normal, ray) < 0 ? 1 : -1; // a thin sheet
    return {side * (onX * along[0] + m[2] * normal[0]), side * onY, side * (onX * along[2] + m[2] * normal[2])};
}

// Reads an image of 480 x 240 normals, rows from the bottom; empty if the file is anything else.
inline std::vector<Vec> normalsOf(const std::filesystem::path& file)
{
    const std::string bytes = readWhole(file), head = "PF\n480 240\n-1.0\n";
    std::vector<Vec> normals;
    if (bytes.size() != head.size() + 480u * 240u * 12u || bytes.compare(0, head.size(), head) != 0)
        return normals;
    for (std::size_t at = head.size(); at < bytes.size(); at += 12) {
        float n[3];
        std::memcpy(n, bytes.data() + at, 12);
        normals.push_back({n[0], n[1], n[2]});
    }
    return normals;
}

// Runs a program that draws the sheets; each normal's error must be below `maxError` degrees.
inline void expectSheets(const std::string& program, double maxError)
{
    TemporaryFolder folder;
    const std::string f = folder.path().string();
    const std::string line = program + " '" + f + "/a.ppm' '" + f + "/a.pfm'";
    ASSERT_EQ(std::system(line.c_str()), 0);
    EXPECT_EQ(readWhole(folder / "a.ppm").size(), std::strlen("P6\n480 240\n255\n") + 480u * 240u * 3u);
    const std::vector<Vec> normals = normalsOf(folder / "a.pfm");
    ASSERT_EQ(normals.size(), 480u * 240u);
    int counts[2] = {0, 0};
    for (std::size_t row = 0; row < 240; ++row) // from the bottom
        for (std::size_t column = 0; column < 480; ++column) {
            const Vec ray{((2 * (double(column) + 0.5) / 480) - 1) * 2 / 2.2,
                          ((2 * (double(row) + 0.5) / 240) - 1) / 2.2, -1};
            const bool right = column >= 240;
            const Vec expected = right ? truth(ray, 1.2, M_PI - 0.4) : truth(ray, -1.2, 0.4);
            if (dot(expected, expected) == 0)
                continue;
            ++counts[right];
            ASSERT_LT(degreesBetween(normals[row * 480 + column], expected), maxError) << column << ", " << row;
        }
    EXPECT_GT(counts[0], 10000); // each sheet covers a fifth of the image
    EXPECT_GT(counts[1], 10000);
}

} // namespace cotan::test
