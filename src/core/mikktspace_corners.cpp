#include <algorithm>
#include <utility>

#include "mikktspace.hpp"

namespace cotan::mikktspace {

void addCorners(const Triangles& t, std::size_t threads, CornersAt& at)
{
    const std::size_t vertices = t.mesh.positions.size();
    // Each thread writes the corners of its own vertices, from the last, and reads the blocks that have such.
    runTasks(threads, threads, [&](std::size_t part) {
        const std::size_t begin = partBegin(vertices, part, threads);
        const std::size_t size = partBegin(vertices, part + 1, threads) - begin;
        for (std::size_t block = t.ranges.size(); block-- > 0;) {
            const VertexRange range = t.ranges[block];
            if (range.least >= begin + size || range.most < begin)
                continue;
            for (std::size_t f = std::min((block + 1) * kBlock, t.count); f-- > block * kBlock;)
                if (!t.has(f, kDegenerate))
                    for (std::size_t c = 3 * f + 3; c-- > 3 * f;)
                        if (const std::size_t v = t.vertices[c]; v - begin < size)
                            at.next[c] = std::exchange(at.first[v], static_cast<std::uint32_t>(c));
        }
    });
}

void Ring::make(const Triangles& t, std::span<const std::uint32_t> corners)
{
    const auto count = static_cast<std::uint32_t>(corners.size());
    if (left.size() < count)
        for (auto* list : {&leaving, &coming, &left, &right})
            list->resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        leaving[i] = t.vertices[nextCorner(corners[i])];
        coming[i] = t.vertices[previousCorner(corners[i])];
        left[i] = right[i] = kNone;
    }
    const auto sorted = [&](const std::vector<std::uint32_t>& others, std::vector<std::uint32_t>& order) {
        keys.resize(count);
        order.resize(count);
        for (std::uint32_t i = 0; i < count; ++i)
            keys[i] = std::uint64_t(others[i]) << 32 | i;
        std::sort(keys.begin(), keys.end());
        std::transform(keys.begin(), keys.end(), order.begin(), [](std::uint64_t key) { return std::uint32_t(key); });
    };
    sorted(leaving, byLeaving);
    sorted(coming, byComing);
    for (std::size_t i = 0, j = 0; i < byLeaving.size() && j < byComing.size();) {
        const std::uint32_t a = leaving[byLeaving[i]], b = coming[byComing[j]];
        if (a == b) {
            left[byLeaving[i]] = byComing[j];
            right[byComing[j]] = byLeaving[i];
        }
        i += a <= b;
        j += b <= a;
    }
}

} // namespace cotan::mikktspace
