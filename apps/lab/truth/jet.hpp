// Numbers that carry their first and second derivatives with respect to two parameters.
#pragma once

#include <cmath>

#include <glm/vec3.hpp>

namespace cotan {

// A value f(s,t) and its derivatives.
struct Jet {
    double f = 0, s = 0, t = 0, ss = 0, st = 0, tt = 0;

    Jet() = default;
    Jet(double constant) : f(constant) {} // implicit, so that constants can be written as numbers
    Jet(double f_, double s_, double t_, double ss_, double st_, double tt_)
        : f(f_), s(s_), t(t_), ss(ss_), st(st_), tt(tt_)
    {
    }
};

inline Jet operator+(const Jet& a, const Jet& b)
{
    return {a.f + b.f, a.s + b.s, a.t + b.t, a.ss + b.ss, a.st + b.st, a.tt + b.tt};
}
inline Jet operator-(const Jet& a, const Jet& b)
{
    return {a.f - b.f, a.s - b.s, a.t - b.t, a.ss - b.ss, a.st - b.st, a.tt - b.tt};
}
inline Jet operator*(const Jet& a, const Jet& b)
{
    return {a.f * b.f,
            a.s * b.f + a.f * b.s,
            a.t * b.f + a.f * b.t,
            a.ss * b.f + 2 * a.s * b.s + a.f * b.ss,
            a.st * b.f + a.s * b.t + a.t * b.s + a.f * b.st,
            a.tt * b.f + 2 * a.t * b.t + a.f * b.tt};
}

// Chain rule: g(a), with the values of g, g' and g'' at a.f.
inline Jet chain(const Jet& a, double g, double g1, double g2)
{
    return {g, g1 * a.s, g1 * a.t, g2 * a.s * a.s + g1 * a.ss, g2 * a.s * a.t + g1 * a.st, g2 * a.t * a.t + g1 * a.tt};
}
inline Jet sin(const Jet& a) { return chain(a, std::sin(a.f), std::cos(a.f), -std::sin(a.f)); }
inline Jet cos(const Jet& a) { return chain(a, std::cos(a.f), -std::sin(a.f), -std::cos(a.f)); }
inline Jet tanh(const Jet& a)
{
    const double t = std::tanh(a.f), d = 1 - t * t;
    return chain(a, t, d, -2 * t * d);
}
inline Jet sech(const Jet& a)
{
    const double t = std::tanh(a.f), g = 1 / std::cosh(a.f);
    return chain(a, g, -g * t, g * (2 * t * t - 1));
}

struct JetVector {
    Jet x, y, z;
    glm::dvec3 value() const { return {x.f, y.f, z.f}; }
    glm::dvec3 s() const { return {x.s, y.s, z.s}; }
    glm::dvec3 t() const { return {x.t, y.t, z.t}; }
    glm::dvec3 ss() const { return {x.ss, y.ss, z.ss}; }
    glm::dvec3 st() const { return {x.st, y.st, z.st}; }
    glm::dvec3 tt() const { return {x.tt, y.tt, z.tt}; }
};

} // namespace cotan
