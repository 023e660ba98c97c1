#include "bake/surface/nearest_texels.hpp"

#include <limits>

#include "bake/bake_surfaces.hpp"

namespace cotan {

void padCharts(Baked& baked, int radius)
{
    std::vector<std::uint32_t> owner(baked.values.size(), kNoTexel);
    for (std::size_t i = 0; i < owner.size(); ++i)
        if ((baked.states[i] & (texelCovered | texelTouched)) != 0 && baked.values[i] != glm::vec3(0))
            owner[i] = std::uint32_t(i);
    spreadNearest(owner, baked.width, baked.height, AskFirst::above);
    const std::int64_t limit = radius > 0 ? std::int64_t(radius) * radius : std::numeric_limits<std::int64_t>::max();
    for (std::size_t i = 0; i < owner.size(); ++i) {
        if (owner[i] == kNoTexel || owner[i] == i || distance2(owner[i], std::uint32_t(i), baked.width) > limit)
            continue;
        baked.values[i] = baked.values[owner[i]];
        baked.states[i] = std::uint8_t(baked.states[i] | texelPadded);
    }
}

} // namespace cotan
