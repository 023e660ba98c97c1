// Half-precision arithmetic, and the portable text compiled with it.
#pragma once

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/portable.hpp"

namespace cotan {

// An IEEE binary16 number, stored as a float. Every operation rounds to nearest even; subnormals are kept, overflow
// gives infinity.
class Half {
public:
    Half() = default;
    Half(double x) : value_(round(x)) {} // implicit, because constants of the portable text are doubles
    operator float() const { return value_; }

    Half& operator+=(Half b) { return *this = Half(double(value_) + b.value_); }
    Half& operator-=(Half b) { return *this = Half(double(value_) - b.value_); }
    Half& operator*=(Half b) { return *this = Half(double(value_) * b.value_); }
    Half& operator/=(Half b) { return *this = Half(double(value_) / b.value_); }
    friend Half operator+(Half a, Half b) { return a += b; }
    friend Half operator-(Half a, Half b) { return a -= b; }
    friend Half operator*(Half a, Half b) { return a *= b; }
    friend Half operator/(Half a, Half b) { return a /= b; }
    friend Half operator-(Half a) { return Half(-double(a.value_)); }
    friend bool operator<(Half a, Half b) { return a.value_ < b.value_; }
    friend bool operator>(Half a, Half b) { return a.value_ > b.value_; }
    friend bool operator<=(Half a, Half b) { return a.value_ <= b.value_; }
    friend bool operator>=(Half a, Half b) { return a.value_ >= b.value_; }
    friend bool operator==(Half a, Half b) { return a.value_ == b.value_; }
    friend bool operator!=(Half a, Half b) { return a.value_ != b.value_; }

    static float round(double x)
    {
        if (x == 0 || !std::isfinite(x))
            return float(x);
        int exponent;
        std::frexp(x, &exponent);
        const int unit = exponent - 11 > -24 ? exponent - 11 : -24; // exponent of the last place
        const double r = std::ldexp(std::nearbyint(std::ldexp(x, -unit)), unit);
        return std::fabs(r) >= 65520 ? std::copysign(std::numeric_limits<float>::infinity(), float(x)) : float(r);
    }

private:
    float value_; // uninitialised by Half(), like a float: members of GLM's unions must be trivial
};

inline Half abs(Half x) { return Half(std::fabs(double(float(x)))); }
inline Half sqrt(Half x) { return Half(std::sqrt(double(float(x)))); }
inline Half pow(Half x, Half y) { return Half(std::pow(double(float(x)), double(float(y)))); }
inline Half exp2(Half x) { return Half(std::exp2(double(float(x)))); }
inline Half floor(Half x) { return Half(std::floor(double(float(x)))); }
inline Half cotan_inverse_power_of_two(Half x) { return Half(std::ldexp(1.0, -std::ilogb(float(x)))); }

} // namespace cotan

template<> struct std::numeric_limits<cotan::Half> : std::numeric_limits<float> {
};

namespace cotan::f16 {
#define COTAN_LANG_CPP
#define COTAN_CPP_REAL Half
#include "cotan/portable_text.inc"
#undef COTAN_CPP_REAL
#undef COTAN_LANG_CPP
} // namespace cotan::f16
