#include "cotan/picture.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/try.hpp"
#include "cotan/convention.hpp"
#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "image/component_types.hpp"
#include "maps/texels.hpp"
#include "scene/geometry.hpp"
#include "scene/normal_maps.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

Result<Image> readFor(const OwnMaps& maps, const std::string& file, Texture Material::*slot, const LoadLimits& limits,
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
    return readImage(file, limits);
}

Result<StatedConvention> conventionOf(const OwnMaps& maps)
{
    auto convention = parseStatedConvention(maps.convention.empty() ? "gltf,exact" : maps.convention);
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

Status applyNormalMap(const OwnMaps& maps, const LoadLimits& limits, Scene& scene)
{
    COTAN_TRY(stated, conventionOf(maps));
    COTAN_TRY(image, readFor(maps, maps.normal, &Material::normalMap, limits, scene));
    if (!stated->channels) // x and y in three channels with constant blue: no such normals exist
        completeNormals(*image);
    COTAN_TRY(convention, maps::makeReadable(*image, *stated, maps.normal, "--convention"));
    if (const std::string found = maps::contradictionOf(*image, *convention); !found.empty())
        scene.warnings.push_back(
            fmt::format("{}: {}; it is read as {} (--convention)", maps.normal, found, describe(*convention)));
    putNormalMap(scene, std::move(*image), inScene(*convention), maps.material);
    return Done{};
}

// ---- heights ---------------------------------------------------------------------------------

constexpr double kDepthOfDiagonal = 0.02;

// The red of a texel; NaN if it is no height. Integers are fractions of 1.
double heightOf(const Image& image, std::size_t texel)
{
    if (image.type == PixelType::unorm8)
        return image.bytes8()[4 * texel] / 255.0;
    if (image.type == PixelType::unorm16)
        return image.words()[4 * texel] / 65535.0;
    const double h = double(image.floats()[4 * texel]);
    return std::abs(h) <= 1e30 ? h : std::nan("");
}

struct HeightRange {
    double low = 1e30, high = -1e30; // low > high: no height
};

HeightRange heightRange(const Image& image)
{
    HeightRange range;
    for (std::size_t i = 0; i < image.pixelCount(); ++i)
        if (const double h = heightOf(image, i); std::isfinite(h)) {
            range.low = std::min(range.low, h);
            range.high = std::max(range.high, h);
        }
    return range;
}

// Heights as 16-bit numbers: filters of 8-bit textures may round to 8 bits, which draws terraces. Texels that are no
// heights are the surface.
Image storedHeights(const Image& image, const HeightRange& range)
{
    Image stored = makeImage(image.width, image.height, PixelType::unorm16, image.name);
    const bool floats = image.type == PixelType::float32;
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        const double h = heightOf(image, i), part = floats ? (h - range.low) / (range.high - range.low) : h;
        std::fill_n(stored.words() + 4 * i, 4, std::uint16_t(std::isfinite(part) ? std::lround(part * 65535) : 65535));
    }
    return stored;
}

Status applyHeightMap(const OwnMaps& maps, const LoadLimits& limits, Scene& scene)
{
    COTAN_TRY(image, readFor(maps, maps.height, &Material::normalMap, limits, scene));
    const HeightRange range = heightRange(*image);
    const Bounds box = bounds(scene);
    const double depth = maps.heightDepth   ? double(*maps.heightDepth)
        : image->type == PixelType::float32 ? range.high - range.low
        : box.empty()                       ? 0.0
                      : kDepthOfDiagonal * glm::distance(glm::dvec3(box.low), glm::dvec3(box.high));
    if (!(range.high > range.low) || !(depth > 0) || !std::isfinite(float(depth)))
        return Done{};
    const int number = int(scene.images.size());
    scene.images.push_back(storedHeights(*image, range));
    bool shaded = false;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        Material& m = scene.materials[i];
        if (!isMaterial(scene, i, maps.material))
            continue;
        m.heightMap = {m.normalMap, float(depth)};
        m.heightMap.map.image = number;
        m.heightMap.map.sampler = {};
        shaded = shaded || m.normalMap.present();
    }
    if (!shaded)
        scene.warnings.push_back(
            maps.height + ": its slopes are drawn flat, without a normal map; cotan map from-height makes one");
    return Done{};
}

Status applyMask(const OwnMaps& maps, const LoadLimits& limits, Scene& scene)
{
    if (maps.mask.empty())
        return usageError("--view mask: expected --mask FILE with it; found none");
    COTAN_TRY(image, readFor(maps, maps.mask, &Material::normalMap, limits, scene));
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        Material& m = scene.materials[i];
        m.baseColorMap = m.normalMap;
        m.baseColorMap.image = isMaterial(scene, i, maps.material) ? int(scene.images.size()) : -1;
    }
    scene.images.push_back(std::move(*image));
    return Done{};
}

} // namespace

Status applyOwnMaps(const OwnMaps& maps, const LoadLimits& limits, Scene& scene, const std::string& show)
{
    const bool any = std::ranges::any_of(maps.files(), [](const std::string& file) { return !file.empty(); });
    const bool reinterprets = maps.normal.empty() && !maps.convention.empty();
    if (!any && !reinterprets && maps.material != -1)
        return usageError("--material: expected --normal-map FILE or another map with it; found none");
    if (maps.heightDepth && maps.height.empty())
        return usageError("--height-depth: expected --height-map FILE with it; found none");
    if ((any || reinterprets) && maps.material >= int(scene.materials.size()))
        return usageError(
            fmt::format("--material: expected 0 to {}; found {}", scene.materials.size() - 1, maps.material));
    if (reinterprets)
        COTAN_CHECK(reinterpretNormalMaps(maps, scene));
    if (!maps.normal.empty())
        COTAN_CHECK(applyNormalMap(maps, limits, scene));
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
        COTAN_TRY(image, readFor(maps, file, slot, limits, scene));
        assignImage(scene, std::move(*image), slot, maps.material, change);
    }
    if (!maps.height.empty())
        COTAN_CHECK(applyHeightMap(maps, limits, scene));
    return show == "mask" ? applyMask(maps, limits, scene) : Status(Done{});
}

} // namespace cotan
