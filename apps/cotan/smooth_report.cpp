#include "smooth_report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace cotan::app {

SmoothStatistics smoothStatistics(const MeshView& mesh)
{
    const VertexSplit split = splitMirrored(mesh);
    const auto positions = gathered(mesh.positions, split);
    const auto normals = gathered(mesh.normals, split);
    const auto texcoords = gathered(mesh.texcoords, split);
    const Cotangents c = smoothCotangents({positions, normals, texcoords, split.indices});
    std::vector<float> shear;
    ValueStatistics stretch;
    for (std::size_t i = 0; i < c.u.size(); ++i) {
        const double u = glm::length(glm::dvec3(c.u[i])), v = glm::length(glm::dvec3(c.v[i]));
        if (!(u > 0) || !(v > 0))
            continue;
        const double sine = std::abs(glm::dot(glm::dvec3(c.u[i]), glm::dvec3(c.v[i]))) / (u * v);
        shear.push_back(float(std::asin(std::min(sine, 1.0)) * 57.29577951308232));
        stretch.add(std::max(u, v) / std::min(u, v));
    }
    SmoothStatistics s;
    s.vertices = c.u.size();
    s.added = split.sources.size() - mesh.positions.size();
    s.without = c.u.size() - shear.size();
    s.shear = angleStatistics(shear);
    s.stretchMedian = stretch.percentile(0.5);
    s.stretchMaximum = stretch.maximum();
    return s;
}

std::string toText(const SmoothStatistics& s)
{
    const std::string figures = s.shear.count == 0 ? "no shear or stretch to measure"
                                                   : fmt::format("shear {}; stretch median {:.3g}, max {:.3g}",
                                                                 toText(s.shear), s.stretchMedian, s.stretchMaximum);
    return fmt::format("{} vertices ({} added where mirrored charts meet), {} without a frame; {}", s.vertices, s.added,
                       s.without, figures);
}

Json toJson(const SmoothStatistics& s)
{
    Json shear = toJson(s.shear);
    shear.erase("pixels"); // these are vertices, not pixels
    return {{"vertices", s.vertices},
            {"vertices_added", s.added},
            {"without_frame", s.without},
            {"shear", shear},
            {"stretch", {{"median", s.stretchMedian}, {"max", s.stretchMaximum}}}};
}

} // namespace cotan::app
