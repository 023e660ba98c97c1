#include "by_mesh.hpp"

#include <algorithm>
#include <atomic>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "bake/bake_surfaces.hpp"
#include "bake/surface/low_surface.hpp"
#include "bake/surface/uv_raster.hpp"
#include "core/loops.hpp"
#include "core/try.hpp"
#include "cotan/model.hpp"
#include "maps/texels.hpp"

namespace cotan::app {

using namespace maps;

namespace {

// Converts between image space, where v runs down, and frame coefficients, where green runs up.
glm::dvec3 flipY(const glm::dvec3& v) { return {v.x, -v.y, v.z}; }

glm::vec3 transformed(const glm::vec3& n, const CotangentFrame<double>& frame, bool fromObject)
{
    const glm::dvec3 unit = glm::normalize(glm::dvec3(n));
    return fromObject ? glm::vec3(flipY(encode(frame, Covector3d(unit))))
                      : glm::vec3(perturb(frame, flipY(unit)).raw());
}

// Stores every component by the convention, dithered if requested.
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

Result<Image> recodeByMesh(const Image& map, const RecodeSettings& s, const MeshOfMap& mesh, const Progress& progress,
                           RecodeCounts& counts, std::size_t& covered)
{
    LoadLimits limits;
    limits.pixels = Pixels::none;
    limits.up = mesh.up;
    COTAN_TRY(scene, loadScene(mesh.file, limits));
    COTAN_TRY(surface, makeLowSurface(*scene, mesh.material, mesh.frame, mesh.tangents));
    const auto indices = indicesToDraw(*surface, {map.width, map.height});
    if (!indices)
        return inputError(mesh.file.string() + ": " + indices.error().message);
    const UvRaster raster({surface->texcoords, *indices}, map.width, map.height);
    const bool fromObject = s.from.kind == MapKind::objectSpace;
    Baked values{map.width,
                 map.height,
                 std::vector<glm::vec3>(map.pixelCount(), glm::vec3(0)),
                 std::vector<std::uint8_t>(map.pixelCount(), 0),
                 {}};
    const auto width = std::size_t(map.width);
    std::atomic<std::size_t> invalid = 0, found = 0;
    CountedSteps blocks(progress, std::size_t(raster.blocks()));
    parallelRanges(0, raster.blocks(), 1, [&](int begin, int end) {
        UvFirsts firsts;
        std::vector<glm::vec3> normals(width * UvRaster::kBlockRows);
        for (int block = begin; block < end && !blocks.stopped(); ++block) {
            raster.firsts(block, firsts);
            const int top = block * UvRaster::kBlockRows, bottom = std::min(top + UvRaster::kBlockRows, map.height);
            for (int y = top; y < bottom; ++y)
                decodeRow(map, y, s.from, std::span(normals).subspan(std::size_t(y - top) * width, width));
            found += firsts.samples.size();
            for (std::size_t i = 0; i < firsts.samples.size(); ++i) {
                const UvSample& sample = firsts.samples[i];
                const std::size_t at = std::size_t(firsts.texels[i].y) * width + std::size_t(firsts.texels[i].x);
                const glm::vec3& normal = normals[at - std::size_t(top) * width];
                const LowPoint p = pointOf(*surface, sample.triangle, double(sample.b1), double(sample.b2));
                if (normal == glm::vec3(0)) { // no direction: use the surface normal
                    ++invalid;
                    values.values[at] = fromObject ? glm::vec3(0, 0, 1) : glm::vec3(p.normal);
                } else {
                    values.values[at] = transformed(normal, p.frame, fromObject);
                }
                values.states[at] = texelCovered;
            }
            blocks.step();
        }
    });
    if (blocks.stopped())
        return stoppedError();
    covered = found;
    counts = {invalid, 0};
    padCharts(values, 0);
    return stored(values, s, counts.clamped);
}

} // namespace cotan::app
