// What the atlas of an environment is made with: maps of all directions, their light as lamps, and what GGX reflects;
// and how that of the studio is stored.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "scene/picture_text.hpp"

namespace cotan::environment {

// The studio's atlas as the program holds it: halfs, rows first.
inline constexpr int kChannels = 3;
inline constexpr std::size_t kStudioHalfs = std::size_t(kChannels) * COTAN_ENVIRONMENT_WIDTH * COTAN_ENVIRONMENT_HEIGHT;

// A function of direction in texels: an octahedral map that can be read without edges.
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

// All light around, as a tree of lamps: close to a lobe's middle it is seen finely, far from it coarsely.
class LampTree {
public:
    // finest: radiance; a power of two of texels a side, at least 8.
    explicit LampTree(const Octahedral& finest);

    // What mirrors with GGX's microfacets reflect, seen straight on: the means of all radiance around each normal,
    // weighed by the distribution at the half vector times n.l. alpha2: squared alpha, over 0; at 1 that is the
    // cosine's mean. Normals that are close together take less time: they share what is found of the tree.
    // Every texel counts in one lamp. So no dots, however bright a small light is, and a white sphere gives 1.
    void lobes(std::span<const glm::vec3> normals, float alpha2, std::span<glm::vec3> means) const;

private:
    // Four texels that meet at a corner, side by side, since processors count with four numbers at once.
    struct Block {
        glm::vec4 x, y, z; // where the middles of their lights are; unit
        glm::vec4 solidAngle;
        std::array<glm::vec4, 3> light; // radiance times solid angle
        glm::vec3 middle;
        float radius; // of all four around the middle, along the chord
        float width;  // of one
    };
    struct Level {
        int size; // blocks a side
        std::vector<Block> blocks;
    };

    std::vector<Level> levels_; // coarsest first; a block's texels are the four blocks of the next
};

// The two factors of f0: albedo = f0 * x + y, for cotan_reflect_pbr's specular term (Smith-correlated GGX, Schlick's
// Fresnel), integrated over all lights. Sampled by the normals that are seen (E. Heitz, Sampling the GGX Distribution
// of Visible Normals, 2018).
// nv: cosine between normal and eye, held from 1e-4; roughness in [0,1], held from 0.045.
glm::dvec2 albedoFactors(double nv, double roughness);

} // namespace cotan::environment
