// light.h against independent formulas in double: at grazing angles, over all roughnesses and on both sides of every
// threshold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/render_text.hpp"
#include "truth/patch.hpp"

namespace cotan {
namespace {

// A float unit vector at `angle` radians from z. Not inlined: gcc 12 at -O2 may otherwise continue with digits that the
// rounding to float removes.
[[gnu::noinline]] glm::vec3 tiltedBy(Random& random, glm::dvec3 z, double angle)
{
    const glm::dvec3 side = glm::normalize(glm::cross(z, random.direction()));
    return glm::vec3(glm::normalize(z * std::cos(angle) + side * std::sin(angle)));
}

template<class Surface>
Surface surfaceOf(glm::dvec3 baseColor, double metallic, double roughness, glm::dvec3 n, glm::dvec3 v)
{
    Surface s;
    s.base_color = decltype(s.base_color)(baseColor);
    s.metallic = decltype(s.metallic)(metallic);
    s.roughness = decltype(s.roughness)(roughness);
    s.occlusion = 1;
    s.emissive = decltype(s.emissive)(0.0, 0.0, 0.0);
    s.n = decltype(s.n)(n);
    s.v = decltype(s.v)(v);
    return s;
}

// glTF 2.0 specification, appendix B: GGX as a density of slopes, Smith's height-correlated masking by its Lambda,
// Schlick's Fresnel; times n.l. Roughness and n.v have the lower bounds that light.h states.
glm::dvec3 pbrByTheBook(const f64::cotan_surface& s, glm::dvec3 l)
{
    const double roughness = std::max(s.roughness, 0.045), alpha = roughness * roughness;
    const double nl = glm::dot(s.n, l), nv = std::max(std::abs(glm::dot(s.n, s.v)), 1e-4);
    if (nl <= 0)
        return glm::dvec3(0);
    const glm::dvec3 h = glm::normalize(l + s.v);
    const double nh = glm::dot(s.n, h), tangent = glm::length(glm::cross(s.n, h)) / nh;
    const double slope = tangent / alpha;
    const double density = 1 / (std::numbers::pi * alpha * alpha * nh * nh * nh * nh * std::pow(1 + slope * slope, 2));
    const auto lambda = [&](double c) {
        const double t = std::sqrt(1 - c * c) / c;
        return (std::sqrt(1 + alpha * alpha * t * t) - 1) / 2;
    };
    const double masking = 1 / (1 + lambda(nl) + lambda(nv));
    const glm::dvec3 f0 = glm::dvec3(0.04) * (1 - s.metallic) + s.base_color * s.metallic;
    const glm::dvec3 fresnel = f0 + (1.0 - f0) * std::pow(1 - glm::dot(s.v, h), 5);
    const glm::dvec3 diffuse = (1.0 - fresnel) * s.base_color * (1 - s.metallic) / std::numbers::pi;
    return (diffuse + fresnel * (density * masking / (4 * nl * nv))) * nl;
}

// Maximum relative difference of the channels; 1 if it is not finite.
double relative(glm::dvec3 found, glm::dvec3 expected)
{
    double worst = 0;
    for (int c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(found[c] / expected[c] - 1));
    return std::isfinite(worst) ? worst : 1;
}

struct LitInput {
    glm::dvec3 n, l, v; // values that float can represent
    glm::dvec3 baseColor;
    double metallic, roughness;
};

// Cosines n.v and n.l from 1e-3 to 1; half of the lights are inside and around the highlight.
LitInput randomLitInput(Random& random, double roughness)
{
    const double alpha = std::pow(std::max(roughness, 0.045), 2);
    for (;;) {
        const glm::dvec3 n(tiltedBy(random, random.direction(), 0));
        const glm::dvec3 v(tiltedBy(random, n, std::acos(std::pow(10, random.range(-3, 0)))));
        glm::dvec3 l(tiltedBy(random, n, std::acos(std::pow(10, random.range(-3, 0)))));
        if (random.unit() < 0.5) {
            const glm::dvec3 h(
                tiltedBy(random, n, random.unit() < 0.2 ? 0 : alpha * std::pow(10, random.range(-2, 1.5))));
            l = glm::dvec3(tiltedBy(random, glm::normalize(h * (2 * glm::dot(v, h)) - v), 0));
        }
        if (glm::dot(n, l) > 1e-3 && glm::dot(n, v) > 1e-3 && glm::length(l + v) > 1e-3)
            return {
                n,        l, v, {random.range(0.01, 1), random.range(0.01, 1), random.range(0.01, 1)}, random.unit(),
                roughness};
    }
}

TEST(Light, pbrIsTheSpecifiedFormulaForAllRoughnessesAndAngles)
{
    Random random(81);
    double worst = 0, worstFloat = 0;
    for (const double roughness : {0.0, 0.02, 0.0451, 0.1, 0.25, 0.5, 0.75, 1.0})
        for (int k = 0; k < 4000; ++k) {
            const LitInput i = randomLitInput(random, double(float(roughness)));
            const auto s = surfaceOf<f64::cotan_surface>(i.baseColor, i.metallic, i.roughness, i.n, i.v);
            const glm::dvec3 expected = pbrByTheBook(s, i.l);
            worst = std::max(worst, relative(f64::cotan_reflect_pbr(s, i.l), expected));
            const auto f = surfaceOf<f32::cotan_surface>(i.baseColor, i.metallic, i.roughness, i.n, i.v);
            worstFloat =
                std::max(worstFloat, relative(glm::dvec3(f32::cotan_reflect_pbr(f, glm::vec3(i.l))), expected));
        }
    // The vectors have unit length only to 6e-8: the sine and cosine of the two formulas differ by that over alpha.
    EXPECT_LT(worst, 1e-4);
    EXPECT_LT(worstFloat, 1e-3); // as light.h states; computing 1 - (n.h)^2 as a difference loses 15 %
}

TEST(Light, pbrFacingTheHighlightIsTheClosedFormAtRoughnessZero)
{
    // n = l = v: D = 1/(pi alpha^2), V = 1/4, F = f0.
    const double alpha2 = std::pow(0.045, 4);
    const auto s = surfaceOf<f32::cotan_surface>({0.9, 0.5, 0.2}, 1, 0, {0, 0.6, 0.8}, {0, 0.6, 0.8});
    const glm::dvec3 expected = glm::dvec3(0.9, 0.5, 0.2) / (4 * std::numbers::pi * alpha2);
    EXPECT_LT(relative(glm::dvec3(f32::cotan_reflect_pbr(s, s.n)), expected), 1e-5);
}

TEST(Light, fresnelIsSchlicksFifthPower)
{
    // Ratio of a coloured and a white metal in the same light: F alone, since white has F = 1.
    for (const double degrees : {0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.0}) {
        const double a = degrees * kDegree;
        const glm::dvec3 n(0, 0, 1), v(std::sin(a), 0, std::cos(a)), l(-std::sin(a), 0, std::cos(a));
        const glm::dvec3 f0(0, 0.3, 0.7);
        const glm::dvec3 some = f64::cotan_reflect_pbr(surfaceOf<f64::cotan_surface>(f0, 1, 0.6, n, v), l);
        const glm::dvec3 white = f64::cotan_reflect_pbr(surfaceOf<f64::cotan_surface>({1, 1, 1}, 1, 0.6, n, v), l);
        const double power = std::pow(1 - std::cos(a), 5); // v.h = n.v here
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(some[c] / white[c], f0[c] + (1 - f0[c]) * power, 1e-6) << degrees;
    }
}

TEST(Light, dielectricReflects4PercentForAnyColour)
{
    // Black dielectric: no diffuse light; facing the light, F = 0.04 against a white metal's 1.
    const glm::dvec3 n(0, 0, 1);
    const glm::dvec3 black = f64::cotan_reflect_pbr(surfaceOf<f64::cotan_surface>({0, 0, 0}, 0, 0.5, n, n), n);
    const glm::dvec3 white = f64::cotan_reflect_pbr(surfaceOf<f64::cotan_surface>({1, 1, 1}, 1, 0.5, n, n), n);
    EXPECT_NEAR(black.x / white.x, 0.04, 1e-9);
    const glm::dvec3 half = f64::cotan_reflect_pbr(surfaceOf<f64::cotan_surface>({0, 0, 0}, 0.5, 0.5, n, n), n);
    EXPECT_NEAR(half.y / white.y, 0.02, 1e-9); // half metallic, black
}

TEST(Light, lightFromBehindIsNotReflected)
{
    const glm::dvec3 n(0, 0, 1), v = glm::normalize(glm::dvec3(0.3, -0.2, 1));
    const auto s = surfaceOf<f64::cotan_surface>({0.5, 0.6, 0.7}, 0.2, 0.4, n, v);
    for (const double z : {-1e-9, -0.2, -1.0}) {
        const glm::dvec3 l = glm::normalize(glm::dvec3(1 + z, 0, z));
        EXPECT_EQ(f64::cotan_reflect_pbr(s, l), glm::dvec3(0));
        EXPECT_EQ(f64::cotan_reflect_blinn_phong(s, l), glm::dvec3(0));
    }
    // Eye slightly below the normal's horizon, light slightly above it on the opposite side: the half vector is one
    // degree from -n, on the back of a mirror. No highlight there.
    auto behind = s;
    behind.roughness = 0;
    behind.v = {std::sqrt(1 - 0.03 * 0.03), 0, -0.03};
    const glm::dvec3 seen = f64::cotan_reflect_pbr(behind, {-std::sqrt(1 - 0.01 * 0.01), 0, 0.01});
    EXPECT_TRUE(seen.x >= 0 && seen.x < 0.01) << seen.x;
}

TEST(Light, blinnPhongIsItsFormula)
{
    Random random(82);
    double worst = 0, worstFloat = 0;
    for (const double roughness : {0.0, 0.05, 0.11, 0.3, 0.6, 0.95, 1.0})
        for (int k = 0; k < 500; ++k) {
            const LitInput i = randomLitInput(random, double(float(roughness)));
            const double rough = std::max(i.roughness, 0.1), alpha = rough * rough;
            const double exponent = std::max(2 / (alpha * alpha) - 2, 1.0);
            const double nh = std::max(glm::dot(i.n, glm::normalize(i.l + i.v)), 1e-4);
            const glm::dvec3 f0 = glm::dvec3(0.04) * (1 - i.metallic) + i.baseColor * i.metallic;
            const glm::dvec3 expected =
                (i.baseColor * (1 - i.metallic) / std::numbers::pi
                 + f0 * (std::pow(std::min(nh, 1.0), exponent) * (exponent + 8) / (8 * std::numbers::pi)))
                * glm::dot(i.n, i.l);
            const auto s = surfaceOf<f64::cotan_surface>(i.baseColor, i.metallic, i.roughness, i.n, i.v);
            worst = std::max(worst, relative(f64::cotan_reflect_blinn_phong(s, i.l), expected));
            const auto f = surfaceOf<f32::cotan_surface>(i.baseColor, i.metallic, i.roughness, i.n, i.v);
            worstFloat =
                std::max(worstFloat, relative(glm::dvec3(f32::cotan_reflect_blinn_phong(f, glm::vec3(i.l))), expected));
        }
    EXPECT_LT(worst, 1e-9);
    EXPECT_LT(worstFloat, 0.01); // three roundings of n.h, 6e-8 each, to the power of 20,000
}

TEST(Light, halfVectorIsUnitAndZeroBetweenOpposites)
{
    const glm::dvec3 l = glm::normalize(glm::dvec3(0.2, 0.7, -0.4)), v = glm::normalize(glm::dvec3(-0.5, 0.1, 0.9));
    EXPECT_LT(glm::length(f64::cotan_half_vector(l, v) - glm::normalize(l + v)), 1e-12);
    EXPECT_EQ(f64::cotan_half_vector(l, -l), glm::dvec3(0));
}

TEST(Light, smoothIsTheCubicBetweenItsEdges)
{
    // The edges of a spot's cone, cosines of 40 and 25 degrees, and points between them.
    const double outer = std::cos(40 * kDegree), inner = std::cos(25 * kDegree);
    const auto at = [&](double part) { return f64::cotan_smooth(outer, inner, outer + (inner - outer) * part); };
    EXPECT_EQ(at(-0.01), 0);
    EXPECT_EQ(at(0), 0);
    EXPECT_NEAR(at(0.25), 0.15625, 1e-12); // 3/16 - 2/64
    EXPECT_NEAR(at(0.5), 0.5, 1e-12);
    EXPECT_NEAR(at(0.9), 0.972, 1e-12);
    EXPECT_EQ(at(1), 1);
    EXPECT_EQ(at(1.01), 1);
}

TEST(Light, falloffIsZeroAtAndBeyondTheRange)
{
    using f64::cotan_light_falloff;
    EXPECT_NEAR(cotan_light_falloff(1, 2), 1 - 1.0 / 16, 1e-12);
    EXPECT_NEAR(cotan_light_falloff(3, 4), (1 - 81.0 / 256) / 9, 1e-12);
    EXPECT_NEAR(cotan_light_falloff(3.999, 4), (1 - std::pow(3.999 / 4, 4)) / (3.999 * 3.999), 1e-12);
    EXPECT_GT(cotan_light_falloff(3.999, 4), 0);
    EXPECT_EQ(cotan_light_falloff(4, 4), 0);
    EXPECT_EQ(cotan_light_falloff(4.001, 4), 0);
    EXPECT_EQ(cotan_light_falloff(400, 4), 0);
    for (const double infinite : {0.0, -1.0})
        EXPECT_NEAR(cotan_light_falloff(5, infinite), 0.04, 1e-12);
    EXPECT_NEAR(cotan_light_falloff(0.02, 0), 2500, 1e-9);
    EXPECT_NEAR(cotan_light_falloff(0.01, 0), 1e4, 1e-6);
    EXPECT_NEAR(cotan_light_falloff(0.001, 0), 1e4, 1e-6); // distances below 0.01 count as 0.01
    EXPECT_NEAR(cotan_light_falloff(0, 1), 1e4, 1e-6);
}

TEST(Light, toneCurveIsNarkowiczsOfEachChannel)
{
    const auto curve = [](double x) { return std::min((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 1.0); };
    const glm::dvec3 c = f64::cotan_tone_map({0.05, 0.6, 3});
    EXPECT_NEAR(c.x, curve(0.05), 1e-12);
    EXPECT_NEAR(c.y, curve(0.6), 1e-12);
    EXPECT_NEAR(c.z, curve(3), 1e-12);
    EXPECT_NEAR(f64::cotan_tone(1), 2.54 / 3.16, 1e-12);
    EXPECT_EQ(f64::cotan_tone(0), 0);
    EXPECT_EQ(f64::cotan_tone(1000), 1); // the curve reaches 1 near 10
}

TEST(Light, srgbIsTheStandardOnBothSidesOfItsThresholds)
{
    // IEC 61966-2-1: linear below 0.0031308 and 0.04045, a power of 2.4 above.
    for (const double x : {0.0, 0.0005, 0.001, 0.002, 0.0031, 0.0031307})
        EXPECT_NEAR(f64::cotan_linear_to_srgb(x), 12.92 * x, 1e-12) << x;
    for (const double x : {0.0031309, 0.0032, 0.0035, 0.004, 0.01, 0.05, 0.3, 1.0})
        EXPECT_NEAR(f64::cotan_linear_to_srgb(x), 1.055 * std::pow(x, 1 / 2.4) - 0.055, 1e-12) << x;
    for (const double x : {0.0, 0.01, 0.02, 0.035, 0.04, 0.04044})
        EXPECT_NEAR(f64::cotan_srgb_to_linear(x), x / 12.92, 1e-12) << x;
    for (const double x : {0.04046, 0.041, 0.05, 0.08, 0.2, 0.5, 1.0})
        EXPECT_NEAR(f64::cotan_srgb_to_linear(x), std::pow((x + 0.055) / 1.055, 2.4), 1e-12) << x;
    // Published values for the codes 10, 11 and 188.
    EXPECT_NEAR(f64::cotan_srgb_to_linear(10 / 255.0), 0.0030353, 1e-7);
    EXPECT_NEAR(f64::cotan_srgb_to_linear(11 / 255.0), 0.0033465, 1e-7);
    EXPECT_NEAR(f64::cotan_srgb_to_linear(188 / 255.0), 0.5028865, 1e-7);
    for (int byte = 0; byte < 256; ++byte) // the standard's two constants leave a step of 2e-8
        EXPECT_NEAR(f64::cotan_linear_to_srgb(f64::cotan_srgb_to_linear(byte / 255.0)), byte / 255.0, 1e-6);
}

const glm::dvec3 kGround(0.16, 0.14, 0.12), kHorizon(0.62, 0.66, 0.72), kZenith(0.28, 0.42, 0.68),
    kBox(0.48, 0.80, 0.36);

double hermite(double k)
{
    k = std::clamp(k, 0.0, 1.0);
    return k * k * (3 - 2 * k);
}

// Independent version of the environment: a sky from horizon to zenith over a ground, and a box light. Blur widens the
// edges, averages the sky and weakens the box.
glm::dvec3 skyOf(glm::dvec3 d, double blur)
{
    const auto between = [blur](double sharp, double blurred) { return sharp * (1 - blur) + blurred * blur; };
    const double width = between(0.06, 0.9), edge = between(0.93, 0.2), soft = between(0.03, 0.8);
    const double height = between(std::sqrt(std::clamp(d.y, 0.0, 1.0)), 0.5);
    const glm::dvec3 sky = kHorizon * (1 - height) + kZenith * height;
    const double above = hermite((d.y + width) / (2 * width));
    const double lit = hermite((glm::dot(d, kBox) - edge + soft) / (2 * soft));
    const double strength = 2.2 * (1 - std::sqrt(blur)) + 0.35 * std::sqrt(blur);
    return kGround * (1 - above) + sky * above + strength * lit;
}

TEST(Light, environmentIsSkyOverGroundWithABox)
{
    const auto far = [](glm::dvec3 a, glm::dvec3 b) { return glm::length(a - b); };
    EXPECT_LT(far(f64::cotan_environment({0, 1, 0}, 0), kZenith), 1e-12);
    EXPECT_LT(far(f64::cotan_environment({0, -1, 0}, 0), kGround), 1e-12);
    EXPECT_LT(far(f64::cotan_environment({-1, 0, 0}, 0), (kGround + kHorizon) * 0.5), 1e-12);
    EXPECT_LT(far(f64::cotan_environment(kBox, 0), kHorizon + (kZenith - kHorizon) * std::sqrt(0.8) + 2.2), 1e-12);
    Random random(83);
    for (const double blur : {0.0, 0.1, 0.5, 0.8, 1.0})
        for (int k = 0; k < 300; ++k) {
            const glm::dvec3 d = k % 3 ? random.direction() : glm::normalize(kBox + random.direction() * 0.4);
            EXPECT_LT(far(f64::cotan_environment(d, blur), skyOf(d, blur)), 1e-12) << blur;
        }
}

TEST(Light, environmentIsReflectedByKarissFit)
{
    // EnvBRDFApprox of B. Karis, Physically Based Shading on Mobile (2014), as published.
    Random random(84);
    for (int k = 0; k < 2000; ++k) {
        const LitInput i = randomLitInput(random, random.unit());
        auto s = surfaceOf<f64::cotan_surface>(i.baseColor, i.metallic, i.roughness, i.n, i.v);
        s.occlusion = random.unit();
        if (k % 5 == 0)
            s.v = -s.v; // from behind: n.v counts as zero
        const double nv = std::max(glm::dot(s.n, s.v), 0.0);
        const glm::dvec4 r = s.roughness * glm::dvec4(-1, -0.0275, -0.572, 0.022) + glm::dvec4(1, 0.0425, 1.04, -0.04);
        const double a004 = std::min(r.x * r.x, std::exp2(-9.28 * std::min(nv, 1.0))) * r.x + r.y;
        const double scale = -1.04 * a004 + r.z, bias = 1.04 * a004 + r.w;
        const glm::dvec3 f0 = glm::dvec3(0.04) * (1 - s.metallic) + s.base_color * s.metallic;
        const glm::dvec3 mirrored = 2 * glm::dot(s.n, s.v) * s.n - s.v;
        const glm::dvec3 expected = s.occlusion
            * (skyOf(s.n, 1) * s.base_color * (1 - s.metallic) + skyOf(mirrored, s.roughness) * (f0 * scale + bias));
        EXPECT_LT(glm::length(f64::cotan_reflect_environment(s) - expected), 1e-9) << k;
    }
}

} // namespace
} // namespace cotan
