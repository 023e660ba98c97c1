// Vectors and covectors, and the three ways to transform a normal. tests/core.cmake checks with covector_mixture.cpp
// what must not compile.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "truth/patch.hpp"

namespace cotan {
namespace {

glm::dmat3 randomMatrix(Random& random)
{
    return glm::dmat3(random.direction() * random.range(0.5, 2), random.direction() * random.range(0.5, 2),
                      random.direction() * random.range(0.5, 2));
}

TEST(Covector, pairingIsTheSameInEverySpace)
{
    Random random(31);
    for (int i = 0; i < 200; ++i) {
        const LinearMap<double> map(randomMatrix(random));
        if (std::abs(map.determinant()) < 0.05)
            continue; // nearly singular: the inverse loses too many digits
        const Vector3d v(random.direction());
        const Covector3d c(random.direction());
        EXPECT_NEAR(dot(map(c), map(v)), dot(c, v), 1e-11);
    }
}

TEST(Covector, crossOfTwoVectorsIsTheirPlane)
{
    Random random(32);
    const Vector3d a(random.direction()), b(random.direction());
    EXPECT_NEAR(dot(cross(a, b), a), 0, 1e-15);
    EXPECT_NEAR(dot(cross(a, b), b), 0, 1e-15);
}

TEST(Covector, transformedNormalStaysPerpendicularToTransformedTangents)
{
    Random random(33);
    for (int i = 0; i < 100; ++i) {
        const glm::dmat3 m = randomMatrix(random);
        const Vector3d a(random.direction()), b(random.direction());
        const auto n = transformNormal(NormalTransform::inverseTranspose, m, cross(a, b));
        const LinearMap<double> map(m);
        EXPECT_NEAR(dot(n, map(a)), 0, 1e-12);
        EXPECT_NEAR(dot(n, map(b)), 0, 1e-12);
    }
}

TEST(Covector, planeImageOfAFlattenedObjectIsTheNormalOfThePlane)
{
    const LinearMap<double> flatten(glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, 0)); // z scaled to zero
    EXPECT_EQ(flatten(Covector3d{0, 0, 1}), (Covector3d{}));
    EXPECT_EQ(flatten.planeImage(Covector3d{0.3, 0.2, 0.9}).x, 0);
    EXPECT_GT(flatten.planeImage(Covector3d{0.3, 0.2, 0.9}).z, 0);
}

glm::dmat3 rotation()
{
    const glm::dvec3 x = glm::normalize(glm::dvec3(1, 2, 3));
    const glm::dvec3 y = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), x));
    return glm::dmat3(x, y, glm::cross(x, y));
}

double disagreement(NormalTransform method, const glm::dmat3& m, glm::dvec3 n)
{
    return degreesBetween(transformNormal(method, m, Covector3d(n)).raw(),
                          transformNormal(NormalTransform::inverseTranspose, m, Covector3d(n)).raw());
}

glm::dmat3 scale(double x, double y, double z) { return glm::dmat3(x, 0, 0, 0, y, 0, 0, 0, z); }

TEST(NormalTransform, allThreeMethodsAgreeForRotationAndUniformScale)
{
    Random random(34);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 n = random.direction();
        const glm::dmat3 m = rotation() * scale(2, 2, 2);
        EXPECT_LT(disagreement(NormalTransform::undoScale, m, n), 1e-10);
        EXPECT_LT(disagreement(NormalTransform::rotationOnly, m, n), 1e-10);
    }
}

TEST(NormalTransform, undoingTheScaleIsRightForAxisAlignedScale)
{
    Random random(35);
    for (double sign : {1.0, -1.0})
        for (int i = 0; i < 50; ++i)
            EXPECT_LT(disagreement(NormalTransform::undoScale, rotation() * scale(sign, 2, 4), random.direction()),
                      1e-10);
}

TEST(NormalTransform, undoingTheScaleIsWrongForAScaleAfterTheRotation)
{
    EXPECT_GT(disagreement(NormalTransform::undoScale, scale(1, 1, 4) * rotation(), {0.6, 0, 0.8}), 5);
}

