// Runs the portable text on random bits: the total functions must return finite frames and unit normals for any input,
// in float and double; the fused forms must match the frames within the range stated in fused.h.
#include <algorithm>
#include <array>
#include <numbers>

#include "cotan/frame.hpp"
#include "fuzz.hpp"

using namespace cotan;
using namespace cotan::fuzz;

namespace {

template<class V> bool isUnit(const V& v, double tolerance = 1e-5)
{
    return std::abs(double(glm::length(v)) - 1) < tolerance;
}

// Whether a value meets the requirement of finite input of ordinary size.
template<class V> bool ordinary(const V& v) { return glm::length(v) > 1e-18f && glm::length(v) < 1e18f; }

glm::vec3 anyVector(Values& values) { return {values.next<float>(), values.next<float>(), values.next<float>()}; }
glm::vec2 anyPair(Values& values) { return {values.next<float>(), values.next<float>()}; }

glm::dvec2 polar(double radians, double length) { return glm::dvec2(std::cos(radians), std::sin(radians)) * length; }

template<class F> void checkFrame(const F& f, std::string_view name, bool metric)
{
    COTAN_HOLDS(isUnit(f.n), "{}", name);
    COTAN_HOLDS(std::isfinite(glm::dot(f.t, decltype(f.t)(1e-3f)) + glm::dot(f.b, decltype(f.b)(1e-3f))), "{}", name);
    const auto longest = std::max(glm::length(f.t), glm::length(f.b));
    COTAN_HOLDS(metric || longest < 1.001f, "{}: {}", name, double(longest));
}

void checkTotalFrames(Values values)
{
    const glm::vec3 n = anyVector(values), dpdx = anyVector(values), dpdy = anyVector(values), m = anyVector(values);
    const glm::vec2 duvdx = anyPair(values), duvdy = anyPair(values);
    for (const FrameInfo& frame : frames()) {
        if (!frame.total || readsVertices(frame.frame))
            continue;
        const bool metric = frame.frame == Frame::gradient;
        const auto f = evaluate(frame.frame, n, dpdx, dpdy, duvdx, duvdy);
        checkFrame(f, frame.name, metric);
        const auto d = evaluate(frame.frame, glm::dvec3(n), glm::dvec3(dpdx), glm::dvec3(dpdy), glm::dvec2(duvdx),
                                glm::dvec2(duvdy));
        checkFrame(d, frame.name, metric);
        COTAN_HOLDS(isUnit(f32::cotan_apply(f, m)), "{}: {} {} {}", frame.name, m.x, m.y, m.z);
        COTAN_HOLDS(isUnit(f32::cotan_encode(f, glm::normalize(n + glm::vec3(0, 0, 1e-3f)))) || !ordinary(n), "{}",
                    frame.name);
        COTAN_HOLDS(isUnit(f32::cotan_encode(f, m)), "{}: {} {} {}", frame.name, m.x, m.y, m.z);
    }
    for (const auto& f :
         {f32::cotan_frame_smooth(n, dpdx, dpdy), f32::cotan_frame_vertex(n, dpdx, duvdx.x < 0 ? -1.0f : 1.0f)}) {
        checkFrame(f, "from vertices", false);
        COTAN_HOLDS(isUnit(f32::cotan_apply(f, m)), "{} {} {}", m.x, m.y, m.z);
        // If a vector is nearly along n, its remaining part is rounding noise and has any direction.
        const auto along = [&](const glm::vec3& v) {
            const glm::vec3 unit = f32::cotan_normalize_or(v, f.n);
            return glm::length(glm::cross(unit, f.n)) < 1e-3f;
        };
        COTAN_HOLDS(along(dpdx) || along(dpdy) || std::abs(glm::dot(f.n, f.t)) + std::abs(glm::dot(f.n, f.b)) < 1e-3f);
    }
}

void checkTexels(Values values)
{
    f32::cotan_normal_format format;
    format.expansion = values.choose(3);
    format.channels = values.choose(4);
    format.green = values.flip() ? 1.0f : -1.0f;
    format.strength = float(values.between(0.25, 4));
    const glm::vec3 texel = anyVector(values);
    if (!ordinary(texel))
        return;
    const glm::vec3 m = f32::cotan_decode(glm::clamp(texel, -1.0f, 1.0f), format);
    COTAN_HOLDS(finite(m), "{} {} {}", m.x, m.y, m.z);
    const glm::vec3 stored = f32::cotan_encode_texel(glm::normalize(texel), format);
    for (const float c : {stored.x, stored.y, stored.z})
        COTAN_HOLDS(c >= (format.expansion == COTAN_EXPAND_SIGNED ? -1.0f : 0.0f) && c <= 1.0f, "{}", c);
}

void checkGradientsAndBlends(Values values)
{
    const glm::vec3 a = anyVector(values), b = anyVector(values), g = anyVector(values);
    if (!ordinary(a) || !ordinary(b))
        return;
    const glm::vec3 n = glm::normalize(a), v = glm::normalize(b);
    COTAN_HOLDS(isUnit(f32::cotan_resolve_gradient(n, g)), "{} {} {}", g.x, g.y, g.z);
    COTAN_HOLDS(finite(f32::cotan_slope_of_texel(v)));
    COTAN_HOLDS(finite(f32::cotan_gradient_of_normal(n, v)));
    const glm::vec3 weights = f32::cotan_triplanar_weights(n);
    COTAN_HOLDS(std::abs(weights.x + weights.y + weights.z - 1) < 1e-5f);
    const glm::vec3 up = glm::vec3(v.x, v.y, std::abs(v.z));
    for (const glm::vec3& blended :
         {f32::cotan_blend_reoriented(n, up), f32::cotan_blend_whiteout(n, up), f32::cotan_blend_udn(n, up),
          f32::cotan_blend_slopes(n, up, 1, 1), f32::cotan_blend_linear(n, up)})
        COTAN_HOLDS(isUnit(blended));
}

void checkMappings(Values values)
{
    const glm::vec3 n = anyVector(values), u = anyVector(values), v = anyVector(values), d = anyVector(values);
    const glm::vec2 uv = anyPair(values), turned(polar(values.between(0, 2 * std::numbers::pi), 1));
    const auto f = f32::cotan_frame_projected(n, u, v);
    checkFrame(f, "projected", true);
    COTAN_HOLDS(finite(f32::cotan_to_texture_space(f, d)), "{} {} {}", d.x, d.y, d.z);
    if (glm::length(d) < 1e15f && glm::length(u) + glm::length(v) < 1e15f) // a sum of products
        COTAN_HOLDS(finite(f32::cotan_texture_travel(f, d)), "{} {} {}", d.x, d.y, d.z);
    const glm::vec3 along = f32::cotan_tangent_direction(f, f.n, turned);
    COTAN_HOLDS(along == glm::vec3(0) || isUnit(along), "{} {} {}", along.x, along.y, along.z);
    COTAN_HOLDS(std::abs(glm::dot(along, f.n)) < 1e-3f, "{} {} {}", along.x, along.y, along.z);
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
        return;
    if (std::abs(uv.x) < 1e5f && std::abs(uv.y) < 1e5f) {
        COTAN_HOLDS(std::abs(f32::cotan_wrapped_difference(uv.x, 1)) <= 0.51f, "{}", uv.x);
        const auto h = f32::cotan_hex_tiles_at(uv, float(values.between(1, 16)));
        COTAN_HOLDS(std::abs(h.weights.x + h.weights.y + h.weights.z - 1) < 1e-4f, "{} {}", uv.x, uv.y);
    }
}

// A relief is read at finite coordinates on its ray, whatever the heights, and ends between its surface and its depth.
void checkRelief(Values values)
{
    const auto f = f32::cotan_frame_projected(anyVector(values), anyVector(values), anyVector(values));
    const glm::vec3 toEye = anyVector(values);
    const glm::vec2 uv(float(values.between(-4, 4)), float(values.between(-4, 4)));
    const float depth = values.next<float>(), steps = values.next<float>(), height = values.next<float>();
    for (auto r : {f32::cotan_relief_start(f, toEye, uv, depth, steps),
                   f32::cotan_relief_shadow(f, toEye, uv, height, depth, steps)}) {
        for (int i = 0; i < 24; ++i) {
            COTAN_HOLDS(finite(r.uv) && r.at >= 0 && r.at <= 1, "reading {}: {} {} at {}", i, r.uv.x, r.uv.y, r.at);
            r = f32::cotan_relief_next(r, values.flip() ? values.next<float>() : float(values.between(0, 1)));
        }
        COTAN_HOLDS(r.found == 0 || r.found == 1, "{}", r.found);
        COTAN_HOLDS(f32::cotan_relief_distance(r, f, toEye, depth) >= 0);
    }
}

void checkSparkle(Values values)
{
    const glm::vec3 dndx = anyVector(values), dndy = anyVector(values);
    if (!(glm::dot(dndx, dndx) + glm::dot(dndy, dndy) >= 0)) // light.h wants numbers
        return;
    const float curved = f32::cotan_variance_of_curvature(dndx, dndy);
    const float filtered = f32::cotan_variance_of_length(float(values.between(0, 1.2)));
    COTAN_HOLDS(curved >= 0 && filtered >= 0, "{} {}", curved, filtered);
    const float roughness = f32::cotan_roughness_of_variance(float(values.between(0, 1)), curved + filtered);
    COTAN_HOLDS(roughness >= 0 && roughness <= 1, "{}", roughness);
}

// ---- fused forms ----------------------------------------------------------------------------

struct Input {
    glm::vec3 n, dpdx, dpdy, m;
    glm::vec2 duvdx, duvdy;
};

glm::dvec3 direction(Values& values)
{
    const double z = values.between(-1, 1), around = values.between(0, 2 * std::numbers::pi);
    return glm::dvec3(polar(around, std::sqrt(1 - z * z)), z);
}

// Two differences with lengths of 1 and 0.3 to 1, 20 to 160 degrees apart; `side` is the sign of the angle.
std::array<glm::dvec2, 2> twoDifferences(Values& values, double side)
{
    constexpr double kDegree = std::numbers::pi / 180;
    const double start = values.between(0, 360), apart = values.between(20, 160) * side;
    const double shorter = values.between(0.3, 1);
    const bool first = values.flip();
    return {polar(start * kDegree, first ? 1 : shorter), polar((start + apart) * kDegree, first ? shorter : 1)};
}

Input wellConditionedInput(Values& values, double pScale, double uvScale, double nLength)
{
    const glm::dvec3 face = direction(values), other = direction(values);
    const glm::dvec3 crossed = glm::cross(face, other);
    const glm::dvec3 x = glm::length(crossed) > 1e-3
        ? glm::normalize(crossed)
        : glm::normalize(glm::cross(face, glm::dvec3(face.y, face.z, -face.x) + 0.1));
    const glm::dvec3 y = glm::cross(face, x);
    const auto p = twoDifferences(values, values.flip() ? 1 : -1), uv = twoDifferences(values, values.flip() ? 1 : -1);
    const glm::dvec2 lean = polar(values.between(0, 2 * std::numbers::pi), std::sin(values.between(0, 1)));
    const glm::dvec2 tilt = polar(values.between(0, 2 * std::numbers::pi), std::sin(values.between(0, 1)));
    Input i;
    i.n = glm::vec3(glm::normalize(face * std::sqrt(1 - glm::dot(lean, lean)) + x * lean.x + y * lean.y) * nLength
                    * (values.flip() ? 1.0 : -1.0));
    i.dpdx = glm::vec3((x * p[0].x + y * p[0].y) * pScale);
    i.dpdy = glm::vec3((x * p[1].x + y * p[1].y) * pScale);
    i.duvdx = glm::vec2(uv[0] * uvScale);
    i.duvdy = glm::vec2(uv[1] * uvScale);
    i.m = glm::vec3(tilt, std::sqrt(1 - glm::dot(tilt, tilt)));
    return i;
}

double degreesBetween(glm::dvec3 a, glm::dvec3 b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

void checkFused(Values values)
{
    // The range of fused.h: each scale from 1e-9 to 1e6, their product from 1e-12 to 1e5, |n| from 0.01 to 100.
    const double pScale = std::pow(10, values.between(-9, 6)), uvScale = std::pow(10, values.between(-9, 6));
    const double nLength = std::pow(10, values.between(-1.99, 1.99));
    if (pScale * uvScale < 1.1e-12 || pScale * uvScale > 0.9e5)
        return;
    const Input i = wellConditionedInput(values, pScale, uvScale, nLength);
    using Fused = glm::vec3 (*)(glm::vec3, glm::vec3, glm::vec3, glm::vec2, glm::vec2, glm::vec3);
    const bool largeArea = glm::length(glm::cross(glm::dvec3(i.dpdx), glm::dvec3(i.dpdy))) * nLength * i.m.z >= 1e-10;
    for (const auto& [frame, fused] : {std::pair<Frame, Fused>(Frame::cotangent, f32::cotan_perturb_cotangent),
                                       std::pair<Frame, Fused>(Frame::gradient, f32::cotan_perturb_gradient),
                                       std::pair<Frame, Fused>(Frame::orthonormal, f32::cotan_perturb_orthonormal)}) {
        if (frame == Frame::gradient && !largeArea)
            continue;
        const auto f = evaluate(frame, glm::dvec3(i.n), glm::dvec3(i.dpdx), glm::dvec3(i.dpdy), glm::dvec2(i.duvdx),
                                glm::dvec2(i.duvdy));
        const glm::dvec3 expected = f64::cotan_apply(f, i.m);
        const glm::vec3 found = fused(i.n, i.dpdx, i.dpdy, i.duvdx, i.duvdy, i.m);
        COTAN_HOLDS(degreesBetween(expected, found) < 0.01, "{} off by {} at |n| {} p {} uv {}", name(frame),
                    degreesBetween(expected, found), nLength, pScale, uvScale);
        COTAN_HOLDS(isUnit(found, 1e-6), "{}", name(frame));
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0)
        return 0;
    const Values values({data + 1, size - 1});
    switch (data[0] % 7) {
    case 0: checkTotalFrames(values); break;
    case 1: checkTexels(values); break;
    case 2: checkGradientsAndBlends(values); break;
    case 3: checkFused(values); break;
    case 4: checkMappings(values); break;
    case 5: checkRelief(values); break;
    default: checkSparkle(values); break;
    }
    return 0;
}
