// Vertices and triangles numbered anew, so that every triangle owns its provoking vertex.
#include <map>

#include "edit_state.hpp"
#include "mesh.hpp"

namespace cotan {

using namespace gltf_edit;

namespace {

// What a primitive draws, as text: those that draw the same go on sharing it.
std::string drawnBy(const Json& primitive)
{
    Json drawn = Json::object();
    for (const char* const part : {"attributes", "indices", "mode", "targets"})
        drawn[part] = primitive.contains(part) ? primitive[part] : Json();
    return nlohmann::json(drawn).dump();
}

// The primitive with the vertices and triangles of `like`.
void drawAs(Json& primitive, const Json& like)
{
    for (const char* const part : {"attributes", "indices", "targets"})
        if (like.contains(part))
            primitive[part] = like[part];
    primitive.erase("mode");
}

// Nothing is changed where there are no triangles.
GltfProvoked provoke(GltfDocument& document, std::size_t m, std::size_t p, ProvokingVertex provoking)
{
    Json& primitive = rootOf(document)["meshes"][m]["primitives"][p];
    GltfProvoked done{.mesh = m, .primitive = p};
    if (!primitive["attributes"].contains("POSITION"))
        return done;
    const auto position = primitive["attributes"]["POSITION"].get<std::size_t>();
    const auto count = rootOf(document)["accessors"][position]["count"].get<std::size_t>();
    std::vector<std::uint32_t> corners = readTriangles(document, gltf::readPrimitive(primitive));
    if (corners.empty())
        return done;
    const std::vector<std::uint32_t> used = takeUsedVertices(corners, count);
    ProvokingMesh own = provokingMesh(corners, used.size(), provoking);
    for (std::uint32_t& source : own.sources)
        source = used[source];
    setTriangles(document, primitive, own.indices, own.sources.size());
    Renewed renewed; // of this primitive: vertex k belongs to its triangle k
    renewVertices(document, primitive, own.sources, renewed);
    noteCopied(document, primitive, primitiveField(m, p));
    done.triangles = corners.size() / 3;
    done.verticesBefore = used.size();
    done.verticesAfter = own.sources.size();
    return done;
}

} // namespace

Result<std::vector<GltfProvoked>> setGltfProvoking(GltfDocument& document, ProvokingVertex provoking)
{
    return caughtGltf(document.source->path, [&] {
        std::vector<GltfProvoked> all;
        std::map<std::string, Json> done; // by what a primitive drew what it draws now
        (void)forEachPrimitive(rootOf(document), [&](std::size_t m, std::size_t p) -> Status {
            Json& primitive = rootOf(document)["meshes"][m]["primitives"][p];
            const std::string drawn = drawnBy(primitive);
            if (const auto found = done.find(drawn); found != done.end()) {
                drawAs(primitive, found->second);
                return Done{};
            }
            const GltfProvoked row = provoke(document, m, p, provoking);
            if (row.triangles == 0)
                return Done{};
            done[drawn] = primitive;
            all.push_back(row);
            return Done{};
        });
        return all;
    });
}

} // namespace cotan