TEST(NormalTransform, rotationOnlyIsWrongByAtMost36Point9DegreesForOneToFour)
{
    double worst = 0;
    for (double a = 0; a < 90; a += 0.01)
        worst = std::max(worst,
                         disagreement(NormalTransform::rotationOnly, scale(1, 1, 4),
                                      {std::sin(a * kDegree), 0, std::cos(a * kDegree)}));
    EXPECT_NEAR(worst, 36.87, 0.01); // atan((4-1)/(2 sqrt 4))
}

TEST(NormalTransform, zeroScaleGivesAFiniteUnitNormal)
{
    for (auto method : {NormalTransform::undoScale, NormalTransform::rotationOnly, NormalTransform::inverseTranspose})
        EXPECT_NEAR(length(transformNormal(method, scale(1, 1, 0), Covector3d{0, 0.6, 0.8})), 1, 1e-12);
}

TEST(CotangentFrame, uniformScaleAndRotationTransformTheFrameLikeTheNormal)
{
    Random random(36);
    const AffinePatch p = randomPatch(random, false);
    const auto d =
        screenDifferences(PixelCamera::lookAt(p.normal * 3.0, {0, 0, 0}, random.direction(), 800), p, {0, 0, 0});
    const auto f = makeFrame(Frame::cotangent, Covector3d(p.normal), d);
    const auto g = transform(LinearMap<double>(rotation() * 3.0), f);
    const glm::dvec3 m = tiltedTexel(random, 30);
    EXPECT_LT(degreesBetween(perturb(g, m).raw(), rotation() * perturb(f, m).raw()), 1e-10);
}

TEST(Covector, arithmeticIsByComponent)
{
    const Covector3d a(1, -2, 3), b(0.5, 4, -6);
    EXPECT_EQ(a + b, (Covector3d{1.5, 2, -3}));
    EXPECT_EQ(a - b, (Covector3d{0.5, -6, 9}));
    EXPECT_EQ(-a, (Covector3d{-1, 2, -3}));
    EXPECT_EQ(a * 2.0, (Covector3d{2, -4, 6}));
    EXPECT_EQ(2.0 * a, a * 2.0);
    EXPECT_EQ(dot(a, Vector3d(2, 5, 7)), 13);
    EXPECT_EQ(dot(Vector3d(2, 5, 7), a), 13);
    EXPECT_EQ(cross(a, b), (Vector3d{0, 7.5, 5}));
    EXPECT_EQ(cross(raise(a), raise(b)), (Covector3d{0, 7.5, 5}));
    EXPECT_EQ(raise(lower(Vector3d(1, 2, 3))), (Vector3d{1, 2, 3}));
    EXPECT_EQ(length(Vector3d(2, -3, 6)), 7);
    EXPECT_EQ(a.raw(), glm::dvec3(1, -2, 3));
}

TEST(Covector, normalizeOrReturnsTheFallbackForZeroInfinityAndNan)
{
    const Vector3d other(0, 1, 0);
    const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_LT(length(normalizeOr(Vector3d(2, -3, 6), other) - Vector3d(2, -3, 6) * (1 / 7.0)), 1e-15);
    for (const Vector3d bad : {Vector3d(0, 0, 0), Vector3d(inf, 0, 0), Vector3d(0, nan, 1)})
        EXPECT_EQ(normalizeOr(bad, other), other);
}

TEST(Covector, angleIsAccurateNear0And180Degrees)
{
    const Vector3d x(3, 0, 0);
    EXPECT_NEAR(angle(x, Vector3d(std::cos(1e-9), std::sin(1e-9), 0)), 1e-9, 1e-18);
    EXPECT_NEAR(angle(x, Vector3d(-1, 0, 1e-9)), std::numbers::pi - 1e-9, 1e-15);
    EXPECT_NEAR(angle(x, Vector3d(0, 0, -2)), std::numbers::pi / 2, 1e-15);
    EXPECT_EQ(angle(x, Vector3d(0, 0, 0)), 0);
}

