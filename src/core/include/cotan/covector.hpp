// Vectors and covectors as different types.
//
// A vector is a displacement: edges, dP/du, light directions. A covector holds the coefficients of a plane or a
// gradient: normals, grad u, the t, b and n of a cotangent frame. A linear map M transforms vectors by M and covectors
// by its inverse transpose. Adding a vector to a covector is meaningless, and here it does not compile: the error
// checking that the 2013 follow-up asks for.
//
//   Vector3d tangent; Covector3d normal;
//   tangent + normal;          // does not compile
//   dot(normal, tangent);      // the pairing of a covector with a vector: a number
//   cross(tangent, bitangent); // of two vectors: a covector
#pragma once

#include <cmath>
#include <type_traits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "cotan/packed.hpp"

namespace cotan {

// Three components of one kind. Arithmetic stays within the kind.
template<class Real, class Kind> struct Triple {
    using Raw = packed::vec<3, Real>;

    Real x = 0;
    Real y = 0;
    Real z = 0;

    constexpr Triple() = default;
    constexpr Triple(Real x_, Real y_, Real z_) : x(x_), y(y_), z(z_) {}
    // Conversions from and to GLM are explicit: GLM does not know the kind.
    constexpr explicit Triple(const Raw& r) : x(r.x), y(r.y), z(r.z) {}
    constexpr Raw raw() const { return Raw(x, y, z); }

    friend constexpr Triple operator+(Triple a, Triple b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend constexpr Triple operator-(Triple a, Triple b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend constexpr Triple operator-(Triple a) { return {-a.x, -a.y, -a.z}; }
    friend constexpr Triple operator*(Triple a, Real s) { return {a.x * s, a.y * s, a.z * s}; }
    friend constexpr Triple operator*(Real s, Triple a) { return a * s; }
    friend constexpr bool operator==(Triple a, Triple b) = default;
};

struct VectorKind;
struct CovectorKind;

template<class Real> using Vector3 = Triple<Real, VectorKind>;
template<class Real> using Covector3 = Triple<Real, CovectorKind>;
using Vector3f = Vector3<float>;
using Vector3d = Vector3<double>;
using Covector3f = Covector3<float>;
using Covector3d = Covector3<double>;

// The pairing of a covector with a vector; for grad u and an edge it is the change of u along the edge. It is invariant
// under linear maps between spaces.
template<class Real> constexpr Real dot(Covector3<Real> c, Vector3<Real> v)
{
    return c.x * v.x + c.y * v.y + c.z * v.z;
}
template<class Real> constexpr Real dot(Vector3<Real> v, Covector3<Real> c) { return dot(c, v); }

// The plane spanned by two vectors, as a covector; its length is the area between them.
template<class Real> constexpr Covector3<Real> cross(Vector3<Real> a, Vector3<Real> b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// The direction common to two planes.
template<class Real> constexpr Vector3<Real> cross(Covector3<Real> a, Covector3<Real> b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// The Euclidean length. Lengths and angles are properties of the space (of its metric), not of the kind; a non-uniform
// map changes them.
template<class Real, class Kind> Real length(Triple<Real, Kind> a)
{
    return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

// Returns a with length 1; `otherwise` if a is zero or not finite.
template<class Real, class Kind> Triple<Real, Kind> normalizeOr(Triple<Real, Kind> a, Triple<Real, Kind> otherwise)
{
    const Real l = length(a);
    return l > 0 && std::isfinite(l) ? a * (1 / l) : otherwise;
}

// Returns the angle between two triples of one kind in radians, accurate near 0 and pi. 0 if one of them is zero.
template<class Real, class Kind> Real angle(Triple<Real, Kind> a, Triple<Real, Kind> b)
{
    return std::atan2(glm::length(glm::cross(a.raw(), b.raw())), glm::dot(a.raw(), b.raw()));
}

// Conversions between vectors and covectors with the same components. They depend on the metric of the space, so they
// are explicit.
template<class Real> constexpr Covector3<Real> lower(Vector3<Real> v) { return {v.x, v.y, v.z}; }
template<class Real> constexpr Vector3<Real> raise(Covector3<Real> c) { return {c.x, c.y, c.z}; }

// A linear map between spaces (the upper left 3x3 of an affine matrix; columns are the images of the axes), with the
// cofactor matrix that covectors need.
template<class Real> class LinearMap {
public:
    using Matrix = packed::mat<3, Real>;

    explicit LinearMap(const Matrix& m)
        : matrix_(m), cofactor_(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])),
          determinant_(glm::dot(m[0], cofactor_[0]))
    {
    }

    Real determinant() const { return determinant_; }

    // Returns M v.
    Vector3<Real> operator()(Vector3<Real> v) const { return Vector3<Real>(matrix_ * v.raw()); }

    // Returns the inverse transpose times c; zero for a singular map (determinant 0). If only the direction matters,
    // planeImage() avoids the division.
    Covector3<Real> operator()(Covector3<Real> c) const
    {
        if (determinant_ == 0)
            return {};
        return Covector3<Real>(cofactor_ * c.raw() * (1 / determinant_));
    }

    // Returns the cofactor matrix times c, with the sign of the determinant: the direction of operator(), but valid for
    // flattened objects too, where it is the normal of the remaining plane.
    Covector3<Real> planeImage(Covector3<Real> c) const { return Covector3<Real>(planeMatrix() * c.raw()); }
    // The matrix of planeImage(), for many covectors: the inverse transpose up to a positive factor.
    Matrix planeMatrix() const { return cofactor_ * Real(determinant_ < 0 ? -1 : 1); }

private:
    Matrix matrix_;
    Matrix cofactor_;
    Real determinant_;
};

// ---- three ways to carry a normal to world space ---------------------------------------------
//
// All three agree only for M = R S, a rotation after a scale along the axes, and a uniform S:
//
//   method            formula        correct for                       wrong for
//   undoScale         R S^-1 n       rotation x axis-aligned scale     shear, a scale in a rotated
//                                    (including mirroring)             parent; a zero scale
//   rotationOnly      R n            rotation x uniform scale          any non-uniform scale: error
//                                                                      up to 36.9 degrees for a
//                                                                      sphere scaled 1:1:4, where
//                                                                      tan = (k-1)/(2 sqrt k)
//   inverseTranspose  M^-T n         every invertible M                a singular M (use
//                                                                      LinearMap::planeImage)
//
// Source: the port of 2017, which uses all three; it prints the first as S^-1 M n, which for M = R S undoes nothing,
// and means R S^-1 n.
enum class NormalTransform { undoScale, rotationOnly, inverseTranspose };

// Transforms a normal by one of the three methods; unit length. The first two take R and S from the columns of M: S is
// their lengths (negative in x if M mirrors), R the columns divided by them.
// Degenerate input: a column of length zero, or a result of length zero, gives `n` normalised.
template<class Real>
Covector3<Real> transformNormal(NormalTransform way, const std::type_identity_t<packed::mat<3, Real>>& m,
                                Covector3<Real> n)
{
    const Covector3<Real> fallback = normalizeOr(n, Covector3<Real>{0, 0, 1});
    if (way == NormalTransform::inverseTranspose)
        return normalizeOr(LinearMap<Real>(m)(n), fallback);

    packed::vec<3, Real> scale(glm::length(m[0]), glm::length(m[1]), glm::length(m[2]));
    if (glm::determinant(m) < 0)
        scale.x = -scale.x;
    if (scale.x == 0 || scale.y == 0 || scale.z == 0)
        return fallback;
    const packed::mat<3, Real> rotation(m[0] / scale.x, m[1] / scale.y, m[2] / scale.z);
    // The sign of x in S contains the mirroring, which rotationOnly drops together with S.
    const auto local = way == NormalTransform::undoScale ? n.raw() / scale : n.raw();
    return normalizeOr(Covector3<Real>(rotation * local), fallback);
}

} // namespace cotan
