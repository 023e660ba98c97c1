// All light around, as a tree of lamps: close to a lobe's middle it is seen finely, far from it coarsely.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "octahedral.hpp"

namespace cotan::environment {

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

} // namespace cotan::environment
