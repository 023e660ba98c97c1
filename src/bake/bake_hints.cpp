#include "bake/bake_hints.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/geometry.hpp"
#include "scene/hard_edges.hpp"
#include "scene/parts.hpp"

namespace cotan {

namespace {

constexpr float kFlat = 1e-3f;    // of the tile's size, and of one tile in uv
constexpr float kReach = 0.1f;    // of the tile: how far beyond its borders copies are kept
constexpr float kCrosses = 0.01f; // of the tile: less is no part that crosses the border

// Coordinates in which the tile is the unit square.
glm::vec2 inTile(const FlatTile& tile, glm::vec3 p)
{
    const glm::vec3 n = glm::cross(tile.along, tile.across), d = p - tile.corner;
    const float area2 = glm::dot(n, n);
    return {glm::dot(glm::cross(d, tile.across), n) / area2, glm::dot(glm::cross(tile.along, d), n) / area2};
}

float diagonalOf(const std::vector<glm::vec3>& positions)
{
    Bounds box = emptyBounds();
    for (const glm::vec3& p : positions)
        box = {glm::min(box.low, p), glm::max(box.high, p)};
    return glm::length(box.high - box.low);
}

// The line about the borders of a tile: something crosses one, and nothing comes in at the opposite one.
std::string crossing(const FlatTile& tile, const Bounds& high)
{
    glm::vec2 first(1e30f), last(-1e30f);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec2 at =
            inTile(tile,
                   {(corner & 1) != 0 ? high.high.x : high.low.x, (corner & 2) != 0 ? high.high.y : high.low.y,
                    (corner & 4) != 0 ? high.high.z : high.low.z});
        first = glm::min(first, at);
        last = glm::max(last, at);
    }
    for (int k = 0; k < 2; ++k) {
        const float before = -first[k], behind = last[k] - 1;
        if ((before > kCrosses && std::abs(behind) < kFlat) || (behind > kCrosses && std::abs(before) < kFlat))
            return "options.wrap: the low mesh is one tile, and the high mesh crosses one of its borders only: with "
                   "it, what leaves there comes in at the opposite border";
    }
    return {};
}

} // namespace

std::optional<FlatTile> flatTileOf(const LowSurface& low)
{
    glm::vec2 first(1e30f), last(-1e30f);
    double area = 0;
    std::optional<FlatTile> tile;
    for (std::size_t f = 0; f < low.triangleCount(); ++f) {
        const std::uint32_t* const c = &low.indices[3 * f];
        const glm::vec2 u = low.texcoords[c[0]], du1 = low.texcoords[c[1]] - u, du2 = low.texcoords[c[2]] - u;
        const glm::vec3 p = low.positions[c[0]], e1 = low.positions[c[1]] - p, e2 = low.positions[c[2]] - p;
        const float det = du1.x * du2.y - du1.y * du2.x;
        area += std::abs(double(det)) / 2;
        for (std::size_t k = 0; k < 3; ++k) {
            first = glm::min(first, low.texcoords[c[k]]);
            last = glm::max(last, low.texcoords[c[k]]);
        }
        if (!tile && det != 0) {
            tile = FlatTile{{}, (e1 * du2.y - e2 * du1.y) / det, (e2 * du1.x - e1 * du2.x) / det};
            tile->corner = p - tile->along * u.x - tile->across * u.y;
        }
    }
    const glm::vec2 whole = glm::round(first);
    if (!tile || std::abs(area - 1) > kFlat || glm::length(first - whole) > kFlat
        || glm::length(last - whole - 1.0f) > kFlat || glm::length(glm::cross(tile->along, tile->across)) == 0)
        return {};
    const float size = glm::length(tile->along) + glm::length(tile->across);
    for (const std::uint32_t v : low.indices)
        if (const glm::vec2 u = low.texcoords[v];
            glm::length(low.positions[v] - (tile->corner + tile->along * u.x + tile->across * u.y)) > kFlat * size)
            return {};
    tile->corner += tile->along * whole.x + tile->across * whole.y;
    return tile;
}

