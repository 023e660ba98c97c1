// Values of sixteen texels side by side, so that the compiler vectorises loops over them and Embree takes them as one
// packet. Loops run over all lanes; the results of unused lanes are never read.
#pragma once

#include <array>
#include <cstddef>

#include <glm/vec3.hpp>

#include "cotan/packed_only.hpp"

namespace cotan {

inline constexpr std::size_t kLanes = 16;

template<class T> struct alignas(64) Lanes : std::array<T, kLanes> {
};

struct Lanes3 {
    alignas(64) float x[kLanes]{}, y[kLanes]{}, z[kLanes]{};

    glm::vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
    void set(std::size_t i, glm::vec3 v)
    {
        x[i] = v.x;
        y[i] = v.y;
        z[i] = v.z;
    }
};

#if defined(__x86_64__) && defined(__GNUC__) && !defined(_WIN32) // there stacks are aligned to 16 bytes only
template<class Loops> [[gnu::target("avx2"), gnu::flatten]] void runWide(const Loops& loops) { loops(); }
#endif

// Calls loops(), of which everything is inlined: eight lanes at a time if the processor has AVX2. Without fused
// multiply-add, so that the values are the same.
template<class Loops> [[gnu::flatten]] void runLanes(const Loops& loops)
{
#if defined(__x86_64__) && defined(__GNUC__) && !defined(_WIN32)
    static const bool wide = __builtin_cpu_supports("avx2") != 0;
    if (wide)
        return runWide(loops);
#endif
    loops();
}

} // namespace cotan
