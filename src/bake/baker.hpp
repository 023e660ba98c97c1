// Finds the point of the high surface for each sample of the low one, and the value that a map stores for it.
#pragma once

#include <span>

#include "bake/bake_surfaces.hpp"
#include "bake/low_points.hpp"

namespace cotan {

class Baker {
public:
    // options.starts must have been measured if it is used (measureRayStarts). All arguments must outlive the Baker.
    Baker(const LowSurface& low, const HighSurface& high, const BakeOptions& options);

    float distance() const { return distance_; }

    // Sets up a probe for each sample: the line on which the high surface is searched.
    void aim(const LowPoints& points, std::span<const UvSample> samples, Probes& probes) const;
    // Finds the hit of each probe. This and the next functions return the number of rays that they shot.
    std::size_t find(std::span<const UvSample> samples, const Probes& probes, Hits& hits) const;
    // Marks probes for which a surface is nearer to the low one than the hit, so that BakeSearch::nearest would find
    // another. None with a cage or for `nearest`.
    std::size_t findNearer(const Probes& probes, const Hits& hits, Lanes<int>& nearer) const;
    // Whether a hit is further in front than 15 % of the search distance. False with a cage and for `nearest`.
    bool anyFarInFront(const Hits& hits) const;
    // Marks probes that hit nothing, while a surface lies somewhere on the line.
    std::size_t findFurther(const Probes& probes, const Hits& hits, Lanes<int>& further) const;
    // Computes the value that the map stores for each hit.
    std::size_t valuesOf(const LowPoints& points, const Probes& probes, const Hits& hits,
                         std::span<const glm::ivec2> rasterTexels, Lanes3& values) const;

private:
    bool measured() const { return options_.cage.empty() && options_.search == BakeSearch::first; }
    void aimFromCage(const UvSample& sample, std::size_t i, Probes& probes) const;
    void aimFromStart(const LowPoints& points, const UvSample& sample, std::size_t i, Probes& probes) const;
    std::size_t findFromFurtherOut(std::span<const UvSample> samples, const Probes& probes, Hits& hits) const;
    float openness(glm::vec3 where, glm::vec3 face, glm::vec3 n, std::uint32_t pattern, std::uint32_t only) const;

    const LowSurface& low_;
    const HighSurface& high_;
    const BakeOptions& options_;
    float distance_ = 0;
    float lift_ = 0;
};

} // namespace cotan
