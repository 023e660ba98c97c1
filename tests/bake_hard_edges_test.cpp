// Rays at hard edges: straight outside bands, and without gaps at the edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bake/bake_surfaces.hpp"
#include "bake/surface/uv_raster.hpp"
#include "bake_cases.hpp"

namespace cotan {
namespace {

constexpr BakeRays kWays[] = {BakeRays::automatic, BakeRays::averaged, BakeRays::straight};

struct EdgeBake {
    LowSurface low;
    Baked baked;
    std::vector<UvSample> at; // per texel; covers is false where none is covered
};

// Bakes low meshes that share a map.
EdgeBake bakeAtEdges(const std::vector<Mesh>& low, const Mesh& high, BakeKind kind, const BakeOptions& given, int size)
{
    auto surface = makeLowSurface(sceneOfMeshes(low), -1, Frame::cotangent, TangentOrigin::generated);
    auto detailed = HighSurface::make({sceneOfMeshes({high})}, 0);
    EXPECT_TRUE(surface && detailed);
    BakeOptions options = given;
    options.kind = kind;
    options.width = options.height = size;
    auto baked = bake(*surface, *detailed, options);
    EXPECT_TRUE(baked);
    EdgeBake result{std::move(*surface), std::move(*baked),
                    std::vector<UvSample>(std::size_t(size) * std::size_t(size))};
    const UvRaster raster({result.low.texcoords, result.low.indices}, size, size);
    UvRow row;
    for (int y = 0; y < size; ++y) {
        raster.row(y, row);
        for (int x = 0; x < size; ++x)
            for (const UvSample& sample : row.of(std::size_t(x)))
                result.at[std::size_t(y) * std::size_t(size) + std::size_t(x)] = sample;
    }
    return result;
}

// Calls check(texel, point, normal, value) for every covered texel.
using CheckTexel = std::function<void(std::size_t, glm::vec3, glm::vec3, glm::vec3)>;
void eachTexel(const EdgeBake& bake, const CheckTexel& check)
{
    for (std::size_t i = 0; i < bake.at.size(); ++i)
        if (const UvSample& s = bake.at[i]; s.covers) {
            const LowPoint p = pointOf(bake.low, s.triangle, double(s.b1), double(s.b2));
            check(i, glm::vec3(p.position), glm::vec3(p.normal), bake.baked.values[i]);
        }
}

BakeOptions along(BakeRays rays)
{
    BakeOptions options;
    options.samples = 1; // a texel has the value at its centre
    options.rays = rays;
    options.highNormals = HighNormals::face;
    return options;
}

void moveBy(Mesh& mesh, glm::vec3 by)
{
    for (glm::vec3& p : mesh.positions)
        p += by;
}

void addMesh(Mesh& to, const Mesh& from)
{
    const auto base = std::uint32_t(to.positions.size());
    to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
    to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
    to.texcoords[0].insert(to.texcoords[0].end(), from.texcoords[0].begin(), from.texcoords[0].end());
    for (const std::uint32_t i : from.indices)
        to.indices.push_back(base + i);
}

// ---- what maps show -------------------------------------------------------------------------

// Bakes two boxes with four bolts each, 3 m apart, whose charts are the halves of the map. Returns for each box the
// number of texels that do not show the bolts where they stand. reds: of the vertex colours of the boxes; empty: none.
std::array<int, 2> misplacedBolts(const BakeOptions& options, const std::vector<float>& reds = {})
{
    const float side = 3;
    std::vector<Mesh> low(2, bolts().low);
    Mesh high = bolts().high, second = high;
    moveBy(low[1], {0, side, 0});
    moveBy(second, {0, side, 0});
    addMesh(high, second);
    for (std::size_t i = 0; i < 2; ++i) {
        for (glm::vec2& uv : low[i].texcoords[0])
            uv.x = (uv.x + float(i)) / 2;
        if (!reds.empty())
            low[i].colors.assign(low[i].positions.size(), {reds[i], 0.5f, 0.5f, 1});
    }
    const float texel = 1 / (0.92f / 3 / 2 * 192); // of a side across the map
    const EdgeBake bake = bakeAtEdges(low, high, BakeKind::height, options, 192);
    std::array<int, 2> tops{}, wrong{};
    eachTexel(bake, [&](std::size_t, glm::vec3 p, glm::vec3 n, glm::vec3 value) {
        const std::size_t box = p.y > side / 2 ? 1 : 0;
        const float r =
            glm::length(glm::vec2(std::abs(p.y - side * float(box)) - kBoltOffset, std::abs(p.z) - kBoltOffset));
        if (n.x < 0.5f || std::abs(r - kBolt) < 0.01f * texel)
            return;
        const bool shown = std::abs(value.x - kBoltTop) < 1e-4f;
        tops[box] += shown;
        wrong[box] += shown != (r < kBolt);
    });
    for (const int shown : tops)
        EXPECT_GT(shown, 20);
    return wrong;
}

// Averaged rays converge on the middle of the box: each bolt is seen 1.14 times nearer to it, by a texel.
constexpr int kLeaning = 5; // misplaced texels, at least

TEST(HardEdges, boltsOnTwoBoxesAreWhereTheyStand)
{
    for (const int misplaced : misplacedBolts(along(BakeRays::automatic)))
        EXPECT_EQ(misplaced, 0);
    for (const int misplaced : misplacedBolts(along(BakeRays::averaged)))
        EXPECT_GT(misplaced, kLeaning);
}

TEST(HardEdges, aMaskMakesTheRaysOfOneBoxStraightAndOfTheOtherAveraged)
{
    for (const std::size_t straight : {0u, 1u}) {
        BakeOptions options = along(BakeRays::automatic);
        Image mask = makeImage(64, 2, PixelType::unorm8);
        for (std::size_t i = 0; i < mask.pixelCount(); ++i)
            mask.bytes8()[4 * i] = i % 64 / 32 == straight ? 255 : 0;
        options.raysMask = std::make_shared<const Image>(std::move(mask));
        const std::array<int, 2> byImage = misplacedBolts(options);
        EXPECT_EQ(byImage[straight], 0);
        EXPECT_GT(byImage[1 - straight], kLeaning);

        const std::vector<float> reds = straight == 0 ? std::vector{1.0f, 0.0f} : std::vector{0.0f, 1.0f};
        const std::array<int, 2> byColors = misplacedBolts(along(BakeRays::vertexColor), reds);
        EXPECT_EQ(byColors[straight], 0);
        EXPECT_GT(byColors[1 - straight], kLeaning);
    }
}

// A cylinder of radius 0.5 from z = -0.8 to 0.8 with a hard rim, as one strip of columns and two caps.
Mesh cappedCylinder(float radius, float half)
{
    constexpr int kColumns = 24;
    Mesh mesh;
    const auto at = [](int i) {
        const double a = 2 * std::numbers::pi * (i % kColumns) / kColumns;
        return glm::vec3(std::cos(a), std::sin(a), 0);
    };
    const glm::vec3 up(0, 0, half);
    std::vector<glm::vec3> top, bottom;
    std::vector<glm::vec2> topUv, bottomUv;
    for (int i = 0; i < kColumns; ++i) {
        const glm::vec3 p = at(i), q = at(i + 1);
        const float u = float(i) / kColumns, v = float(i + 1) / kColumns;
        addPolygon(mesh, {p * radius - up, q * radius - up, q * radius + up, p * radius + up}, {p, q, q, p},
                   {{u, 0.5f}, {v, 0.5f}, {v, 0}, {u, 0}});
        top.push_back(p * radius + up);
        topUv.push_back(glm::vec2(0.25f, 0.75f) + 0.24f * glm::vec2(p.x, -p.y));
        bottom.insert(bottom.begin(), p * radius - up);
        bottomUv.insert(bottomUv.begin(), glm::vec2(0.75f, 0.75f) + 0.24f * glm::vec2(p));
    }
    addPolygon(mesh, top, {{0, 0, 1}}, topUv);
    addPolygon(mesh, bottom, {{0, 0, -1}}, bottomUv);
    return mesh;
}

// Blocks stand off the wall near its ends: their sides towards the middle must not be seen, nor those towards the rims.
TEST(HardEdges, blocksOnACappedCylinderShowNoSides)
{
    const float half = 0.8f, block = 0.05f, offset = 0.55f;
    const Mesh low = cappedCylinder(0.5f, half);
    Mesh high = cappedCylinder(0.49f, half - 0.01f);
    for (const float z : {-offset, offset}) // from 0.45 to 0.6 from the axis, on both sides of it
        for (const float x : {-0.525f, 0.525f})
            addBox(high, {x - 0.075f, -block, z - block}, {x + 0.075f, block, z + block}, false, nullptr);
    std::array<int, 3> sides{}; // texels that show a side that faces along the axis
    for (std::size_t way = 0; way < 3; ++way) {
        const EdgeBake bake = bakeAtEdges({low}, high, BakeKind::objectNormal, along(kWays[way]), 128);
        int tops = 0;
        eachTexel(bake, [&](std::size_t, glm::vec3 p, glm::vec3 n, glm::vec3 value) {
            if (std::abs(n.z) > 0.5f || std::abs(p.z) > half - 0.1f)
                return;
            sides[way] += std::abs(value.z) > 0.5f;
            tops += std::abs(value.x) > 0.999f && std::abs(std::abs(p.z) - offset) < block && std::abs(p.y) < block;
        });
        EXPECT_GT(tops, 10);
        // The cylinder's rim lies 0.01 inside that of the low one, beyond the straight rays beside it.
        EXPECT_EQ(bake.baked.statistics.missed > 0, kWays[way] == BakeRays::straight);
    }
    EXPECT_EQ(sides[0], 0); // automatic
    EXPECT_GT(sides[1], 20);
    EXPECT_EQ(sides[2], 0);
}

// Rounded cubes in slightly larger boxes: each side of a box must show its half of each rounding, and nothing of the
// other half, which the neighbouring side shows.
TEST(HardEdges, cornersHaveNoGapsAndEachSideShowsItsHalf)
{
    for (const float gap : {0.0f, 0.01f, 0.03f})
        for (const float bevel : {0.02f, 0.1f}) {
            Mesh low, high;
            Atlas atlas{3};
            addBox(low, glm::vec3(-0.5f), glm::vec3(0.5f), false, &atlas);
            addBevelledCube(high, 0.5f - gap, bevel);
            std::array<float, 3> least{1, 1, 1}; // cosine to the box's normal
            for (std::size_t way = 0; way < 3; ++way) {
                BakeOptions options = along(kWays[way]);
                options.highNormals = HighNormals::smooth;
                const EdgeBake bake = bakeAtEdges({low}, high, BakeKind::objectNormal, options, 192);
                EXPECT_TRUE(way == 2 || bake.baked.statistics.missed == 0) << gap << " " << bevel << " " << way;
                eachTexel(bake, [&](std::size_t, glm::vec3, glm::vec3 n, glm::vec3 value) {
                    if (value != glm::vec3(0))
                        least[way] = std::min(least[way], glm::dot(n, value));
                });
            }
            const float corner = std::sqrt(1 / 3.0f); // where three sides meet
            for (const std::size_t way : {0u, 1u})
                EXPECT_GT(least[way], corner - 0.03f) << gap << " " << bevel << " " << way;
            EXPECT_TRUE(bevel < 0.1f || least[2] < corner - 0.2f) << least[2];
        }
}

// Averaged normals differ from a side's own only at its rim, so that averaged rays bend in the outermost triangles
// alone.
TEST(HardEdges, bandsReachOverFineTriangles)
{
    constexpr int kCells = 16;
    Mesh low, high;
    Atlas atlas{3};
    for (const Axes& side : sides()) {
        const std::vector<glm::vec2> uv = atlas.cell(); // of corners (-1, -1), (1, -1), (1, 1), (-1, 1)
        const auto uvAt = [&](float i, float j) {
            return uv[0] + (uv[1] - uv[0]) * (i / kCells) + (uv[3] - uv[0]) * (j / kCells);
        };
        for (int y = 0; y < kCells; ++y)
            for (int x = 0; x < kCells; ++x) {
                const auto i = float(x), j = float(y);
                const glm::vec3 centre =
                    side.n * 0.5f + side.u * ((i + 0.5f) / kCells - 0.5f) + side.v * ((j + 0.5f) / kCells - 0.5f);
                addSquare(low, side, centre, glm::vec2(0.5f / kCells),
                          {uvAt(i, j), uvAt(i + 1, j), uvAt(i + 1, j + 1), uvAt(i, j + 1)});
            }
    }
    addBevelledCube(high, 0.42f, 0.05f); // 0.08 inside; a cell is 0.0625
    const EdgeBake bands = bakeAtEdges({low}, high, BakeKind::objectNormal, along(BakeRays::automatic), 192);
    const EdgeBake averaged = bakeAtEdges({low}, high, BakeKind::objectNormal, along(BakeRays::averaged), 192);
    EXPECT_LT(20 * bands.baked.statistics.missed, averaged.baked.statistics.missed);
    eachTexel(bands, [&](std::size_t i, glm::vec3 p, glm::vec3, glm::vec3) {
        if ((bands.baked.states[i] & texelMissed) != 0) {
            // Near the corners, where each of the three edges has its own direction within a cell.
            const glm::vec3 in = 0.5f - glm::abs(p);
            EXPECT_LT(std::max({in.x, in.y, in.z}), 0.08f);
        }
    });
}

// A ball off an edge, in front of neither side.
TEST(HardEdges, whatFloatsBeyondAnEdgeIsFoundFromBothSides)
{
    Mesh low, high;
    Atlas atlas{3};
    addBox(low, glm::vec3(-0.5f), glm::vec3(0.5f), false, &atlas);
    addBox(high, glm::vec3(-0.5f), glm::vec3(0.5f), false, nullptr);
    const glm::vec3 out = glm::normalize(glm::vec3(1, 1, 0));
    for (const Axes& half : {Axes{out, {0, 0, 1}, glm::cross(out, glm::vec3(0, 0, 1))},
                             {-out, glm::cross(out, glm::vec3(0, 0, 1)), {0, 0, 1}}})
        addDome(high, half, {0.55f, 0.55f, 0.1f}, 0.04f);
    for (const BakeRays rays : kWays) {
        const EdgeBake bake = bakeAtEdges({low}, high, BakeKind::height, along(rays), 384);
        std::array<int, 2> seen{}; // from +x and +y
        eachTexel(bake, [&](std::size_t, glm::vec3, glm::vec3 n, glm::vec3 value) {
            if (value.x > 0.02f)
                ++seen[n.x > 0.5f ? 0 : 1];
        });
        for (const int texels : seen)
            EXPECT_TRUE(rays == BakeRays::straight ? texels == 0 : texels > 5) << texels;
    }
}

// Straight rays beside a concave edge would run along the other wall and meet what stands on it.
TEST(HardEdges, wallsOfAPocketDoNotShowEachOthersDetail)
{
    const BakeCase pair = pocket();
    const EdgeBake bake = bakeAtEdges({pair.low}, pair.high, BakeKind::height, along(BakeRays::automatic), 256);
    EXPECT_EQ(bake.baked.statistics.missed, 0u);
    eachTexel(bake, [&](std::size_t, glm::vec3 p, glm::vec3 n, glm::vec3 value) {
        if (std::abs(n.y) > 0.5f && std::abs(p.y) < 0.21f) { // nothing stands on these two walls
            EXPECT_NEAR(value.x, 0, 1e-5) << p.x << " " << p.z;
        }
    });
}

TEST(HardEdges, smoothMeshesBakeToTheSameBytesEachWay)
{
    Mesh low = cappedCylinder(0.5f, 0.8f), high = cappedCylinder(0.51f, 0.82f);
    low.indices.resize(24 * 6); // without caps
    const EdgeBake first = bakeAtEdges({low}, high, BakeKind::normal, along(BakeRays::averaged), 96);
    for (const BakeRays rays : kWays)
        EXPECT_EQ(bakeAtEdges({low}, high, BakeKind::normal, along(rays), 96).baked.values, first.baked.values);
}

TEST(HardEdges, straightRaysStartAtTheGivenDistance)
{
    Mesh low, high;
    Atlas atlas{3};
    addBox(low, glm::vec3(-0.5f), glm::vec3(0.5f), false, &atlas);
    addBox(high, glm::vec3(-0.5f), glm::vec3(0.5f), false, nullptr);
    addSquare(high, sides()[0], {0.54f, 0, 0}, {0.2f, 0.2f});
    for (const BakeRays rays : kWays) {
        BakeOptions options = along(rays);
        options.extrusion = 0.05f;
        const EdgeBake bake = bakeAtEdges({low}, high, BakeKind::height, options, 96);
        eachTexel(bake, [&](std::size_t, glm::vec3 p, glm::vec3 n, glm::vec3 value) {
            if (n.x < 0.5f || std::max(std::abs(p.y), std::abs(p.z)) > 0.15f)
                return;
            // Averaged directions shorten to 1 / sqrt(3) in the middle of a side: 0.029 are less than 0.04.
            EXPECT_NEAR(value.x, rays == BakeRays::averaged ? 0 : 0.04f, 1e-5);
        });
    }
}

// Both have rays of their own.
TEST(HardEdges, cagesAndTheNearestSearchAreTheSameEachWay)
{
    const BakeCase pair = bolts();
    const auto bakeWith = [&](BakeRays rays, bool cage) {
        BakeOptions options = along(rays);
        if (cage)
            for (const glm::vec3 p : pair.low.positions)
                options.cage.push_back(p * 1.4f);
        else
            options.search = BakeSearch::nearest;
        return bakeAtEdges({pair.low}, pair.high, BakeKind::objectNormal, options, 48).baked.values;
    };
    for (const bool cage : {false, true})
        for (const BakeRays rays : kWays)
            EXPECT_EQ(bakeWith(rays, cage), bakeWith(BakeRays::averaged, cage)) << cage;
}

// ---- edges and bands ------------------------------------------------------------------------

// Two unit squares that meet at the edge x = 1; the second rises by an angle from the plane of the first. Each vertex
// is used by one square only.
LowSurface foldOf(float degrees, bool smooth)
{
    const float a = degrees * std::numbers::pi_v<float> / 180;
    const glm::vec3 up(0, 0, 1), second(-std::sin(a), 0, std::cos(a)), mean = glm::normalize(up + second);
    LowSurface low;
    for (const float x : {0.0f, 1.0f})
        for (const float y : {0.0f, 1.0f})
            low.positions.emplace_back(x, y, 0);
    for (const float t : {0.0f, 1.0f})
        for (const float y : {0.0f, 1.0f})
            low.positions.emplace_back(1 + t * std::cos(a), y, t * std::sin(a));
    low.normals = {up, up, up, up, second, second, second, second};
    if (smooth)
        for (const std::size_t v : {2u, 3u, 4u, 5u})
            low.normals[v] = mean;
    low.texcoords.resize(8);
    low.indices = {0, 2, 3, 0, 3, 1, 4, 6, 7, 4, 7, 5};
    low.triangleInstance.assign(4, 0);
    return low;
}

const std::vector<std::uint32_t> kFoldGroups = {0, 1, 2, 3, 2, 3, 4, 5};

TEST(HardEdges, areThoseWithDifferentNormalsOfOneInstance)
{
    const HardEdges hard = hardEdgesOf(foldOf(40, false), kFoldGroups);
    EXPECT_EQ(hard.count, 1u);
    for (std::size_t i = 0; i < 12; ++i) // from vertex 2 to 3, and from 5 to 4
        EXPECT_EQ(hard.of[i] == 0, i == 1 || i == 11) << i;
    EXPECT_EQ(hard.beyond[2], 1u); // the diagonal of the first square
    EXPECT_EQ(hard.beyond[1], HardEdges::kNone);
    const HardEdges smooth = hardEdgesOf(foldOf(40, true), kFoldGroups);
    EXPECT_EQ(smooth.count, 0u);
    EXPECT_EQ(smooth.beyond[1], 3u);
    const std::vector<std::uint32_t> apart = {0, 1, 2, 3, 6, 7, 4, 5}; // two instances
    EXPECT_EQ(hardEdgesOf(foldOf(40, false), apart).count, 0u);
}

TEST(HardEdges, bandsAreTwiceAsWideAsTheirRaysMoveSidewaysAndEndAtTheEdge)
{
    for (const float degrees : {40.0f, -40.0f}) {
        const LowSurface low = foldOf(degrees, false);
        std::vector<glm::vec3> directions = low.normals;
        for (const std::size_t v : {2u, 3u, 4u, 5u})
            directions[v] = glm::normalize(low.normals[0] + low.normals[7]);
        const EdgeSide side = sideOf(low, directions, 1);
        const float sine = std::sin(20 * std::numbers::pi_v<float> / 180);
        EXPECT_NEAR(side.sine, degrees > 0 ? -sine : sine, 1e-6); // outwards where the fold is convex
        EXPECT_EQ(side.out, glm::vec3(1, 0, 0));
        const float need = 0.4f, width = 2 * need * sine;
        const RayBands bands = makeBands(low, hardEdgesOf(low, kFoldGroups), directions, std::vector{need});
        ASSERT_EQ(bands.bands.size(), 2u);    // one on each side
        for (std::uint32_t f = 0; f < 4; ++f) // over the diagonals to the edge's far triangles, but not over the edge
            EXPECT_EQ(bands.first[f + 1] - bands.first[f], 1u);
        EXPECT_NEAR(bands.bendAt(0, {1, 0.5f, 0}).amount, 1, 1e-6);
        EXPECT_NEAR(bands.bendAt(0, {1 - width / 2, 0.4f, 0}).amount, 0.5f, 1e-6);
        EXPECT_NEAR(bands.bendAt(0, {1 - 1.01f * width, 0.4f, 0}).amount, 0, 0);
        const glm::vec3 diagonal(0.9f, 0.9f, 0);
        EXPECT_EQ(bands.bendAt(0, diagonal).amount, bands.bendAt(1, diagonal).amount);
        EXPECT_GT(bands.bendAt(1, diagonal).amount, 0.5f);
        EXPECT_LT(glm::length(bands.bendAt(1, diagonal).direction - directions[2]), 1e-6f);
    }
}

} // namespace
} // namespace cotan
