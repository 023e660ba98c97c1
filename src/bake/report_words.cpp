#include "bake/report_words.hpp"

#include <fmt/format.h>

#include "scene/geometry.hpp"

namespace cotan {

std::string counted(std::size_t number, const std::string& noun)
{
    return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

std::string toText(const ValueSummary& s)
{
    return s.count > 0 ? fmt::format("{:.2f} / {:.2f} / {:.2f}", s.mean, s.percentile95, s.maximum)
                       : "nothing to measure";
}

Json toJson(const ValueSummary& s)
{
    return {{"count", s.count}, {"mean", s.mean}, {"percentile95", s.percentile95}, {"maximum", s.maximum}};
}

Json countsOf(const Scene& scene)
{
    std::size_t triangles = 0;
    for (const Mesh& mesh : scene.meshes)
        triangles += mesh.triangleCount();
    return {{"meshes", scene.meshes.size()},
            {"instances", scene.instances.size()},
            {"materials", scene.materials.size()},
            {"images", scene.images.size()},
            {"triangles", triangles},
            {"triangles_drawn", trianglesDrawn(scene)},
            {"warnings", scene.warnings}};
}

} // namespace cotan
