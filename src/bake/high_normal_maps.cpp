#include "bake/high_normal_maps.hpp"

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/try.hpp"
#include "cotan/vector.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

glm::vec4 texelAt(const Image& image, const Sampler& sampler, glm::dvec2 uv)
{
    auto stored = [&](int x, int y) { return storedComponents(image, x, y); };
    return sampler.magnify == Filter::linear ? bilinearTexel(image.width, image.height, sampler, uv, stored)
                                             : nearestTexel(image.width, image.height, sampler, uv, stored);
}

} // namespace

Result<HighNormalMaps> HighNormalMaps::make(std::vector<Scene>& scenes, Frame frame)
{
    HighNormalMaps maps;
    bool anyMap = false;
    for (Scene& scene : scenes) {
        std::map<int, const Image*> kept;
        for (const Instance& instance : scene.instances) {
            const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            if (mesh.indices.empty())
                continue; // as HighSurface does
            Part& part = maps.parts_.emplace_back();
            const Material& material = scene.materials[std::size_t(mesh.material)];
            const Texture& map = material.normalMap;
            anyMap = anyMap || map.present();
            if (!map.present() || mesh.texcoords[std::size_t(map.texcoord)].empty())
                continue;
            const auto [entry, isNew] = kept.try_emplace(map.image, nullptr);
            if (isNew) {
                maps.images_.push_back(std::move(scene.images[std::size_t(map.image)]));
                entry->second = &maps.images_.back();
            }
            const Image& image = *entry->second;
            if (!hasPixels(image))
                continue;
            COTAN_TRY(surface, makeLowSurface(scene, -1, frame, TangentOrigin::stored, {&instance, 1}));
            part = {
                std::move(*surface), &image, map.sampler,
                toFormat<f64::cotan_normal_format>(material.normalFormat, image.type, double(material.normalScale))};
            ++maps.mapped_;
        }
    }
    if (maps.mapped_ == 0)
        return inputError(fmt::format("{}: expected a normal map {}; found none", scenes.empty() ? "" : scenes[0].name,
                                      anyMap ? "and texture coordinates for it" : "in a material"));
    return maps;
}

glm::vec3 HighNormalMaps::normalAt(std::uint32_t instance, std::uint32_t triangle, double b1, double b2,
                                   glm::vec3 smooth) const
{
    const Part& part = parts_[instance];
    if (!part.image)
        return smooth;
    const LowSurface& s = part.surface;
    const TriangleEdges edges = edgesOf(s, triangle);
    const double area = std::abs(edges.uvArea2());
    const glm::dvec2 uv =
        glm::dvec2(s.texcoords[s.indices[3 * std::size_t(triangle)]]) + edges.uv1 * b1 + edges.uv2 * b2;
    const bool readable = area > 0 && area < double(kFarthestUv) && std::abs(uv.x) <= double(kFarthestUv)
        && std::abs(uv.y) <= double(kFarthestUv);
    if (!readable)
        return smooth;
    const glm::dvec3 m = f64::cotan_decode(glm::dvec3(texelAt(*part.image, part.sampler, uv)), part.format);
    const LowPoint point = pointOf(s, triangle, b1, b2);
    const glm::dvec3 n = perturb(point.frame, m).raw(); // n of the frame for a texel without direction
    return glm::vec3(unitOr(n, glm::dvec3(smooth)));
}

} // namespace cotan
