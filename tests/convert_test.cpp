// Maps for another frame, on patches whose new texels are worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "bake/convert/reencode.hpp"
#include "cotan/convention.hpp"
#include "cotan/scene.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {
namespace {

const auto kGltf = toFormat<f64::cotan_normal_format>(Convention{});

// An 8-bit map with the same texel everywhere; `m` is along (+u, +v, outwards).
Image constantMap(glm::dvec3 m, int side = 32)
{
    Image image = makeImage(side, side, PixelType::unorm8, "constant");
    const glm::dvec3 stored = f64::cotan_encode_texel(glm::normalize(m), kGltf);
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        for (std::size_t k = 0; k < 3; ++k)
            image.bytes8()[4 * i + k] = std::uint8_t(std::lround(255 * stored[int(k)]));
        image.bytes8()[4 * i + 3] = 77;
    }
    return image;
}

glm::dvec3 texelOf(const Image& image, int x, int y)
{
    const auto format = toFormat<f64::cotan_normal_format>(Convention{}, image.type);
    return glm::normalize(f64::cotan_decode(storedTexel(image, x, y), format));
}

MapUse useOf(const Mesh& mesh, double scale = 1)
{
    return {makeSurface(mesh, Texture{}), Convention{}, scale, Wrap::repeat, Wrap::repeat};
}

// A patch whose uv fill the unit square.
Mesh patch(float stretch, bool mirrored = false)
{
    Mesh mesh = makePatch(stretch, 0, mirrored, 4);
    glm::vec2 low(1e9f), high(-1e9f);
    for (glm::vec2 uv : mesh.texcoords[0]) {
        low = glm::min(low, uv);
        high = glm::max(high, uv);
    }
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        mesh.texcoords[0][i] = (mesh.texcoords[0][i] - low) / (high - low);
        mesh.positions[i].x *= stretch; // so that the unit square of uv is stretched by `stretch`
    }
    return mesh;
}

constexpr FramePair kToCotangent{Frame::mikktspace, Frame::cotangent, TangentOrigin::generated,
                                 TangentOrigin::generated};
constexpr FramePair kToOrthonormal{Frame::mikktspace, Frame::orthonormal, TangentOrigin::generated,
                                   TangentOrigin::generated};

// Rounding to 8 bits: half a step of 1/127 per axis is at most 0.37 degrees for unit vectors in an orthonormal frame;
// stretching the texel by two at most doubles it.
constexpr double k8Bits = 0.8;

