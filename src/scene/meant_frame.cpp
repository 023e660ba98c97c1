#include "scene/meant_frame.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

constexpr float kOneCopy = 1.01f; // a little over: uv of a chart that fills the map are rounded

bool hasNormalMap(const Material& m) { return m.normalMap.present() || m.coat.normalMap.present(); }

// What the material says, or else its map.
std::optional<Frame> namedBy(const Scene& scene, const Material& m)
{
    if (m.normalFrame || !hasNormalMap(m))
        return hasNormalMap(m) ? m.normalFrame : std::nullopt;
    const std::size_t image = std::size_t((m.normalMap.present() ? m.normalMap : m.coat.normalMap).image);
    return image < scene.images.size() ? frameFromName(scene.images[image].frame) : std::nullopt;
}

// In the world, of each material.
std::vector<double> areasOf(const Scene& scene)
{
    std::vector<double> areas(scene.materials.size());
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const glm::dmat3 m{glm::mat3(instance.toWorld)};
        const auto at = [&](std::size_t i) { return m * glm::dvec3(mesh.positions[mesh.indices[i]]); };
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const glm::dvec3 p = at(i);
            areas[std::size_t(mesh.material)] += glm::length(glm::cross(at(i + 1) - p, at(i + 2) - p)) / 2;
        }
    }
    return areas;
}

} // namespace

std::optional<NamedFrame> namedFrame(const Scene& scene)
{
    if (std::ranges::none_of(scene.materials, [&](const Material& m) { return namedBy(scene, m).has_value(); }))
        return std::nullopt;
    const std::vector<double> areas = areasOf(scene);
    std::array<double, kFrameCount> area{};
    std::array<std::size_t, kFrameCount> materials{};
    std::size_t all = 0;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        all += hasNormalMap(m) ? 1 : 0;
        if (const auto frame = namedBy(scene, m)) {
            area[std::size_t(*frame)] += areas[i];
            ++materials[std::size_t(*frame)];
        }
    }
    std::size_t best = 0;
    for (std::size_t f = 0; f < area.size(); ++f)
        if (std::pair(area[f], materials[f]) > std::pair(area[best], materials[best]))
            best = f;
    return NamedFrame{Frame(int(best)), all - materials[best]};
}

bool repeatsNormalMaps(const Scene& scene)
{
    return std::ranges::any_of(scene.meshes, [&](const Mesh& mesh) {
        const Material& m = scene.materials[std::size_t(mesh.material)];
        if (!m.normalMap.present())
            return false;
        const std::vector<glm::vec2> uv = textureUv(m.normalMap, mesh);
        glm::vec2 low(1e30f), high(-1e30f);
        for (const glm::vec2& c : uv) {
            low = glm::min(low, c);
            high = glm::max(high, c);
        }
        return !uv.empty() && (high.x - low.x > kOneCopy || high.y - low.y > kOneCopy);
    });
}

Frame autoFrame(const Scene& scene, MapSource source)
{
    if (const auto named = namedFrame(scene))
        return named->frame;
    const bool shaped = source == MapSource::shape || std::ranges::none_of(scene.materials, hasNormalMap);
    return shaped || (source == MapSource::own && repeatsNormalMaps(scene)) ? Frame::cotangent : Frame::orthonormal;
}

std::string frameNote(const Scene& scene, Frame frame)
{
    const auto named = namedFrame(scene);
    if (!named)
        return "";
    const std::string maps = "the normal maps are for the frame " + std::string(name(named->frame));
    if (named->frame != frame)
        return maps + ", as the file says, and are read with " + std::string(name(frame));
    return named->others == 0 ? ""
                              : maps + " in the largest part of the model; those of " + std::to_string(named->others)
            + " other material(s) are not, and are read with it all the same";
}

} // namespace cotan
