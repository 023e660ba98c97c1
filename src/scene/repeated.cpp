#include "scene/repeated.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace cotan {

namespace {

constexpr std::size_t kAsked = 4096; // triangles of the sample
constexpr std::size_t kMany = 40;    // of these that repeat others of them

std::size_t hashOf(const CornersOfTriangle& triangle)
{
    std::uint64_t hash = (std::uint64_t(triangle.key) + 1) * 0x9e3779b97f4a7c15u;
    for (const glm::vec3& p : triangle.at)
        for (const float c : {p.x, p.y, p.z}) {
            hash = (hash ^ std::bit_cast<std::uint32_t>(c + 0.0f)) * 0xff51afd7ed558ccdu; // -0 is 0
            hash ^= hash >> 32;
        }
    return std::size_t(hash);
}

bool manyRepeat(std::size_t count, const std::function<CornersOfTriangle(std::size_t)>& triangle)
{
    const std::size_t asked = std::min(count, kAsked);
    KnownTriangles known(asked);
    std::size_t repeated = 0;
    for (std::size_t k = 0; k < asked; ++k)
        repeated += known.see(triangle(std::size_t(double(k) * double(count) / double(asked)))) > 0 ? 1 : 0;
    return repeated >= kMany;
}

} // namespace

KnownTriangles::KnownTriangles(std::size_t most) : table_(std::bit_ceil(2 * most + 1), 0) {}

std::uint8_t KnownTriangles::see(const CornersOfTriangle& triangle)
{
    const std::size_t last = table_.size() - 1;
    std::size_t at = hashOf(triangle) & last;
    for (; table_[at] != 0; at = (at + 1) & last)
        if (const CornersOfTriangle& k = known_[table_[at] - 1]; k.key == triangle.key && k.at == triangle.at)
            return std::exchange(times_[table_[at] - 1], std::uint8_t(2));
    known_.push_back(triangle);
    times_.push_back(1);
    table_[at] = std::uint32_t(known_.size());
    return 0;
}

std::vector<std::uint8_t> repeatedTriangles(std::size_t count,
                                            const std::function<CornersOfTriangle(std::size_t)>& triangle)
{
    if (!manyRepeat(count, triangle))
        return {};
    KnownTriangles known(count);
    std::vector<std::uint8_t> repeated(count);
    for (std::size_t i = 0; i < count; ++i)
        repeated[i] = known.see(triangle(i));
    return repeated;
}

} // namespace cotan
