// A function of direction in texels: an octahedral map that can be read without edges.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace cotan::environment {

// Texels have four floats, the last one 0, since processors add four at once.
class Octahedral {
public:
    // side: texels, even.
    explicit Octahedral(int side) : size_(side), texels_(std::size_t(side + 2) * std::size_t(side + 2), glm::vec4(0)) {}

    int size() const { return size_; }

    // x, y: -1 to size(): there is a border of one texel around the map.
    glm::vec4& at(int x, int y) { return texels_[index(x, y)]; }
    const glm::vec4& at(int x, int y) const { return texels_[index(x, y)]; }

    // Fills the border with what is beside it on the sphere. Due after writing, before reading.
    void fold();

    // The unit direction of a place inside a texel, (0,0) to (1,1).
    glm::vec3 direction(int x, int y, glm::vec2 inside = glm::vec2(0.5f)) const;

private:
    std::size_t index(int x, int y) const { return std::size_t(y + 1) * std::size_t(size_ + 2) + std::size_t(x + 1); }

    int size_;
    std::vector<glm::vec4> texels_;
};

// Solid angle of a square of side 1 in the map, around a unit direction.
float solidAngleOfPlace(glm::vec3 direction);

} // namespace cotan::environment
