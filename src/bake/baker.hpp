// Finds the point of the high surface for each sample of the low one, and the value that a map stores for it.
#pragma once

#include <span>

#include "bake/bake_surfaces.hpp"
#include "bake/low_points.hpp"

namespace cotan {

// What rays from a hit find around it.
struct Around {
    Lanes<float> openness{}, thickness{};
    Lanes3 open; // unit, the mean open direction; the normal if none is open
};

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
    // Shoots the rays from each hit into the hemisphere above the surface, for occlusion and bent normals.
    std::size_t lookOut(const Probes& probes, const Hits& hits, std::span<const glm::ivec2> rasterTexels,
                        Around& around) const;
    // And those into the surface, for thickness.
    std::size_t lookIn(const Probes& probes, const Hits& hits, std::span<const glm::ivec2> rasterTexels,
                       Around& around) const;
    // Computes the value that a map of a kind stores for each hit. around: set by the functions above, if it is read;
    // materials: by HighMaterials::read, if the kind reads them.
    void valuesOf(BakeKind kind, const LowPoints& points, const Probes& probes, const Hits& hits, const Around& around,
                  const MaterialValues& materials, Lanes3& values) const;
    float unitOf(BakeKind kind) const; // Baked::unit

private:
    bool measured() const { return options_.cage.empty() && options_.search == BakeSearch::first; }
    void aimFromCage(const UvSample& sample, std::size_t i, Probes& probes) const;
    void aimFromStart(const LowPoints& points, const UvSample& sample, std::size_t i, Probes& probes) const;
    std::size_t findFromFurtherOut(std::span<const UvSample> samples, const Probes& probes, Hits& hits) const;
    template<class See>
    std::size_t look(const Probes& probes, const Hits& hits, std::span<const glm::ivec2> rasterTexels, float side,
                     const See& see) const;

    const LowSurface& low_;
    const HighSurface& high_;
    const BakeOptions& options_;
    float distance_ = 0;
    float lift_ = 0;
    float diagonal_ = 0;            // of the high surface
    std::vector<glm::vec3> around_; // directions of look() around the z axis
};

} // namespace cotan
