#include "source_material.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace cotan {

namespace {

Texture use(const SourceMap& map, int image)
{
    Texture texture = map.use;
    texture.image = image;
    return texture;
}

Texture read(const SourceMap& map, TextureReader& textures, const std::string& material)
{
    return map.path.empty() ? Texture{} : use(map, textures.image(map.path, material));
}

// Blinn-Phong's exponent e is about as wide as GGX with alpha^2 = 2/(e + 2), alpha = roughness^2.
float roughnessFromShininess(float shininess)
{
    constexpr float kUnknown = 0.7f;
    return shininess > 0 ? std::pow(2.0f / (shininess + 2.0f), 0.25f) : kUnknown;
}

void setSurface(const SourceMaterial& source, TextureReader& textures, Material& material)
{
    const SourceMap &rough = source.roughnessMap, &metal = source.metalnessMap;
    const int roughImage = rough.path.empty() ? -1 : textures.image(rough.path, material.name);
    const int metalImage = metal.path.empty() ? -1 : textures.image(metal.path, material.name);
    const float roughness = roughImage >= 0 ? 1 : roughnessFromShininess(source.shininess);
    material.roughness = std::clamp(source.roughness.value_or(roughness), 0.0f, 1.0f);
    material.metallic = std::clamp(source.metallic.value_or(metalImage >= 0 ? 1.0f : 0.0f), 0.0f, 1.0f);
    // Without a map of its own the other factor must not be scaled by a white channel's neighbour.
    material.metallicRoughnessMap =
        use(roughImage >= 0 ? rough : metal, textures.metallicRoughness(roughImage, metalImage));
}

void setBaseColor(const SourceMaterial& source, TextureReader& textures, Scene& scene, Material& material)
{
    material.baseColorMap = read(source.colorMap, textures, material.name);
    glm::vec3 base = source.color;
    if (base == glm::vec3(0) && material.baseColorMap.present())
        base = glm::vec3(1); // exporters that leave the factor at black mean the map alone

    float opacity = source.opacity;
    if (opacity <= 0) {
        scene.warnings.push_back(fmt::format("material {}: its opacity is 0; taken as opaque", material.name));
        opacity = 1;
    }
    material.baseColor = glm::vec4(base, std::min(opacity, 1.0f));
    if (opacity < 1)
        material.alphaMode = AlphaMode::blend;

    if (source.opacityMap.path.empty())
        return;
    if (source.opacityMap.path == source.colorMap.path)
        material.alphaMode = AlphaMode::mask;
    else
        scene.warnings.push_back(
            fmt::format("material {}: the opacity map {} is left out; alpha is read from the colour map", material.name,
                        source.opacityMap.path));
}

// Names that say that green points down: "directx", or "dx" standing alone or after "normal".
bool namesDirectX(const std::string& path)
{
    std::string name = path.substr(path.find_last_of("/\\") + 1);
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto letter = [&](std::size_t i) {
        return i < name.size() && std::isalpha(static_cast<unsigned char>(name[i]));
    };
    if (name.find("directx") != std::string::npos)
        return true;
    for (std::size_t at = name.find("dx"); at != std::string::npos; at = name.find("dx", at + 1)) {
        const bool starts = at == 0 || !letter(at - 1) || std::string_view(name).substr(0, at).ends_with("normal");
        if (starts && !letter(at + 2))
            return true;
    }
    return false;
}

void setNormalMap(const SourceMaterial& source, TextureReader& textures, Scene& scene, Material& material)
{
    const SourceMap& map = source.normalMap;
    if (map.path.empty())
        return;
    bool converted = false;
    material.normalMap = use(map, textures.normalMap(map.path, material.name, map.strength, converted));
    if (!material.normalMap.present() || converted)
        return; // the strength is in the conversion
    material.normalScale = map.strength;
    if (namesDirectX(map.path)) {
        material.normalFormat.greenUp = false;
        scene.warnings.push_back(fmt::format(
            "material {}: normal map {} is taken as green down (DirectX), as its name says", material.name, map.path));
    }
}

} // namespace

Material makeMaterial(const SourceMaterial& source, TextureReader& textures, Scene& scene)
{
    Material material;
    material.name = source.name;
    material.doubleSided = true; // these formats do not say
    setBaseColor(source, textures, scene, material);
    setSurface(source, textures, material);
    setNormalMap(source, textures, scene, material);
    material.emissive = source.emission;
    material.emissiveMap = read(source.emissionMap, textures, material.name);
    if (material.emissiveMap.present() && material.emissive == glm::vec3(0))
        material.emissive = glm::vec3(1);
    material.occlusionMap = read(source.occlusionMap, textures, material.name);
    return material;
}

void warnAboutTexcoords(const Mesh& mesh, Scene& scene)
{
    const Material& material = scene.materials[std::size_t(mesh.material)];
    const Texture* const all[] = {&material.baseColorMap, &material.metallicRoughnessMap, &material.normalMap,
                                  &material.occlusionMap, &material.emissiveMap};
    for (const Texture* texture : all) {
        if (texture->present() && mesh.texcoords[std::size_t(texture->texcoord)].empty()) {
            scene.warnings.push_back(
                fmt::format("mesh {}: it has no texture coordinates {}, which material {} needs; textures and "
                            "normal map cannot show",
                            mesh.name, texture->texcoord, material.name));
            return;
        }
    }
}

} // namespace cotan