TEST(Covector, mapsUseTheMatrixAndItsInverseTranspose)
{
    const glm::dmat3 m(1, 0, 0, 2, 3, 0, 0, 1, -4); // columns; determinant -12
    const LinearMap<double> map(m);
    EXPECT_NEAR(map.determinant(), -12, 1e-12);
    EXPECT_EQ(map(Vector3d(1, 2, 3)), Vector3d(m * glm::dvec3(1, 2, 3)));
    const glm::dvec3 c(0.5, -1, 2), expected = glm::transpose(glm::inverse(m)) * c;
    EXPECT_LT(length(map(Covector3d(c)) - Covector3d(expected)), 1e-12);
    // The cofactor matrix times c has the same direction, mirrored or not.
    EXPECT_LT(length(map.planeImage(Covector3d(c)) - Covector3d(expected * 12.0)), 1e-12);
    const LinearMap<double> unmirrored(glm::dmat3(1, 0, 0, 2, 3, 0, 0, 1, 4));
    EXPECT_GT(dot(unmirrored.planeImage(Covector3d(c)), raise(unmirrored(Covector3d(c)))), 0);
}

TEST(NormalTransform, mirroredScaleInARotationMatchesTheFormulas)
{
    // M = R S, S = (-2, 3, 5): inverse transpose and undoing the scale give R S^-1 n; rotation only ignores S.
    const glm::dmat3 r(0, 1, 0, 0, 0, 1, 1, 0, 0); // x to y, y to z, z to x
    const glm::dmat3 m(r[0] * -2.0, r[1] * 3.0, r[2] * 5.0);
    const glm::dvec3 n(0.6, -0.48, 0.64);
    const glm::dvec3 unscaled = glm::normalize(r * glm::dvec3(n.x / -2, n.y / 3, n.z / 5));
    for (const NormalTransform method : {NormalTransform::undoScale, NormalTransform::inverseTranspose})
        EXPECT_LT(glm::length(transformNormal(method, m, Covector3d(n)).raw() - unscaled), 1e-12);
    EXPECT_LT(glm::length(transformNormal(NormalTransform::rotationOnly, m, Covector3d(n)).raw() - r * n), 1e-12);
    // A scale of zero returns n, normalised.
    const glm::dmat3 flat(r[0], r[1], r[2] * 0.0);
    for (const NormalTransform method :
         {NormalTransform::undoScale, NormalTransform::rotationOnly, NormalTransform::inverseTranspose})
        EXPECT_LT(glm::length(transformNormal(method, flat, Covector3d(n * 3.0)).raw() - n), 1e-12);
}

TEST(CotangentFrame, isTransformedByTheInverseTranspose)
{
    const glm::dmat3 m(1, 0, 0, 2, 3, 0, 0, 1, -4);
    const CotangentFrame<double> f{Covector3d(1, 0.2, -0.3), Covector3d(0.4, 2, 0.1), Covector3d(-0.2, 0.3, 0.9)};
    const CotangentFrame<double> g = transform(LinearMap<double>(m), f);
    const glm::dmat3 it = glm::transpose(glm::inverse(m));
    EXPECT_LT(glm::length(g.t.raw() - it * f.t.raw()), 1e-12);
    EXPECT_LT(glm::length(g.b.raw() - it * f.b.raw()), 1e-12);
    EXPECT_LT(glm::length(g.n.raw() - it * f.n.raw()), 1e-12);
}

TEST(CotangentFrame, perturbsByItsThreeCovectors)
{
    const CotangentFrame<double> f{Covector3d(1, 0.2, -0.3), Covector3d(0.4, 2, 0.1), Covector3d(-0.2, 0.3, 0.9)};
    const glm::dvec3 m(0.3, -0.5, 0.8);
    const glm::dvec3 expected = glm::normalize(f.t.raw() * m.x + f.b.raw() * m.y + f.n.raw() * m.z);
    EXPECT_LT(glm::length(perturb(f, m).raw() - expected), 1e-12);
    EXPECT_LT(glm::length(encode(f, Covector3d(expected)) - glm::normalize(m)), 1e-12);
}

} // namespace
} // namespace cotan
