#include "cotan/maps.hpp"

#include <numbers>

#include <glm/geometric.hpp>

#include "cotan/vector.hpp"
#include "maps/texels.hpp"

namespace cotan::maps {

std::vector<float> anglesBetween(const Image& a, const Convention& conventionA, const Image& b,
                                 const Convention& conventionB)
{
    std::vector<float> degrees(a.pixelCount());
    const std::size_t width = std::size_t(a.width);
    forRowBands(a.height, [&](int first, int last) {
        std::vector<glm::vec3> rowA(width), rowB(width);
        for (int y = first; y < last; ++y) {
            decodeRow(a, y, conventionA, rowA);
            decodeRow(b, y, conventionB, rowB);
            float* out = degrees.data() + std::size_t(y) * width;
            for (std::size_t x = 0; x < width; ++x) {
                const glm::vec3 m = rowA[x], n = rowB[x];
                const bool both = glm::dot(m, m) > 0 && glm::dot(n, n) > 0;
                out[x] = both ? angleBetween(m, n) * float(180 / std::numbers::pi) : -1.0f;
            }
        }
    });
    return degrees;
}

} // namespace cotan::maps
