// Claims of docs/explanation/theory.md that no table of `cotan accuracy` covers.
#include <gtest/gtest.h>

#include "truth/patch.hpp"
#include "truth/tessellation.hpp"

namespace cotan {
namespace {

struct Pixel {
    AffinePatch patch;
    Differences<double> d;
};

Pixel randomPixel(Random& random, bool mirrored)
{
    Pixel x;
    x.patch = randomPatch(random, mirrored);
    glm::dvec3 eye;
    do
        eye = random.direction();
    while (glm::dot(eye, x.patch.normal) < 0.2);
    x.d = screenDifferences(PixelCamera::lookAt(eye * 4.0, {0, 0, 0}, random.direction(), 1800), x.patch, {0, 0, 0});
    return x;
}

double determinant(const Differences<double>& d) { return d.duvdx.x * d.duvdy.y - d.duvdx.y * d.duvdy.x; }

TEST(Theory, theNonperspectiveFormIsNotTheInverseTransposeOfTheTangents)
{
    Random random(31);
    double sum = 0;
    constexpr int kPixels = 1000;
    for (int i = 0; i < kPixels; ++i) {
        const Pixel x = randomPixel(random, false);
        // Tangents dP/du and dP/dv by the inverse of the uv differences.
        const double det = determinant(x.d);
        const glm::dvec3 px = x.d.dpdx.raw(), py = x.d.dpdy.raw();
        const glm::dvec3 dpdu = (px * x.d.duvdy.y - py * x.d.duvdx.y) / det;
        const glm::dvec3 dpdv = (py * x.d.duvdx.x - px * x.d.duvdy.x) / det;
        // Their inverse transpose with n gives the gradients, as in the exact frame.
        const glm::dvec3 area = glm::cross(dpdu, dpdv);
        AffinePatch gradients = x.patch;
        gradients.gradU = glm::cross(dpdv, area) / glm::dot(area, area);
        gradients.gradV = glm::cross(area, dpdu) / glm::dot(area, area);
        const glm::dvec3 m = tiltedTexel(random, 45);
        EXPECT_LT(degreesBetween(truthS(gradients, m), shade(Frame::cotangent, x.patch.normal, x.d, m)), 1e-8);
        sum += degreesBetween(truthS(gradients, m), shade(Frame::nonperspective, x.patch.normal, x.d, m));
    }
    EXPECT_GT(sum / kPixels, 10);
}

TEST(Theory, mirroredUvHaveANegativeDeterminant)
{
    Random random(32);
    for (int i = 0; i < 1000; ++i) {
        // Rows point up and the surface is seen from its front: unmirrored uv have the orientation of the screen.
        EXPECT_GT(determinant(randomPixel(random, false).d), 0);
        EXPECT_LT(determinant(randomPixel(random, true).d), 0);
    }
}

TEST(Theory, gradientOfUIsTheTangentOfVCrossTheNormal)
{
    for (const Surface& surface : surfaces()) {
        Random random(33);
        for (int i = 0; i < 100; ++i) {
            const SurfacePoint p = surface.at({random.unit(), random.unit()});
            // |N| = |Pu x Pv|; n is outward or inward, depending on the orientation of uv.
            const glm::dvec3 area = glm::cross(p.dpdu, p.dpdv);
            const glm::dvec3 n = glm::normalize(area);
            EXPECT_LT(glm::length(glm::cross(p.dpdv, n) / glm::length(area) - p.gradU), 1e-9) << surface.name;
            EXPECT_LT(glm::length(glm::cross(n, p.dpdv) / glm::length(area) + p.gradU), 1e-9) << surface.name;
        }
    }
}

// Fraction of texels that need a negative z to encode a steep relief on a coarse sphere, for normals on the outside.
double fractionOfNegativeZ(Frame frame)
{
    const Surface& sphere = surfaces().front();
    const Tessellation mesh = tessellate(sphere, 8, false, false);
    Random random(71);
    int negative = 0;
    constexpr int kSamples = 20000;
    for (int i = 0; i < kSamples; ++i) {
        const Interpolated x = interpolate(mesh, randomPoint(random, mesh));
        const SurfacePoint p = sphere.at(x.parameters);
        const glm::dvec3 target = truthS(p, texelOf(Waves{8, 24}.at(x.uv.x, x.uv.y)));
        const auto f = makeFrame(frame, Covector3d(glm::normalize(x.n)), x.edges);
        negative += encode(f, Covector3d(target)).z < 0 && glm::dot(target, x.n) > 0;
    }
    return double(negative) / kSamples;
}

TEST(Theory, onlyFramesInThePlaneOfTheFaceNeedNegativeZ)
{
    EXPECT_EQ(fractionOfNegativeZ(Frame::cotangent), 0); // t and b perpendicular to n: z has the sign of n . target
    EXPECT_EQ(fractionOfNegativeZ(Frame::exact), 0);
    EXPECT_GT(fractionOfNegativeZ(Frame::paperFull), 0.05);
}

} // namespace
} // namespace cotan
