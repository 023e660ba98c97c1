#include "by_mesh.hpp"

#include <atomic>
#include <vector>

#include <glm/geometric.hpp>

#include "bake/bake_surfaces.hpp"
#include "bake/surface/low_surface.hpp"
#include "bake/surface/uv_raster.hpp"
#include "cotan/model.hpp"
#include "maps/texels.hpp"

namespace cotan::maps {

namespace {

// A direction of picture space and a frame's coefficients differ by the way of green: v runs down the picture.
glm::dvec3 upsideDown(const glm::dvec3& v) { return {v.x, -v.y, v.z}; }

glm::vec3 turned(const glm::vec3& n, const CotangentFrame<double>& frame, bool fromObject)
{
    const glm::dvec3 unit = glm::normalize(glm::dvec3(n));
    return fromObject ? glm::vec3(upsideDown(encode(frame, Covector3d(unit))))
                      : glm::vec3(perturb(frame, upsideDown(unit)).raw());
}

// Every component by its convention, dithered if asked for.
Image stored(const Baked& values, const RecodeSettings& s, std::size_t& clamped)
{
    Image out = makeImage(values.width, values.height, s.type);
    std::vector<glm::vec4> row(std::size_t(values.width));
    const bool tangent = s.to.kind != MapKind::objectSpace;
    for (int y = 0; y < values.height; ++y) {
        for (std::size_t x = 0; x < row.size(); ++x) {
            const glm::vec3 n = values.values[std::size_t(y) * row.size() + x];
            clamped += tangent && n.z < 0 && s.to.channels != Channels::xyz;
            row[x] = encodeTexel(n, s.to, s.type);
        }
        if (s.dither)
            ditherRow(row, s.type, y);
        storeRow(out, y, row);
    }
    return out;
}

} // namespace

Result<Image> throughMesh(const Image& map, const RecodeSettings& s, const MeshOfMap& mesh, const Progress& progress,
                          RecodeCounts& counts, std::size_t& shown)
{
    LoadLimits limits;
    limits.pixels = Pixels::none;
    limits.up = mesh.up;
    const auto scene = loadScene(mesh.file, limits);
    if (!scene)
        return scene.error();
    const auto surface = makeLowSurface(*scene, mesh.material, mesh.frame, mesh.tangents);
    if (!surface)
        return surface.error();
    const UvRaster raster({surface->texcoords, surface->indices}, map.width, map.height);
    const bool fromObject = s.from.kind == MapKind::objectSpace;
    Baked values{map.width,
                 map.height,
                 std::vector<glm::vec3>(map.pixelCount(), glm::vec3(0)),
                 std::vector<std::uint8_t>(map.pixelCount(), 0),
                 {}};
    std::atomic<std::size_t> invalid = 0, found = 0;
    CountedSteps rows(progress, std::size_t(map.height));
    forRowBands(map.height, [&](int first, int last) {
        UvRow places;
        std::vector<glm::vec3> normals(std::size_t(map.width));
        for (int y = first; y < last && !rows.stopped(); ++y) {
            raster.row(y, places, {.most = 1});
            decodeRow(map, y, s.from, normals);
            for (std::size_t x = 0; x < normals.size(); ++x) {
                if (places.of(x).empty())
                    continue;
                const UvSample& place = places.of(x).front();
                ++found;
                const std::size_t at = std::size_t(y) * normals.size() + x;
                const LowPoint p = pointOf(*surface, place.triangle, double(place.b1), double(place.b2));
                if (normals[x] == glm::vec3(0)) { // no direction: that of the surface
                    ++invalid;
                    values.values[at] = fromObject ? glm::vec3(0, 0, 1) : glm::vec3(p.normal);
                } else {
                    values.values[at] = turned(normals[x], p.frame, fromObject);
                }
                values.states[at] = texelCovered;
            }
            rows.step();
        }
    });
    if (rows.stopped())
        return stoppedError();
    shown = found;
    counts = {invalid, 0};
    padCharts(values, 0);
    return stored(values, s, counts.clamped);
}

} // namespace cotan::maps
