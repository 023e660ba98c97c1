#include "tangents_mesh.hpp"

#include <algorithm>
#include <array>
#include <atomic>

namespace cotan::tangents {

bool usable(const MeshView& mesh, std::size_t threads)
{
    const std::size_t count = mesh.positions.size();
    if (mesh.normals.size() != count || mesh.texcoords.size() != count || mesh.indices.size() % 3 != 0
        || mesh.indices.size() >= kNone || count >= kNone)
        return false;
    std::atomic<bool> inRange{true};
    runParts(mesh.indices.size(), threads, [&](std::size_t begin, std::size_t end) {
        const auto part = mesh.indices.subspan(begin, end - begin);
        if (!std::all_of(part.begin(), part.end(), [count](std::uint32_t i) { return i < count; }))
            inRange = false;
    });
    return inRange;
}

LargeArray<std::uint32_t> weld(const MeshView& mesh, std::size_t threads, const Task& sideTask)
{
    const auto key = [&](std::uint32_t i) {
        const glm::vec3 p = mesh.positions[i], n = mesh.normals[i];
        const glm::vec2 t = mesh.texcoords[i];
        return std::array{bitsOf(p.x), bitsOf(p.y), bitsOf(p.z), bitsOf(n.x),
                          bitsOf(n.y), bitsOf(n.z), bitsOf(t.x), bitsOf(t.y)};
    };
    return firstEqual(static_cast<std::uint32_t>(mesh.positions.size()), key, threads, sideTask);
}

} // namespace cotan::tangents
