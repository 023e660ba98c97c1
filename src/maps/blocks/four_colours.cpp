#include "four_colours.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "maps/texels.hpp"

namespace cotan::maps {

namespace {

using Colours = std::array<glm::vec3, 16>; // of the texels of a block, 0 to 255

struct Coded {
    Colours colours{};
    float error = 1e30f; // sum of squares
};

// Takes for each texel the nearest of `palette`, if that is better.
void improve(Coded& best, const Colours& texels, const std::array<glm::vec3, 4>& palette)
{
    Coded coded{{}, 0};
    const auto distance = [](glm::vec3 a, glm::vec3 b) { return glm::dot(a - b, a - b); };
    for (std::size_t i = 0; i < 16; ++i) {
        coded.colours[i] = *std::min_element(palette.begin(), palette.end(), [&](glm::vec3 a, glm::vec3 b) {
            return distance(a, texels[i]) < distance(b, texels[i]);
        });
        coded.error += distance(coded.colours[i], texels[i]);
    }
    if (coded.error < best.error)
        best = coded;
}

glm::vec3 rounded(glm::vec3 colour, glm::vec3 steps)
{
    return glm::round(glm::clamp(colour / 255.0f, 0.0f, 1.0f) * steps) / steps * 255.0f;
}

Coded coded(const Colours& texels, FourColours kind)
{
    constexpr glm::vec3 kSteps(31, 63, 31);
    constexpr int kRounds = 8; // of power iteration
    Coded best;
    glm::vec3 mean(0);
    for (const glm::vec3 texel : texels)
        mean += texel / 16.0f;
    if (kind == FourColours::one) {
        best.colours.fill(mean);
        return best;
    }
    if (kind == FourColours::line) {
        glm::vec3 axis(0);
        for (const glm::vec3 texel : texels)
            if (glm::length(texel - mean) > glm::length(axis))
                axis = texel - mean;
        for (int i = 0; i < kRounds && glm::length(axis) > 0; ++i) {
            glm::vec3 next(0);
            for (const glm::vec3 texel : texels)
                next += glm::dot(texel - mean, glm::normalize(axis)) * (texel - mean);
            axis = next;
        }
        axis = glm::length(axis) > 0 ? glm::normalize(axis) : axis;
        float low = 0, high = 0;
        for (const glm::vec3 texel : texels) {
            low = std::min(low, glm::dot(texel - mean, axis));
            high = std::max(high, glm::dot(texel - mean, axis));
        }
        for (const float inside : {0.0f, 1 / 16.0f, 1 / 8.0f, 1 / 4.0f}) {
            const glm::vec3 a = rounded(mean + axis * glm::mix(low, high, inside), kSteps);
            const glm::vec3 b = rounded(mean + axis * glm::mix(high, low, inside), kSteps);
            improve(best, texels, {a, (2.0f * a + b) / 3.0f, (a + 2.0f * b) / 3.0f, b});
        }
        const glm::vec3 one = rounded(mean, 3.0f * kSteps); // between two colours that are near
        improve(best, texels, {one, one, one, one});
        return best;
    }
    constexpr float kTables[8][2] = {{2, 8}, {5, 17}, {9, 29}, {13, 42}, {18, 60}, {24, 80}, {33, 106}, {47, 183}};
    const glm::vec3 base = rounded(mean, glm::vec3(31));
    const auto lighter = [&](float by) { return glm::clamp(base + by, 0.0f, 255.0f); };
    for (const auto& [near, far] : kTables)
        improve(best, texels, {lighter(-far), lighter(-near), lighter(near), lighter(far)});
    if (kind == FourColours::grey)
        return best;
    glm::vec3 across(0), down(0);
    for (std::size_t i = 0; i < 16; ++i) { // least squares: the squared distances from the middle add up to 20
        across += (texels[i] - mean) * (float(i % 4) - 1.5f) / 20.0f;
        down += (texels[i] - mean) * (float(i / 4) - 1.5f) / 20.0f;
    }
    Coded flat{{}, 0};
    for (std::size_t i = 0; i < 16; ++i) {
        const glm::vec3 colour = mean + across * (float(i % 4) - 1.5f) + down * (float(i / 4) - 1.5f);
        flat.colours[i] = glm::round(glm::clamp(colour, 0.0f, 255.0f));
        flat.error += glm::dot(flat.colours[i] - texels[i], flat.colours[i] - texels[i]);
    }
    return flat.error < best.error ? flat : best;
}

} // namespace

Image inFourColours(const Image& image, FourColours colours)
{
    Image made = image;
    std::array<std::vector<glm::vec4>, 4> rows;
    rows.fill(std::vector<glm::vec4>(std::size_t(image.width)));
    for (int top = 0; top + 4 <= image.height; top += 4) {
        for (int y = 0; y < 4; ++y)
            loadRow(image, top + y, rows[std::size_t(y)]);
        for (std::size_t left = 0; left + 4 <= rows[0].size(); left += 4) {
            Colours texels;
            for (std::size_t i = 0; i < 16; ++i)
                texels[i] = glm::vec3(rows[i / 4][left + i % 4]) * 255.0f;
            texels = coded(texels, colours).colours;
            for (std::size_t i = 0; i < 16; ++i)
                rows[i / 4][left + i % 4] = glm::vec4(texels[i] / 255.0f, rows[i / 4][left + i % 4].w);
        }
        for (int y = 0; y < 4; ++y)
            storeRow(made, top + y, rows[std::size_t(y)]);
    }
    return made;
}

} // namespace cotan::maps
