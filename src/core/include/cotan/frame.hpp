// Frames by name, their evaluation, and the typed frame.
//
//     const cotan::Differences<float> d = {{1, 0, 0}, {0, 1, 0}, {1, 0}, {0, 1}}; // dp/dx, dp/dy, duv/dx, duv/dy
//     const auto frame = cotan::makeFrame(cotan::Frame::cotangent, cotan::Covector3<float>(0, 0, 1), d);
//     const cotan::Covector3<float> perturbed = cotan::perturb(frame, {0.1f, 0, 0.99f}); // by a decoded texel
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

#include "cotan/covector.hpp"
#include "cotan/portable.hpp"

namespace cotan {

// ---- by name -------------------------------------------------------------------------------

// The mathematics is in the portable text (shaders/cotan/frame.h); this is its C++ interface.

// All frames, from the table cotan/frames.inc. The numbers are the values of the GPU's specialisation constant
// COTAN_FRAME.
enum class Frame {
#define COTAN_FRAME_ROW(number, enumerator, ...) enumerator = number,
#include "cotan/frames.inc"
};

inline constexpr int kFrameCount = 0
#define COTAN_FRAME_ROW(...) +1
#include "cotan/frames.inc"
    ;

// The input of a frame, and the function that evaluates it.
enum class FrameSource {
    differences, // a normal, and differences of position and uv along any two directions: evaluate()
    triangle,    // the same arguments, with the edges of the whole triangle: evaluate()
    cotangents,  // two covectors, made per vertex and interpolated: evaluateCotangents()
    tangents,    // a tangent and a sign, made per vertex and interpolated: evaluateTangents()
};

// Where the interpolated normal is normalised.
enum class FrameNormal {
    frame,  // in the frame, which accepts a normal of any length
    caller, // by the caller; the frame requires a unit normal
    nobody, // not at all: the frame and the perturbed normal use the normal as interpolated
};

struct FrameInfo {
    Frame frame;
    std::string_view name; // as on the command line
    std::string_view word; // in the portable text: cotan_frame_WORD
    FrameSource source;
    bool total;         // no input gives NaN; otherwise degenerate input may
    bool dependsOnView; // depends on the eye, or on the direction of the rows of the render target
    FrameNormal normal;
    bool fused;               // cotan_perturb_WORD exists, too: frame and texel in one step
    std::string_view after;   // a reference besides the chapter of 2006 and the follow-up of 2013; may be empty
    std::string_view summary; // one line
};

// All frames, in the order of the enum.
const std::array<FrameInfo, kFrameCount>& frames();

const FrameInfo& info(Frame frame); // frame: a valid enumerator (isFrame)
inline std::string_view name(Frame frame) { return info(frame).name; }

// Whether the frame at a surface point depends on the position of the eye, or on the direction of the rows of the
// render target. No map can be made for such a frame.
inline bool dependsOnView(Frame frame) { return info(frame).dependsOnView; }

// Whether a frame reads tangents or cotangents at the vertices of a mesh, which must be stored or derived before.
inline bool readsTangents(Frame frame) { return info(frame).source == FrameSource::tangents; }
inline bool readsCotangents(Frame frame) { return info(frame).source == FrameSource::cotangents; }
inline bool readsVertices(Frame frame) { return readsTangents(frame) || readsCotangents(frame); }

// Whether the fused form of a frame reads two vectors that are constant on a triangle (cotan/triangle.hpp) and that an
// earlier stage makes.
inline bool readsTriangleVectors(Frame frame)
{
    return info(frame).source == FrameSource::triangle && info(frame).fused;
}

// Returns the frame with that name, or nothing.
std::optional<Frame> frameFromName(std::string_view name);

// Whether a number from outside is that of a frame.
inline bool isFrame(int number) { return number >= 0 && number < kFrameCount; }

// Evaluates a frame whose source is `differences` or `triangle`. Other frames read the vertices and must not be passed:
// they give t = b = 0 and n as passed.
// Arguments and degenerate input: as for the functions cotan_frame_NAME in shaders/cotan/frame.h.
f32::cotan_frame evaluate(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 dpdx, f32::cotan_vec3 dpdy,
                          f32::cotan_vec2 duvdx, f32::cotan_vec2 duvdy);
f64::cotan_frame evaluate(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 dpdx, f64::cotan_vec3 dpdy,
                          f64::cotan_vec2 duvdx, f64::cotan_vec2 duvdy);

// Evaluates a frame whose source is `cotangents`, from interpolated covectors u and v; other frames as above.
f32::cotan_frame evaluateCotangents(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 u, f32::cotan_vec3 v);
f64::cotan_frame evaluateCotangents(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 u, f64::cotan_vec3 v);

// Evaluates a frame whose source is `tangents`, from an interpolated tangent t; other frames as above.
// alongV: +1 or -1, such that alongV * cross(n, t) points along increasing v. For a glTF TANGENT it is -w.
f32::cotan_frame evaluateTangents(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 t, float alongV);
f64::cotan_frame evaluateTangents(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 t, double alongV);

// ---- typed ---------------------------------------------------------------------------------

// Differences along any two directions: screen derivatives, triangle edges, steps of a uv raster.
template<class Real> struct Differences {
    using Uv = packed::vec<2, Real>;
    Vector3<Real> dpdx; // displacement of position
    Vector3<Real> dpdy;
    Uv duvdx{0, 0}; // change of texture coordinates along the same displacement
    Uv duvdy{0, 0};
};

template<class Real> struct CotangentFrame {
    Covector3<Real> t; // along grad u
    Covector3<Real> b; // along grad v
    Covector3<Real> n;
};

namespace detail {
inline auto text(float) { return f32::cotan_frame{}; }
inline auto text(double) { return f64::cotan_frame{}; }

template<class Real> auto toText(const CotangentFrame<Real>& f)
{
    auto r = text(Real{});
    r.t = f.t.raw();
    r.b = f.b.raw();
    r.n = f.n.raw();
    return r;
}
} // namespace detail

// Returns a frame of the given kind from a normal and differences. Degenerate input: as documented for the function
// cotan_frame_NAME in shaders/cotan/frame.h.
template<class Real> CotangentFrame<Real> makeFrame(Frame kind, Covector3<Real> n, const Differences<Real>& d)
{
    const auto f = evaluate(kind, n.raw(), d.dpdx.raw(), d.dpdy.raw(), d.duvdx, d.duvdy);
    return {Covector3<Real>(f.t), Covector3<Real>(f.b), Covector3<Real>(f.n)};
}

// Returns the perturbed normal, unit, for a decoded texel m (components along +u, +v, outwards). The texel is neither a
// vector nor a covector of world space: its numbers are coefficients. If the sum is zero, the result is n
// (cotan_apply).
template<class Real>
Covector3<Real> perturb(const CotangentFrame<Real>& f, std::type_identity_t<packed::vec<3, Real>> m)
{
    return Covector3<Real>(cotan_apply(detail::toText(f), m));
}

// The inverse of perturb: returns the unit texel m that this frame maps to `target`. Exact also for frames that are not
// orthonormal; linearly dependent covectors give (0,0,1). m.z <= 0: the target is below the horizon.
template<class Real> packed::vec<3, Real> encode(const CotangentFrame<Real>& f, Covector3<Real> target)
{
    return cotan_encode(detail::toText(f), target.raw());
}

// Transforms a frame to another space. Covectors use the inverse transpose. Maps other than rotations with uniform
// scale change their relative lengths, and thus the perturbed normal: bake at the scale that will be used.
template<class Real> CotangentFrame<Real> transform(const LinearMap<Real>& map, const CotangentFrame<Real>& f)
{
    return {map(f.t), map(f.b), map(f.n)};
}

} // namespace cotan
