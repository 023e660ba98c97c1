#include "scene/normal_maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include <glm/geometric.hpp>

#include "scene/geometry.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

const Texture& mapOf(const Material& m) { return m.normalMap.present() ? m.normalMap : m.coat.normalMap; }

// ---- green -----------------------------------------------------------------------------------

// Adds a triangle's area. Degenerate triangles, and corners without a tangent or a normal, add nothing.
void addTriangle(const Mesh& mesh, const std::vector<glm::vec2>& uv, std::size_t first, StoredGreen& area)
{
    const std::uint32_t* const at = &mesh.indices[first];
    const glm::dvec3 p0(mesh.positions[at[0]]);
    const glm::dvec3 p1 = glm::dvec3(mesh.positions[at[1]]) - p0, p2 = glm::dvec3(mesh.positions[at[2]]) - p0;
    const glm::dvec2 uv0(uv[at[0]]);
    const glm::dvec2 uv1 = glm::dvec2(uv[at[1]]) - uv0, uv2 = glm::dvec2(uv[at[2]]) - uv0;
    const double uvArea = uv1.x * uv2.y - uv1.y * uv2.x, third = glm::length(glm::cross(p1, p2)) / 6;
    if (!(std::abs(uvArea) > 0) || !(third > 0) || !std::isfinite(third))
        return;
    const double sign = uvArea < 0 ? -1 : 1;
    const glm::dvec3 alongU = sign * (p1 * uv2.y - p2 * uv1.y), alongV = sign * (p2 * uv1.x - p1 * uv2.x);
    for (int k = 0; k < 3; ++k) {
        const glm::dvec4 stored(mesh.tangents[at[k]]);
        const glm::dvec3 tangent(stored), up = glm::cross(glm::dvec3(mesh.normals[at[k]]), tangent) * stored.w;
        if (tangent == glm::dvec3(0) || up == glm::dvec3(0))
            continue;
        area.compared += third;
        if (glm::dot(tangent, alongU) > 0 && glm::dot(up, alongV) > 0) // `up` should point against increasing v
            area.contradicting += third;
    }
}

std::string nameOf(const Scene& scene, const Material& m)
{
    const std::size_t image = std::size_t(mapOf(m).image);
    const std::string& name = image < scene.images.size() ? scene.images[image].name : m.name;
    return name.empty() ? "of material '" + m.name + "'" : "'" + name + "'";
}

// Changes the signs of green, of w and of what is measured from t towards b.
void reverse(Scene& scene, const std::vector<bool>& materials)
{
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (materials[i]) {
            Material& m = scene.materials[i];
            m.greenReversed = !m.greenReversed;
            m.normalFormat.greenUp = !m.normalFormat.greenUp;
            m.coat.normalFormat.greenUp = !m.coat.normalFormat.greenUp;
            m.anisotropy.rotation = -m.anisotropy.rotation;
        }
    for (Mesh& mesh : scene.meshes)
        if (materials[std::size_t(mesh.material)])
            for (glm::vec4& tangent : mesh.tangents)
                tangent.w = -tangent.w;
}

// The materials of the chosen meshes, with a copy of each that other meshes read too.
std::vector<bool> ownMaterials(Scene& scene, const std::vector<bool>& chosen)
{
    const std::size_t count = scene.materials.size();
    std::vector<bool> shared(count);
    for (std::size_t i = 0; i < chosen.size(); ++i)
        if (!chosen[i])
            shared[std::size_t(scene.meshes[i].material)] = true;
    std::vector<int> own(count, -1);
    std::vector<bool> materials(count);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (!chosen[i])
            continue;
        const std::size_t m = std::size_t(scene.meshes[i].material);
        if (own[m] < 0 && shared[m]) {
            own[m] = int(scene.materials.size());
            scene.materials.push_back(scene.materials[m]);
            scene.materials.back().copyOf = int(m);
            materials.push_back(false);
        }
        scene.meshes[i].material = own[m] < 0 ? int(m) : own[m];
        materials[std::size_t(scene.meshes[i].material)] = true;
    }
    return materials;
}

// ---- the frame -------------------------------------------------------------------------------

constexpr float kOneCopy = 1.01f; // slightly above 1: uv of a chart that fills the map are rounded

bool hasNormalMap(const Material& m) { return mapOf(m).present(); }

// World-space area of each material.
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

// Whether the texture coordinates of any mesh with a normal map extend over more than one copy of the map.
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

} // namespace

std::optional<Frame> namedFrameOf(const Scene& scene, const Material& m)
{
    if (m.normalFrame || !hasNormalMap(m))
        return hasNormalMap(m) ? m.normalFrame : std::nullopt;
    const std::size_t image = std::size_t(mapOf(m).image);
    return image < scene.images.size() ? frameFromName(scene.images[image].frame) : std::nullopt;
}

std::optional<Frame> namedFrameOf(const Scene& scene, const Mesh& mesh)
{
    const Material& m = scene.materials[std::size_t(mesh.material)];
    return mesh.named && hasNormalMap(m) ? mesh.named : namedFrameOf(scene, m);
}

StoredGreen storedGreen(const Mesh& mesh, const std::vector<glm::vec2>& uv)
{
    StoredGreen area;
    area.present = !mesh.tangents.empty() && !mesh.normals.empty();
    if (!area.present || uv.empty())
        return area;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        addTriangle(mesh, uv, i, area);
    return area;
}

