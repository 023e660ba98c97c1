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

} // namespace cotan
