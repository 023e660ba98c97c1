#include "scene_check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "cotan/portable.hpp"

namespace cotan {

namespace {

// One line, or nothing.
using Problem = std::optional<std::string>;

template<class T> bool finite(const T& value)
{
    const std::span<const float> numbers(reinterpret_cast<const float*>(&value), sizeof value / sizeof(float));
    return std::ranges::all_of(numbers, [](float x) { return std::isfinite(x); });
}

bool below(int index, std::size_t size) { return index >= 0 && std::size_t(index) < size; }

Problem checkImage(const Image& image)
{
    const bool sized = image.width > 0 && image.height > 0;
    if (!sized || image.data.size() % image.bytesPerPixel() != 0
        || image.data.size() / image.bytesPerPixel() != image.pixelCount())
        return fmt::format("expected the bytes of {} x {} pixels, found {}", image.width, image.height,
                           image.data.size());
    return std::nullopt;
}

Problem checkTexture(const Texture& texture, std::size_t images, std::string_view name)
{
    if (texture.image < -1 || texture.image >= int(images))
        return fmt::format("{}: expected an image below {}, found {}", name, images, texture.image);
    if (texture.texcoord != 0 && texture.texcoord != 1)
        return fmt::format("{}: expected uv set 0 or 1, found {}", name, texture.texcoord);
    if (!finite(texture.uRow) || !finite(texture.vRow))
        return fmt::format("{}: expected a finite transform of uv", name);
    return std::nullopt;
}

Problem checkMaterial(const Material& m, std::size_t images)
{
    const std::pair<const Texture*, std::string_view> textures[] = {{&m.baseColorMap, "base colour"},
                                                                    {&m.metallicRoughnessMap, "metal and roughness"},
                                                                    {&m.normalMap, "normal map"},
                                                                    {&m.occlusionMap, "occlusion"},
                                                                    {&m.emissiveMap, "emission"}};
    for (const auto& [texture, name] : textures)
        if (Problem problem = checkTexture(*texture, images, name))
            return problem;
    const glm::vec4 factors(m.metallic, m.roughness, m.occlusionStrength, m.normalScale);
    if (!finite(m.baseColor) || !finite(m.emissive) || !finite(factors) || !finite(m.alphaCutoff))
        return "expected finite factors";
    return std::nullopt;
}

template<class T> Problem checkArray(const std::vector<T>& values, std::size_t vertices, std::string_view name)
{
    if (!values.empty() && values.size() != vertices)
        return fmt::format("{}: expected {} entries, one a vertex, found {}", name, vertices, values.size());
    const auto bad = std::ranges::find_if(values, [](const T& value) { return !finite(value); });
    if (bad != values.end())
        return fmt::format("{} {}: expected finite numbers", name, bad - values.begin());
    return std::nullopt;
}

Problem checkIndices(const Mesh& mesh)
{
    if (mesh.indices.size() % 3 != 0)
        return fmt::format("expected three indices a triangle, found {} together", mesh.indices.size());
    const std::size_t vertices = mesh.vertexCount();
    const auto bad = std::ranges::find_if(mesh.indices, [&](std::uint32_t i) { return i >= vertices; });
    if (bad != mesh.indices.end())
        return fmt::format("triangle {}: expected an index below {}, found {}", (bad - mesh.indices.begin()) / 3,
                           vertices, *bad);
    return std::nullopt;
}

Problem checkMesh(const Mesh& mesh, std::size_t materials)
{
    if (!below(mesh.material, materials))
        return fmt::format("expected a material below {}, found {}", materials, mesh.material);
    const std::size_t n = mesh.vertexCount();
    if (mesh.normals.size() != n)
        return fmt::format("normals: expected {} entries, one a vertex, found {}", n, mesh.normals.size());
    for (Problem problem : {checkArray(mesh.positions, n, "position"), checkArray(mesh.normals, n, "normal"),
                            checkArray(mesh.tangents, n, "tangent"), checkArray(mesh.texcoords[0], n, "uv set 0"),
                            checkArray(mesh.texcoords[1], n, "uv set 1"), checkArray(mesh.colors, n, "colour"),
                            checkArray(mesh.cotangentsU, n, "cotangent u"),
                            checkArray(mesh.cotangentsV, n, "cotangent v"), checkIndices(mesh)})
        if (problem)
            return problem;
    return std::nullopt;
}

Problem checkInstance(const Instance& instance, std::size_t meshes)
{
    if (!below(instance.mesh, meshes))
        return fmt::format("expected a mesh below {}, found {}", meshes, instance.mesh);
    if (!finite(instance.toWorld))
        return "expected a finite transform";
    return std::nullopt;
}

Problem checkLight(const Light& light)
{
    const glm::vec4 numbers(light.intensity, light.range, light.innerCone, light.outerCone);
    if (!finite(light.color) || !finite(light.position) || !finite(light.direction) || !finite(numbers))
        return "expected finite numbers";
    return std::nullopt;
}

Problem checkCamera(const Camera& camera)
{
    const glm::vec2 numbers(camera.verticalFieldOfView, camera.verticalExtent);
    if (!finite(camera.eye) || !finite(camera.target) || !finite(camera.up) || !finite(numbers))
        return "expected finite numbers";
    return std::nullopt;
}

// "mesh 3: ..." for the first of the list with a problem.
template<class T, class F> Problem first(const std::vector<T>& list, std::string_view what, F check)
{
    for (std::size_t i = 0; i < list.size(); ++i)
        if (const Problem problem = check(list[i]))
            return fmt::format("{} {}: {}", what, i, *problem);
    return std::nullopt;
}

} // namespace

Status checkScene(const Scene& scene, const std::string& file)
{
    Problem problem = first(scene.images, "image", checkImage);
    if (!problem)
        problem = first(scene.materials, "material", [&](const Material& m) { return checkMaterial(m, scene.images.size()); });
    if (!problem)
        problem = first(scene.meshes, "mesh", [&](const Mesh& m) { return checkMesh(m, scene.materials.size()); });
    if (!problem)
        problem = first(scene.instances, "instance", [&](const Instance& i) { return checkInstance(i, scene.meshes.size()); });
    if (!problem)
        problem = first(scene.lights, "light", checkLight);
    if (!problem)
        problem = first(scene.cameras, "camera", checkCamera);
    if (problem)
        return inputError(fmt::format("{}: {}", file, *problem));
    return Done{};
}

} // namespace cotan
