// Clear coat, anisotropic highlights, sheen and transmission of light.h and sheen.h against independent formulas in
// double, and against two properties of every reflection: reciprocity and energy conservation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/render_text.hpp"
#include "truth/patch.hpp"

namespace cotan {
namespace {

struct LayerRay {
    glm::dvec3 n, t, v, l; // t is perpendicular to n
};

LayerRay randomLayerRay(Random& random)
{
    for (;;) {
        LayerRay r{random.direction(), random.direction(), random.direction(), random.direction()};
        r.t = glm::normalize(r.t - r.n * glm::dot(r.n, r.t));
        if (glm::dot(r.n, r.v) > 0.01 && glm::dot(r.n, r.l) > 0.01)
            return r;
    }
}

// B. Walter and others 2007 and E. Heitz 2014: an anisotropic GGX surface is an isotropic one in a space scaled by the
// two roughnesses; masking uses Lambda of the projected roughness.
double anisotropicByTheBook(const LayerRay& r, double along, double across)
{
    const glm::dvec3 b = glm::cross(r.n, r.t), h = glm::normalize(r.v + r.l);
    const auto slopes = [&](glm::dvec3 w) { return glm::dvec2(glm::dot(w, r.t), glm::dot(w, b)) / glm::dot(w, r.n); };
    const glm::dvec2 s = slopes(h) / glm::dvec2(along, across);
    const double density =
        1 / (std::numbers::pi * along * across * std::pow(glm::dot(h, r.n), 4) * std::pow(1 + glm::dot(s, s), 2));
    const auto lambda = [&](glm::dvec3 w) {
        const glm::dvec2 a = slopes(w) * glm::dvec2(along, across);
        return (std::sqrt(1 + glm::dot(a, a)) - 1) / 2;
    };
    const double masking = 1 / (1 + lambda(r.v) + lambda(r.l));
    return density * masking / (4 * glm::dot(r.n, r.v) * glm::dot(r.n, r.l));
}

TEST(LightLayers, anisotropicHighlightIsHeitzsFormula)
{
    Random random(901);
    double worst = 0;
    for (const double roughness : {0.045, 0.2, 0.5, 1.0})
        for (const double strength : {0.0, 0.3, 0.7, 1.0})
            for (int k = 0; k < 500; ++k) {
                const LayerRay r = randomLayerRay(random);
                const double across = roughness * roughness, along = across + (1 - across) * strength * strength;
                const double expected = anisotropicByTheBook(r, along, across);
                const double found = f64::cotan_ggx_anisotropic(r.n, r.v, r.l, roughness, strength, r.t);
                worst = std::max(worst, std::abs(found / expected - 1));
            }
    EXPECT_LT(worst, 1e-6); // double precision; near-mirrors amplify rounding errors
}

TEST(LightLayers, anisotropyOfZeroIsIsotropic)
{
    Random random(902);
    for (int k = 0; k < 1000; ++k) {
        const LayerRay r = randomLayerRay(random);
        const double roughness = random.range(0.05, 1);
        const double even = f64::cotan_ggx(r.n, r.v, r.l, roughness);
        EXPECT_NEAR(f64::cotan_ggx_anisotropic(r.n, r.v, r.l, roughness, 0, r.t) / even, 1, 1e-6);
    }
}

TEST(LightLayers, reflectionIsReciprocal)
{
    Random random(903);
    for (int k = 0; k < 1000; ++k) {
        const LayerRay r = randomLayerRay(random);
        const double roughness = random.range(0.05, 1), strength = random.unit();
        const double there = f64::cotan_ggx_anisotropic(r.n, r.v, r.l, roughness, strength, r.t);
        const double back = f64::cotan_ggx_anisotropic(r.n, r.l, r.v, roughness, strength, r.t);
        EXPECT_NEAR(back / there, 1, 1e-9);
        const f64::cotan_coat coat{strength, roughness, r.n};
        const double coatThere = f64::cotan_reflect_coat(coat, r.v, r.l) / glm::dot(r.n, r.l);
        const double coatBack = f64::cotan_reflect_coat(coat, r.l, r.v) / glm::dot(r.n, r.v);
        EXPECT_NEAR(coatBack, coatThere, 1e-9 * coatThere);
    }
}

// Light reflected in a white furnace: the integral of `reflect` over all lights, in cells of equal solid angle.
template<class Reflect> double furnace(glm::dvec3 n, glm::dvec3 t, int cells, Reflect reflect)
{
    const glm::dvec3 b = glm::cross(n, t);
    double sum = 0;
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < 2 * cells; ++j) {
            const double z = (i + 0.5) / cells, a = std::numbers::pi * (j + 0.5) / cells, s = std::sqrt(1 - z * z);
            sum += reflect(t * (s * std::cos(a)) + b * (s * std::sin(a)) + n * z);
        }
    return sum * 2 * std::numbers::pi / (2.0 * cells * cells);
}

TEST(LightLayers, anisotropicWhiteMetalConservesEnergy)
{
    const glm::dvec3 n(0, 0, 1), t(1, 0, 0);
    double smooth = 0;
    for (const double roughness : {0.3, 0.6, 1.0})
        for (const double strength : {0.0, 0.5, 1.0})
            for (const double degrees : {0.0, 40.0, 75.0})
                for (const double rotation : {0.0, 45.0, 90.0}) {
                    const double a = degrees * kDegree, p = rotation * kDegree;
                    const glm::dvec3 v(std::sin(a) * std::cos(p), std::sin(a) * std::sin(p), std::cos(a));
                    const double all = furnace(n, t, 256, [&](glm::dvec3 l) {
                        return f64::cotan_ggx_anisotropic(n, v, l, roughness, strength, t) * l.z;
                    });
                    EXPECT_LT(all, 1.002) << roughness << " " << strength << " " << degrees; // sum over cells
                    EXPECT_GT(all, 0.3) << roughness << " " << strength << " " << degrees;   // one bounce only
                    if (roughness < 0.5 && strength == 0)
                        smooth = std::max(smooth, all);
                }
    EXPECT_GT(smooth, 0.97); // smooth surfaces lose almost nothing
}

TEST(LightLayers, coatOverWhiteConservesEnergy)
{
    const glm::dvec3 n(0, 0, 1), t(1, 0, 0);
    for (const double roughness : {0.2, 0.5, 1.0})
        for (const double degrees : {0.0, 40.0, 60.0, 75.0, 85.0}) {
            const double a = degrees * kDegree;
            const glm::dvec3 v(std::sin(a), 0, std::cos(a));
            const f64::cotan_coat coat{1, roughness, n};
            const double lobe = furnace(n, t, 256, [&](glm::dvec3 l) { return f64::cotan_reflect_coat(coat, v, l); });
            // A base below the coat that reflects everything.
            EXPECT_LT(lobe + 1 - f64::cotan_coat_fraction(coat, v), 1.005) << roughness << " " << degrees;
            EXPECT_GT(lobe, 0.01);
        }
}

TEST(LightLayers, coatIsABlackDielectricTimesItsStrength)
{
    Random random(904);
    for (int k = 0; k < 500; ++k) {
        const LayerRay r = randomLayerRay(random);
        const double roughness = random.range(0.05, 1), strength = random.unit();
        f64::cotan_surface s{};
        s.roughness = roughness;
        s.occlusion = 1;
        s.n = r.n;
        s.v = r.v;
        const f64::cotan_coat coat{strength, roughness, r.n};
        const double expected = strength * f64::cotan_reflect_pbr(s, r.l).x;
        EXPECT_NEAR(f64::cotan_reflect_coat(coat, r.v, r.l), expected, 1e-9 * expected);
        const glm::dvec3 around = f64::cotan_reflect_environment(s) * strength;
        EXPECT_LT(glm::length(f64::cotan_reflect_coat_environment(coat, r.v) - around), 1e-9);
        const double power = std::pow(1 - glm::dot(r.n, r.v), 5);
        EXPECT_NEAR(f64::cotan_coat_fraction(coat, r.v), strength * (0.04 + 0.96 * power), 1e-12);
    }
}

TEST(LightLayers, plainGlossIsMetallicRoughness)
{
    Random random(905);
    for (int k = 0; k < 200; ++k) {
        const LayerRay r = randomLayerRay(random);
        f64::cotan_surface s{};
        s.base_color = {random.unit(), random.unit(), random.unit()};
        s.metallic = random.unit();
        s.roughness = random.range(0.05, 1);
        s.occlusion = 1;
        s.n = r.n;
        s.v = r.v;
        const f64::cotan_gloss plain = f64::cotan_gloss_of(1.5, 1, {1, 1, 1});
        EXPECT_LT(glm::length(f64::cotan_reflect_glossy(s, plain, r.l) - f64::cotan_reflect_pbr(s, r.l)), 1e-9);
        EXPECT_LT(glm::length(f64::cotan_reflect_environment_glossy(s, plain) - f64::cotan_reflect_environment(s)),
                  1e-9);
        EXPECT_EQ(f64::cotan_reflecting_normal(s, plain), s.n);
    }
    // Water and diamond; an index of 0 stands for infinity.
    EXPECT_NEAR(f64::cotan_gloss_of(1.33, 1, {1, 1, 1}).f0.x, 0.0201, 1e-4);
    EXPECT_NEAR(f64::cotan_gloss_of(2.42, 1, {1, 1, 1}).f0.x, 0.1724, 1e-4);
    EXPECT_EQ(f64::cotan_gloss_of(0, 0.5, {1, 1, 1}).f0.x, 0.5);
    EXPECT_EQ(f64::cotan_gloss_of(2.42, 0.5, {9, 1, 0}).f0.x, 0.5); // clamped to 1, then multiplied by the strength
}

// Charlie sheen as specified by KHR_materials_sheen.
double charlieByTheBook(const LayerRay& r, double roughness)
{
    const double alpha = roughness * roughness, inverse = 1 / alpha;
    const double cosine = glm::dot(r.n, glm::normalize(r.v + r.l));
    const double density =
        (2 + inverse) * std::pow(std::sin(std::acos(std::min(cosine, 1.0))), inverse) / (2 * std::numbers::pi);
    const auto fit = [&](double x) {
        const double k = (1 - alpha) * (1 - alpha);
        const double a = k * 25.3245 + (1 - k) * 21.5473, b = k * 3.32435 + (1 - k) * 3.82987;
        const double c = k * 0.16801 + (1 - k) * 0.19823, d = -k * 1.27393 - (1 - k) * 1.97760;
        const double e = -k * 4.85967 - (1 - k) * 4.32054;
        return a / (1 + b * std::pow(x, c)) + d * x + e;
    };
    const auto lambda = [&](double x) { return std::exp(x < 0.5 ? fit(x) : 2 * fit(0.5) - fit(1 - x)); };
    const double nv = glm::dot(r.n, r.v), nl = glm::dot(r.n, r.l);
    return density * std::min(1 / ((1 + lambda(nv) + lambda(nl)) * 4 * nv * nl), 1.0);
}

TEST(LightLayers, sheenReflectsByCharliesFormula)
{
    Random random(907);
    double worst = 0;
    for (const double roughness : {0.15, 0.3, 0.6, 1.0})
        for (int k = 0; k < 500; ++k) {
            const LayerRay r = randomLayerRay(random);
            const double expected = charlieByTheBook(r, roughness);
            if (expected > 1e-6)
                worst = std::max(worst, std::abs(f64::cotan_charlie(r.n, r.v, r.l, roughness) / expected - 1));
        }
    EXPECT_LT(worst, 1e-9);
    // Roughness below 0.15 is treated as 0.15.
    const LayerRay r = randomLayerRay(random);
    EXPECT_EQ(f64::cotan_charlie(r.n, r.v, r.l, 0), f64::cotan_charlie(r.n, r.v, r.l, 0.15));
}

TEST(LightLayers, sheenAlbedoIsItsIntegral)
{
    const glm::dvec3 n(0, 0, 1), t(1, 0, 0);
    double worst = 0, sum = 0;
    int count = 0;
    for (const double roughness : {0.0, 0.15, 0.18, 0.25, 0.35, 0.5, 0.7, 0.85, 1.0})
        for (const double nv : {0.03, 0.06, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
            const glm::dvec3 v(std::sqrt(1 - nv * nv), 0, nv);
            const double all =
                furnace(n, t, 200, [&](glm::dvec3 l) { return f64::cotan_charlie(n, v, l, roughness) * l.z; });
            const double error = std::abs(f64::cotan_sheen_albedo(nv, roughness) - all);
            worst = std::max(worst, error);
            sum += error;
            ++count;
        }
    EXPECT_LT(worst, 0.03);        // as sheen.h states, plus the error of the sum over cells
    EXPECT_LT(sum / count, 0.008); // many cosines here are small, where the fit is worse than on average
}

TEST(LightLayers, sheenOverWhiteConservesEnergy)
{
    const glm::dvec3 n(0, 0, 1), t(1, 0, 0), white(1);
    for (const double roughness : {0.0, 0.3, 0.6, 1.0})
        for (const double nv : {0.03, 0.1, 0.3, 0.6, 1.0}) {
            const glm::dvec3 v(std::sqrt(1 - nv * nv), 0, nv);
            const f64::cotan_sheen cloth{white, roughness};
            const auto lambert = [&](glm::dvec3 l) { return white * (l.z / std::numbers::pi); };
            const double all = furnace(
                n, t, 200, [&](glm::dvec3 l) { return f64::cotan_reflect_sheen(cloth, n, v, l, lambert(l)).y; });
            EXPECT_LT(all, 1.045) << roughness << " " << nv; // error of the fit
            EXPECT_GT(all, 0.6) << roughness << " " << nv;
            EXPECT_NEAR(f64::cotan_reflect_sheen_around(cloth, n, v, white, white).y, 1, 1e-12);
        }
}

TEST(LightLayers, sheenIsReciprocal)
{
    Random random(908);
    for (int k = 0; k < 1000; ++k) {
        const LayerRay r = randomLayerRay(random);
        const f64::cotan_sheen cloth{{random.unit(), random.unit(), random.unit()}, random.unit()};
        const double nl = glm::dot(r.n, r.l), nv = glm::dot(r.n, r.v);
        const glm::dvec3 color(0.2, 0.5, 0.8);
        const glm::dvec3 there = f64::cotan_reflect_sheen(cloth, r.n, r.v, r.l, color * nl) / nl;
        const glm::dvec3 back = f64::cotan_reflect_sheen(cloth, r.n, r.l, r.v, color * nv) / nv;
        EXPECT_LT(glm::length(there - back), 1e-9 * glm::length(there));
    }
}

// Reflected, scattered and transmitted light sum to 1, whatever the transmission. Metals transmit none.
TEST(LightLayers, reflectedAndTransmittedLightSumToOne)
{
    Random random(909);
    for (int k = 0; k < 500; ++k) {
        const LayerRay r = randomLayerRay(random);
        f64::cotan_surface s{};
        s.base_color = {1, 1, 1};
        s.roughness = random.range(0.05, 1);
        s.occlusion = 1;
        s.n = r.n;
        s.v = r.v;
        f64::cotan_gloss g = f64::cotan_gloss_of(random.range(1, 2), random.unit(), {1, random.unit(), 0.5});
        g.transmission = random.unit();
        const glm::dvec2 albedo = f64::cotan_split_sum(glm::dot(r.n, r.v), s.roughness);
        const glm::dvec3 white(1), back = f64::cotan_reflect_image(s, g, white, white, albedo);
        const glm::dvec3 transmitted = f64::cotan_transmittance(s, g);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(back[c] + transmitted[c], 1,
                        0.02); // transmittance does not account for multiple bounces
            EXPECT_LE(transmitted[c], g.transmission);
        }
        // Light scattered from a lamp falls by the same fraction.
        f64::cotan_gloss opaque = g;
        opaque.transmission = 0;
        const glm::dvec3 glint = f64::cotan_reflect_highlight(s, g, r.l, 3);
        const glm::dvec3 whole = f64::cotan_reflect_highlight(s, opaque, r.l, 3);
        f64::cotan_gloss clear = g;
        clear.transmission = 1;
        const glm::dvec3 bare = f64::cotan_reflect_highlight(s, clear, r.l, 3);
        EXPECT_LT(glm::length(glint - (bare * g.transmission + whole * (1 - g.transmission))), 1e-9);
        EXPECT_EQ(f64::cotan_reflect_highlight(s, clear, r.l, 0), glm::dvec3(0));
        s.metallic = 1;
        EXPECT_EQ(f64::cotan_transmittance(s, g), glm::dvec3(0));
    }
}

TEST(LightLayers, anisotropyFollowsTheTangentOfASkewedParametrisation)
{
    Random random(906);
    for (int k = 0; k < 500; ++k) {
        // The plane p = p0 + u du + v dv; the gradients of u and v are t and b of the cotangent frame.
        const glm::dvec3 du = random.direction() * random.range(0.1, 10),
                         dv = random.direction() * random.range(0.1, 10);
        const glm::dvec3 n = glm::normalize(glm::cross(du, dv)) * (random.unit() < 0.5 ? -1.0 : 1.0);
        const double area = glm::dot(glm::cross(du, dv), n);
        const glm::dvec3 t = glm::cross(dv, n) / area, b = glm::cross(n, du) / area;
        const glm::dvec3 along = f64::cotan_direction_on_surface(n, t, b, {1, 0}, n);
        EXPECT_LT(glm::length(along - glm::normalize(du)), 1e-6);
        const glm::dvec3 across = f64::cotan_direction_on_surface(n, t, b, {0, 1}, n);
        EXPECT_NEAR(glm::dot(across, along), 0, 1e-6);
        EXPECT_GT(glm::dot(across, dv), 0);
        const glm::dvec3 bent = glm::normalize(n + random.direction() * 0.5);
        const glm::dvec3 direction = f64::cotan_direction_on_surface(n, t, b, {0.6, -0.8}, bent);
        EXPECT_NEAR(glm::dot(direction, bent), 0, 1e-6);
        EXPECT_NEAR(glm::length(direction), 1, 1e-6);
    }
    EXPECT_EQ(f32::cotan_direction_on_surface({0, 0, 1}, {0, 0, 0}, {0, 0, 0}, {1, 0}, {0, 0, 1}), glm::vec3(0));
}

TEST(LightLayers, bentNormalOfAFullyAnisotropicMirrorIsAcrossTheDirection)
{
    // Seen along its brushing, a brushed mirror reflects like a cylinder with that axis.
    const glm::dvec3 n(0, 0, 1), t(1, 0, 0), v = glm::normalize(glm::dvec3(0.4, 0.5, 0.7));
    const glm::dvec3 bent = f64::cotan_bent_normal(n, v, 0, 1, t);
    EXPECT_LT(glm::length(bent - glm::normalize(glm::dvec3(0.4, 0, 0.7))), 1e-9);
    EXPECT_LT(glm::length(f64::cotan_bent_normal(n, v, 0, 0, t) - n), 1e-9);
    EXPECT_LT(glm::length(f64::cotan_bent_normal(n, v, 1, 1, t) - n), 1e-9);
}

} // namespace
} // namespace cotan
