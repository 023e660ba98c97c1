#include "octahedral.hpp"

#include <cmath>

#include <glm/geometric.hpp>

#include "scene/picture_text.hpp"

namespace cotan::environment {

// Over an edge the map goes on with itself, turned round.
void Octahedral::fold()
{
    const int last = size_ - 1;
    for (int i = 0; i < size_; ++i) {
        at(i, -1) = at(last - i, 0);
        at(i, size_) = at(last - i, last);
        at(-1, i) = at(0, last - i);
        at(size_, i) = at(last, last - i);
    }
    for (const int x : {-1, size_})
        for (const int y : {-1, size_})
            at(x, y) = at(x < 0 ? last : 0, y < 0 ? last : 0);
}

glm::vec3 Octahedral::direction(int x, int y, glm::vec2 inside) const
{
    const glm::vec2 place((float(x) + inside.x) / float(size_), (float(y) + inside.y) / float(size_));
    return glm::normalize(f32::cotan_octahedral_direction(place));
}

// The map is the octahedron seen from above, unfolded: a square of side 2 there. On the octahedron a direction d ends
// at d / (|x|+|y|+|z|), whose distance r sets the angle: 1/r^3 times the area seen from above.
float solidAngleOfPlace(glm::vec3 d)
{
    const float size = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    return 4 * size * size * size;
}

} // namespace cotan::environment
