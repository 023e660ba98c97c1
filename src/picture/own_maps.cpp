#include "cotan/picture.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/try.hpp"
#include "cotan/convention.hpp"
#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "image/component_types.hpp"
#include "maps/texels.hpp"
#include "scene/normal_maps.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

Result<Image> readFor(const OwnMaps& maps, const std::string& file, Texture Material::*slot, int memory,
                      const Scene& scene)
{
    // Whether any mesh with a chosen material has the uv set that the image is sampled with.
    const bool hasUv = std::ranges::any_of(scene.meshes, [&](const Mesh& mesh) {
        const Texture& map = scene.materials[std::size_t(mesh.material)].*slot;
        return isMaterial(scene, std::size_t(mesh.material), maps.material) && !mesh.texcoords[uvSetOf(map)].empty();
    });
    if (!hasUv)
        return inputError(
            fmt::format("{}: expected a mesh with texture coordinates to show {} on; found none", scene.name, file));
    return readImage(file, limitsFor(memory));
}

Result<StatedConvention> conventionOf(const OwnMaps& maps)
{
    auto convention = parseStatedConvention(maps.convention.empty() ? "gltf" : maps.convention);
    if (!convention)
        return usageError("--convention: " + convention.error().message);
    if (convention->convention.kind != MapKind::tangentSpace)
        return usageError(fmt::format("--convention: expected a tangent-space map; found '{}'", maps.convention));
    return convention;
}

// Reads the model's own normal maps with another convention.
Status reinterpretNormalMaps(const OwnMaps& maps, Scene& scene)
{
    COTAN_TRY(convention, conventionOf(maps));
    bool any = false;
    restoreDeclaredGreen(scene, maps.material);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        Material& m = scene.materials[i];
        if (!m.normalMap.present() || !isMaterial(scene, i, maps.material))
            continue;
        m.normalFormat = inScene(convention->convention);
        any = true;
    }
    if (!any)
        return usageError("--convention: expected --normal-map FILE with it, or a model with normal maps; found none");
    return Done{};
}

Status applyNormalMap(const OwnMaps& maps, int memory, Scene& scene)
{
    COTAN_TRY(stated, conventionOf(maps));
    COTAN_TRY(image, readFor(maps, maps.normal, &Material::normalMap, memory, scene));
    COTAN_TRY(convention, maps::conventionOf(*stated, maps.normal, image->channels, "--convention"));
    if (!stated->channels) // x and y in three channels with constant blue: no such normals exist
        completeNormals(*image);
    if (convention->channels != Channels::xyz)
        maps::unswizzle(*image, maps::swizzleOf(*image));
    maps::undo(stated->damage, *image);
    if (const std::string found = maps::contradictionOf(*image, *convention); !found.empty())
        scene.warnings.push_back(
            fmt::format("{}: {}; it is read as {} (--convention)", maps.normal, found, describe(*convention)));
    putNormalMap(scene, std::move(*image), inScene(*convention), maps.material);
    return Done{};
}

} // namespace

Status applyOwnMaps(const OwnMaps& maps, int memory, Scene& scene)
{
    const bool any =
        !(maps.normal.empty() && maps.baseColor.empty() && maps.metallicRoughness.empty() && maps.occlusion.empty());
    const bool reinterprets = maps.normal.empty() && !maps.convention.empty();
    if (!any && !reinterprets && maps.material != -1)
        return usageError("--material: expected --normal-map FILE or another map with it; found none");
    if ((any || reinterprets) && maps.material >= int(scene.materials.size()))
        return usageError(
            fmt::format("--material: expected 0 to {}; found {}", scene.materials.size() - 1, maps.material));
    if (reinterprets)
        COTAN_CHECK(reinterpretNormalMaps(maps, scene));
    if (!maps.normal.empty())
        COTAN_CHECK(applyNormalMap(maps, memory, scene));
    struct OwnMap {
        const std::string& file;
        Texture Material::*slot;
        void (*change)(Material&);
    };
    const OwnMap others[] = {
        {maps.baseColor, &Material::baseColorMap, [](Material& m) { m.baseColor = glm::vec4(1); }},
        {maps.metallicRoughness, &Material::metallicRoughnessMap, [](Material& m) { m.metallic = m.roughness = 1; }},
        {maps.occlusion, &Material::occlusionMap, [](Material& m) { m.occlusionStrength = 1; }}};
    for (const auto& [file, slot, change] : others) {
        if (file.empty())
            continue;
        COTAN_TRY(image, readFor(maps, file, slot, memory, scene));
        assignImage(scene, std::move(*image), slot, maps.material, change);
    }
    return Done{};
}

} // namespace cotan
