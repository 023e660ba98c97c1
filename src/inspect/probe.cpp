#include "inspect/probe.hpp"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "cotan/vector.hpp"

namespace cotan {

namespace {

using glm::dvec3;

struct Ray {
    dvec3 from, along; // along has length 1 in depth, not as a vector
};

// Through a place of the picture; along . forward is 1, so that its parameter is the depth.
Ray rayAt(const Camera& camera, glm::ivec2 size, glm::vec2 place)
{
    const dvec3 eye(camera.eye), forward = glm::normalize(dvec3(camera.target) - eye);
    const dvec3 right = glm::normalize(glm::cross(forward, dvec3(camera.up))), up = glm::cross(right, forward);
    const double height =
        camera.orthographic ? double(camera.verticalExtent) : 2 * std::tan(double(camera.verticalFieldOfView) / 2);
    const double x = (double(place.x) - size.x * 0.5) * height / size.y,
                 y = (size.y * 0.5 - double(place.y)) * height / size.y;
    const dvec3 aside = right * x + up * y;
    return camera.orthographic ? Ray{eye + aside, forward} : Ray{eye, forward + aside};
}

// Moeller and Trumbore. positive determinants: the front is seen.
bool meets(const Ray& ray, const dvec3& a, const dvec3& b, const dvec3& c, bool bothSides, double& t,
           glm::dvec2& weights)
{
    const dvec3 e1 = b - a, e2 = c - a, p = glm::cross(ray.along, e2);
    const double determinant = glm::dot(e1, p);
    if (!(std::abs(determinant) > 0) || (determinant < 0 && !bothSides))
        return false;
    const dvec3 s = ray.from - a;
    const double u = glm::dot(s, p) / determinant;
    const dvec3 q = glm::cross(s, e1);
    const double v = glm::dot(ray.along, q) / determinant;
    t = glm::dot(e2, q) / determinant;
    weights = {u, v};
    return u >= 0 && v >= 0 && u + v <= 1;
}

} // namespace

std::optional<PickedPoint> pick(const Scene& scene, const Camera& camera, glm::ivec2 size, glm::vec2 place)
{
    std::optional<PickedPoint> nearest;
    if (size.x < 1 || size.y < 1)
        return nearest;
    const Ray ray = rayAt(camera, size, place);
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const glm::dmat4 toWorld(instance.toWorld);
        const glm::dmat4 toMesh = glm::inverse(toWorld);
        const Ray local{dvec3(toMesh * glm::dvec4(ray.from, 1)), dvec3(toMesh * glm::dvec4(ray.along, 0))};
        const bool bothSides = scene.materials[std::size_t(mesh.material)].doubleSided;
        for (std::size_t triangle = 0; triangle < mesh.triangleCount(); ++triangle) {
            const auto corner = [&](std::size_t k) { return dvec3(mesh.positions[mesh.indices[3 * triangle + k]]); };
            double t = 0;
            glm::dvec2 weights{0};
            if (!meets(local, corner(0), corner(1), corner(2), bothSides, t, weights) || !(t > 0) || !(t < best))
                continue;
            best = t;
            nearest = PickedPoint{int(i),
                                  instance.mesh,
                                  triangle,
                                  {1 - weights.x - weights.y, weights.x, weights.y},
                                  glm::vec3(ray.from + ray.along * t),
                                  float(t)};
        }
    }
    return nearest;
}

Probed Prober::at(const Scene& scene, std::uint64_t number, const PickedPoint& hit, Frame frame, TangentOrigin tangents)
{
    const Instance& instance = scene.instances[std::size_t(hit.instance)];
    const Mesh& mesh = scene.meshes[std::size_t(hit.mesh)];
    const Texture& map = scene.materials[std::size_t(mesh.material)].normalMap;
    if (number != number_ || hit.instance != instance_) {
        surface_ = makeSurface(mesh, map, glm::dmat3(glm::mat3(instance.toWorld)));
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

} // namespace cotan
