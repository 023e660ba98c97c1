// Second step of MikkTSpace: which corners meet at a vertex, and which of those are neighbours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mikktspace_triangles.hpp"

namespace cotan::mikktspace {

using tangents::kNone;

// The corners at each welded vertex, in order; those of degenerate triangles are left out.
struct CornersAt {
    LargeArray<std::uint32_t> first; // per vertex; kNone: it has none
    LargeArray<std::uint32_t> next;  // per corner; kNone: it is its vertex's last

    // Into `corners`, as far as they fit. Returns the first that does not fit, or kNone.
    std::uint32_t list(std::size_t vertex, std::span<std::uint32_t> corners, std::uint32_t& count) const
    {
        std::uint32_t c = first[vertex];
        for (count = 0; c != kNone && count < corners.size(); c = next[c])
            corners[count++] = c;
        return c;
    }

    // All of them.
    void list(std::size_t vertex, std::vector<std::uint32_t>& corners) const
    {
        corners.clear();
        for (std::uint32_t c = first[vertex]; c != kNone; c = next[c])
            corners.push_back(c);
    }
};

// Memory for that, without corners yet.
CornersAt noCorners(const MeshView& mesh);

void addCorners(const Triangles& t, std::size_t threads, CornersAt& at);

// Which of the corners at one vertex are neighbours: across the edge that leaves the vertex at corner i,
// and across the one that comes back to it, is the corner left[i], right[i]; kNone where there is none.
// As indices into the list of corners. Of the edges between the same two vertices the k-th that runs one
// way meets the k-th that runs the other way.
struct Ring {
    std::vector<std::uint32_t> left, right;

    void make(const Triangles& t, std::span<const std::uint32_t> corners);

private:
    std::uint32_t count = 0;                    // of corners; the lists are as long as the longest needed so far
    std::vector<std::uint32_t> leaving, coming; // the edges' other vertices
    std::vector<std::uint32_t> byLeaving, byComing;
    std::vector<std::uint64_t> keys; // another vertex, and the corner below it

    void pair();
};

// The corners that hang together with `seed`, as far as take(corner) says yes: it is asked for each in
// order, to the left first, and says no to a neighbour that is none.
template<class List, class Take> void walk(std::uint32_t seed, const List& left, const List& right, const Take& take)
{
    for (std::uint32_t i = seed; take(i);)
        i = left[i];
    for (std::uint32_t i = right[seed]; take(i);)
        i = right[i];
}

} // namespace cotan::mikktspace
