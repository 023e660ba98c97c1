// Finds the triangles that each texel shows, and the points on them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "cotan/packed_only.hpp"

namespace cotan {

// Triangles in texture space, (0,0) the top left corner of the image, (1,1) its bottom right.
struct UvTriangles {
    std::span<const glm::vec2> texcoords;
    std::span<const std::uint32_t> indices; // three per triangle, each inside texcoords
    glm::vec2 scale{1, 1};                  // factor on the texcoords
};

// Gets the scaled uv of a triangle and twice its area. Returns false if it is not drawn: without an area, or with uv
// beyond a million.
bool cornersOf(const UvTriangles& triangles, std::uint32_t triangle, glm::dvec2 (&uv)[3], double& area);

// A point of a triangle: corner 0 + (corner 1 - corner 0) * b1 + (corner 2 - corner 0) * b2.
struct UvSample {
    std::uint32_t triangle = 0;
    float b1 = 0, b2 = 0;
    bool covers = false; // the triangle covers the texel's centre; otherwise it only touches the texel, and the point
                         // is its nearest to the centre, moved inside by 1e-4 of the way to the triangle's middle
};

// Working memory of the raster. It is kept with the result, so that a result that is reused allocates nothing.
template<class Texel> struct UvScratch {
    std::vector<std::pair<Texel, UvSample>> found; // in order of discovery
    std::vector<std::uint8_t> taken, twice;        // texels that have a sample, and those that have two
    std::vector<std::uint32_t> next;               // per group: index in the result of its next sample
    std::vector<std::uint32_t> orders, sorted;     // order of the triangles, parallel to `found` and the result
};

// The samples of each texel of a row, one texel after the other.
template<class Sample> struct SamplesOfRow {
    std::vector<std::uint32_t> first; // width + 1: index of the first sample of each texel
    std::vector<Sample> samples;

    std::span<const Sample> of(std::size_t x) const
    {
        return std::span(samples).subspan(first[x], first[x + 1] - first[x]);
    }
};

// The samples of a texel, in the order of the triangles: those that cover its centre; if there is none, those within
// half a texel's diagonal of it. At maxPerTexel one of two triangles that share an edge covers a centre on it.
struct UvRow : SamplesOfRow<UvSample> {
    UvScratch<int> scratch; // not part of the result
};

// Limits the samples of a texel.
struct UvLimits {
    std::size_t maxPerTexel =
        SIZE_MAX; // maximum per texel, at least 1; 1: the first; more: spread over the list of triangles
    std::function<bool(const UvSample&)> accepts{}; // samples for which this is false are left out; empty: none
};

// The texels of a row whose centres a triangle covers, `last` included.
struct UvSpan {
    std::uint32_t triangle = 0;
    int y = 0, first = 0, last = 0;
};

// The texels of a block of rows that show something, each with one sample: that of the first triangle that covers its
// centre; if there is none, of the first within half a texel's diagonal of it. They are ordered by squares of 4 x 4, so
// that sixteen in a row are close to one another, and in a square by triangle.
struct UvFirsts {
    std::vector<glm::ivec2> texels; // parallel to `samples`
    std::vector<UvSample> samples;
    std::vector<glm::ivec2> coveredTwice; // texels whose centre another triangle covers too, each once
    UvScratch<glm::ivec2> scratch;        // not part of the result
};

// Rasterises a uv layout into the texels of an image. Stores a list of the triangles that may touch each block of rows:
// about 20 bytes per triangle of the size of a texel. The arrays of UvTriangles must outlive it. Triangles without area
// in uv, or with uv that are not finite or further than 1e6 from zero, touch nothing.
class UvRaster {
public:
    // tile: the unit square of uv that the image covers ((0,0) for ordinary layouts; UDIM 1001 + u + 10 v). wrap: the
    // image repeats outside the unit square; then all copies of a triangle are rasterised, whatever the tile. A
    // triangle whose inscribed circle has space for 4 by 4 whole images is rasterised in 16 of them, evenly chosen.
    UvRaster(const UvTriangles& triangles, int width, int height, glm::ivec2 tile = {0, 0}, bool wrap = false);

    // The samples of the rows from `first` on, 0 at the top, one row for each of `results`. May be called from several
    // threads. With limits.maxPerTexel the time grows with the triangles in a block of rows, but not with their texels.
    void rows(int first, std::span<UvRow> results, const UvLimits& limits = {}) const;
    void row(int y, UvRow& result, const UvLimits& limits = {}) const { rows(y, {&result, 1}, limits); }

    // The first samples of the texels in the rows from kBlockRows * block on. May be called from several threads.
    static constexpr int kBlockRows = 8;
    int blocks() const { return (height_ + kBlockRows - 1) / kBlockRows; }
    void firsts(int block, UvFirsts& result) const;

    // Calls use for every triangle and row, block by block, within a block in the order of the triangles. The time does
    // not grow with the number of texels in a row.
    void eachSpan(const std::function<void(const UvSpan&)>& use) const;

private:
    struct TriangleCopy { // a copy of a triangle in the repeated image
        std::uint32_t triangle;
        glm::ivec2 tile;
    };
    struct Drawn { // the copy in texels of the image, with positive area
        std::uint32_t triangle;
        glm::dvec2 corner[3];
        bool mirrored;          // corners 1 and 2 are exchanged
        glm::ivec2 first, last; // columns and rows that it may touch
    };
    struct Weights;

    static bool covers(const Drawn& t, glm::dvec2 p);
    // First and last texel within `reach` of a triangle on the line y = py. low, high: where it begins and ends there.
    std::pair<int, int> span(const Drawn& t, double py, double reach, double& low, double& high) const;
    // The samples of rows of one block.
    void rowsOfBlock(int first, std::span<UvRow> results, const UvLimits& limits) const;
    // Call emit(x, sample) for each texel of row y. full, taken: texels to skip; full may be null.
    template<class Emit> void scanCentres(const Drawn& t, int y, const std::uint8_t* full, const Emit& emit) const;
    template<class Emit> void scanTouching(const Drawn& t, int y, const std::uint8_t* taken, const Emit& emit) const;
    // Calls use(copy, drawn) for every copy of a triangle that may touch a texel, in order.
    template<class Use> void eachCopy(glm::ivec2 tile, bool wrap, const Use& use) const;
    Drawn inTexels(const TriangleCopy& copy, const glm::dvec2 (&uv)[3], double area) const;
    Drawn inTexels(const TriangleCopy& copy) const;
    // The copies of triangles in a block, in order.
    std::span<const TriangleCopy> copiesIn(int block) const
    {
        const std::size_t from = blockFirst_[std::size_t(block)], to = blockFirst_[std::size_t(block) + 1];
        return {copies_.data() + from, to - from};
    }

    UvTriangles triangles_;
    int width_, height_;
    std::vector<std::size_t> blockFirst_; // blocks + 1
    std::vector<TriangleCopy> copies_;
};

// About the number of rows of texels that the triangles touch, in all copies of a repeated image `height` texels high.
// The work of such a raster grows with this number and with that of its texels.
double rowsUnder(const UvTriangles& triangles, int height);

} // namespace cotan
