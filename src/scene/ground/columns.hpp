// What stands above a level plane, as columns: from where to where each is filled.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <glm/vec2.hpp>

#include "cotan/scene.hpp"

namespace cotan::ground {

// A grid of columns over the plane. A point at height h above the plane stands in the column at (x, z) - h * lean: with
// the direction of a light as lean, a column holds what shades one place. Between its lowest and its highest point a
// column counts as full.
struct Columns {
    // Heights above the plane; from > to where nothing stands.
    struct Span {
        float from = std::numeric_limits<float>::infinity(), to = -from;

        void hold(float height)
        {
            from = std::min(from, height);
            to = std::max(to, height);
        }
        bool meets(float lowest, float highest) const { return from <= highest && to > lowest; }
    };

    // What is translucent in a column, which counts as full in the same way.
    struct Veil {
        Span span;
        std::array<float, 4> stops{}; // the share of light, of each layer of cotan_shadow_threshold
    };

    int side = 0; // columns along x and along z
    glm::vec2 lean{0};
    glm::vec2 low{0}, extent{0}; // of the grid, in x and z
    float top = 0;               // of the highest column, above the plane
    std::vector<Span> spans;     // rows along x first
    std::vector<Veil> veils;     // likewise; empty where nothing is translucent

    // The share of a ray's light that does not arrive. The ray leaves the plane at `place` and moves sideways by
    // `speed` as it rises by 1, the columns' lean not counted. Of the veils of one layer that it meets the densest
    // counts: they are mostly one surface.
    float stopped(glm::vec2 place, glm::vec2 speed) const;
};

// The columns of all that throws shadows. Masked materials count where their mask leaves them, blended ones as veils by
// their alpha, read at four places of a column. plane: y.
Columns makeColumns(const Scene& scene, double plane, glm::vec2 lean, int side);

} // namespace cotan::ground
