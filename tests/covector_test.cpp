// Vectors and covectors, and the three ways to carry a normal. What must not compile is tested by
// tests/core.cmake with covector_mixture.cpp.
#include <gtest/gtest.h>

#include "cotan/truth/patch.hpp"

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
            continue; // nearly singular: the inverse loses too many digits to compare
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

TEST(Covector, planeImageOfAFlattenedObjectIsTheNormalOfWhatRemains)
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

double disagreement(NormalTransform way, const glm::dmat3& m, glm::dvec3 n)
{
    return degreesBetween(transformNormal(way, m, Covector3d(n)).raw(),
                          transformNormal(NormalTransform::inverseTranspose, m, Covector3d(n)).raw());
}

glm::dmat3 scale(double x, double y, double z) { return glm::dmat3(x, 0, 0, 0, y, 0, 0, 0, z); }

TEST(NormalTransform, allThreeWaysAgreeForRotationAndUniformScale)
{
    Random random(34);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 n = random.direction();
        const glm::dmat3 m = rotation() * scale(2, 2, 2);
        EXPECT_LT(disagreement(NormalTransform::undoScale, m, n), 1e-10);
        EXPECT_LT(disagreement(NormalTransform::rotationOnly, m, n), 1e-10);
    }
}

TEST(NormalTransform, undoingTheScaleIsRightForScaleAlongTheAxesMirroredOrNot)
{
    Random random(35);
    for (double sign : {1.0, -1.0})
        for (int i = 0; i < 50; ++i)
            EXPECT_LT(disagreement(NormalTransform::undoScale, rotation() * scale(sign, 2, 4),
                                   random.direction()), 1e-10);
}

TEST(NormalTransform, undoingTheScaleIsWrongForAScaleAfterTheRotation)
{
    EXPECT_GT(disagreement(NormalTransform::undoScale, scale(1, 1, 4) * rotation(), {0.6, 0, 0.8}), 5);
}

TEST(NormalTransform, rotationOnlyIsWrongByAtMost36Point9DegreesForOneToFour)
{
    double worst = 0;
    for (double a = 0; a < 90; a += 0.01)
        worst = std::max(worst, disagreement(NormalTransform::rotationOnly, scale(1, 1, 4),
                                             {std::sin(a * kDegree), 0, std::cos(a * kDegree)}));
    EXPECT_NEAR(worst, 36.87, 0.01); // atan((4-1)/(2 sqrt 4))
}

TEST(NormalTransform, zeroScaleGivesAFiniteUnitNormal)
{
    for (auto way : {NormalTransform::undoScale, NormalTransform::rotationOnly, NormalTransform::inverseTranspose})
        EXPECT_NEAR(length(transformNormal(way, scale(1, 1, 0), Covector3d{0, 0.6, 0.8})), 1, 1e-12);
}

TEST(CotangentFrame, uniformScaleAndRotationCarryTheFrameWithTheNormal)
{
    Random random(36);
    const AffinePatch p = randomPatch(random, false);
    const auto d = screenDifferences(PixelCamera::lookAt(p.normal * 3.0, {0, 0, 0}, random.direction(), 800), p,
                                     {0, 0, 0});
    const auto f = makeFrame(Frame::cotangent, Covector3d(p.normal), d);
    const auto g = transform(LinearMap<double>(rotation() * 3.0), f);
    const glm::dvec3 m = tiltedTexel(random, 30);
    EXPECT_LT(degreesBetween(perturb(g, m).raw(), rotation() * perturb(f, m).raw()), 1e-10);
}

} // namespace
} // namespace cotan
