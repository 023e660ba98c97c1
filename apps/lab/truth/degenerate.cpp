#include "truth/degenerate.hpp"

#include <cmath>
#include <limits>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace cotan {

namespace {

PixelInput goodInput(Random& random, double leanDegrees, bool mirrored)
{
    const AffinePatch p = randomPatch(random, mirrored);
    const glm::dvec3 e = glm::normalize(glm::cross(p.normal, random.direction()));
    glm::dvec3 view;
    do
        view = random.direction();
    while (glm::dot(view, p.normal) < 0.25);
    const auto d = screenDifferences(PixelCamera::lookAt(view * 3.0, {0, 0, 0}, random.direction(), 1000), p, e * 0.3);
    const glm::dvec3 away = glm::normalize(glm::cross(p.normal, random.direction()));
    const double a = leanDegrees * kDegree;
    const glm::dvec3 n = p.normal * std::cos(a) + away * std::sin(a);
    return {glm::vec3(n * random.range(0.6, 1)), toFloat(d), glm::vec3(tiltedTexel(random, 35))};
}

} // namespace

const std::vector<DegenerateCase>& degenerateCases()
{
    using F = float;
    static const std::vector<DegenerateCase> list = {
        {"good", [](Random&, PixelInput&) {}},
        {"mirrored uv", [](Random&, PixelInput&) {}, false, 10, true},
        {"constant uv",
         [](Random&, PixelInput& x) {
             x.d.duvdx = x.d.duvdy = {0, 0};
         },
         true},
        {"collinear uv", [](Random& r, PixelInput& x) { x.d.duvdy = x.d.duvdx * F(r.range(-2, 2)); }},
        {"u constant, v varies", [](Random&, PixelInput& x) { x.d.duvdx.x = x.d.duvdy.x = 0; }},
        {"zero-area pixel triangle",
         [](Random& r, PixelInput& x) {
             const F k = F(r.range(-2, 2));
             x.d.dpdy = x.d.dpdx * k;
             x.d.duvdy = x.d.duvdx * k;
         }},
        {"second difference zero",
         [](Random&, PixelInput& x) {
             x.d.dpdy = {};
             x.d.duvdy = {0, 0};
         },
         true},
        {"all differences zero", [](Random&, PixelInput& x) { x.d = {}; }, true},
        {"n 80 degrees off the face", [](Random&, PixelInput&) {}, false, 80},
        {"n 89.9 degrees off the face", [](Random&, PixelInput&) {}, false, 89.9},
        {"n in the face plane", [](Random&, PixelInput& x) { x.n = x.d.dpdx.raw(); }},
        {"n zero",
         [](Random&, PixelInput& x) {
             x.n = {0, 0, 0};
         }},
        {"tiny: everything x 1e-12",
         [](Random&, PixelInput& x) {
             x.d.dpdx = x.d.dpdx * 1e-12f;
             x.d.dpdy = x.d.dpdy * 1e-12f;
             x.d.duvdx *= 1e-12f;
             x.d.duvdy *= 1e-12f;
         }},
        {"huge: dp x 1e16, uv x 1e8",
         [](Random&, PixelInput& x) {
             x.d.dpdx = x.d.dpdx * 1e16f;
             x.d.dpdy = x.d.dpdy * 1e16f;
             x.d.duvdx *= 1e8f;
             x.d.duvdy *= 1e8f;
         }},
        {"uneven: dp x 1e10, uv x 1e-14",
         [](Random&, PixelInput& x) {
             x.d.dpdx = x.d.dpdx * 1e10f;
             x.d.dpdy = x.d.dpdy * 1e10f;
             x.d.duvdx *= 1e-14f;
             x.d.duvdy *= 1e-14f;
         }},
        {"helper lane beyond the horizon",
         [](Random& r, PixelInput& x) {
             const F k = F(-r.range(5, 500));
             x.d.dpdy = x.d.dpdy * k + x.d.dpdx * 0.3f;
             x.d.duvdy = x.d.duvdy * k + x.d.duvdx * 0.3f;
         }},
        {"one difference infinite or NaN",
         [](Random& r, PixelInput& x) {
             const F bad = r.unit() < 0.5 ? std::numeric_limits<F>::infinity() : std::numeric_limits<F>::quiet_NaN();
             (r.unit() < 0.5 ? x.d.dpdy.x : x.d.duvdx.x) = bad;
         },
         true},
        {"constant uv and a horizontal texel",
         [](Random&, PixelInput& x) {
             x.d.duvdx = x.d.duvdy = {0, 0};
             x.m = {1, 0, 0};
         },
         true},
        {"empty texel",
         [](Random&, PixelInput& x) {
             x.m = {0, 0, 0};
         },
         true},
    };
    return list;
}

PixelInput makeInput(Random& random, const DegenerateCase& c)
{
    PixelInput input = goodInput(random, c.leanDegrees, c.mirrored);
    c.modify(random, input);
    return input;
}

#if defined(__SSE2__)
constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
FlushDenormals::FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | kFlushToZero | kDenormalsAreZero); }
FlushDenormals::~FlushDenormals() { _mm_setcsr(saved_); }
#else
FlushDenormals::FlushDenormals() = default;
FlushDenormals::~FlushDenormals() = default;
#endif

} // namespace cotan
