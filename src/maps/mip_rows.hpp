// The smaller levels of a map whose rows arrive one after another.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "cotan/maps.hpp"

namespace cotan::maps {

// Means over a footprint. `coverage`: fraction of the footprint that has a direction.
struct MipMoments {
    glm::vec3 normal{0};
    float coverage = 0;
    float bx = 0, by = 0, bb = 0; // slopes and the sum of their squares

    void add(const MipMoments& o, float weight)
    {
        normal += o.normal * weight;
        coverage += o.coverage * weight;
        bx += o.bx * weight, by += o.by * weight, bb += o.bb * weight;
    }
};

// Makes the levels of mipChain, without roughness, in memory for a few rows of each.
class MipRows {
public:
    // Takes the next rows of a level, from the top.
    using Take = std::function<void(std::size_t level, Image rows)>;

    // width, height: of the map. averagesAlpha: else alpha is 1.
    MipRows(int width, int height, const MipSettings& settings, bool averagesAlpha);

    // Adds the next rows of the map, from the top, and makes what rows of the smaller levels they complete.
    void add(const Image& rows, const Take& take);

private:
    struct Level {
        int width = 0, height = 0;
        int next = 0;  // the row to be made next
        int first = 0; // of the rows below, which the next level needs
        std::vector<MipMoments> moments{};
        std::vector<float> alphas{};

        float meanAlpha(int x, int y) const; // of texel (x, y) of the next level
        void keepFrom(int row);
    };

    void makeRows(std::size_t level, const Take& take);

    MipSettings settings_;
    bool averagesAlpha_;
    std::vector<Level> levels_;
};

} // namespace cotan::maps
