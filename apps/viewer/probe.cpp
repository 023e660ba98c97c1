#include "probe.hpp"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "cotan/vector.hpp"
#include "scene/texture_sample.hpp"

namespace cotan::viewer {

Probed Prober::at(const Scene& scene, std::uint64_t number, const PickedPoint& hit, Frame frame, TangentOrigin tangents)
{
    const Instance& instance = scene.instances[std::size_t(hit.instance)];
    const Mesh& mesh = scene.meshes[std::size_t(hit.mesh)];
    const Material& material = scene.materials[std::size_t(mesh.material)];
    const Texture& map = material.normalMap;
    if (number != number_ || hit.instance != instance_) {
        surface_ = makeSurface(mesh, frameTexture(material), glm::dmat3(glm::mat3(instance.toWorld)));
        number_ = number;
        instance_ = hit.instance;
    }
    Probed p;
    p.normal = unitOrZero(normalAt(surface_, hit.triangle, hit.barycentric));
    p.hasUv = surface_.hasUv();
    if (!p.hasUv)
        return p;
    p.uv = glm::vec2(uvAt(surface_, hit.triangle, hit.barycentric));
    if (map.present()) {
        const Image& image = scene.images[std::size_t(map.image)];
        const glm::vec2 inside = p.uv - glm::vec2(std::floor(p.uv.x), std::floor(p.uv.y));
        if (image.width > 0 && image.height > 0)
            p.texel = glm::min(glm::ivec2(inside * glm::vec2(image.width, image.height)),
                               glm::ivec2(image.width - 1, image.height - 1));
    }
    const f64::cotan_frame f = frameAt(surface_, frame, tangents, hit.triangle, hit.barycentric);
    p.t = glm::vec3(f.t);
    p.b = glm::vec3(f.b);
    const double side = glm::dot(glm::cross(glm::dvec3(p.normal), glm::dvec3(f.t)), glm::dvec3(f.b));
    p.w = side < 0 ? 1 : side > 0 ? -1 : 0;
    if (surface_.hasStored())
        p.storedTangent = unitOrZero(glm::dvec3(storedAt(surface_, hit.triangle, hit.barycentric)));
    return p;
}

} // namespace cotan::viewer
