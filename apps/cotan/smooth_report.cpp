#include "smooth_report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "cotan/report/statistics.hpp"

namespace cotan::app {

namespace {

template<class T>
std::vector<T> gathered(std::span<const T> values, const std::vector<std::uint32_t>& sources)
{
    std::vector<T> out;
    out.reserve(sources.size());
    for (const std::uint32_t s : sources)
        out.push_back(values[s]);
    return out;
}

// The value at rank floor(q * (count - 1)).
double percentile(std::vector<float>& values, double q)
{
    if (values.empty())
        return kOfNothing;
    const auto at = values.begin() + std::ptrdiff_t(q * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return double(*at);
}

} // namespace

std::string reportSmooth(const MeshView& mesh, nlohmann::ordered_json& row)
{
    const VertexSplit split = splitMirrored(mesh);
    const auto positions = gathered(mesh.positions, split.sources);
    const auto normals = gathered(mesh.normals, split.sources);
    const auto texcoords = gathered(mesh.texcoords, split.sources);
    const Cotangents c = smoothCotangents({positions, normals, texcoords, split.indices});
    std::vector<float> shear, stretch;
    for (std::size_t i = 0; i < c.u.size(); ++i) {
        const double u = glm::length(glm::dvec3(c.u[i])), v = glm::length(glm::dvec3(c.v[i]));
        if (!(u > 0) || !(v > 0))
            continue;
        const double sine = std::abs(glm::dot(glm::dvec3(c.u[i]), glm::dvec3(c.v[i]))) / (u * v);
        shear.push_back(float(std::asin(std::min(sine, 1.0)) * 57.29577951308232));
        stretch.push_back(float(std::max(u, v) / std::min(u, v)));
    }
    const std::size_t without = c.u.size() - shear.size();
    const AngleStatistics s = statisticsOf(shear);
    const double median = percentile(stretch, 0.5), most = percentile(stretch, 1);
    row["vertices"] = c.u.size();
    row["vertices_added"] = split.sources.size() - mesh.positions.size();
    row["without_frame"] = without;
    row["shear"] = toJson(s);
    row["shear"].erase("pixels");
    row["stretch"] = {{"median", median}, {"max", most}};
    const std::string figures = shear.empty() ? "no shear or stretch to measure"
                                              : fmt::format("shear {}; stretch median {:.3g}, max {:.3g}", toText(s), median, most);
    return fmt::format("{} vertices ({} added where mirrored charts meet), {} without a frame; {}", c.u.size(),
                       split.sources.size() - mesh.positions.size(), without, figures);
}

} // namespace cotan::app
