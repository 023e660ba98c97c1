// The smaller levels of a map whose rows arrive one after another.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "cotan/maps.hpp"

namespace cotan::maps {

// Means over a footprint. `coverage`: fraction of the footprint that has a direction.
struct MipMoments {
    glm::vec3 normal{0};
    float coverage = 0;
    float bx = 0, by = 0, bb = 0; // slopes and the sum of their squares
    float alpha = 1;              // not a mean over the footprint

    void add(const MipMoments& o, float weight)
    {
        normal += o.normal * weight;
        coverage += o.coverage * weight;
        bx += o.bx * weight, by += o.by * weight, bb += o.bb * weight;
    }
};

// Makes the levels of mipChain in memory for a few rows of each.
class MipRows {
public:
    // What is made of alpha: 1; its average; or 1, with the roughness beside and level 0 as well.
    enum Alpha { one, averaged, roughness };

    // Takes the next rows of a level, from the top, and those of its roughness.
    using Take = std::function<void(std::size_t level, Image normals, Image roughness)>;

    // width, height: of the map.
    MipRows(int width, int height, const MipSettings& settings, Alpha alpha);

    std::size_t levels() const { return levels_.size(); }
    std::pair<int, int> size(std::size_t level) const { return {levels_[level].width, levels_[level].height}; }

    // Adds the next rows of the map, from the top, and makes what rows of the smaller levels they complete.
    void add(const Image& rows, const Take& take);

    // After all rows, with Alpha::roughness: MipLevel::meanLength and meanRoughness.
    std::pair<double, double> means(std::size_t level) const;

private:
    struct Level {
        int width = 0, height = 0;
        int next = 0;  // the row to be made next
        int first = 0; // of the rows below, which the next level needs
        std::vector<MipMoments> moments{};
        double length = 0, roughness = 0, count = 0; // sums over texels; count: of those with a direction

        float meanAlpha(int x, int y) const; // of texel (x, y) of the next level
        void keepFrom(int row);
        std::size_t grow(int rows); // returns the first new texel
    };

    void makeRows(std::size_t level, const Take& take);
    void store(std::size_t level, int rows, std::size_t start, const Take& take); // from texel `start` on

    MipSettings settings_;
    Alpha alpha_;
    std::vector<Level> levels_;
};

} // namespace cotan::maps