double degrees(glm::dvec3 a, glm::dvec3 b)
{
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

TEST(Convert, twiceTheWidthDoublesTheSlopeAlongUForCotangent)
{
    // grad u is half as long as grad v, and cotangent keeps that ratio: (2x, y, z) gives what (x, y, z) gave before.
    const Image map = constantMap({0.3, 0.2, 1});
    const glm::dvec3 old = texelOf(map, 3, 3);
    const MapUse uses[] = {useOf(patch(2))};
    const Reencoded r = reencode(map, uses, kToCotangent, 16);
    ASSERT_EQ(r.image.type, PixelType::unorm16);
    EXPECT_EQ(r.covered, 32u * 32u);
    EXPECT_EQ(r.several, 0u);
    const glm::dvec3 expected = glm::normalize(glm::dvec3(2 * old.x, old.y, old.z));
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            EXPECT_LT(degrees(texelOf(r.image, x, y), expected), 0.01); // 16 bits and float positions
    EXPECT_NEAR(r.moved.mean, degrees(old, expected), 0.01);
    // Without conversion, cotangent would have halved the slope along u.
    EXPECT_NEAR(r.unconverted.mean, degrees(old, glm::normalize(glm::dvec3(old.x / 2, old.y, old.z))), 0.01);
    EXPECT_LT(r.error.maximum, 0.01);
    EXPECT_LT(reencode(map, uses, kToCotangent, 8).error.maximum, k8Bits);
}

TEST(Convert, theSameFrameOrSquareUvChangeOnlyRounding)
{
    const Image map = makeReliefMap(Relief::waves, 64);
    const FramePair same{Frame::mikktspace, Frame::mikktspace, TangentOrigin::generated, TangentOrigin::generated};
    const MapUse stretched[] = {useOf(patch(2))}, square[] = {useOf(patch(1))};
    for (const Reencoded& r : {reencode(map, stretched, same, 8), reencode(map, square, kToCotangent, 8)}) {
        int largest = 0;
        for (std::size_t i = 0; i < map.data.size(); ++i)
            largest = std::max(largest, std::abs(int(map.bytes8()[i]) - int(r.image.bytes8()[i])));
        EXPECT_LE(largest, 1); // old texels are not quite unit length, new ones are
    }
}

TEST(Convert, roundTripReproducesTheMap)
{
    const Image map = makeReliefMap(Relief::waves, 64);
    const MapUse uses[] = {useOf(patch(2))};
    const Reencoded there = reencode(map, uses, kToCotangent, 16);
    const FramePair backwards{Frame::cotangent, Frame::mikktspace, TangentOrigin::generated, TangentOrigin::generated};
    const Reencoded back = reencode(there.image, uses, backwards, 16);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            EXPECT_LT(degrees(texelOf(map, x, y), texelOf(back.image, x, y)), 0.02); // 16 bits, twice
}

TEST(Convert, mirroredChartsAgreeIfBothFramesMirror)
{
    const MapUse uses[] = {useOf(patch(1)), useOf(patch(1, true))};
    const Reencoded r = reencode(makeReliefMap(Relief::waves, 32), uses, kToOrthonormal, 8);
    EXPECT_EQ(r.several, 32u * 32u);
    EXPECT_EQ(r.disagreeing, 0u);
}

TEST(Convert, conflictsOfDifferentlyStretchedChartsAreCounted)
{
    const Image map = constantMap({0.5, 0.2, 1});
    const MapUse uses[] = {useOf(patch(1)), useOf(patch(2, true))};
    const Reencoded r = reencode(map, uses, kToCotangent, 16);
    EXPECT_EQ(r.several, 32u * 32u);
    EXPECT_EQ(r.disagreeing, 32u * 32u);
    // One sample needs (x,y,z), the other (2x,y,z). By symmetry of the sum neither gets its target: the error of the
    // worse is at least half the angle between them, on a surface where slopes along u count half.
    const glm::dvec3 old = texelOf(map, 0, 0);
    const double apart = degrees(old, glm::normalize(glm::dvec3(old.x / 2, old.y, old.z)));
    EXPECT_GT(r.disagreement.mean, 0.4 * apart);
    EXPECT_LT(r.disagreement.maximum, apart * 1.3);
}

TEST(Convert, aFlatTexelStaysFlatWithoutConflicts)
{
    const MapUse uses[] = {useOf(patch(1)), useOf(patch(2))};
    const Image map = constantMap({0, 0, 1});
    const Reencoded r = reencode(map, uses, kToCotangent, 8);
    EXPECT_EQ(r.image.data, map.data); // including alpha
    EXPECT_EQ(r.disagreeing, 0u);
}

TEST(Convert, theSolverAgreesWithAGridSearch)
{
    const auto frame = [](double sx, double sy, double rotation) {
        const glm::dvec3 t(std::cos(rotation), std::sin(rotation), 0), b(-std::sin(rotation), std::cos(rotation), 0);
        return glm::dmat3(t * sx, b * sy, glm::dvec3(0, 0, 1));
    };
    const Demand demands[] = {{frame(1, 1, 0.3), glm::normalize(glm::dvec3(0.4, 0.1, 1))},
                              {frame(0.5, 1, 1.2), glm::normalize(glm::dvec3(-0.2, 0.5, 1))},
                              {frame(1, 0.7, -0.5), glm::normalize(glm::dvec3(0.1, -0.3, 1))}};
    const auto cost = [&](glm::dvec3 m) {
        double sum = 0;
        for (const Demand& d : demands) {
            const glm::dvec3 r = glm::normalize(d.frame * m) - d.target;
            sum += glm::dot(r, r);
        }
        return sum;
    };
    glm::dvec3 best(0, 0, 1);
    for (double x = -1.5; x <= 1.5; x += 0.004)
        for (double y = -1.5; y <= 1.5; y += 0.004)
            if (const glm::dvec3 m(x, y, 1); cost(m) < cost(best))
                best = m;
    const glm::dvec3 solved = solveTexel(demands, {0, 0, 1});
    EXPECT_LE(cost(solved), cost(best) + 1e-12);
    EXPECT_LT(degrees(solved, best), 0.3); // the grid's step is 0.23 degrees
    EXPECT_NEAR(glm::length(solved), 1, 1e-12);
}

TEST(Convert, aSingularFrameDemandsNothing)
{
    const Demand none{glm::dmat3(glm::dvec3(0), glm::dvec3(0), glm::dvec3(0, 0, 1)), {0.6, 0, 0.8}};
    const Demand sound{glm::dmat3(1), {0, 0.6, 0.8}};
    EXPECT_EQ(solveTexel({&none, 1}, {0.1, 0.2, 0.9}), glm::dvec3(0.1, 0.2, 0.9));
    const Demand both[] = {none, sound};
    EXPECT_LT(degrees(solveTexel(both, {0, 0, 1}), sound.target), 1e-6);
}

TEST(Convert, paddingIsConvertedLikeTheNearestChart)
{
    Mesh mesh = patch(2);
    for (glm::vec2& uv : mesh.texcoords[0])
        uv *= glm::vec2(0.5f, 1.0f); // the left half
    for (glm::vec3& p : mesh.positions)
        p.x *= 0.5f; // still two to one
    const Image map = constantMap({0.3, 0.2, 1});
    const MapUse uses[] = {useOf(mesh)};
    const Reencoded r = reencode(map, uses, kToCotangent, 8);
    EXPECT_EQ(r.covered, 16u * 32u);
    EXPECT_EQ(r.padded, 16u * 32u);
    for (int x = 0; x < 32; ++x)
        EXPECT_LT(degrees(texelOf(r.image, x, 9), texelOf(r.image, 3, 3)), 1e-9) << x;
}

TEST(Convert, uncoveredTexelsAndMapsAreUnchanged)
{
    Image map = makeReliefMap(Relief::waves, 32);
    EXPECT_EQ(reencode(map, {}, kToCotangent, 8).image.data, map.data);
    Mesh mesh = patch(2);
    for (glm::vec2& uv : mesh.texcoords[0])
        uv *= 0.5f;
    for (std::size_t k = 0; k < 3; ++k)
        map.bytes8()[4 * (32 * 31 + 31) + k] = 0; // black, in the padding
    const MapUse uses[] = {useOf(mesh)};
    const Reencoded r = reencode(map, uses, kToCotangent, 8);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(r.image.bytes8()[4 * (32 * 31 + 31) + k], 0);
}

TEST(Convert, theScaleOfTheMaterialIsKept)
{
    // The material scales slopes when reading, and each use has its own scale: every surface point keeps its normal.
    const Image map = constantMap({0.4, 0.3, 1});
    for (double scale : {0.5, 2.0, -1.0}) {
        const MapUse uses[] = {useOf(patch(2), scale)};
        const Reencoded r = reencode(map, uses, kToCotangent, 16);
        EXPECT_LT(r.error.maximum, 0.02) << scale;
        // x and y keep their meaning: the scale acts on both sides equally, so the texel is the same as with scale 1.
        const glm::dvec3 old = texelOf(map, 0, 0);
        EXPECT_LT(degrees(texelOf(r.image, 5, 5), glm::normalize(glm::dvec3(2 * old.x, old.y, old.z))), 0.02) << scale;
    }
    const MapUse flattened[] = {useOf(patch(2), 0)};
    EXPECT_EQ(reencode(map, flattened, kToCotangent, 8).image.data, map.data);
}

TEST(Convert, mirroredAndRepeatingWrapAreDistinguished)
{
    Mesh mesh = patch(1);
    for (glm::vec2& uv : mesh.texcoords[0])
        uv.x *= 2;
    for (glm::vec3& p : mesh.positions)
        p.x *= 2;
    MapUse repeat = useOf(mesh), mirror = repeat, clamp = repeat;
    mirror.wrapU = Wrap::mirror;
    clamp.wrapU = Wrap::clamp;
    const Image map = makeReliefMap(Relief::waves, 32);
    EXPECT_EQ(reencode(map, {&repeat, 1}, kToCotangent, 8).several, 32u * 32u);
    EXPECT_EQ(reencode(map, {&mirror, 1}, kToCotangent, 8).several, 32u * 32u);
    const Reencoded clamped = reencode(map, {&clamp, 1}, kToCotangent, 8);
    EXPECT_EQ(clamped.several, 0u);
    EXPECT_EQ(clamped.covered, 32u * 32u);
}

TEST(Convert, theScaleOfANodeIsApplied)
{
    const Image map = constantMap({0.3, 0.2, 1});
    const MapUse straight[] = {useOf(patch(2))};
    const MapUse byNode[] = {{makeSurface(patch(1), Texture{}, glm::dmat3(2, 0, 0, 0, 1, 0, 0, 0, 1)), Convention{}, 1,
                              Wrap::repeat, Wrap::repeat}};
    EXPECT_EQ(reencode(map, straight, kToCotangent, 8).image.data, reencode(map, byNode, kToCotangent, 8).image.data);
}

TEST(Convert, theNumberOfThreadsDoesNotMatter)
{
    const Image map = makeReliefMap(Relief::waves, 64);
    const MapUse uses[] = {useOf(makeSphere(1, 12)), useOf(patch(2, true))};
    const FramePair toSmooth{Frame::mikktspace, Frame::smooth, TangentOrigin::generated, TangentOrigin::generated};
    const Reencoded one = reencode(map, uses, toSmooth, 8, 1), several = reencode(map, uses, toSmooth, 8, 3);
    EXPECT_EQ(one.image.data, several.image.data);
    EXPECT_EQ(one.error.mean, several.error.mean);
    EXPECT_EQ(one.disagreeing, several.disagreeing);
}

} // namespace
} // namespace cotan