bool readsReversed(const StoredGreen& mesh, const StoredGreen& map)
{
    const bool unclear =
        !(mesh.compared > 0) || (mesh.fraction() > kGreenMentionedFrom && mesh.fraction() < kGreenReversedFrom);
    return mesh.present && (unclear ? map.fraction() : mesh.fraction()) >= kGreenReversedFrom;
}

std::vector<std::string> reconcileGreenWithTangents(Scene& scene)
{
    const auto materialOf = [&](std::size_t mesh) { return std::size_t(scene.meshes[mesh].material); };
    std::vector<StoredGreen> own(scene.meshes.size());
    std::map<int, StoredGreen> maps; // by image
    for (std::size_t i = 0; i < own.size(); ++i) {
        const Material& m = scene.materials[materialOf(i)];
        if (mapOf(m).present()) // the tangents are for the uv of the surface's own map
            own[i] = storedGreen(scene.meshes[i], textureUv(m.normalMap, scene.meshes[i]));
        maps[mapOf(m).image].add(own[i]);
    }
    std::vector<bool> chosen(own.size());
    struct Meshes {
        std::size_t reversed = 0, declared = 0, material = 0;
    };
    std::map<int, Meshes> found; // by image
    for (std::size_t i = 0; i < own.size(); ++i) {
        const Material& m = scene.materials[materialOf(i)];
        const StoredGreen& ofMap = maps[mapOf(m).image];
        const std::optional<Frame> named = namedFrameOf(scene, m); // tangents mean nothing to maps for other frames
        chosen[i] = readsReversed(own[i], ofMap) && !m.anisotropy.map.present() && (!named || readsTangents(*named));
        if (!mapOf(m).present())
            continue;
        Meshes& meshes = found.try_emplace(mapOf(m).image, Meshes{.material = materialOf(i)}).first->second;
        ++(chosen[i] ? meshes.reversed : meshes.declared);
    }
    std::vector<std::string> lines;
    for (const auto& [image, meshes] : found)
        if (meshes.reversed > 0 || maps[image].fraction() >= kGreenMentionedFrom)
            lines.push_back("TANGENT.w contradicts the texture coordinates on "
                            + std::to_string(std::lround(100 * maps[image].fraction()))
                            + " % of the area of normal map " + nameOf(scene, scene.materials[meshes.material])
                            + (meshes.reversed == 0 ? ": its green is read as declared"
                                                    : ": without stored tangents its green is flipped"
                                       + (meshes.declared == 0 ? std::string()
                                                               : " in " + std::to_string(meshes.reversed) + " of "
                                                  + std::to_string(meshes.reversed + meshes.declared) + " meshes")
                                       + " (--convention gltf: as declared)"));
    reverse(scene, ownMaterials(scene, chosen));
    return lines;
}

void restoreDeclaredGreen(Scene& scene, int material)
{
    std::vector<bool> chosen(scene.materials.size());
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        chosen[i] = scene.materials[i].greenReversed && isMaterial(scene, i, material);
    reverse(scene, chosen);
    for (Mesh& mesh : scene.meshes)
        if (const int original = scene.materials[std::size_t(mesh.material)].copyOf; original >= 0)
            if (chosen[std::size_t(mesh.material)])
                mesh.material = original;
    if (material < 0) // copies are at the end, and nothing refers to them now
        std::erase_if(scene.materials, [](const Material& m) { return m.copyOf >= 0; });
}

std::optional<NamedFrame> namedFrame(const Scene& scene)
{
    if (std::ranges::none_of(scene.materials, [&](const Material& m) { return namedFrameOf(scene, m).has_value(); }))
        return std::nullopt;
    const std::vector<double> areas = areasOf(scene);
    std::array<double, kFrameCount> area{};
    std::array<std::size_t, kFrameCount> materials{};
    std::size_t all = 0;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        all += hasNormalMap(m) ? 1 : 0;
        if (const auto frame = namedFrameOf(scene, m)) {
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

Frame autoFrame(const Scene& scene, MapSource source)
{
    if (const auto named = namedFrame(scene))
        return named->frame;
    const bool shaped = source == MapSource::shape || std::ranges::none_of(scene.materials, hasNormalMap);
    return shaped || (source == MapSource::own && repeatsNormalMaps(scene)) ? Frame::cotangent : Frame::orthonormal;
}

Frame meantFrame(const Scene& scene, MapSource source)
{
    const Frame frame = autoFrame(scene, source);
    if (frame == Frame::orthonormal && !namedFrame(scene))
        return Frame::mikktspace;
    return frame == Frame::cotangent || frame == Frame::triangle ? Frame::exact : frame;
}

std::string frameNote(const Scene& scene, std::optional<Frame> frame)
{
    const auto named = namedFrame(scene);
    if (!frame || !named)
        return "";
    const std::string maps = "the normal maps are for the frame " + std::string(name(named->frame));
    if (named->frame != *frame)
        return maps + ", as the file says, and are read with " + std::string(name(*frame));
    return named->others == 0 ? ""
                              : maps + ", the named frame with the largest area; " + std::to_string(named->others)
            + " other material(s) name another frame or none, and are read with it as well";
}

} // namespace cotan
