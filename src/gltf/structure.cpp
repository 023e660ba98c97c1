// Materials and collections of a glTF file as plain values.
#include "gltf_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "schema.hpp"

namespace cotan::gltf {

namespace {

float numberOf(const Json& object, std::string_view name, double otherwise)
{
    return float(valueOr(object, name, otherwise));
}

float unitRange(double x) { return float(std::clamp(x, 0.0, 1.0)); }

// Not negative, and no brighter than what lamps and products with it can bear.
glm::vec3 colorOf(const Json& object, std::string_view name, const glm::vec3& otherwise, double most)
{
    glm::dvec3 color = vectorOr(object, name, glm::dvec3(otherwise));
    for (int i = 0; i < 3; ++i)
        color[i] = std::clamp(color[i], 0.0, most);
    return glm::vec3(color);
}

// 0 stands for infinity; between 0 and 1 there is nothing that the extension allows.
float readIor(const Json& ior)
{
    const float index = numberOf(ior, "ior", 1.5);
    return index == 0 ? 0.0f : std::max(index, 1.0f);
}

// An object; where it is missing, one without members.
const Json& orNone(const Json* object)
{
    static const Json none = Json::object();
    return object ? *object : none;
}

// The scale of a normal map.
float scaleOf(const Json& owner, const char* slot) { return numberOf(orNone(member(owner, slot)), "scale", 1); }

// What extensions say of light on the surface. One that is missing has the defaults of one without members.
void readLayers(const Json& source, const TextureOf& texture, Material& m)
{
    const Json& coat = orNone(extension(source, "KHR_materials_clearcoat"));
    m.coat.strength = unitRange(valueOr(coat, "clearcoatFactor", 0.0));
    m.coat.roughness = unitRange(valueOr(coat, "clearcoatRoughnessFactor", 0.0));
    m.coat.normalScale = scaleOf(coat, "clearcoatNormalTexture");
    if (m.coat.strength > 0) {
        m.coat.map = texture(coat, "clearcoatTexture");
        m.coat.roughnessMap = texture(coat, "clearcoatRoughnessTexture");
        m.coat.normalMap = texture(coat, "clearcoatNormalTexture");
    }

    const Json& anisotropy = orNone(extension(source, "KHR_materials_anisotropy"));
    m.anisotropy.strength = unitRange(valueOr(anisotropy, "anisotropyStrength", 0.0));
    m.anisotropy.rotation = numberOf(anisotropy, "anisotropyRotation", 0);
    if (m.anisotropy.strength > 0)
        m.anisotropy.map = texture(anisotropy, "anisotropyTexture");

    const Json& specular = orNone(extension(source, "KHR_materials_specular"));
    m.specular.ior = readIor(orNone(extension(source, "KHR_materials_ior")));
    m.specular.strength = unitRange(valueOr(specular, "specularFactor", 1.0));
    m.specular.color = // may be over 1
        colorOf(specular, "specularColorFactor", m.specular.color, gltf_schema::kBrightest);
    if (m.specular.strength > 0) {
        m.specular.map = texture(specular, "specularTexture");
        m.specular.colorMap = texture(specular, "specularColorTexture");
    }

    const Json& sheen = orNone(extension(source, "KHR_materials_sheen"));
    m.sheen.color = colorOf(sheen, "sheenColorFactor", glm::vec3(0), 1);
    m.sheen.roughness = unitRange(valueOr(sheen, "sheenRoughnessFactor", 0.0));
    if (m.sheen.present()) {
        m.sheen.colorMap = texture(sheen, "sheenColorTexture");
        m.sheen.roughnessMap = texture(sheen, "sheenRoughnessTexture");
    }

    const Json& transmission = orNone(extension(source, "KHR_materials_transmission"));
    m.transmission.strength = unitRange(valueOr(transmission, "transmissionFactor", 0.0));
    if (m.transmission.strength > 0)
        m.transmission.map = texture(transmission, "transmissionTexture");
}

// What a camera or light says under the name of its kind.
const Json& described(const Json& object, const std::string& kind, const std::string& field)
{
    const Json* const description = member(object, kind);
    if (!description)
        failGltf("{}.{}: missing; its type is \"{}\"", field, kind, kind);
    return *description;
}

Camera readCamera(const Json& source, const std::string& field)
{
    const auto& kind = source["type"].get_ref<const std::string&>();
    const Json& description = described(source, kind, field);
    Camera camera;
    camera.name = valueOr(source, "name", std::string());
    camera.orthographic = kind == "orthographic";
    // Sizes that show nothing, or more than half a sphere, are brought to the nearest usable one.
    if (camera.orthographic)
        camera.verticalExtent = float(std::max(2 * std::abs(description["ymag"].get<double>()), 1e-6));
    else
        camera.verticalFieldOfView = float(std::clamp(description["yfov"].get<double>(), 0.001, 3.1));
    return camera;
}

Light readLight(const Json& source, const std::string& field)
{
    const auto& kind = source["type"].get_ref<const std::string&>();
    Light light;
    light.kind = kind == "directional" ? LightKind::directional : kind == "point" ? LightKind::point : LightKind::spot;
    light.color = vectorOr(source, "color", light.color);
    light.intensity = numberOf(source, "intensity", 1);
    light.range = numberOf(source, "range", 0);
    double inner = 0, outer = std::numbers::pi / 4;
    if (light.kind == LightKind::spot) {
        const Json& spot = described(source, kind, field);
        inner = valueOr(spot, "innerConeAngle", inner);
        outer = valueOr(spot, "outerConeAngle", outer);
    }
    outer = std::clamp(outer, 0.0, std::numbers::pi / 2);
    light.outerCone = float(outer);
    light.innerCone = float(std::clamp(inner, 0.0, outer));
    return light;
}

} // namespace

Material readMaterial(const Json& source, const TextureOf& texture)
{
    const Json& pbr = orNone(member(source, "pbrMetallicRoughness"));
    Material m;
    m.name = valueOr(source, "name", std::string());
    m.tangentsFor = tangentReader(source);
    const glm::dvec4 baseColor = vectorOr(pbr, "baseColorFactor", glm::dvec4(m.baseColor));
    for (int i = 0; i < 4; ++i)
        m.baseColor[i] = unitRange(baseColor[i]);
    m.metallic = unitRange(valueOr(pbr, "metallicFactor", 1.0));
    m.roughness = unitRange(valueOr(pbr, "roughnessFactor", 1.0));
    const float strength =
        numberOf(orNone(extension(source, "KHR_materials_emissive_strength")), "emissiveStrength", 1);
    m.emissive = colorOf(source, "emissiveFactor", m.emissive, 1) * strength;
    m.occlusionStrength = unitRange(readTextureUse(member(source, "occlusionTexture")).strength);
    m.normalScale = scaleOf(source, "normalTexture");
    m.normalFormat.expansion = expansionOf(source);
    const std::string alpha = valueOr(source, "alphaMode", std::string("OPAQUE"));
    m.alphaMode = alpha == "MASK" ? AlphaMode::mask : alpha == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
    m.alphaCutoff = numberOf(source, "alphaCutoff", 0.5);
    m.doubleSided = valueOr(source, "doubleSided", false);
    m.unlit = extension(source, "KHR_materials_unlit") != nullptr;
    m.baseColorMap = texture(pbr, "baseColorTexture");
    m.metallicRoughnessMap = texture(pbr, "metallicRoughnessTexture");
    m.normalMap = texture(source, "normalTexture");
    m.occlusionMap = texture(source, "occlusionTexture");
    m.emissiveMap = texture(source, "emissiveTexture");
    if (!m.unlit)
        readLayers(source, texture, m);
    return m;
}

Structure readStructure(const Json& root)
{
    Structure s;
    std::size_t at = 0; // for messages
    s.scenes = readAll(&root, "scenes", [](const Json& scene) { return valueOr(scene, "nodes", std::vector<int>()); });
    s.defaultScene = valueOr(root, "scene", -1);
    s.nodes = readAll(&root, "nodes", readNode);
    s.meshes = readAll(&root, "meshes", readMesh);
    s.skins = readAll(&root, "skins", readSkin);
    s.cameras =
        readAll(&root, "cameras", [&](const Json& c) { return readCamera(c, fmt::format("cameras[{}]", at++)); });
    at = 0;
    s.lights = readAll(extension(root, "KHR_lights_punctual"), "lights", [&](const Json& l) {
        return readLight(l, fmt::format("extensions.KHR_lights_punctual.lights[{}]", at++));
    });
    s.normalMaps =
        readAll(&root, "materials", [](const Json& m) { return readTextureUse(member(m, "normalTexture")); });
    s.images = readAll(&root, "images", readImage);
    s.textures = readAll(&root, "textures", [&](const Json& t) { return readTexture(t, s.images.size()); });
    s.samplers = readAll(&root, "samplers", readSampler);
    return s;
}

} // namespace cotan::gltf
