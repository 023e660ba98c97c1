// The frame in half precision, as mobile shaders would like to have it. Attributes are float and camera-relative; the
// scene says which part is computed in half.
#include "half.hpp"

#include "rows.hpp"
#include "tables.hpp"
#include "truth/precision.hpp"

#include <fmt/format.h>

namespace cotan {

namespace {

constexpr int kTrials = 4000;

f16::cotan_vec3 toHalf(glm::vec3 v) { return {Half(v.x), Half(v.y), Half(v.z)}; }
f16::cotan_vec2 toHalf(glm::vec2 v) { return {Half(v.x), Half(v.y)}; }
glm::dvec3 toDouble(f16::cotan_vec3 v) { return {float(v.x), float(v.y), float(v.z)}; }

struct HalfInput {
    f16::cotan_vec3 n, dpdx, dpdy, m;
    f16::cotan_vec2 duvdx, duvdy;
};

// Rounds the inputs to half. If `scaled`, first scales the differences in float by powers of two, so that their largest
// components are in [1,2).
HalfInput input(const PrecisionTrial& t, const Differences<float>& d, bool scaled)
{
    f32::cotan_differences s{d.dpdx.raw(), d.dpdy.raw(), d.duvdx, d.duvdy, 1, 1};
    if (scaled)
        s = f32::cotan_scale_differences(d.dpdx.raw(), d.dpdy.raw(), d.duvdx, d.duvdy);
    return {toHalf(glm::vec3(t.normal)), toHalf(s.dpdx),  toHalf(s.dpdy),
            toHalf(glm::vec3(t.texel)),  toHalf(s.duvdx), toHalf(s.duvdy)};
}

void measure(const AccuracySelection& selection, const char* scene, Frame frame, bool scaled, double footprint,
             std::vector<Measurement>& result)
{
    if (!selection.wants(frame) || !selection.wantsScene(scene))
        return;
    Random random(84);
    AngleCollector angles;
    for (int i = 0; i < kTrials; ++i) {
        const PrecisionTrial t = makeTrial(random, {0, footprint, 1, std::max(1.0, 10 * footprint)});
        const HalfInput x = input(t, measuredDifferences(t, PositionSource::cameraRelative), scaled);
        const auto f = frame == Frame::cotangent ? f16::cotan_frame_cotangent(x.n, x.dpdx, x.dpdy, x.duvdx, x.duvdy)
            : frame == Frame::orthonormal        ? f16::cotan_frame_orthonormal(x.n, x.dpdx, x.dpdy, x.duvdx, x.duvdy)
                                          : f16::cotan_frame_cotangent_2013(x.n, x.dpdx, x.dpdy, x.duvdx, x.duvdy);
        // cotan_apply is not used, because its guard would hide sums that are not finite.
        const glm::dvec3 v = toDouble(f.t * x.m.x + f.b * x.m.y + f.n * x.m.z);
        angles.add(degreesBetween(v, shade(frame, t.normal, t.exact, t.texel)));
    }
    result.push_back(angles.finish({"half", scene, fmt::format("footprint {:g}", footprint), std::string(name(frame)),
                                    "exact arithmetic", "half"}));
}

// Rounds positions and uv themselves to half before they are differenced; the frame is in float.
void measureAttributes(const AccuracySelection& selection, double footprint, std::vector<Measurement>& result)
{
    const char* scene = "attributes in half, frame in float";
    if (!selection.wants(Frame::cotangent) || !selection.wantsScene(scene))
        return;
    Random random(85);
    AngleCollector angles;
    for (int i = 0; i < kTrials; ++i) {
        const PrecisionTrial t = makeTrial(random, {0, footprint});
        glm::vec3 p[3];
        glm::vec2 uv[3];
        for (int k = 0; k < 3; ++k) {
            const glm::dvec2 b = t.barycentrics[k];
            auto at = [&](const auto& corner) {
                return corner[0] + (corner[1] - corner[0]) * b.x + (corner[2] - corner[0]) * b.y;
            };
            const glm::dvec3 q = at(t.positions) - t.eye;
            const glm::dvec2 w = at(t.texcoords);
            p[k] = {Half::round(q.x), Half::round(q.y), Half::round(q.z)};
            uv[k] = {Half::round(w.x), Half::round(w.y)};
        }
        const Differences<float> d{Vector3f(p[1] - p[0]), Vector3f(p[2] - p[0]), uv[1] - uv[0], uv[2] - uv[0]};
        angles.add(degreesBetween(shadeFloat(Frame::cotangent, t.normal, d, t.texel),
                                  shade(Frame::cotangent, t.normal, t.exact, t.texel)));
    }
    result.push_back(angles.finish({"half", scene, fmt::format("footprint {:g}", footprint),
                                    std::string(name(Frame::cotangent)), "exact arithmetic", "half"}));
}

} // namespace

std::vector<Measurement> measureHalf(const AccuracySelection& selection)
{
    std::vector<Measurement> result;
    for (double footprint : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
        measure(selection, "all in half", Frame::cotangent2013, false, footprint, result);
        for (Frame frame : {Frame::cotangent, Frame::orthonormal, Frame::cotangent2013})
            measure(selection, "scaled in float, frame in half", frame, true, footprint, result);
    }
    for (double footprint : {1e-4, 1e-3, 1e-2, 1e-1})
        measureAttributes(selection, footprint, result);
    return result;
}

} // namespace cotan
