// A number type that counts its operations, for compiling the portable text as C++.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "cost/scalar_count.hpp"

namespace cotan::cost {

// Receives the counts while a count is running; there is only one at a time.
inline Operations* counting = nullptr;

struct CountedReal {
    double value;
    bool product; // the result of a multiplication
    bool rooted;  // the result of a square root

    CountedReal() = default; // trivial, as GLM's vectors require; uninitialised like a double
    CountedReal(double v) : value(v), product(false), rooted(false) {}
    CountedReal(int v) : CountedReal(double(v)) {}
    CountedReal(std::uint32_t v) : CountedReal(double(v)) {}
    explicit operator double() const { return value; }
    explicit operator float() const { return float(value); }
    explicit operator std::uint32_t() const { return std::uint32_t(value); }

    CountedReal& operator+=(CountedReal b) { return *this = *this + b; }
    CountedReal& operator-=(CountedReal b) { return *this = *this - b; }
    CountedReal& operator*=(CountedReal b) { return *this = *this * b; }
    CountedReal& operator/=(CountedReal b) { return *this = *this / b; }

    static CountedReal counted(int Operations::*kind, double v, bool isProduct = false)
    {
        if (counting)
            ++(counting->*kind);
        CountedReal r(v);
        r.product = isProduct;
        return r;
    }
    static CountedReal sum(CountedReal a, CountedReal b, double v)
    {
        if (counting && (a.product || b.product))
            ++counting->merged;
        return counted(&Operations::add, v);
    }

    friend CountedReal operator+(CountedReal a, CountedReal b) { return sum(a, b, a.value + b.value); }
    friend CountedReal operator-(CountedReal a, CountedReal b) { return sum(a, b, a.value - b.value); }
    friend CountedReal operator-(CountedReal a)
    {
        a.value = -a.value;
        return a;
    }
    friend CountedReal operator*(CountedReal a, CountedReal b)
    {
        return counted(&Operations::multiply, a.value * b.value, true);
    }
    friend CountedReal operator/(CountedReal a, CountedReal b)
    {
        if (counting && b.rooted && a.value == 1) { // how lang.h writes an inverse square root in C++
            --counting->root;
            return counted(&Operations::inverseRoot, a.value / b.value);
        }
        return counted(&Operations::divide, a.value / b.value);
    }
    friend bool operator<(CountedReal a, CountedReal b) { return count(a.value < b.value); }
    friend bool operator>(CountedReal a, CountedReal b) { return count(a.value > b.value); }
    friend bool operator<=(CountedReal a, CountedReal b) { return count(a.value <= b.value); }
    friend bool operator>=(CountedReal a, CountedReal b) { return count(a.value >= b.value); }
    friend bool operator==(CountedReal a, CountedReal b) { return count(a.value == b.value); }

    friend CountedReal max(CountedReal a, CountedReal b)
    {
        return counted(&Operations::maximum, std::fmax(a.value, b.value));
    }
    friend CountedReal min(CountedReal a, CountedReal b)
    {
        return counted(&Operations::maximum, std::fmin(a.value, b.value));
    }
    friend CountedReal abs(CountedReal a) // costs only a sign change
    {
        a.value = std::fabs(a.value);
        return a;
    }
    friend CountedReal sqrt(CountedReal a)
    {
        CountedReal r = counted(&Operations::root, std::sqrt(a.value));
        r.rooted = true;
        return r;
    }
    friend CountedReal copysign(CountedReal a, CountedReal s)
    {
        return counted(&Operations::bits, std::copysign(a.value, s.value));
    }
    friend CountedReal cotan_inverse_power_of_two(CountedReal a)
    {
        return counted(&Operations::bits, std::ldexp(1.0, -std::ilogb(a.value)));
    }
    friend CountedReal exp2(CountedReal a) { return CountedReal(std::exp2(a.value)); }
    friend CountedReal floor(CountedReal a) { return CountedReal(std::floor(a.value)); }
    friend CountedReal pow(CountedReal a, CountedReal b) { return CountedReal(std::pow(a.value, b.value)); }

private:
    static bool count(bool result)
    {
        if (counting)
            ++counting->compare;
        return result;
    }
};

} // namespace cotan::cost

// GLM requires its scalar type to be a floating-point number.
template<> struct std::numeric_limits<cotan::cost::CountedReal> : std::numeric_limits<double> {
};
