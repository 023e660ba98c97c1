#include "scene/scene_check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

#include <glm/geometric.hpp>

#include "cotan/vector.hpp"
#include "cotan/view.hpp"
#include "scene/geometry.hpp"

namespace cotan {

namespace {

// One line that describes the problem; nothing if there is none.
using Problem = std::optional<std::string>;

// Concatenates texts and numbers.
template<class... Parts> std::string joined(const Parts&... parts)
{
    std::string text;
    const auto add = [&](const auto& part) {
        if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(part)>>)
            text += std::to_string(part);
        else
            text += part;
    };
    (add(parts), ...);
    return text;
}

template<class T> bool finite(const T& value)
{
    const std::span<const float> numbers(reinterpret_cast<const float*>(&value), sizeof value / sizeof(float));
    return std::ranges::all_of(numbers, [](float x) { return std::isfinite(x); });
}

bool below(int index, std::size_t size) { return index >= 0 && std::size_t(index) < size; }

class Checker {
public:
    Checker(const Scene& scene, const SceneRules& rules) : scene_(scene), rules_(rules) {}

    Problem run() const
    {
        for (Problem problem : {first(scene_.images, "image", &Checker::checkImage),
                                first(scene_.materials, "material", &Checker::checkMaterial),
                                first(scene_.meshes, "mesh", &Checker::checkMesh),
                                first(scene_.instances, "instance", &Checker::checkInstance),
                                first(scene_.lights, "light", &Checker::checkLight),
                                first(scene_.cameras, "camera", &Checker::checkCamera)})
            if (problem)
                return problem;
        return std::nullopt;
    }

private:
    // Returns "mesh 3: ..." for the first item of the list with a problem.
    template<class T>
    Problem first(const std::vector<T>& list, std::string_view what, Problem (Checker::*check)(const T&) const) const
    {
        for (std::size_t i = 0; i < list.size(); ++i)
            if (const Problem problem = (this->*check)(list[i]))
                return joined(what, " ", i, ": ", *problem);
        return std::nullopt;
    }

    // Returns `expected` as the problem if the numbers must be finite and are not.
    template<class... Values> Problem checkNumbers(std::string_view expected, const Values&... values) const
    {
        return rules_.finite && !(finite(values) && ...) ? Problem(expected) : std::nullopt;
    }

    Problem checkImage(const Image& image) const
    {
        if (!rules_.pixels && image.width == 0 && image.height == 0 && image.data.empty())
            return std::nullopt;
        const bool sized = image.width > 0 && image.height > 0;
        if (!sized || image.data.size() % image.bytesPerPixel() != 0
            || image.data.size() / image.bytesPerPixel() != std::uint64_t(image.width) * std::uint64_t(image.height))
            return joined("expected the bytes of ", image.width, " x ", image.height, " pixels, found ",
                          image.data.size());
        return std::nullopt;
    }

    Problem checkTexture(const Texture& texture, std::string_view name) const
    {
        const std::size_t images = scene_.images.size();
        if (texture.image != -1 && !below(texture.image, images))
            return joined(name, ": expected an image below ", images, ", found ", texture.image);
        if (texture.texcoord != 0 && texture.texcoord != 1)
            return joined(name, ": expected uv set 0 or 1, found ", texture.texcoord);
        return checkNumbers(joined(name, ": expected a finite transform of uv"), texture.uRow, texture.vRow);
    }

    Problem checkMaterial(const Material& m) const
    {
        for (const auto& [texture, name] : texturesOf(m))
            if (Problem problem = checkTexture(*texture, name))
                return problem;
        const glm::vec4 factors(m.metallic, m.roughness, m.occlusionStrength, m.normalScale);
        if (Problem problem = checkNumbers("expected finite factors", m.baseColor, m.emissive, factors, m.alphaCutoff))
            return problem;
        const glm::vec4 coat(m.coat.strength, m.coat.roughness, m.coat.normalScale, m.anisotropy.strength);
        const glm::vec4 layers(m.anisotropy.rotation, m.specular.ior, m.specular.strength, m.sheen.roughness);
        if (Problem problem = checkNumbers("expected finite factors of extensions", coat, layers, m.specular.color,
                                           m.sheen.color, m.transmission.strength, m.heightMap.depth))
            return problem;
        const int expansion = int(m.normalFormat.expansion), channels = int(m.normalFormat.channels);
        if (!below(expansion, COTAN_EXPAND_EXACT16 + 1) || !below(channels, COTAN_CHANNELS_SLOPE + 1))
            return joined("expected a normal encoding, found ", expansion, " ", channels);
        return std::nullopt;
    }

    template<class T>
    Problem checkArray(const std::vector<T>& values, std::size_t vertices, std::string_view name) const
    {
        if (!values.empty() && values.size() != vertices)
            return joined(name, ": expected ", vertices, " entries, one per vertex, found ", values.size());
        const auto bad = std::ranges::find_if(values, [](const T& value) { return !finite(value); });
        if (rules_.finite && bad != values.end())
            return joined(name, " ", bad - values.begin(), ": expected finite numbers");
        return std::nullopt;
    }

