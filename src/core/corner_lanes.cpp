#include "corner_lanes.hpp"

namespace cotan::tangents {

namespace {

[[gnu::always_inline]] inline void deriveAll(CornerLanes& c)
{
    constexpr std::size_t kTogether = 16; // derived whether in use or not: a constant count is faster
    static_assert(CornerLanes::kLanes % kTogether == 0);
    for (std::size_t begin = 0; begin < c.count; begin += kTogether)
        for (std::size_t lane = begin; lane < begin + kTogether; ++lane)
            c.put(lane, gradientsOf(c.edges(lane)));
}

#if defined(__x86_64__) && defined(__GNUC__)
// Eight lanes at a time if the CPU supports it. Without fused multiply-add, so that the values are the same.
[[gnu::target("avx2")]] void deriveEight(CornerLanes& lanes) { deriveAll(lanes); }
#endif

} // namespace

void deriveGradients(CornerLanes& lanes)
{
#if defined(__x86_64__) && defined(__GNUC__)
    static const bool eight = __builtin_cpu_supports("avx2") != 0;
    if (eight)
        return deriveEight(lanes);
#endif
    deriveAll(lanes);
}

} // namespace cotan::tangents
