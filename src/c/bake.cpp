// cotan.h: baking from arrays.
#include <array>
#include <cmath>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "call.hpp"
#include "cotan/bake/bake_model.hpp"
#include "meshes.hpp"
#include "pictures.hpp"

using namespace cotan;
using namespace cotan::c;

namespace {

// One mesh in a scene of its own, at these positions, 3 for each vertex.
Scene sceneOf(const cotan_mesh& m, const float* positions)
{
    Mesh mesh;
    for (std::size_t v = 0; v < m.vertex_count; ++v) {
        mesh.positions.emplace_back(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
        mesh.normals.emplace_back(m.normals[3 * v], m.normals[3 * v + 1], m.normals[3 * v + 2]);
        if (m.texcoords)
            mesh.texcoords[0].emplace_back(m.texcoords[2 * v], m.texcoords[2 * v + 1]);
    }
    mesh.indices.assign(m.indices, m.indices + m.index_count);
    Scene scene;
    scene.materials.resize(1);
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({});
    return scene;
}

BakeKind kindOf(std::string_view wanted)
{
    constexpr std::array<std::pair<std::string_view, BakeKind>, 4> kKinds = {{{"normal", BakeKind::normal},
                                                                              {"object-normal", BakeKind::objectNormal},
                                                                              {"height", BakeKind::height},
                                                                              {"occlusion", BakeKind::occlusion}}};
    for (const auto& [name, kind] : kKinds)
        if (name == wanted)
            return kind;
    fail(ErrorKind::usage,
         "options.kind: expected normal, object-normal, height or occlusion, found '" + std::string(wanted) + "'");
}

BakeModelOptions bakeOptionsOf(const cotan_bake_options& o, const cotan_picture& map)
{
    BakeModelOptions options;
    const std::string_view frame = o.frame ? o.frame : "cotangent";
    const auto known = frameFromName(frame);
    if (!known)
        fail(ErrorKind::usage, "options.frame: there is none named '" + std::string(frame) + "'");
    require(std::isfinite(o.max_distance) && o.max_distance >= 0, "options.max_distance: expected 0 or more");
    require(std::isfinite(o.cage_reach) && o.cage_reach >= 0, "options.cage_reach: expected 0 or more");
    require(o.threads >= 0, "options.threads: expected 0 or more");
    require(o.padding >= -1, "options.padding: expected -1 or more");
    require(o.occlusion_rays >= 0 && o.occlusion_rays <= 1 << 16, "options.occlusion_rays: expected 0 to 65536");
    BakeOptions& b = options.bake;
    b.kind = kindOf(o.kind ? o.kind : "normal");
    b.frame = *known;
    b.width = map.width;
    b.height = map.height;
    b.samples = o.samples != 0 ? o.samples : 1;
    b.maxDistance = o.max_distance;
    b.cageReach = o.cage_reach;
    b.occlusionRays = o.occlusion_rays != 0 ? o.occlusion_rays : 64;
    b.threads = o.threads;
    options.tangents = TangentOrigin::generated;
    options.padding = o.padding;
    options.stored.type = typeOf(map, "map");
    options.stored.dither = o.dither != 0;
    options.stored.format = storableAs(o.convention ? o.convention : "gltf", "options.convention", options.stored.type);
    return options;
}

} // namespace

cotan_status cotan_bake(const cotan_mesh* low, const cotan_mesh* high, const cotan_bake_options* options,
                        cotan_picture* map, cotan_bake_result* result, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const cotan_mesh &simple = checkedMesh(low, "low", true), &detailed = checkedMesh(high, "high", false);
        const cotan_picture& out = checkedPicture(map, "map");
        const cotan_bake_options o = optionsOf(options, "options", offsetof(cotan_bake_options, cage));
        if (result)
            checked(result, "result");
        HighModel model;
        model.scenes.push_back(sceneOf(detailed, detailed.positions));
        BakeModelOptions wanted = bakeOptionsOf(o, out);
        const Scene around = o.cage ? sceneOf(simple, o.cage) : Scene{};
        wanted.cage = o.cage ? &around : nullptr;
        const BakedModel baked = valueOf(
            bakeModel(sceneOf(simple, simple.positions), std::move(model), wanted, progressOf(o.progress, o.user)));
        put(baked.maps[0].image, out);
        if (result) {
            const BakeStatistics& s = baked.maps[0].statistics;
            *result = {result->size, s.texels, s.covered, s.missed, s.negative, s.twice, s.rays, s.rayDistance};
        }
    });
}
