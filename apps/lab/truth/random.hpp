// Random numbers that are the same on every machine: splitmix64 (S. Vigna's constants).
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/vec3.hpp>

namespace cotan {

class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits()
    {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ull);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
        return z ^ (z >> 31);
    }
    double unit() { return double(bits() >> 11) * 0x1p-53; } // [0,1)
    double range(double a, double b) { return a + (b - a) * unit(); }
    double azimuth() { return range(0, 2 * std::numbers::pi); }
    glm::dvec3 direction() // uniform on the unit sphere
    {
        const double z = range(-1, 1);
        const double a = azimuth();
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(a), r * std::sin(a), z};
    }

private:
    std::uint64_t state_;
};

} // namespace cotan
