// Finds the points of the high surface that belong to points of the low one, and what a map says of them.
#pragma once

#include <span>

#include "bake/bake_surfaces.hpp"
#include "bake/low_points.hpp"

namespace cotan {

class Baker {
public:
    // options.starts: measured, where they are used. All is the caller's.
    Baker(const LowSurface& low, const HighSurface& high, const BakeOptions& options);

    float distance() const { return distance_; }

    // The lines on which the high surface is looked for from places of the low one.
    void aim(const LowPoints& points, std::span<const UvSample> places, Probes& probes) const;
    // The points of the high surface that belong to places of the low one. This and the next three return how many rays
    // that took.
    std::size_t find(std::span<const UvSample> places, const Probes& probes, Hits& hits) const;
    // Where something lies nearer to the low surface than what was found, so that BakeSearch::nearest would take that.
    // 0 everywhere for other rules.
    std::size_t somethingNearer(const Probes& probes, const Hits& hits, Lanes<int>& nearer) const;
    // Whether one of them is further in front than 0.15 of the limit. False for other rules.
    bool standsOff(const Hits& hits) const;
    // Where nothing was found, but something lies on the line.
    std::size_t somethingFurther(const Probes& probes, const Hits& hits, Lanes<int>& further) const;
    // What the map says of each hit.
    std::size_t valuesOf(const LowPoints& points, const Probes& probes, const Hits& hits,
                         std::span<const glm::ivec2> samples, Lanes3& values) const;

private:
    bool measured() const { return options_.cage.empty() && options_.search == BakeSearch::first; }
    void aimFromCage(const UvSample& place, std::size_t i, Probes& probes) const;
    void aimFromStart(const LowPoints& points, const UvSample& place, std::size_t i, Probes& probes) const;
    std::size_t findFromFurtherOut(std::span<const UvSample> places, const Probes& probes, Hits& hits) const;
    float openness(glm::vec3 where, glm::vec3 face, glm::vec3 n, std::uint32_t pattern) const;

    const LowSurface& low_;
    const HighSurface& high_;
    const BakeOptions& options_;
    float distance_ = 0;
    float lift_ = 0;
};

} // namespace cotan
