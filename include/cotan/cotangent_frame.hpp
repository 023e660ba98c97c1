// The typed frame: three covectors, and what may be done with them.
#pragma once

#include <type_traits>

#include "cotan/covector.hpp"
#include "cotan/frame.hpp"

namespace cotan {

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

// The frame in another space. Covectors go by the inverse transpose; for a map that is not a
// rotation with uniform scale the lengths change, and with them the perturbed normal: bake in the
// scale that will be used.
template<class Real> CotangentFrame<Real> transform(const LinearMap<Real>& map, const CotangentFrame<Real>& f)
{
    return {map(f.t), map(f.b), map(f.n)};
}

} // namespace cotan
