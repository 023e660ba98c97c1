// One ray per texel, from outside inwards, that starts at a measured distance: the map shows what stands off the low
// mesh and not what is hidden behind something else.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "bake/bake_surfaces.hpp"
#include "bake/surface/uv_raster.hpp"
#include "bake_cases.hpp"

namespace cotan {
namespace {

struct Pair {
    LowSurface low;
    HighSurface high;
    BakeOptions options;
};

Pair setupOf(const BakeCase& pair, BakeKind kind, int size = 128)
{
    auto low = makeLowSurface(sceneOfMeshes({pair.low}), -1, Frame::cotangent, TangentOrigin::generated);
    auto high = HighSurface::make({sceneOfMeshes({pair.high})}, 0);
    EXPECT_TRUE(low && high);
    Pair setup{std::move(*low), std::move(*high), {}};
    setup.options.kind = kind;
    setup.options.samples = 1; // a texel has the value at its centre
    setup.options.width = setup.options.height = size;
    setup.options.highNormals = HighNormals::face;
    return setup;
}

Baked bakeOf(const Pair& setup)
{
    auto baked = bake(setup.low, setup.high, setup.options);
    EXPECT_TRUE(baked);
    return *baked;
}

// Values of the covered texels.
std::vector<glm::vec3> valuesOf(const Baked& baked)
{
    std::vector<glm::vec3> values;
    for (std::size_t i = 0; i < baked.values.size(); ++i)
        if ((baked.states[i] & texelCovered) != 0)
            values.push_back(baked.values[i]);
    return values;
}

// Calls check(point, face normal, value) for every covered texel.
void forTexels(const Pair& setup, const Baked& baked, const std::function<void(glm::vec3, glm::vec3, glm::vec3)>& check)
{
    const UvRaster raster({setup.low.texcoords, setup.low.indices}, baked.width, baked.height);
    UvRow row;
    for (int y = 0; y < baked.height; ++y) {
        raster.row(y, row);
        for (int x = 0; x < baked.width; ++x)
            for (const UvSample& sample : row.of(std::size_t(x))) {
                if (!sample.covers)
                    continue;
                const LowPoint p = pointOf(setup.low, sample.triangle, double(sample.b1), double(sample.b2));
                check(glm::vec3(p.position), glm::vec3(p.normal),
                      baked.values[std::size_t(y) * std::size_t(baked.width) + std::size_t(x)]);
            }
    }
}

// The vertices of the low mesh, each moved by `move`(position, normal).
std::vector<glm::vec3> cageOf(const LowSurface& low, const std::function<glm::vec3(glm::vec3, glm::vec3)>& move)
{
    std::vector<glm::vec3> cage;
    for (std::size_t i = 0; i < low.positions.size(); ++i)
        cage.push_back(move(low.positions[i], low.normals[i]));
    return cage;
}

TEST(BakeFirst, detachedBoltsAreInTheMapWhereTheGeometryHasThem)
{
    Pair setup = setupOf(bolts(), BakeKind::height);
    setup.options.rays = BakeRays::averaged;
    const Baked baked = bakeOf(setup);
    EXPECT_EQ(baked.statistics.missed, 0u);
    int tops = 0, faces = 0;
    forTexels(setup, baked, [&](glm::vec3 p, glm::vec3 n, glm::vec3 value) {
        if (n.x < 0.5f) {
            EXPECT_LE(value.x, 1e-5f);
            return;
        }
        // Averaged normals at the corners of a cube are diagonal: rays converge on its centre and meet the plane of the
        // tops 1.14 times as far out.
        const auto apart = [&](float standoff) {
            const glm::vec3 q = p * ((0.5f + standoff) / 0.5f);
            return glm::length(glm::vec2(std::abs(q.y) - kBoltOffset, std::abs(q.z) - kBoltOffset));
        };
        if (apart(kBoltTop) < kBolt * 0.99f) {
            EXPECT_NEAR(value.x, kBoltTop, 1e-5) << p.y << " " << p.z;
            ++tops;
        } else if (apart(kBoltTop) > kBolt && apart(0.03f) > kBolt && apart(0.05f) > kBolt
                   && std::max(std::abs(p.y), std::abs(p.z)) < 0.46f) {
            EXPECT_NEAR(value.x, 0, 1e-5) << p.y << " " << p.z;
            ++faces;
        }
    });
    EXPECT_GT(tops, 40);
    EXPECT_GT(faces, 1000);
    // The same as with a cage made by hand: the cube, scaled by 1.4.
    Pair caged = setupOf(bolts(), BakeKind::objectNormal), free = setupOf(bolts(), BakeKind::objectNormal);
    free.options.rays = BakeRays::averaged;
    caged.options.cage = cageOf(caged.low, [](glm::vec3 p, glm::vec3) { return p * 1.4f; });
    const Baked a = bakeOf(caged), b = bakeOf(free);
    std::size_t apart = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        apart += glm::length(a.values[i] - b.values[i]) > 1e-3f;
    EXPECT_LE(apart, a.statistics.covered / 500); // rays along edges
    // The tops and the shafts below them are not the nearest surface, so the older rule finds none of them.
    Pair older = setupOf(bolts(), BakeKind::height);
    older.options.search = BakeSearch::nearest;
    for (const glm::vec3& v : valuesOf(bakeOf(older)))
        EXPECT_LT(v.x, 0.01f);
    EXPECT_GE(baked.statistics.nearer, std::size_t(tops));
}

TEST(BakeFirst, aPlateShowsItsUpperSideEvenToRaysFromInside)
{
    Pair setup = setupOf(plate(), BakeKind::objectNormal, 32);
    const Baked baked = bakeOf(setup);
    for (const glm::vec3& v : valuesOf(baked))
        EXPECT_GT(v.z, 0.999f);
    EXPECT_EQ(baked.statistics.nearer, baked.statistics.covered); // the lower side is nearer everywhere
    setup.options.search = BakeSearch::nearest;
    for (const glm::vec3& v : valuesOf(bakeOf(setup)))
        EXPECT_LT(v.z, -0.999f);
    // The same if rays start between the two sides: back faces count only where there is no front face.
    setup.options.search = BakeSearch::first;
    setup.options.extrusion = 0.005f;
    for (const glm::vec3& v : valuesOf(bakeOf(setup)))
        EXPECT_GT(v.z, 0.999f);
    const BakeCase pair = plate();
    Mesh lower;
    addSquare(lower, {-kUpwards.n, kUpwards.v, kUpwards.u}, {0, 0, -0.01f}, {0.5f, 0.5f});
    Pair only = setupOf({pair.low, lower}, BakeKind::objectNormal, 32);
    for (const glm::vec3& v : valuesOf(bakeOf(only)))
        EXPECT_LT(v.z, -0.999f);
}

TEST(BakeFirst, eachSideOfAThinWallShowsItsOwnDomes)
{
    const Pair setup = setupOf(thinWalls(), BakeKind::height);
    const Baked baked = bakeOf(setup);
    EXPECT_EQ(baked.statistics.missed, 0u);
    int outside = 0, inside = 0;
    forTexels(setup, baked, [&](glm::vec3 p, glm::vec3 n, glm::vec3 value) {
        EXPECT_GE(value.x, -1e-5f) << p.x << " " << p.y << " " << p.z;
        EXPECT_LE(value.x, 0.0501f) << p.x << " " << p.y << " " << p.z;
        outside += n.x > 0.5f && p.x > 0.49f && value.x > 0.04f;
        inside += n.x < -0.5f && p.x > 0.47f && value.x > 0.04f;
    });
    EXPECT_GT(outside, 5);
    EXPECT_GT(inside, 5);
}

TEST(BakeFirst, fingersThatNearlyTouchDoNotShowEachOther)
{
    const Pair setup = setupOf(fingers(), BakeKind::height, 256);
    const Baked baked = bakeOf(setup);
    EXPECT_EQ(baked.statistics.missed, 0u);
    int rivets = 0, domes = 0;
    forTexels(setup, baked, [&](glm::vec3 p, glm::vec3 n, glm::vec3 value) {
        EXPECT_GE(value.x, -1e-5f);
        EXPECT_LE(value.x, n.z > 0.5f ? 0.0601f : 0.0091f) << p.x << " " << p.y << " " << p.z;
        rivets += std::abs(n.x) > 0.5f && value.x > 0.006f;
        domes += n.z > 0.5f && value.x > 0.05f;
    });
    EXPECT_GT(rivets, 5);
    EXPECT_GT(domes, 30);
}

TEST(BakeFirst, aPocketShowsItsInsideAndNothingBehindItsWalls)
{
    const Pair setup = setupOf(pocket(), BakeKind::height, 256);
    const Baked baked = bakeOf(setup);
    EXPECT_EQ(baked.statistics.missed, 0u);
    int floor = 0, walls = 0, rim = 0;
    forTexels(setup, baked, [&](glm::vec3 p, glm::vec3 n, glm::vec3 value) {
        const bool in = std::max(std::abs(p.x), std::abs(p.y)) < 0.201f && p.z > -0.301f;
        const bool top = n.z > 0.5f && !in;
        EXPECT_GE(value.x, -1e-5f);
        EXPECT_LE(value.x, (top ? 0.09f : 0.0801f) + 1e-4f) << p.x << " " << p.y << " " << p.z;
        floor += in && n.z > 0.5f && value.x > 0.07f;
        walls += in && std::abs(n.x) > 0.5f && value.x > 0.05f;
        rim += top && value.x > 0.0899f;
    });
    EXPECT_GT(floor, 5);
    EXPECT_GT(walls, 5);
    EXPECT_GT(rim, 20);
}

TEST(BakeFirst, theOuterOfTwoShellsIsBaked)
{
    const Pair setup = setupOf(shells(), BakeKind::height);
    const Baked baked = bakeOf(setup);
    int dome = 0;
    forTexels(setup, baked, [&](glm::vec3 p, glm::vec3, glm::vec3 value) {
        // The bevel of the outer shell lies at most 0.05 (1 - 1 / sqrt 3) under the cube's corners.
        const bool corner = std::max({std::min(std::abs(p.x), std::abs(p.y)), std::min(std::abs(p.x), std::abs(p.z)),
                                      std::min(std::abs(p.y), std::abs(p.z))})
            > 0.44f;
        EXPECT_GE(value.x, corner ? -0.0212f : -1e-5f);
        EXPECT_LE(value.x, 0.1001f);
        dome += value.x > 0.09f;
    });
    EXPECT_GT(dome, 5);
}

TEST(BakeFirst, detailFloatingOverAHollowAndTheHollowBesideItAreBaked)
{
    const Pair setup = setupOf(hollow(), BakeKind::height);
    const Baked baked = bakeOf(setup);
    forTexels(setup, baked, [&](glm::vec3 p, glm::vec3, glm::vec3 value) {
        const float r = glm::length(glm::vec2(p));
        if (r < 0.079f) {
            EXPECT_NEAR(value.x, 0.06, 1e-5) << r;
        } else if (r > 0.081f && r < 0.14f) { // facets of 15 degrees lie up to 0.15 (1 - cos 7.5) inside the ball,
            EXPECT_NEAR(value.x, -std::sqrt(0.0225f - r * r), 0.004) << r; // times 2.6, the slope there
        } else if (r > 0.151f) {
            EXPECT_NEAR(value.x, 0, 1e-5) << r;
        }
    });
}

TEST(BakeFirst, rayStartsCanBeQueriedAndLimited)
{
    const Pair measured = setupOf(bolts(), BakeKind::height);
    const auto starts = makeRayStarts(measured.low, measured.high, {});
    ASSERT_TRUE(starts);
    // Distance along the diagonal from a corner to the plane of the tops, plus 5 % and 0.002 of the diagonal.
    const double needed = double(kBoltTop) * std::sqrt(3.0);
    EXPECT_NEAR(starts->farthest, needed * 1.05 + 0.002 * std::sqrt(3.0), 1e-4);
    EXPECT_TRUE(starts->directionsDiffer);
    EXPECT_NEAR(starts->limit, 0.1 * std::sqrt(3.0), 1e-5);
    for (std::size_t v = 0; v < measured.low.positions.size(); ++v) {
        EXPECT_NEAR(glm::dot(starts->directions[v], glm::normalize(measured.low.positions[v])), 1, 1e-6);
        if (measured.low.positions[v].x < 0) { // nothing stands off there: the margin alone
            EXPECT_NEAR(starts->distances[v], 0.002 * std::sqrt(3.0), 1e-3);
        }
    }
    // 5 cm is less than the bolts need; surfaces beyond a limit of 4 cm do not count.
    for (const auto& [extrusion, limit] : {std::pair(0.05f, 0.0f), {0.0f, 0.04f}}) {
        Pair setup = setupOf(bolts(), BakeKind::height);
        setup.options.extrusion = extrusion;
        setup.options.maxDistance = limit;
        for (const glm::vec3& v : valuesOf(bakeOf(setup)))
            EXPECT_LT(v.x, 0.06f);
    }
}

// The unit square with `cells` cells a side, facing upwards.
Mesh cellsOf(std::uint32_t cells)
{
    Mesh mesh;
    for (std::uint32_t j = 0; j <= cells; ++j)
        for (std::uint32_t i = 0; i <= cells; ++i) {
            const glm::vec2 c(float(i) / float(cells), float(j) / float(cells));
            mesh.positions.emplace_back(c.x, c.y, 0);
            mesh.normals.emplace_back(0, 0, 1);
            mesh.texcoords[0].emplace_back(c.x, 1 - c.y);
        }
    for (std::uint32_t j = 0; j < cells; ++j)
        for (std::uint32_t i = 0; i < cells; ++i) {
            const std::uint32_t a = j * (cells + 1) + i, b = a + 1, d = a + cells + 1, c = d + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
        }
    return mesh;
}

// A plate of two triangles, 0.05 above many. Most of the low triangles are far from the plate's corners; if they are
// finer than the points sampled on the plate, they are far from every sample. The plate counts over all of them.
TEST(BakeFirst, aPlateOverAFineLowMeshIsInAllOfIt)
{
    for (const auto& [cells, under] : {std::pair(32u, 1u), {220u, 1u}, {220u, 300u}, {330u, 37u}}) {
        Mesh high = cellsOf(under);
        addSquare(high, kUpwards, {0.5f, 0.5f, 0.05f}, {0.6f, 0.6f});
        for (const glm::vec3& v : valuesOf(bakeOf(setupOf({cellsOf(cells), high}, BakeKind::height))))
            ASSERT_NEAR(v.x, 0.05, 1e-5) << cells << " over " << under;
    }
}

TEST(BakeFirst, missesAreCountedWithThoseThatHitFurtherAway)
{
    // Over the left half the high surface is 0.3 away; over the right half there is none.
    Mesh high;
    addSquare(high, kUpwards, {-0.5f, 0, 0.3f}, {0.5f, 1});
    Pair setup = setupOf({plate().low, high}, BakeKind::normal, 32);
    setup.options.maxDistance = 0.1f;
    for (const BakeSearch search : {BakeSearch::first, BakeSearch::nearest}) {
        setup.options.search = search;
        const BakeStatistics s = bakeOf(setup).statistics;
        EXPECT_EQ(s.missed, s.covered);
        EXPECT_NEAR(double(s.further), double(s.covered) / 2, 1);
    }
}

TEST(BakeFirst, occlusionHasNoBlackBlots)
{
    // Openness of flat points in the open is one; what stands off the plate darkens it only at its foot.
    for (const BakeCase& pair : {plate(), bolts(), shells()}) {
        Pair setup = setupOf(pair, BakeKind::occlusion, 48);
        const Baked baked = bakeOf(setup);
        for (std::size_t i = 0; i < baked.values.size(); ++i) {
            if ((baked.states[i] & texelCovered) != 0) {
                EXPECT_GT(baked.values[i].x, 0.2f) << i;
            }
        }
    }
}

TEST(BakeFirst, normalsNotWindingDefineTheFront)
{
    BakeCase pair = bolts();
    for (std::size_t i = 0; i < pair.high.indices.size(); i += 3)
        std::swap(pair.high.indices[i + 1], pair.high.indices[i + 2]);
    const Baked flipped = bakeOf(setupOf(pair, BakeKind::height)),
                straight = bakeOf(setupOf(bolts(), BakeKind::height));
    for (std::size_t i = 0; i < flipped.values.size(); ++i)
        EXPECT_NEAR(flipped.values[i].x, straight.values[i].x, 1e-5);
}

TEST(BakeFirst, bytesDoNotDependOnThreads)
{
    for (const BakeCase& pair : {bolts(), fingers(), pocket()}) {
        Pair setup = setupOf(pair, BakeKind::objectNormal, 64);
        setup.options.threads = 1;
        const Baked one = bakeOf(setup);
        setup.options.threads = 3;
        const Baked three = bakeOf(setup);
        EXPECT_TRUE(one.values == three.values);
        EXPECT_TRUE(one.states == three.states);
    }
}

TEST(BakeFirst, optionsMadeForAnotherLowSurfaceAreRefused)
{
    const Pair setup = setupOf(plate(), BakeKind::normal, 16);
    const auto refused = [&](const BakeOptions& options, const std::string& text) {
        const auto baked = bake(setup.low, setup.high, options);
        ASSERT_FALSE(baked) << text;
        EXPECT_NE(baked.error().message.find(text), std::string::npos) << baked.error().message;
    };
    BakeOptions cage = setup.options;
    cage.cage.resize(setup.low.positions.size() - 1);
    refused(cage, "cage: expected");
    BakeOptions frame = setup.options;
    frame.frame = Frame::mikktspace;
    refused(frame, "which the low surface was made for");
    BakeOptions starts = setup.options;
    starts.starts = std::make_shared<const RayStarts>();
    refused(starts, "made for another low surface");
}

} // namespace
} // namespace cotan
