#include "octahedral.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "cotan/scene/picture_text.hpp"

namespace cotan::environment {

const glm::vec3& Octahedral::around(int x, int y) const
{
    // Over an edge the map goes on with itself, turned round.
    if (x < 0 || x >= size) {
        x = std::clamp(x, 0, size - 1);
        y = size - 1 - y;
    }
    if (y < 0 || y >= size) {
        y = std::clamp(y, 0, size - 1);
        x = size - 1 - x;
    }
    return at(x, y);
}

glm::vec3 Octahedral::direction(int x, int y, glm::vec2 inside) const
{
    const glm::vec2 place((float(x) + inside.x) / float(size), (float(y) + inside.y) / float(size));
    return glm::normalize(f32::cotan_octahedral_direction(place));
}

glm::vec3 Octahedral::read(glm::vec3 direction) const
{
    const glm::vec2 p = f32::cotan_octahedral_place(direction) * float(size) - glm::vec2(0.5f);
    const float fx = std::floor(p.x), fy = std::floor(p.y);
    const float kx = p.x - fx, ky = p.y - fy;
    const int x = int(fx), y = int(fy);
    if (x >= 0 && y >= 0 && x + 1 < size && y + 1 < size) {
        const glm::vec3 top = at(x, y) * (1 - kx) + at(x + 1, y) * kx;
        return top * (1 - ky) + (at(x, y + 1) * (1 - kx) + at(x + 1, y + 1) * kx) * ky;
    }
    const glm::vec3 top = around(x, y) * (1 - kx) + around(x + 1, y) * kx;
    return top * (1 - ky) + (around(x, y + 1) * (1 - kx) + around(x + 1, y + 1) * kx) * ky;
}

// The map is the octahedron seen from above, unfolded: a square of side 2 there. On the octahedron a direction d ends
// at d / (|x|+|y|+|z|), whose distance r sets the angle: 1/r^3 times the area seen from above.
float solidAngleOfPlace(glm::vec3 d)
{
    const float size = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    return 4 * size * size * size;
}

Octahedral halved(const Octahedral& finer)
{
    Octahedral coarse(finer.size / 2);
    for (int y = 0; y < coarse.size; ++y)
        for (int x = 0; x < coarse.size; ++x) {
            glm::vec3 sum(0);
            float weights = 0;
            for (int i = 0; i < 4; ++i) {
                const int fx = 2 * x + (i & 1), fy = 2 * y + (i >> 1);
                const float weight = solidAngleOfPlace(finer.direction(fx, fy));
                sum += finer.at(fx, fy) * weight;
                weights += weight;
            }
            coarse.at(x, y) = sum / weights;
        }
    return coarse;
}

} // namespace cotan::environment
