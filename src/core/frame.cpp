#include "cotan/frame.hpp"

namespace cotan {

namespace {

using enum FrameSource;

constexpr std::array<FrameInfo, kFrameCount> kFrames = {{
    {Frame::cotangent, "cotangent", differences, true, false,
     "2013 cotangent frame, sign-corrected and total (default)"},
    {Frame::cotangent2013, "cotangent-2013", differences, false, true, "cotangent frame as printed in 2013"},
    {Frame::nonperspective, "nonperspective", differences, false, true, "its non-perspective shortcut"},
    {Frame::paperFull, "paper-full", differences, false, false, "2006, full 3x3 inverse"},
    {Frame::paperNodet, "paper-nodet", differences, false, false, "2006 _01, no determinant, unit lengths"},
    {Frame::paperTranspose, "paper-transpose", differences, false, false, "2006 _02, inverse transpose"},
    {Frame::paperOrthogonal, "paper-orthogonal", differences, false, true, "2006 _03, taken as orthogonal"},
    {Frame::unit, "unit", differences, false, false, "cotangents, each of unit length"},
    {Frame::orthonormal, "orthonormal", differences, true, false,
     "tangent first, b = +-n x t; reads MikkTSpace maps without tangents"},
    {Frame::gradient, "gradient", differences, true, false, "true surface gradient, metric bump height"},
    {Frame::exact, "exact", triangle, true, false, "per-triangle gradients from the three vertices"},
    {Frame::smooth, "smooth", vertices, true, false, "cotangents averaged at the vertices at load"},
    {Frame::vertex, "vertex", vertices, true, false, "classic per-vertex tangents, orthonormal per pixel"},
    {Frame::mikktspace, "mikktspace", vertices, true, false, "MikkTSpace, per vertex, not renormalised"},
}};

// One text for both precisions: N is cotan::f32 or cotan::f64, spelled by the caller.
#define COTAN_EVALUATE(N)                                                                          \
    switch (frame) {                                                                               \
    case Frame::cotangent: return N::cotan_frame_cotangent(n, dpdx, dpdy, duvdx, duvdy);           \
    case Frame::cotangent2013: return N::cotan_frame_cotangent_2013(n, dpdx, dpdy, duvdx, duvdy);  \
    case Frame::nonperspective: return N::cotan_frame_nonperspective(n, dpdx, dpdy, duvdx, duvdy); \
    case Frame::paperFull: return N::cotan_frame_paper_full(n, dpdx, dpdy, duvdx, duvdy);          \
    case Frame::paperNodet: return N::cotan_frame_paper_nodet(n, dpdx, dpdy, duvdx, duvdy);        \
    case Frame::paperTranspose:                                                                    \
        return N::cotan_frame_paper_transpose(n, dpdx, dpdy, duvdx, duvdy);                        \
    case Frame::paperOrthogonal:                                                                   \
        return N::cotan_frame_paper_orthogonal(n, dpdx, dpdy, duvdx, duvdy);                       \
    case Frame::unit: return N::cotan_frame_unit(n, dpdx, dpdy, duvdx, duvdy);                     \
    case Frame::orthonormal: return N::cotan_frame_orthonormal(n, dpdx, dpdy, duvdx, duvdy);       \
    case Frame::gradient: return N::cotan_frame_gradient(n, dpdx, dpdy, duvdx, duvdy);             \
    case Frame::exact: return N::cotan_frame_exact(n, dpdx, dpdy, duvdx, duvdy);                   \
    case Frame::smooth:                                                                            \
    case Frame::vertex:                                                                            \
    case Frame::mikktspace: break;                                                                 \
    }                                                                                              \
    N::cotan_frame none;                                                                           \
    none.t = none.b = N::cotan_vec3(0, 0, 0);                                                      \
    none.n = n;                                                                                    \
    return none

} // namespace

const std::array<FrameInfo, kFrameCount>& frames() { return kFrames; }

const FrameInfo& info(Frame frame) { return kFrames[static_cast<std::size_t>(frame)]; }

std::optional<Frame> frameFromName(std::string_view name)
{
    for (const FrameInfo& f : kFrames)
        if (f.name == name)
            return f.frame;
    return std::nullopt;
}

f32::cotan_frame evaluate(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 dpdx,
                          f32::cotan_vec3 dpdy, f32::cotan_vec2 duvdx, f32::cotan_vec2 duvdy)
{
    COTAN_EVALUATE(f32);
}

f64::cotan_frame evaluate(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 dpdx,
                          f64::cotan_vec3 dpdy, f64::cotan_vec2 duvdx, f64::cotan_vec2 duvdy)
{
    COTAN_EVALUATE(f64);
}

} // namespace cotan