void repeatAround(const FlatTile& tile, HighModel& high)
{
    for (Scene& scene : high.scenes) {
        const std::vector<Instance> given = scene.instances;
        for (const Instance& instance : given) {
            std::vector<glm::vec2> at;
            for (const glm::vec3& p : scene.meshes[std::size_t(instance.mesh)].positions)
                at.push_back(inTile(tile, glm::vec3(instance.toWorld * glm::vec4(p, 1))));
            for (int x = -1; x <= 1; ++x)
                for (int y = -1; y <= 1; ++y) {
                    if (x == 0 && y == 0)
                        continue;
                    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
                    const glm::vec2 begin = -kReach - glm::vec2(x, y), end = 1 + kReach - glm::vec2(x, y); // unmoved
                    std::vector<std::uint32_t> near;
                    for (std::size_t f = 0; f < mesh.triangleCount(); ++f) {
                        const std::uint32_t* const c = &mesh.indices[3 * f];
                        const glm::vec2 from = glm::min(at[c[0]], glm::min(at[c[1]], at[c[2]])),
                                        to = glm::max(at[c[0]], glm::max(at[c[1]], at[c[2]]));
                        if (from.x <= end.x && from.y <= end.y && to.x >= begin.x && to.y >= begin.y)
                            near.push_back(std::uint32_t(f));
                    }
                    if (near.empty())
                        continue;
                    Instance copy = instance;
                    const glm::vec3 step = tile.along * float(x) + tile.across * float(y);
                    copy.toWorld = glm::translate(glm::mat4(1), step) * instance.toWorld;
                    copy.mesh = int(scene.meshes.size());
                    scene.meshes.push_back(trianglesOfMesh(mesh, near));
                    scene.instances.push_back(std::move(copy));
                }
        }
    }
}

bool seemExchanged(std::size_t lowTriangles, std::size_t highTriangles) { return 8 * highTriangles < lowTriangles; }

std::vector<std::string> bakeHints(const LowSurface& low, const HighSurface& high, const BakeModelOptions& options,
                                   const std::vector<BakeKind>& kinds)
{
    std::vector<std::string> lines;
    const double simple = double(diagonalOf(low.positions)),
                 detailed = double(glm::length(high.box().high - high.box().low));
    for (const double factor : {100.0, 1000.0})
        for (const bool larger : {true, false})
            if (const double times = larger ? detailed / simple : simple / detailed;
                times > factor / 1.4 && times < factor * 1.4)
                lines.push_back(fmt::format("the {} mesh is about {:g} times as large as the {} one ({:.3g} and {:.3g} "
                                            "units): export both in the same unit, metres or {}",
                                            larger ? "high" : "low", factor, larger ? "low" : "high",
                                            std::max(detailed, simple), std::min(detailed, simple),
                                            factor < 1000 ? "centimetres" : "millimetres"));
    if (!options.ownMaps && std::ranges::any_of(kinds, showsNormals)
        && seemExchanged(low.triangleCount(), high.triangleCount()))
        lines.push_back(fmt::format("the high mesh has {} triangles and the low one {}: exchange the two files if they "
                                    "are mixed up",
                                    high.triangleCount(), low.triangleCount()));
    if (std::ranges::any_of(kinds, [](BakeKind kind) { return kind == BakeKind::normal; }))
        if (const std::size_t hard = unsplitHardEdges(low.positions, low.normals, low.texcoords, low.indices); hard > 0)
            lines.push_back(fmt::format("{} {}", hard, kHardEdgeAdvice));
    std::size_t outside = 0;
    std::vector<int> others = tilesOf(low, &outside);
    const bool bakesOne = options.tiles.empty() && std::erase(others, kFirstUdim) > 0; // else nothing is found
    constexpr std::size_t kShown = 8;
    if (bakesOne && !others.empty())
        lines.push_back(fmt::format("options.tiles: the low mesh also has triangles on tiles {}{}: they are not baked",
                                    fmt::join(std::span(others).first(std::min(others.size(), kShown)), ", "),
                                    others.size() > kShown ? ", ..." : ""));
    if (outside > 0)
        lines.push_back(
            fmt::format("{} of {} triangles of the low mesh lie at least in part outside of the tiles {} to "
                        "{}: nothing is baked for them there",
                        outside, low.triangleCount(), kFirstUdim, kLastUdim));
    if (const auto tile = options.wrap ? std::nullopt : flatTileOf(low))
        if (std::string line = crossing(*tile, high.box()); !line.empty())
            lines.push_back(std::move(line));
    return lines;
}

} // namespace cotan