    static Problem checkIndices(const Mesh& mesh)
    {
        if (mesh.indices.size() % 3 != 0)
            return joined("expected three indices per triangle, found ", mesh.indices.size(), " in total");
        const std::size_t vertices = mesh.vertexCount();
        const auto bad = std::ranges::find_if(mesh.indices, [&](std::uint32_t i) { return i >= vertices; });
        if (bad != mesh.indices.end())
            return joined("triangle ", (bad - mesh.indices.begin()) / 3, ": expected an index below ", vertices,
                          ", found ", *bad);
        return std::nullopt;
    }

    Problem checkSkin(const Mesh& mesh) const
    {
        const std::size_t n = mesh.skin[0].empty() ? 0 : mesh.vertexCount();
        for (const auto* values :
             {&mesh.bindPositions, &mesh.bindNormals, &mesh.skin[0], &mesh.skin[1], &mesh.skin[2]}) {
            if (values->size() != n)
                return joined("skin: expected ", n, " entries, found ", values->size());
            if (const Problem problem = checkArray(*values, n, "skin"))
                return problem;
        }
        return std::nullopt;
    }

    Problem checkMesh(const Mesh& mesh) const
    {
        const std::size_t n = mesh.vertexCount();
        if (!below(mesh.material, scene_.materials.size()))
            return joined("expected a material below ", scene_.materials.size(), ", found ", mesh.material);
        if (mesh.normals.size() != n)
            return joined("normals: expected ", n, " entries, one per vertex, found ", mesh.normals.size());
        for (Problem problem : {checkArray(mesh.positions, n, "position"), checkArray(mesh.normals, n, "normal"),
                                checkArray(mesh.tangents, n, "tangent"), checkArray(mesh.texcoords[0], n, "uv set 0"),
                                checkArray(mesh.texcoords[1], n, "uv set 1"), checkArray(mesh.colors, n, "colour"),
                                checkArray(mesh.cotangentsU, n, "cotangent u"),
                                checkArray(mesh.cotangentsV, n, "cotangent v"), checkSkin(mesh), checkIndices(mesh)})
            if (problem)
                return problem;
        return std::nullopt;
    }

    Problem checkInstance(const Instance& instance) const
    {
        if (!below(instance.mesh, scene_.meshes.size()))
            return joined("expected a mesh below ", scene_.meshes.size(), ", found ", instance.mesh);
        return checkNumbers("expected a finite transform", instance.toWorld);
    }

    Problem checkLight(const Light& l) const
    {
        const glm::vec4 numbers(l.intensity, l.range, l.innerCone, l.outerCone);
        return checkNumbers("expected finite numbers", l.color, l.position, l.direction, numbers);
    }

    Problem checkCamera(const Camera& c) const
    {
        const glm::vec2 numbers(c.verticalFieldOfView, c.verticalExtent);
        return checkNumbers("expected finite numbers", c.eye, c.target, c.up, numbers);
    }

    const Scene& scene_;
    const SceneRules& rules_;
};

// ---- views -----------------------------------------------------------------------------------

constexpr float kHalfTurn = 3.14159274f; // radians

Problem problemOfView(const View& view)
{
    if (view.width < 1 || view.height < 1)
        return joined("view: expected a width and a height of at least 1; found ", view.width, "x", view.height);
    if (!isFrame(int(view.frame)))
        return joined("view.frame: expected 0 to ", kFrameCount - 1, "; found ", int(view.frame));
    if (view.samples != 1 && view.samples != 4 && view.samples != 16)
        return joined("view.samples: expected 1, 4 or 16; found ", view.samples);
    if (!std::isfinite(view.exposure))
        return joined("view.exposure: expected a finite number; found ", view.exposure);
    if (!(view.shadowSoftness >= 0) || !std::isfinite(view.shadowSoftness))
        return joined("view.shadowSoftness: expected a number of at least 0; found ", view.shadowSoftness);
    const Camera& c = view.camera;
    if (!isFinite(c.eye) || !isFinite(c.target) || !isFinite(c.up))
        return "view.camera: expected finite numbers";
    const glm::dvec3 along = glm::dvec3(c.target) - glm::dvec3(c.eye), up(c.up);
    if (along == glm::dvec3(0))
        return "view.camera: the eye and the target are the same point";
    if (glm::cross(along, up) == glm::dvec3(0))
        return "view.camera: expected an up direction across the line of sight; found one along it, or zero";
    const float lens = c.orthographic ? c.verticalExtent : c.verticalFieldOfView;
    if (!(lens > 0) || !std::isfinite(lens) || (!c.orthographic && lens >= kHalfTurn))
        return joined("view.camera: expected a ",
                      c.orthographic ? "verticalExtent above 0" : "verticalFieldOfView above 0 and below pi",
                      "; found ", lens);
    return std::nullopt;
}

} // namespace

Status checkScene(const Scene& scene, const std::string& name, const SceneRules& rules)
{
    if (const Problem problem = Checker(scene, rules).run())
        return about(name, inputError(*problem));
    return Done{};
}

Status checkView(const View& view)
{
    if (const Problem problem = problemOfView(view))
        return usageError(*problem);
    return Done{};
}

} // namespace cotan
