// The lines of docs/how-to/godot.md for height maps, drawn by Godot and compared with rays against the displaced sheet.
#include <gtest/gtest.h>

#include <algorithm>

#include <fmt/format.h>

#include "godot_draw.hpp"
#include "godot_sheet.hpp"

namespace cotan::test {
namespace {

constexpr int kReliefWidth = 480, kReliefHeight = 240, kHeightSide = 256;
constexpr double kReliefDepth = 0.3, kReliefTexels = 512, kMiddle = -1.2, kAngle = 0.4; // of the left sheet

// Smooth hills, stored in bytes.
std::string hillBytes()
{
    std::string all;
    for (int row = 0; row < kHeightSide; ++row)
        for (int column = 0; column < kHeightSide; ++column) {
            const double u = 2 * M_PI * column / kHeightSide, v = 2 * M_PI * row / kHeightSide;
            all.append(3, char(std::lround(255 * (0.5 + 0.25 * std::sin(3 * u) + 0.25 * std::cos(2 * v)))));
            all += '\xff';
        }
    return all;
}

// The height between stored neighbours is that of the nearest, as the test's textures are not filtered.
double storedAt(const std::string& hills, double u, double v)
{
    const auto index = [](double x) {
        return std::size_t(std::min(int((x - std::floor(x)) * kHeightSide), kHeightSide - 1));
    };
    return static_cast<unsigned char>(hills[(index(v) * kHeightSide + index(u)) * 4]) / 255.0;
}

// Where a ray from the eye meets the displaced sheet: small steps, and bisection. Axes: along the sheet, up, and out.
std::array<double, 2> uvWhereRayMeets(const std::string& hills, Vec ray)
{
    const double c = std::cos(kAngle), s = std::sin(kAngle);
    const Vec local{ray[0] * c - ray[2] * s, ray[1], ray[0] * s + ray[2] * c};
    const auto [x, y] = onSheet(ray, kMiddle, kAngle);
    const auto uvAt = [&, x = x, y = y](double down) {
        const double k = -down / local[2], px = x + local[0] * k, py = y + local[1] * k;
        return std::array<double, 2>{std::abs(px) + (1 - py) / 2, 1 - py};
    };
    const auto inside = [&](double down) {
        const auto uv = uvAt(down);
        return -down <= (storedAt(hills, uv[0], uv[1]) - 1) * kReliefDepth;
    };
    double low = 0, high = 0;
    while (high < kReliefDepth && !inside(high)) {
        low = high;
        high += kReliefDepth / 500;
    }
    for (int i = 0; i < 20; ++i)
        (inside((low + high) / 2) ? high : low) = (low + high) / 2;
    return uvAt(high);
}

// The section's shader, as a reader makes it; it writes the coordinates that it finds.
std::string pagesShader()
{
    TemporaryFolder folder;
    const ToolRun printed = runTool(
        {"shader", "--lang", "godot", "--frame", "gradient", "--form", "total", "--set", "parallax", "--channels", "2"},
        folder.path());
    EXPECT_EQ(printed.code, 0) << printed.err;
    const std::string page = readWhole(COTAN_SOURCE_DIR "/docs/how-to/godot.md");
    const std::size_t section = page.find("## Height maps"), code = page.find("```glsl\n", section) + 8;
    std::string text =
        printed.out.substr(0, printed.out.find("void fragment()")) + page.substr(code, page.find("```\n", code) - code);
    const std::string type = "shader_type spatial;\n",
                      begin = type + "render_mode unshaded;\n" + kGodotNumbers + "uniform float part;\n";
    text.replace(text.find(type), type.size(), begin);
    return text.substr(0, text.rfind('}')) + "    ALBEDO = cotan_test_unit((part < 0.5 ? uv.x : uv.y) / 4.0);\n}\n";
}

class GodotRelief : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Driver, GodotRelief, testing::Values("GLES3"), [](const auto& p) { return p.param; });

TEST_P(GodotRelief, thePagesLinesFindWhereRaysMeetTheShearedMirroredSheet)
{
    const std::string hills = hillBytes(), lines = pagesShader();
    GodotJobs jobs;
    const nlohmann::json map = jobs.texture(hills, kHeightSide, kHeightSide);
    const std::string unset = "uniform float depth = 0.05;";
    for (const char* depth : {"0.3", "0.0"}) {
        std::string text = lines;
        const std::size_t at = text.find(unset);
        ASSERT_NE(at, std::string::npos);
        jobs.add(text.replace(at, unset.size(), fmt::format("uniform float depth = {};", depth)), kReliefWidth,
                 kReliefHeight, 2, {{"textures", {{"height_map", map}}}, {"sheet", sheetFor(Frame::cotangent)}});
    }
    const std::vector<std::string> images = jobs.draw(GetParam());
    double mean[2] = {0, 0}, flat = 0;
    int count = 0;
    for (int row = 0; row < kReliefHeight; ++row)
        for (int column = 0; column < kReliefWidth / 2; ++column) {
            const Vec ray{((2 * (column + 0.5) / kReliefWidth) - 1) * 2 / 2.2,
                          (1 - 2 * (row + 0.5) / kReliefHeight) / 2.2, -1};
            const auto [x, y] = onSheet(ray, kMiddle, kAngle);
            if (!(std::abs(x) < 0.95 && std::abs(y) < 0.95 && std::abs(x) > 0.1)) // away from edges
                continue;
            const auto expected = uvWhereRayMeets(hills, ray);
            const std::array<double, 2> plain{std::abs(x) + (1 - y) / 2, 1 - y};
            std::array<double, 2> drawn[2];
            for (int job = 0; job < 2; ++job)
                for (int part = 0; part < 2; ++part)
                    drawn[job][std::size_t(part)] = 4
                        * unitOfBytes(images[std::size_t(job)].data()
                                      + 3 * (part * kReliefWidth * kReliefHeight + row * kReliefWidth + column));
            for (int job = 0; job < 2; ++job)
                mean[job] += std::hypot(drawn[job][0] - expected[0], drawn[job][1] - expected[1]) * kReliefTexels;
            flat = std::max(flat, std::hypot(drawn[1][0] - plain[0], drawn[1][1] - plain[1]));
            ++count;
        }
    ASSERT_GT(count, 8000);
    fmt::print("relief {}: {:.2f} texels off in the mean, without it {:.1f}\n", GetParam(), mean[0] / count,
               mean[1] / count);
    EXPECT_LT(mean[0] / count, 0.5); // the search ends within depth / 16 / 64, below 0.2 texels across
    EXPECT_GT(mean[1] / count, 10);
    EXPECT_LT(flat, 1e-4) << "a depth of 0 leaves the coordinates";
}

} // namespace
} // namespace cotan::test
