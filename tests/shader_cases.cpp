#include "shader_cases.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "truth/patch.hpp"

namespace cotan::test {

namespace {

using shader_text::Choice;
using shader_text::Form;
using shader_text::Language;

glm::dvec2 polar(double degrees, double length)
{
    const double a = degrees * std::numbers::pi / 180;
    return {length * std::cos(a), length * std::sin(a)};
}

// Well-conditioned input: differences 30 to 150 degrees apart, n within 50 degrees of the surface normal, the texel's
// normal within 55 degrees of z.
Vectors soundVectors(Random& random, bool mirrored, bool behind, bool yDown)
{
    const glm::dvec3 z = random.direction();
    const glm::dvec3 x = glm::normalize(glm::cross(z, std::abs(z.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 y = glm::cross(z, x);
    const double start = random.range(0, 360), uvStart = random.range(0, 360), scale = 0.01;
    const glm::dvec2 p0 = polar(start, random.range(0.3, 1));
    glm::dvec2 p1 = polar(start + random.range(30, 150), random.range(0.3, 1));
    glm::dvec2 uv1 = polar(uvStart + (mirrored ? -1 : 1) * random.range(30, 150), random.range(0.3, 1));
    if (yDown) {
        p1 = -p1;
        uv1 = -uv1;
    }
    const double away = random.range(0, 50) * std::numbers::pi / 180;
    const glm::dvec2 lean = polar(random.range(0, 360), std::sin(away));
    const glm::dvec3 n = z * std::cos(away) + x * lean.x + y * lean.y;
    Vectors v;
    v.n = glm::vec3(n * (behind ? -1.0 : 1.0));
    v.dpdx = glm::vec3((x * p0.x + y * p0.y) * scale);
    v.dpdy = glm::vec3((x * p1.x + y * p1.y) * scale);
    v.duvdx = glm::vec2(polar(uvStart, random.range(0.3, 1)) * scale);
    v.duvdy = glm::vec2(uv1 * scale);
    v.texel = glm::vec3(tiltedTexel(random, random.range(0, 55)) * (127.0 / 255) + 128.0 / 255);
    return v;
}

// The normal as frames that require a unit normal get it.
glm::dvec3 unitOf(glm::vec3 n) { return glm::normalize(glm::dvec3(n)); }

glm::dvec3 decoded(const Vectors& v, const Convention& c = {})
{
    return f64::cotan_decode(v.texel, toFormat<f64::cotan_normal_format>(c));
}

// drawn: calls the function that takes screen-space derivatives itself.
Case frameCase(const std::string& label, Choice choice, bool drawn = false)
{
    Case c;
    c.name = label;
    const bool total = info(choice.frame).total;
    choice.callerDifferences = !drawn;
    c.text = [choice](Language l) {
        Choice in = choice;
        in.language = l;
        in.functionsOnly = l == Language::godot;
        const auto text = makeShaderText(in);
        if (!text)
            throw std::runtime_error(text.error().message);
        return text->text;
    };
    const auto made = makeShaderText(choice);
    const bool fused = made && made->form == Form::fused;
    // Frames that take the normal as it is return one that is not finite.
    c.last = fused || info(choice.frame).normal == FrameNormal::nobody ? Kind::degenerate
        : total                                                        ? Kind::nonFinite
                                                                       : Kind::sound;
    const Frame frame = choice.frame;
    const Convention convention = choice.convention;
    if (total && frame != Frame::gradient) { // `gradient` is metric
        const FrameSource source = info(frame).source;
        c.moves = source == FrameSource::triangle ? FrameSource::differences : source;
        c.anyScale = !(readsCotangents(frame) && fused); // the text says so
    }
    if (!readsVertices(frame)) {
        c.call = drawn ? "cotan_perturb_normal(n, p, uv, m)" : made->entry + "(n, dpdx, dpdy, duvdx, duvdy, m)";
        c.expected = [=](const Vectors& v) {
            const glm::dvec3 n = total ? glm::dvec3(v.n) : unitOf(v.n);
            return f64::cotan_apply(
                evaluate(frame, n, glm::dvec3(v.dpdx), glm::dvec3(v.dpdy), glm::dvec2(v.duvdx), glm::dvec2(v.duvdy)),
                decoded(v, convention));
        };
        return c;
    }
    c.call = made->entry + (readsCotangents(frame) ? "(n, dpdx, dpdy, m)" : "(n, dpdx, duvdx.x * -100.0, m)");
    c.expected = [=](const Vectors& v) {
        const glm::dvec3 n(v.n), x(v.dpdx), y(v.dpdy);
        if (fused) // a different formula from the frame's: equal only up to rounding
            return f64::cotan_perturb_smooth(n, x, y, decoded(v));
        const f64::cotan_frame f = readsCotangents(frame) ? evaluateCotangents(frame, n, x, y)
                                                          : evaluateTangents(frame, n, x, 100.0 * v.duvdx.x);
        return f64::cotan_apply(f, decoded(v));
    };
    return c;
}

glm::dvec3 perturbedByTwoSets(Frame frame, const Vectors& v, glm::dvec2 otherDx, glm::dvec2 otherDy)
{
    const glm::dvec3 n(v.n), dpdx(v.dpdx), dpdy(v.dpdy);
    const auto a = evaluate(frame, n, dpdx, dpdy, glm::dvec2(v.duvdx), glm::dvec2(v.duvdy));
    const auto b = evaluate(frame, n, dpdx, dpdy, otherDx, otherDy);
    const glm::dvec2 slope = f64::cotan_slope_of_texel(decoded(v));
    return f64::cotan_resolve_gradient(a.n,
                                       f64::cotan_gradient_of_slope(a, slope) + f64::cotan_gradient_of_slope(b, slope));
}

// `gradient` in its total form, `cotangent` in its fused form.
Case uvSetsCase(Frame frame, bool drawn = false)
{
    Choice choice;
    choice.frame = frame;
    choice.uvSets = 2;
    Case c = frameCase(std::string(name(frame)) + ", two uv sets", choice, drawn);
    c.call = drawn ? "cotan_perturb_normal(n, p, uv, m, uv * 3.0, m)"
                   : "cotan_perturb_normal_from_differences(n, dpdx, dpdy, duvdx, duvdy, m, duvdy, duvdx, m)";
    c.expected = [frame, drawn](const Vectors& v) {
        return drawn ? perturbedByTwoSets(frame, v, glm::dvec2(v.duvdx) * 3.0, glm::dvec2(v.duvdy) * 3.0)
                     : perturbedByTwoSets(frame, v, v.duvdy, v.duvdx);
    };
    return c;
}

// Cases given by one line of portable text. The same line is compiled as C++ with the names of f64. n, m and m2 are
// unit vectors.
#define COTAN_LINE_CASE(label, ...) COTAN_EXPANDED_LINE_CASE(label, __VA_ARGS__)
#define COTAN_EXPANDED_LINE_CASE(label, ...)                                                                           \
    lineCase(label, #__VA_ARGS__,                                                                                      \
             [](glm::dvec3 n, glm::dvec3 m, glm::dvec3 m2, glm::dvec3 dpdx, glm::dvec3 dpdy) -> glm::dvec3 {           \
                 using namespace f64;                                                                                  \
                 (void)n, (void)m, (void)m2, (void)dpdx, (void)dpdy;                                                   \
                 return __VA_ARGS__;                                                                                   \
             })

// A triangle with uv, and the same triangle transformed by a matrix that shears and mirrors.
#define COTAN_EDGES                                                                                                    \
    dpdx, dpdy, cotan_vec2(cotan_real(1.0), cotan_real(0.25)), cotan_vec2(cotan_real(-0.5), cotan_real(0.75)), n
#define COTAN_TRANSFORMED                                                                                              \
    cotan_triangle_transformed(cotan_triangle_of_edges(COTAN_EDGES),                                                   \
                               cotan_vec3(cotan_real(2.0), cotan_real(0.5), cotan_real(0.0)),                          \
                               cotan_vec3(cotan_real(0.0), cotan_real(-1.0), cotan_real(0.25)),                        \
                               cotan_vec3(cotan_real(0.125), cotan_real(0.0), cotan_real(1.0)), cotan_real(-1.0))

// A sheared, stretched projector: 30 to 150 degrees between its gradients, 50 degrees off the surface at most.
#define COTAN_PROJECTED cotan_frame_projected(n, dpdx* cotan_real(100.0), dpdy* cotan_real(60.0))

#define COTAN_RELIEF                                                                                                   \
    cotan_relief_next(cotan_relief_next(cotan_relief_start(COTAN_PROJECTED, n + COTAN_PROJECTED.t,                     \
                                                           cotan_vec2(m.x, m.y), cotan_real(0.25), cotan_real(4.0)),   \
                                        cotan_real(0.125)),                                                            \
                      cotan_real(0.625))
#define COTAN_RELIEF_SHADOW                                                                                            \
    cotan_relief_next(cotan_relief_shadow(COTAN_PROJECTED, n + COTAN_PROJECTED.b, COTAN_RELIEF.uv, cotan_real(0.5),    \
                                          cotan_real(0.25), cotan_real(4.0)),                                          \
                      cotan_real(0.25))

template<class Expected> Case lineCase(const std::string& label, const std::string& line, Expected expected)
{
    Case c;
    c.name = label;
    c.call = "cotan_case(n, dpdx, dpdy, m)";
    c.text = [line](Language l) {
        return shader_text::translate(l,
                                      "COTAN_FUNCTION cotan_vec3 cotan_case(cotan_vec3 n_any, cotan_vec3 dpdx, "
                                      "cotan_vec3 dpdy, cotan_vec3 texel)\n"
                                      "{\n"
                                      "    cotan_vec3 n = n_any * cotan_inversesqrt(dot(n_any, n_any));\n"
                                      "    cotan_normal_format format;\n"
                                      "    format.expansion = 0;\n    format.channels = 0;\n"
                                      "    format.green = cotan_real(1.0);\n    format.strength = cotan_real(1.0);\n"
                                      "    cotan_vec3 m = cotan_decode(texel, format);\n"
                                      "    m = m * cotan_inversesqrt(dot(m, m));\n"
                                      "    cotan_vec3 m2 = cotan_vec3(m.y, -m.x, m.z);\n"
                                      "    return "
                                          + line + ";\n}\n");
    };
    c.expected = [expected](const Vectors& v) {
        Convention along;
        along.v = VDirection::up;
        const glm::dvec3 m = glm::normalize(decoded(v, along));
        return expected(unitOf(v.n), m, glm::dvec3(m.y, -m.x, m.z), glm::dvec3(v.dpdx), glm::dvec3(v.dpdy));
    };
    return c;
}

void addLines(std::vector<Case>& all)
{
    all.push_back(COTAN_LINE_CASE("resolve, of normal",
                                  cotan_resolve_gradient(n, cotan_gradient_of_normal(n, n * cotan_real(2.0) + m))));
    all.push_back(COTAN_LINE_CASE("of volume", cotan_resolve_gradient(n, cotan_gradient_of_volume(n, m))));
    all.push_back(COTAN_LINE_CASE(
        "of height",
        cotan_resolve_gradient(
            n, cotan_gradient_of_height(n, dpdx, dpdy, m.x * cotan_real(0.003), m.y * cotan_real(0.003)))));
    all.push_back(COTAN_LINE_CASE(
        "triplanar",
        cotan_resolve_gradient(n,
                               cotan_gradient_triplanar(n, cotan_triplanar_weights(n), cotan_slope_of_texel(m),
                                                        cotan_slope_of_texel(m2), cotan_slope_of_texel(m)))));
    all.push_back(
        COTAN_LINE_CASE("of slope",
                        cotan_resolve_gradient(
                            n, cotan_gradient_of_slope(cotan_frame_smooth(n, dpdx, dpdy), cotan_slope_of_texel(m)))));
    all.push_back(COTAN_LINE_CASE(
        "encode", cotan_encode(cotan_frame_smooth(n, dpdx, dpdy), cotan_apply(cotan_frame_smooth(n, dpdx, dpdy), m))));
    all.push_back(COTAN_LINE_CASE("triangle",
                                  cotan_apply(cotan_frame_of_triangle(n, cotan_triangle_of_edges(COTAN_EDGES).u,
                                                                      cotan_triangle_of_edges(COTAN_EDGES).v),
                                              m)));
    all.push_back(COTAN_LINE_CASE("triangle, fused",
                                  cotan_perturb_triangle(n, cotan_triangle_of_sound_edges(COTAN_EDGES).u,
                                                         cotan_triangle_of_sound_edges(COTAN_EDGES).v, m)));
    all.push_back(COTAN_LINE_CASE("triangle, scaled",
                                  cotan_perturb_triangle_scaled(n, cotan_triangle_of_sound_edges(COTAN_EDGES).u,
                                                                cotan_triangle_of_sound_edges(COTAN_EDGES).v, m)));
    all.push_back(COTAN_LINE_CASE(
        "cotangent, seen",
        cotan_perturb_cotangent_seen(n, dpdx, dpdy, cotan_vec2(cotan_real(0.3), cotan_real(0.1)),
                                     cotan_vec2(cotan_real(-0.2), cotan_real(0.4)), m, cotan_real(-1.0))));
    all.push_back(COTAN_LINE_CASE("triangle, transformed",
                                  cotan_perturb_triangle(n, COTAN_TRANSFORMED.u, COTAN_TRANSFORMED.v, m)));
    all.push_back(
        COTAN_LINE_CASE("smooth, fused", cotan_perturb_smooth(n, m2 * cotan_real(0.5), cotan_vec3(m.z, m.x, m.y), m)));
    // The factors are 1, unknown to the compiler: Mesa 22.3 folds the packing of constants to wrong words.
    all.push_back(COTAN_LINE_CASE(
        "triangle in 12 bytes",
        cotan_normalize_or(
            m
                + cotan_unpack_triangle_u(cotan_pack_triangle(
                    cotan_vec3(cotan_real(0.3), cotan_real(-0.7), cotan_real(0.65)) * cotan_sign(cotan_real(7.0) - m.z),
                    cotan_vec3(cotan_real(-0.2), cotan_real(0.6), cotan_real(0.1)) * cotan_sign(cotan_real(7.0) - m.z)))
                + cotan_unpack_triangle_v(
                      cotan_pack_triangle(cotan_vec3(cotan_real(0.3), cotan_real(-0.7), cotan_real(0.65))
                                              * cotan_sign(cotan_real(7.0) - m.z),
                                          cotan_vec3(cotan_real(-0.2), cotan_real(0.6), cotan_real(0.1))
                                              * cotan_sign(cotan_real(7.0) - m.z)))
                    * cotan_real(0.5),
            n)));
    all.push_back(COTAN_LINE_CASE(
        "smooth in 8 bytes",
        cotan_normalize_or(m * cotan_real(3.0) + cotan_unpack_smooth8(n, cotan_pack_smooth8(n, m, m2)).t, n)));
    all.push_back(COTAN_LINE_CASE(
        "smooth in 4 bytes, packed",
        cotan_normalize_or(m * cotan_real(3.0)
                               + cotan_unpack_smooth4(
                                     cotan_vec3(cotan_real(0.0), cotan_real(0.6), cotan_real(-0.8)),
                                     cotan_pack_smooth4(cotan_vec3(cotan_real(0.0), cotan_real(0.6), cotan_real(-0.8)),
                                                        cotan_vec3(cotan_real(0.3), cotan_real(-0.7), cotan_real(0.65)),
                                                        cotan_vec3(cotan_real(-0.2), cotan_real(0.6), cotan_real(0.1))))
                                     .b,
                           n)));
    all.push_back(COTAN_LINE_CASE("smooth in 4 bytes, unpacked",
                                  cotan_normalize_or(m * cotan_real(3.0) + cotan_unpack_smooth4(n, 0x92345678u).t
                                                         + cotan_unpack_smooth4(n, 0x72345678u).b,
                                                     n)));
    all.push_back(COTAN_LINE_CASE(
        "tangent in 2 bytes, packed",
        cotan_normalize_or(
            m * cotan_real(3.0)
                + cotan_frame_vertex(
                      n,
                      cotan_vec3(
                          cotan_unpack_tangent2(
                              cotan_vec3(cotan_real(0.0), cotan_real(0.6), cotan_real(-0.8)),
                              cotan_pack_tangent2(cotan_vec3(cotan_real(0.0), cotan_real(0.6), cotan_real(-0.8)),
                                                  cotan_vec3(cotan_real(0.3), cotan_real(-0.7), cotan_real(0.65)),
                                                  cotan_real(-1.0)))
                              .x,
                          cotan_unpack_tangent2(cotan_vec3(cotan_real(0.0), cotan_real(0.6), cotan_real(-0.8)), 0x5678u)
                              .y,
                          cotan_unpack_tangent2(cotan_vec3(cotan_real(0.0), cotan_real(0.6), cotan_real(-0.8)), 0x8678u)
                              .w),
                      cotan_real(1.0))
                      .t,
            n)));
    all.push_back(COTAN_LINE_CASE("blend reoriented", cotan_blend_reoriented(m, m2)));
    all.push_back(COTAN_LINE_CASE("blend whiteout", cotan_blend_whiteout(m, m2)));
    all.push_back(COTAN_LINE_CASE("blend udn", cotan_blend_udn(m, m2)));
    all.push_back(COTAN_LINE_CASE("blend slopes", cotan_blend_slopes(m, m2, cotan_real(0.7), cotan_real(0.4))));
    all.push_back(COTAN_LINE_CASE("blend linear", cotan_blend_linear(m, m2)));
    // A frame whose vectors are neither orthogonal nor unit, and a vector into it.
    all.push_back(
        COTAN_LINE_CASE("into texture space", cotan_normalize_or(cotan_to_texture_space(COTAN_PROJECTED, m), n)));
    all.push_back(COTAN_LINE_CASE("texture travel", cotan_normalize_or(cotan_texture_travel(COTAN_PROJECTED, m), n)));
    all.push_back(COTAN_LINE_CASE("tangent direction",
                                  cotan_tangent_direction(COTAN_PROJECTED, n, cotan_vec2(m.x, cotan_real(0.7)))));
    all.push_back(COTAN_LINE_CASE("projected", cotan_apply(COTAN_PROJECTED, m)));
    all.push_back(
        COTAN_LINE_CASE("wrapped differences",
                        cotan_normalize_or(cotan_vec3(cotan_wrapped_difference(m.x * cotan_real(3.0), cotan_real(1.0)),
                                                      cotan_wrapped_difference(m.y, cotan_real(0.0)), cotan_real(0.25)),
                                           n)));
    all.push_back(COTAN_LINE_CASE(
        "rotated slope",
        cotan_normalize_or(cotan_vec3(cotan_slope_of_rotated(cotan_vec2(m.x, m.y), cotan_real(0.6), cotan_real(0.8)).x,
                                      cotan_slope_of_rotated(cotan_vec2(m.x, m.y), cotan_real(0.6), cotan_real(0.8)).y,
                                      m.z),
                           n)));
    all.push_back(COTAN_LINE_CASE(
        "hex tiles", cotan_normalize_or(cotan_hex_tiles_at(cotan_vec2(m.x, m.y), cotan_real(2.0)).weights, n)));
    all.push_back(COTAN_LINE_CASE(
        "parallax",
        cotan_normalize_or(cotan_vec3(cotan_parallax_offset(COTAN_PROJECTED, m, cotan_real(0.5)).x,
                                      cotan_parallax_offset(COTAN_PROJECTED, m, cotan_real(0.5)).y, cotan_real(1.0)),
                           n)));
    // Two readings, the second inside the relief, then one of its shadow. What is compared to decide is exact in float.
    all.push_back(COTAN_LINE_CASE(
        "relief", cotan_normalize_or(cotan_vec3(COTAN_RELIEF.uv.x, COTAN_RELIEF.uv.y, COTAN_RELIEF.at), n)));
    all.push_back(COTAN_LINE_CASE(
        "relief, its shadow",
        cotan_normalize_or(cotan_vec3(COTAN_RELIEF_SHADOW.uv.x, COTAN_RELIEF_SHADOW.uv.y,
                                      COTAN_RELIEF_SHADOW.at
                                          + cotan_relief_distance(COTAN_RELIEF, COTAN_PROJECTED, n, cotan_real(0.25))),
                           n)));
}

// `triangle` in two stages, as it is used: the first makes U and V in half floats.
Case twoStagesCase()
{
    Choice choice;
    choice.frame = Frame::triangle;
    Case c = frameCase("triangle in two stages", choice);
    c.call = "cotan_perturb_normal_on_triangle(n, cotan_make_triangle(dpdx - dpdx, dpdx, dpdy, duvdx - duvdx, duvdx, "
             "duvdy, n, n, n), m)";
    c.halfs = true;
    return c;
}

// A sample after a transform by `scale` that may also mirror x. Positions and tangents are vectors; engines make
// tangents unit again. Cotangents are covectors. A mirror reverses the w of tangents, which the cases take from duvdx.
Sample movedSample(const Vectors& from, FrameSource source, float scale, bool mirrored)
{
    const glm::vec3 axes(mirrored ? -1 : 1, 1, 1);
    Vectors v = from;
    v.n = axes * v.n;
    const float factor = source == FrameSource::tangents ? 1 : source == FrameSource::cotangents ? 1 / scale : scale;
    v.dpdx = axes * v.dpdx * factor;
    v.dpdy = axes * v.dpdy * factor;
    if (source == FrameSource::tangents)
        v.duvdx *= axes.x;
    return {v, Kind::moved, from, scale, mirrored, source};
}

} // namespace

std::vector<Sample> samples()
{
    Random random(401);
    std::vector<Sample> all;
    for (int k = 0; k < 512; ++k)
        all.push_back({soundVectors(random, k & 1, k & 2, k & 4), Kind::sound});
    // Only answers that do not depend on rounding; fused.h names those that do.
    for (int k = 0; k < 16; ++k) {
        Vectors v = soundVectors(random, k & 1, k & 2, k & 4);
        v.duvdx = v.duvdy = {0, 0};
        all.push_back({v, Kind::degenerate});
        v.dpdx = v.dpdy = {0, 0, 0};
        all.push_back({v, Kind::degenerate});
        v = soundVectors(random, k & 1, k & 2, k & 4);
        v.duvdx.x = v.duvdy.x = 0;
        all.push_back({v, Kind::degenerate});
    }
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (float bad : {nan, inf, -inf}) {
        Vectors v = soundVectors(random, false, false, false);
        v.dpdx.y = bad;
        all.push_back({v, Kind::nonFinite});
        v = soundVectors(random, false, false, false);
        v.duvdy.x = bad;
        all.push_back({v, Kind::nonFinite});
        v = soundVectors(random, false, false, false);
        v.n.z = bad;
        all.push_back({v, Kind::nonFinite});
    }
    for (const Sample& lit : litSamples())
        all.push_back(lit);
    for (int k = 0; k < 8; ++k) {
        const Vectors from = soundVectors(random, k & 1, k & 2, k & 4);
        for (const FrameSource source : {FrameSource::differences, FrameSource::cotangents, FrameSource::tangents})
            for (const float scale : {0.25f, 0.5f, 1.0f, 2.0f, 4.0f})
                for (const bool mirrored : {false, true})
                    all.push_back(movedSample(from, source, scale, mirrored));
    }
    return all;
}

// The forms of `cotangent` without a frame of their own; Godot has neither.
Case cotangentCase(Form form)
{
    Case c;
    const bool seen = form == Form::seen;
    c.name = "cotangent, " + std::string(name(form));
    c.text = [form](Language l) {
        Choice choice;
        choice.language = l;
        choice.frame = Frame::cotangent;
        choice.form = form;
        choice.callerDifferences = true;
        const auto text = makeShaderText(choice);
        if (!text)
            throw std::runtime_error(text.error().message);
        return text->text;
    };
    c.last = Kind::degenerate;
    Choice usual;
    usual.frame = Frame::cotangent;
    usual.form = form;
    c.call = makeShaderText(usual)->entry + "(n, dpdx, dpdy, duvdx, duvdy, m" + (seen ? ", 1.0)" : ")");
    c.expected = [seen](const Vectors& v) {
        const glm::dvec3 n(v.n), x(v.dpdx), y(v.dpdy), m = decoded(v);
        const glm::dvec2 u(v.duvdx), w(v.duvdy);
        return seen ? f64::cotan_perturb_cotangent_seen(n, x, y, u, w, m, 1.0)
                    : f64::cotan_perturb_cotangent_area(n, x, y, u, w, m);
    };
    return c;
}

std::vector<Case> frameCases(bool drawn)
{
    std::vector<Case> all;
    for (const FrameInfo& f : frames()) {
        if (drawn && f.source != FrameSource::differences)
            continue;
        Choice choice;
        choice.frame = f.frame;
        choice.form = Form::total;
        all.push_back(frameCase(std::string(f.name), choice, drawn));
        if (!shader_text::hasFusedForm(f.frame))
            continue;
        choice.form = Form::fused;
        all.push_back(frameCase(std::string(f.name) + ", fused", choice, drawn));
    }
    if (!drawn)
        all.push_back(twoStagesCase());
    return all;
}

std::vector<Case> drawnCases()
{
    std::vector<Case> all = frameCases(true);
    for (const Frame frame : {Frame::gradient, Frame::cotangent})
        all.push_back(uvSetsCase(frame, true));
    return all;
}

std::vector<Case> casesOfAllLanguages()
{
    std::vector<Case> all = frameCases(false);
    for (Channels channels : {Channels::orthographic, Channels::stereographic, Channels::slope}) {
        Choice choice;
        choice.convention.channels = channels;
        choice.convention.v = VDirection::up; // green increases along v
        choice.convention.expansion = channels == Channels::slope ? Expansion::signedValues : Expansion::biased;
        all.push_back(frameCase(channels == Channels::orthographic ? "two channels, 2c - 1"
                                    : channels == Channels::slope  ? "slopes, signed"
                                                                   : "stereographic, 2c - 1",
                                choice));
    }
    for (const Frame frame : {Frame::gradient, Frame::cotangent})
        all.push_back(uvSetsCase(frame));
    addLines(all);
    for (Case& lit : litCases())
        all.push_back(std::move(lit));
    return all;
}

std::vector<Case> godotCases()
{
    std::vector<Case> some;
    for (Case& c : casesOfAllLanguages())
        if (!c.halfs && c.text(Language::godot).find("uint") == std::string::npos)
            some.push_back(std::move(c));
    return some;
}

std::vector<Case> cases()
{
    std::vector<Case> all = casesOfAllLanguages();
    for (const Form form : {Form::seen, Form::area})
        all.push_back(cotangentCase(form));
    return all;
}

} // namespace cotan::test
