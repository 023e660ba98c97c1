#include "page.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "page.html.h"

namespace {

constexpr std::uint32_t kAround = 48, kAlong = 64;           // quads of the measured mesh
constexpr std::uint32_t kCellsAround = 16, kCellsAlong = 32; // cells of the drawing, each of several quads
constexpr std::uint32_t kSteps = 20;

// A JSON array of count items.
template<class Item> std::string list(std::size_t count, const Item& item)
{
    std::string text = "[";
    for (std::size_t i = 0; i < count; ++i)
        text += (i > 0 ? "," : "") + item(i);
    return text + "]";
}

std::string number(double x)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", x);
    return text;
}

std::string quoted(const char* text) { return "\"" + std::string(text) + "\""; }

// x, y and reversed depth of the cells' corners in a drawing of 600 x 540.
std::string drawing(const Mesh& pose)
{
    const double c = std::cos(0.4), s = std::sin(0.4), d = std::cos(0.3), t = std::sin(0.3);
    return list((kCellsAround + 1) * (kCellsAlong + 1), [&](std::size_t i) {
        const std::size_t column = i % (kCellsAround + 1) * (kAround / kCellsAround),
                          row = i / (kCellsAround + 1) * (kAlong / kCellsAlong);
        const glm::dvec3 p(pose.positions[row * (kAround + 1) + column]);
        const double x = c * p.x + s * p.z, z = c * p.z - s * p.x, y = d * p.y - t * z, near = t * p.y + d * z;
        const auto whole = [](double pixels) { return std::to_string(std::lround(pixels)); };
        return whole(300 + 100 * x) + "," + whole(270 - 100 * y) + "," + whole(100 * near);
    });
}

// One character per cell: '#' plus the mean error in half degrees, clamped to 28 degrees.
std::string cells(const std::vector<float>& triangles)
{
    constexpr std::uint32_t kWide = kAround / kCellsAround, kTall = kAlong / kCellsAlong;
    std::string text;
    for (std::uint32_t j = 0; j < kCellsAlong; ++j)
        for (std::uint32_t i = 0; i < kCellsAround; ++i) {
            double sum = 0;
            for (std::uint32_t k = 0; k < kWide * kTall; ++k) {
                const std::size_t quad = (j * kTall + k / kWide) * kAround + i * kWide + k % kWide;
                sum += triangles[2 * quad] + triangles[2 * quad + 1];
            }
            text += static_cast<char>('#' + std::min(56L, std::lround(sum / (kWide * kTall))));
        }
    return quoted(text.c_str());
}

std::string measured(Measured& tube, const Motion& motion)
{
    std::vector<Errors> errors[2]; // with carried and with derived normals; by time
    for (int derived = 0; derived < 2; ++derived) {
        for (std::uint32_t step = 0; step <= kSteps; ++step)
            errors[derived].push_back(tube.at(motion, double(step) / kSteps, derived == 1));
        for (std::uint32_t step = 0; step <= kSteps; step += kSteps / 4) {
            std::printf("| %s | %s | %.2f |", motion.name, derived ? "derived" : "carried", double(step) / kSteps);
            for (const double mean : errors[derived][step].mean)
                std::printf(" %.2f |", mean);
            std::printf("\n");
        }
    }
    // value(errors at one time, method) as nested arrays by kind of normals, method from `first` on, and time.
    const auto over = [&](std::size_t first, const auto& value) {
        return list(2, [&](std::size_t derived) {
            return list(kWays.size() - first, [&](std::size_t way) {
                return list(kSteps + 1, [&](std::size_t step) { return value(errors[derived][step], way + first); });
            });
        });
    };
    return "{\"name\":" + quoted(motion.name) + ",\"text\":" + quoted(motion.text)
        + ",\"means\":" + over(0, [](const Errors& e, std::size_t way) { return number(e.mean[way]); }) + ",\"most95\":"
        + over(0, [](const Errors& e, std::size_t way) { return number(e.most95[way]); }) + ",\"cells\":"
        + over(1, [](const Errors& e, std::size_t way) { return cells(e.triangles[way]); }) + ",\"points\":"
        + list(kSteps + 1,
               [&](std::size_t step) {
                   return drawing(posed(tube.rest(), motion, double(step) / kSteps, Normals::exact));
               })
        + "}\n";
}

} // namespace

std::string figure(const Gpu& gpu)
{
    Measured tube(gpu, kAround, kAlong);
    std::printf("| motion | normals | time |");
    for (const Way& way : kWays)
        std::printf(" %s |", way.name);
    std::printf("\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
    const std::string data = "{\"around\":" + std::to_string(kCellsAround) + ",\"along\":" + std::to_string(kCellsAlong)
        + ",\"steps\":" + std::to_string(kSteps) + ",\"ways\":"
        + list(kWays.size(),
               [](std::size_t i) {
                   return "{\"name\":" + quoted(kWays[i].name) + ",\"text\":" + quoted(kWays[i].text) + "}";
               })
        + ",\"motions\":" + list(kMotions.size(), [&](std::size_t i) { return measured(tube, kMotions[i]); }) + "}";
    std::string page = kPage;
    return page.replace(page.find("DATA"), 4, data);
}
