// A function of direction in texels: an octahedral map that can be read without edges.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace cotan::environment {

struct Octahedral {
    int size = 0; // texels a side, even
    std::vector<glm::vec3> texels;

    explicit Octahedral(int side) : size(side), texels(std::size_t(side) * std::size_t(side), glm::vec3(0)) {}

    glm::vec3& at(int x, int y) { return texels[std::size_t(y) * std::size_t(size) + std::size_t(x)]; }
    const glm::vec3& at(int x, int y) const { return texels[std::size_t(y) * std::size_t(size) + std::size_t(x)]; }

    // Up to one texel over the edge: the one beside it on the sphere.
    const glm::vec3& around(int x, int y) const;

    // The unit direction of a place inside a texel, (0,0) to (1,1).
    glm::vec3 direction(int x, int y, glm::vec2 inside = glm::vec2(0.5f)) const;

    // Filtered between the four nearest texels. direction: of any length but 0.
    glm::vec3 read(glm::vec3 direction) const;
};

// Solid angle of a square of side 1 in the map, around a unit direction.
float solidAngleOfPlace(glm::vec3 direction);

// Half as many texels a side; each the mean of four, by their solid angles.
Octahedral halved(const Octahedral& finer);

} // namespace cotan::environment
