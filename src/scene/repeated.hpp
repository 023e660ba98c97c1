// Triangles that lie exactly on others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

namespace cotan {

struct CornersOfTriangle {
    std::array<glm::vec3, 3> at{};
    std::int64_t key = 0; // what else has to be equal
};

// The triangles that were seen, by their hash; at most `most`.
class KnownTriangles {
public:
    explicit KnownTriangles(std::size_t most);

    // How often it was seen before, at most 2.
    std::uint8_t see(const CornersOfTriangle& triangle);

private:
    std::vector<CornersOfTriangle> known_;
    std::vector<std::uint8_t> times_;  // how often each was seen, at most 2
    std::vector<std::uint32_t> table_; // numbers of known_ from 1 on; 0 where none is
};

// How many earlier ones have the corners of each of so many triangles, in the same order: 0, 1, or 2 for more. Empty
// where few repeat, by a sample of them: then nobody waits for an answer about all. Whatever looks at all triangles of
// a place takes a thousand times as long where a thousand lie on one another.
std::vector<std::uint8_t> repeatedTriangles(std::size_t count,
                                            const std::function<CornersOfTriangle(std::size_t)>& triangle);

} // namespace cotan
