#include "mesh_weld.hpp"

#include <bit>
#include <cstdint>
#include <cstring>

namespace cotan {

namespace {

using Index = std::uint32_t;

// Calls f with each attribute array that the mesh has.
template<class M, class F> void eachAttribute(M& mesh, F f)
{
    const auto call = [&](auto& attribute) {
        if (!attribute.empty())
            f(attribute);
    };
    call(mesh.positions);
    call(mesh.normals);
    call(mesh.tangents);
    call(mesh.texcoords[0]);
    call(mesh.texcoords[1]);
    call(mesh.colors);
    call(mesh.cotangentsU);
    call(mesh.cotangentsV);
}

std::uint64_t hashVertex(const Mesh& mesh, Index vertex)
{
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    eachAttribute(mesh, [&](const auto& attribute) {
        const auto& value = attribute[vertex];
        for (int c = 0; c < value.length(); ++c) {
            hash = (hash ^ std::bit_cast<std::uint32_t>(value[c])) * 0xff51afd7ed558ccdu;
            hash ^= hash >> 32;
        }
    });
    return hash;
}

bool equalVertices(const Mesh& mesh, Index a, Index b)
{
    bool equal = true;
    eachAttribute(mesh, [&](const auto& attribute) {
        equal = equal && std::memcmp(&attribute[a], &attribute[b], sizeof attribute[a]) == 0;
    });
    return equal;
}

} // namespace

void weldVertices(Mesh& mesh)
{
    constexpr Index kNone = ~Index(0);
    std::vector<Index> table(std::bit_ceil(mesh.vertexCount() * 2 + 1), kNone); // open addressing
    std::vector<Index> newIndex(mesh.vertexCount(), kNone);                     // of the first of equal vertices
    std::vector<Index> kept;                                                    // old index of every new vertex
    for (Index& index : mesh.indices) {
        std::size_t slot = hashVertex(mesh, index) & (table.size() - 1);
        while (table[slot] != kNone && !equalVertices(mesh, table[slot], index))
            slot = (slot + 1) & (table.size() - 1);
        if (table[slot] == kNone) {
            table[slot] = index;
            newIndex[index] = Index(kept.size());
            kept.push_back(index);
        }
        index = newIndex[table[slot]];
    }
    eachAttribute(mesh, [&](auto& attribute) {
        std::remove_reference_t<decltype(attribute)> packed;
        packed.reserve(kept.size());
        for (const Index old : kept)
            packed.push_back(attribute[old]);
        attribute = std::move(packed);
    });
}

} // namespace cotan
