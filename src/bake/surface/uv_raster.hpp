// Which triangles a texel shows, and where on them.
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
    std::span<const std::uint32_t> indices; // three a triangle, each inside texcoords
    glm::vec2 scale{1, 1};                  // of the texcoords
};

// A point of a triangle: corner 0 + (corner 1 - corner 0) * b1 + (corner 2 - corner 0) * b2.
struct UvSample {
    std::uint32_t triangle = 0;
    float b1 = 0, b2 = 0;
    bool covers = false; // the triangle covers the texel's centre; otherwise it only touches the texel, and
                         // the place is its point nearest to the centre, a ten-thousandth of the way to the middle
                         // of the triangle inside its edge
};

// What the raster works with. It stays with the result, so that a result that is used again takes no new memory.
template<class Texel> struct UvScratch {
    std::vector<std::pair<Texel, UvSample>> found; // in the order in which they were found
    std::vector<std::uint8_t> taken, twice;        // texels that have their place, and those that have two
    std::vector<std::uint32_t> next;               // where in the result the next of a group goes
    std::vector<std::uint32_t> orders, sorted;     // number of the triangle, beside `found` and beside the result
};

// The places of each texel of a row, one texel after the other.
template<class Place> struct PlacesOfRow {
    std::vector<std::uint32_t> first; // width + 1: where those of a texel begin
    std::vector<Place> places;

    std::span<const Place> of(std::size_t x) const
    {
        return std::span(places).subspan(first[x], first[x + 1] - first[x]);
    }
};

// Of a texel in the order of the triangles: those that cover its centre; where there is none, those that come within
// half a texel's diagonal of it. Triangles that share an edge never both cover a centre on it.
struct UvRow : PlacesOfRow<UvSample> {
    UvScratch<int> scratch; // no part of the result
};

// Which places of a texel are wanted, where not all are.
struct UvFew {
    std::size_t most = SIZE_MAX; // of each texel, at least 1; of more, some that are spread over the list of triangles;
                                 // of 1 the first
    std::function<bool(const UvSample&)> counts{}; // others are left out; may be empty: all count
};

// Texels of a row whose centres a triangle covers, `last` included.
struct UvSpan {
    std::uint32_t triangle = 0;
    int y = 0, first = 0, last = 0;
};

// The texels of a block of rows that show something, each with one place: that of the first triangle that covers its
// centre; where there is none, of the first that comes within half a texel's diagonal of it. They come square by square
// of 4 x 4, so that sixteen in a row are close to one another, and in a square triangle by triangle.
struct UvFirsts {
    std::vector<glm::ivec2> texels; // beside places
    std::vector<UvSample> places;
    std::vector<glm::ivec2> again; // texels whose centre another triangle covers too, once
    UvScratch<glm::ivec2> scratch; // no part of the result
};

// The texels of an image under a layout of uv. Keeps, per block of rows, a list of the triangles that
// may touch it: some 20 bytes a triangle of the size of a texel. The arrays of UvTriangles must outlive it. Triangles
// without area in uv, or with uv that are not finite or further than 1e6 from zero, touch nothing.
class UvRaster {
public:
    // tile: which unit square of uv the image shows ((0,0) for ordinary layouts; UDIM 1001 + u + 10 v).
    // wrap: uv outside the unit square show the image repeated; then every triangle is shown in all places, whatever
    // the tile; one that has room for 4 by 4 whole copies in its inscribed circle in 16 of them, evenly chosen.
    UvRaster(const UvTriangles& triangles, int width, int height, glm::ivec2 tile = {0, 0}, bool wrap = false);

    // The places of the rows from `first` on, 0 at the top, one for each of `results`. May be called from several
    // threads. With few.most it takes time for each triangle that is in a block of rows, but not for each of its
    // texels.
    void rows(int first, std::span<UvRow> results, const UvFew& few = {}) const;
    void row(int y, UvRow& result, const UvFew& few = {}) const { rows(y, {&result, 1}, few); }

    // The first places of the texels in rows from kBlockRows * block on. May be called from several threads.
    static constexpr int kBlockRows = 8;
    int blocks() const { return (height_ + kBlockRows - 1) / kBlockRows; }
    void firsts(int block, UvFirsts& result) const;

    // Calls use for every triangle and row, block by block, in each in the order of the triangles. Takes no time for
    // texels.
    void eachSpan(const std::function<void(const UvSpan&)>& use) const;

private:
    struct Listed { // a triangle in one of the places where the repeated image shows it
        std::uint32_t triangle;
        glm::ivec2 tile;
    };
    struct Shown { // the same as it lies on the image, in texels, counter-clockwise for y downwards
        std::uint32_t triangle;
        glm::dvec2 corner[3];
        bool mirrored;          // corners 1 and 2 are exchanged
        glm::ivec2 first, last; // columns and rows that it may touch
    };
    struct Weights;

    static bool covers(const Shown& t, glm::dvec2 p);
    // The texels of the line py that a triangle may reach, and where it begins and ends on it.
    std::pair<int, int> span(const Shown& t, double py, double reach, double& low, double& high) const;
    // The places of rows of one block.
    void rowsOfBlock(int first, std::span<UvRow> results, const UvFew& few) const;
    // Call emit(x, place) for each texel of the row y. full, taken: texels that are not asked about; full null: none.
    template<class Emit> void scanCentres(const Shown& t, int y, const std::uint8_t* full, const Emit& emit) const;
    template<class Emit> void scanTouching(const Shown& t, int y, const std::uint8_t* taken, const Emit& emit) const;
    // Calls use(listed, shown) for every triangle and place that may touch a texel, in order.
    template<class Use> void eachPlace(glm::ivec2 tile, bool wrap, const Use& use) const;
    Shown shownAt(const Listed& listed, const glm::dvec2 (&uv)[3], double area) const;
    Shown shownAt(const Listed& listed) const;
    // The triangles of a block, in order.
    std::span<const Listed> listedIn(int block) const
    {
        const std::size_t from = blockFirst_[std::size_t(block)], to = blockFirst_[std::size_t(block) + 1];
        return {listed_.data() + from, to - from};
    }

    UvTriangles triangles_;
    int width_, height_;
    std::vector<std::size_t> blockFirst_; // blocks + 1
    std::vector<Listed> listed_;
};

// About how many rows of texels the triangles are in, in all copies of a repeated image that is so many texels high:
// what the work of such a raster grows with, besides its texels.
double rowsUnder(const UvTriangles& triangles, int height);

} // namespace cotan
