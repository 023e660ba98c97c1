// Small surfaces and maps for the tests of lint and convert.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "bake/lint/map_fit.hpp"

namespace cotan::test {

struct Corner {
    glm::vec3 position;
    glm::vec2 uv;
    glm::vec3 normal{0, 0, 1};
};

// Three vertices for each triangle, none shared.
inline Mesh meshOf(const std::vector<Corner>& corners)
{
    Mesh mesh;
    for (const Corner& c : corners) {
        mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
        mesh.positions.push_back(c.position);
        mesh.normals.push_back(c.normal);
        mesh.texcoords[0].push_back(c.uv);
    }
    return mesh;
}

// A rectangle in xy facing +z with its lower left corner at `at`; uv run from `low` (top left, as v runs down) to
// `high`.
inline std::vector<Corner> rectangle(glm::vec2 at, glm::vec2 size, glm::vec2 low, glm::vec2 high)
{
    const auto corner = [&](float x, float y) {
        return Corner{{at.x + x * size.x, at.y + y * size.y, 0},
                      {low.x + x * (high.x - low.x), high.y + y * (low.y - high.y)}};
    };
    return {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 0), corner(1, 1), corner(0, 1)};
}

inline MappedSurface surfaceOf(const std::vector<Corner>& corners) { return makeSurface(meshOf(corners), Texture{}); }

inline std::vector<Corner> operator+(std::vector<Corner> a, const std::vector<Corner>& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

inline constexpr Convention kUnconverted{.expansion = Expansion::signedValues,
                                         .greenUp = false}; // signed, green along v: stored without conversion

// A float map; texel(x, y) returns the normal along (+u, +v, outwards).
template<class Texel> Image floatMap(int width, int height, const Texel& texel)
{
    Image image = makeImage(width, height, PixelType::float32, "map");
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 m = texel(x, y);
            float* p = image.floats() + 4 * (y * width + x);
            p[0] = float(m.x);
            p[1] = float(m.y);
            p[2] = float(m.z);
            p[3] = 1;
        }
    return image;
}

inline double angleBetween(glm::dvec3 a, glm::dvec3 b)
{
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

} // namespace cotan::test
