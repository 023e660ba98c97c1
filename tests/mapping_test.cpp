// Frames of projectors, coordinates that jump, and rotated tiles, compared with analytic maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "truth/patch.hpp"
#include "truth/surface.hpp"

namespace cotan {
namespace {

using namespace f64;

// A box that projects a map: uv = (dot(x, p) / width, dot(y, p) / height), turned, sheared or mirrored.
struct Projector {
    glm::dvec3 gradU, gradV;
};
Projector randomProjector(Random& random, bool mirrored)
{
    const glm::dvec3 z = random.direction();
    const glm::dvec3 x = glm::normalize(glm::cross(z, random.direction())), y = glm::cross(z, x);
    return {x / random.range(0.2, 2), y * (mirrored ? -1.0 : 1.0) / random.range(0.2, 2)};
}

TEST(Projector, itsFrameEqualsThatOfTheSameUvOnTheSurface)
{
    Random random(71);
    int compared = 0;
    for (int i = 0; i < 400; ++i) {
        const Projector box = randomProjector(random, i & 1);
        const AffinePatch plane = randomPatch(random, false); // only its place and normal
        const PixelCamera camera = PixelCamera::lookAt(plane.normal * 3.0, {0, 0, 0}, random.direction(), 800);
        const auto d = screenDifferences(camera, plane, {0, 0, 0});
        auto uv = [&](glm::dvec3 dp) { return glm::dvec2(glm::dot(box.gradU, dp), glm::dot(box.gradV, dp)); };
        const cotan_frame truth =
            cotan_frame_gradient(plane.normal, d.dpdx.raw(), d.dpdy.raw(), uv(d.dpdx.raw()), uv(d.dpdy.raw()));
        const cotan_frame f = cotan_frame_projected(plane.normal * 3.0, box.gradU, box.gradV);
        EXPECT_LT(glm::length(f.t - truth.t) + glm::length(f.b - truth.b), 1e-9 * (1 + glm::length(truth.t)));
        EXPECT_LT(glm::length(f.n - truth.n), 1e-12);
        ++compared;
    }
    EXPECT_EQ(compared, 400);
}

// A decal over an edge of a mesh whose uv jump there: the surface's tangents jump, the projector's frame does not.
TEST(Projector, doesNotSeeTheSeamOfTheSurfaceBelow)
{
    Random random(72);
    const Projector box = randomProjector(random, true);
    const glm::dvec3 n = random.direction(), m = tiltedTexel(random, 40);
    const glm::dvec3 truth = glm::normalize(n + box.gradU * m.x / m.z + box.gradV * m.y / m.z
                                            - n * glm::dot(n, box.gradU * m.x / m.z + box.gradV * m.y / m.z));
    EXPECT_LT(degreesBetween(cotan_apply(cotan_frame_projected(n, box.gradU, box.gradV), m), truth), 1e-6);
}

// Blending by surface gradients: half of the decal over half of a surface with bumps of its own.
TEST(Projector, addsToTheBumpsBelowAsTheirHeightsDo)
{
    Random random(73);
    for (int i = 0; i < 100; ++i) {
        const AffinePatch own = randomPatch(random, i & 1);
        const Projector box = randomProjector(random, i & 2);
        const glm::dvec2 slopeOwn(random.range(-1, 1), random.range(-1, 1)), slopeBox(random.range(-1, 1), 0.5);
        const double k = random.unit();
        // The height (1 - k) h_own + k h_box is linear in space, so its gradient is known.
        glm::dvec3 grad = (own.gradU * slopeOwn.x + own.gradV * slopeOwn.y) * (1 - k)
            + (box.gradU * slopeBox.x + box.gradV * slopeBox.y) * k;
        grad -= own.normal * glm::dot(own.normal, grad);
        const cotan_frame decal = cotan_frame_projected(own.normal, box.gradU, box.gradV);
        const glm::dvec3 g = cotan_mix(cotan_gradient_of_slope({own.gradU, own.gradV, own.normal}, slopeOwn),
                                       cotan_gradient_of_slope(decal, slopeBox), k);
        EXPECT_LT(degreesBetween(cotan_resolve_gradient(own.normal, g), glm::normalize(own.normal - grad)), 1e-5);
    }
}

TEST(Projector, edgeOnAndBrokenOnesLeaveTheSurface)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const glm::dvec3 n(0, 0, 1);
    const cotan_frame edgeOn = cotan_frame_projected(n, {0, 0, 5}, {0, 0, 7});
    EXPECT_EQ(edgeOn.t, glm::dvec3(0));
    EXPECT_EQ(cotan_apply(edgeOn, glm::normalize(glm::dvec3(1, 1, 1))), n);
    const cotan_frame broken = cotan_frame_projected(n, {nan, 0, 0}, {0, 1, 0});
    EXPECT_EQ(cotan_apply(broken, glm::normalize(glm::dvec3(1, 1, 1))), n);
}

// A cylinder with u from atan2: across its seam u jumps by 1, and a whole column of pixels has a wrong frame.
TEST(WrappedDifference, removesTheSeamOfAnAngle)
{
    Random random(74);
    double worstPlain = 0, worstWrapped = 0;
    for (int i = 0; i < 400; ++i) {
        const double angle = std::numbers::pi + random.range(-0.02, 0.02); // around the jump of atan2
        auto at = [](double a, double z) { return glm::dvec3(std::cos(a), std::sin(a), z); };
        auto uvAt = [](glm::dvec3 p) { return glm::dvec2(std::atan2(p.y, p.x) / (2 * std::numbers::pi), p.z); };
        const glm::dvec3 p = at(angle, 0), right = at(angle + 0.01, 0), down = at(angle + 0.002, -0.01);
        glm::dvec2 duvdx = uvAt(right) - uvAt(p), duvdy = uvAt(down) - uvAt(p);
        const glm::dvec3 n = glm::normalize(p), m = glm::normalize(glm::dvec3(0.5, 0.3, 1));
        // grad u = 1 / (2 pi) along the circle, grad v = 1 along z: v is the longer.
        const glm::dvec3 around(-std::sin(angle), std::cos(angle), 0);
        const glm::dvec3 truth =
            glm::normalize(around * m.x / (2 * std::numbers::pi) + glm::dvec3(0, 0, m.y) + n * m.z);
        auto error = [&] {
            return degreesBetween(cotan_apply(cotan_frame_cotangent(n, right - p, down - p, duvdx, duvdy), m), truth);
        };
        worstPlain = std::max(worstPlain, error());
        for (glm::dvec2* d : {&duvdx, &duvdy})
            *d = {cotan_wrapped_difference(d->x, 1.0), cotan_wrapped_difference(d->y, 0.0)};
        worstWrapped = std::max(worstWrapped, error());
    }
    EXPECT_GT(worstPlain, 20) << "without the seam nothing is tested";
    EXPECT_LT(worstWrapped, 0.2) << "what chords of 0.01 radians leave";
}

TEST(WrappedDifference, isTheNearestValueForAnyPeriod)
{
    for (const double period : {1.0, 2 * std::numbers::pi, 0.25})
        for (const double d : {-0.1, 0.0, 0.03, 0.12})
            for (int k = -3; k <= 3; ++k)
                EXPECT_NEAR(cotan_wrapped_difference(d + k * period, period), d, 1e-12) << period;
    EXPECT_EQ(cotan_wrapped_difference(0.75, 0.0), 0.75);
    EXPECT_EQ(cotan_wrapped_difference(0.75, -1.0), 0.75);
}

TEST(RotatedSlope, isTheSlopeOfTheHeightThatIsLookedUpRotated)
{
    Random random(75);
    const Waves waves;
    for (int i = 0; i < 100; ++i) {
        const double a = random.azimuth(), c = std::cos(a), s = std::sin(a), step = 1e-6;
        const glm::dvec2 uv(random.unit(), random.unit());
        auto rotated = [&](double u, double v) { return waves.at(c * u - s * v, s * u + c * v); };
        const glm::dvec2 truth((rotated(uv.x + step, uv.y).h - rotated(uv.x - step, uv.y).h) / (2 * step),
                               (rotated(uv.x, uv.y + step).h - rotated(uv.x, uv.y - step).h) / (2 * step));
        const ReliefSample r = rotated(uv.x, uv.y);
        EXPECT_LT(glm::length(cotan_slope_of_rotated({r.hu, r.hv}, c, s) - truth), 1e-4);
    }
}

TEST(HexTiles, weightsAddUpAndDoNotJumpAtTheEdges)
{
    Random random(76);
    auto weightOf = [](const cotan_hex_tiles& h, glm::dvec2 id) {
        return (h.a == id ? h.weights.x : 0) + (h.b == id ? h.weights.y : 0) + (h.c == id ? h.weights.z : 0);
    };
    int edges = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec2 uv(random.range(-5, 5), random.range(-5, 5));
        const glm::dvec2 near = uv + glm::dvec2(random.range(-1, 1), random.range(-1, 1)) * 1e-4;
        for (const double sharpness : {1.0, 7.0}) {
            const cotan_hex_tiles h = cotan_hex_tiles_at(uv, sharpness), other = cotan_hex_tiles_at(near, sharpness);
            EXPECT_NEAR(h.weights.x + h.weights.y + h.weights.z, 1, 1e-12);
            EXPECT_GE(std::min({h.weights.x, h.weights.y, h.weights.z}), 0);
            EXPECT_TRUE(h.a != h.b && h.b != h.c && h.a != h.c);
            for (const glm::dvec2 id : {h.a, h.b, h.c, other.a, other.b, other.c}) // slope 5.5 per unit, times 7
                EXPECT_LT(std::abs(weightOf(h, id) - weightOf(other, id)), 2e-4 * 5.5 * sharpness);
            edges += h.a != other.a || h.b != other.b;
        }
    }
    EXPECT_GT(edges, 10) << "no pair lies across an edge";
}

// A hexagon is one and the same wherever its weight is the largest: a corner of the triangles, at its own place.
TEST(HexTiles, aCornerBelongsToOneHexagonWithFullWeight)
{
    const double side = 1 / (2 * std::sqrt(3.0));
    for (int i = -3; i <= 3; ++i)
        for (int j = -3; j <= 3; ++j) { // corners of a triangular grid, a hair inside
            const glm::dvec2 uv((i + 0.5 * j) * side + 1e-7, j * side * std::sqrt(0.75) + 1e-7);
            const cotan_hex_tiles h = cotan_hex_tiles_at(uv, 1);
            EXPECT_GT(h.weights.x, 0.999) << i << "," << j;
            EXPECT_EQ(h.a, glm::dvec2(i, j));
        }
}

} // namespace
} // namespace cotan
