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

// The mathematics is the portable text (shaders/cotan/frame.h); this is how C++ reaches it.

// All frames, from the table cotan/frames.inc. The numbers are those of the GPU's specialisation constant COTAN_FRAME.
enum class Frame {
#define COTAN_FRAME_ROW(number, enumerator, ...) enumerator = number,
#include "cotan/frames.inc"
};

inline constexpr int kFrameCount = 0
#define COTAN_FRAME_ROW(...) +1
#include "cotan/frames.inc"
    ;

// What a frame is made from, and by which function.
enum class FrameSource {
    differences, // normal and differences of position and uv along any two directions: evaluate()
    triangle,    // the same arguments, but the edges of the whole triangle: evaluate()
    cotangents,  // two covectors made per vertex and interpolated: evaluateCotangents()
    tangents,    // a tangent and a sign made per vertex and interpolated: evaluateTangents()
};

// Who makes the interpolated normal unit.
enum class FrameNormal {
    frame,  // the frame itself: it takes a normal of any length
    caller, // whoever asks for the frame, which takes a unit normal
    nobody, // the frame is of the normal as interpolated, and so is what it perturbs
};

struct FrameInfo {
    Frame frame;
    std::string_view name; // as on the command line
    std::string_view word; // in the portable text: cotan_frame_WORD
    FrameSource source;
    bool total;         // no input gives NaN; otherwise degenerate input may
    bool dependsOnView; // changes with where it is seen from, or with the way that the target's rows run
    FrameNormal normal;
    bool fused;               // there is also cotan_perturb_WORD: frame and texel in one step
    std::string_view after;   // a reference beside the chapter of 2006 and the follow-up of 2013; may be empty
    std::string_view summary; // one line
};

// All frames, in the order of the enum.
const std::array<FrameInfo, kFrameCount>& frames();

const FrameInfo& info(Frame frame); // of an enumerator only: isFrame
inline std::string_view name(Frame frame) { return info(frame).name; }

// Whether the frame at a point of a surface changes with the view: with the place of the eye, or with the way that the
// rows of the target run. No map can be made for such a frame.
inline bool dependsOnView(Frame frame) { return info(frame).dependsOnView; }

// What a frame reads at the vertices of a mesh, which has to be stored or derived before: nothing, tangents or
// cotangents.
inline bool readsTangents(Frame frame) { return info(frame).source == FrameSource::tangents; }
inline bool readsCotangents(Frame frame) { return info(frame).source == FrameSource::cotangents; }
inline bool readsVertices(Frame frame) { return readsTangents(frame) || readsCotangents(frame); }

// Whether the fused form of a frame reads two vectors that are constant on a triangle (cotan/triangle.hpp), which an
// earlier stage makes.
inline bool readsTriangleVectors(Frame frame)
{
    return info(frame).source == FrameSource::triangle && info(frame).fused;
}

// The frame of that name; nothing if there is none.
std::optional<Frame> frameFromName(std::string_view name);

// Whether a number is that of a frame: of one that comes from outside.
inline bool isFrame(int number) { return number >= 0 && number < kFrameCount; }

// Evaluates a frame whose source is `differences` or `triangle`. The caller must not ask for a frame that reads the
// vertices: there is nothing to evaluate, and it gives t = b = 0 and n as passed.
// Arguments and degenerate input: as for the functions cotan_frame_NAME in shaders/cotan/frame.h.
f32::cotan_frame evaluate(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 dpdx, f32::cotan_vec3 dpdy,
                          f32::cotan_vec2 duvdx, f32::cotan_vec2 duvdy);
f64::cotan_frame evaluate(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 dpdx, f64::cotan_vec3 dpdy,
                          f64::cotan_vec2 duvdx, f64::cotan_vec2 duvdy);

// Evaluates a frame whose source is `cotangents`, from interpolated covectors u and v; others as above.
f32::cotan_frame evaluateCotangents(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 u, f32::cotan_vec3 v);
f64::cotan_frame evaluateCotangents(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 u, f64::cotan_vec3 v);

// Evaluates a frame whose source is `tangents`, from an interpolated tangent t; others as above.
// alongV: alongV * cross(n, t) points along increasing v. For a glTF TANGENT it is -w.
f32::cotan_frame evaluateTangents(Frame frame, f32::cotan_vec3 n, f32::cotan_vec3 t, float alongV);
f64::cotan_frame evaluateTangents(Frame frame, f64::cotan_vec3 n, f64::cotan_vec3 t, double alongV);

// ---- typed ---------------------------------------------------------------------------------

// Differences along any two directions: screen derivatives, triangle edges, a uv raster's steps.
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

// The frame of that kind from a normal and differences. Degenerate input: as documented for the
// function cotan_frame_NAME in shaders/cotan/frame.h.
template<class Real> CotangentFrame<Real> makeFrame(Frame kind, Covector3<Real> n, const Differences<Real>& d)
{
    const auto f = evaluate(kind, n.raw(), d.dpdx.raw(), d.dpdy.raw(), d.duvdx, d.duvdy);
    return {Covector3<Real>(f.t), Covector3<Real>(f.b), Covector3<Real>(f.n)};
}

// The perturbed normal, unit, from a decoded texel m (components along +u, +v, outwards). The
// texel is neither vector nor covector of world space: its numbers are coefficients.
// Zero sums give n (cotan_apply).
template<class Real>
Covector3<Real> perturb(const CotangentFrame<Real>& f, std::type_identity_t<packed::vec<3, Real>> m)
{
    return Covector3<Real>(cotan_apply(detail::toText(f), m));
}

// The inverse of perturb: the unit texel that this frame turns into `target`. Exact for frames that
// are not orthonormal; a dependent frame gives (0,0,1). m.z <= 0: target below the horizon.
template<class Real> packed::vec<3, Real> encode(const CotangentFrame<Real>& f, Covector3<Real> target)
{
    return cotan_encode(detail::toText(f), target.raw());
}

// The frame in another space. Covectors go by the inverse transpose; for a map that is not a rotation with uniform
// scale the lengths change, and with them the perturbed normal: bake in the scale that will be used.
template<class Real> CotangentFrame<Real> transform(const LinearMap<Real>& map, const CotangentFrame<Real>& f)
{
    return {map(f.t), map(f.b), map(f.n)};
}

} // namespace cotan
