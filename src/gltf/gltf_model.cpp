// Reads materials and collections as plain values, and checks the accessors: every offset, stride and count is checked
// once, and reads then rely on it.
#include "gltf_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/ranges.h>
#include <glm/common.hpp>

#include "core/one_line.hpp"
#include "core/parse_number.hpp"
#include "gltf/json/lookup.hpp"
#include "schema.hpp"

namespace cotan::gltf {

namespace {

float numberOf(const Json& object, std::string_view name, double otherwise)
{
    return float(valueOr(object, name, otherwise));
}

float unitRange(double x) { return float(std::clamp(x, 0.0, 1.0)); }

// A colour clamped to [0,maximum], so that products with it stay finite in float.
glm::vec3 colorOf(const Json& object, std::string_view name, const glm::vec3& otherwise, double maximum)
{
    return glm::vec3(glm::clamp(vectorOr(object, name, glm::dvec3(otherwise)), 0.0, maximum));
}

// 0 stands for infinity; the extension allows no values between 0 and 1.
float readIor(const Json& ior)
{
    const float index = numberOf(ior, "ior", 1.5);
    return index == 0 ? 0.0f : std::max(index, 1.0f);
}

// The object, or an empty one if it is missing.
const Json& orNone(const Json* object)
{
    static const Json none = Json::object();
    return object ? *object : none;
}

// The scale of a normal map.
float scaleOf(const Json& owner, const char* slot) { return float(readTextureUse(member(owner, slot)).scale); }

// Reads the layers that extensions add. A missing extension has the defaults of an empty one.
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

// The object of a camera or light that is named like its type.
const Json& described(const Json& object, const std::string& kind, const std::string& field)
{
    const Json* const description = member(object, kind);
    if (!description)
        failGltf("{}.{}: missing, although the type is \"{}\"", field, kind, kind);
    return *description;
}

Camera readCamera(const Json& source, const std::string& field)
{
    const auto& kind = source["type"].get_ref<const std::string&>();
    const Json& description = described(source, kind, field);
    Camera camera;
    camera.name = valueOr(source, "name", std::string());
    camera.orthographic = kind == "orthographic";
    // Sizes that show nothing, or more than half a sphere, are clamped to the nearest usable size.
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
    m.baseColor = glm::vec4(glm::clamp(vectorOr(pbr, "baseColorFactor", glm::dvec4(m.baseColor)), 0.0, 1.0));
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
    std::size_t at = 0; // the field's index in its collection, for messages
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

namespace cotan {

using gltf::Accessor, gltf::Elements, gltf::Json;

namespace {

// ---- materials of a variant -----------------------------------------------------------------

constexpr const char* kVariants = "KHR_materials_variants";

// By name (the first that matches) or number. Extensions have not been checked.
std::size_t findVariant(const Json& root, const std::string& wanted)
{
    std::vector<std::string> names;
    const Json* const variants = gltf::member(gltf::extension(root, kVariants), "variants");
    if (variants && variants->is_array())
        for (const Json& variant : *variants) {
            const Json* const name = gltf::member(variant, "name");
            names.push_back(name && name->is_string() ? name->get<std::string>() : std::string());
        }
    return findNamed(names, wanted, "variants");
}

// The material of a mapping of a primitive. count: of materials.
int materialOf(const Json& mapping, std::size_t count, std::size_t mesh, std::size_t primitive)
{
    const Json material = mapping.is_object() ? mapping.value("material", Json()) : Json();
    if (!material.is_number_unsigned() || material.get<std::uint64_t>() >= count)
        failGltf("{}.extensions.{}: expected an index below {}, the number of materials, found {}",
                 primitiveField(mesh, primitive), kVariants, count, oneLine(material.dump()));
    return material.get<int>();
}

// What decides how the normal maps of a material are read; empty if it has none.
std::string normalsOf(const Json& material)
{
    const Json* const map = gltf::member(material, "normalTexture");
    const Json* const coat = gltf::extension(material, "KHR_materials_clearcoat");
    if (!map && !gltf::member(coat, "clearcoatNormalTexture"))
        return {};
    const Json* const anisotropy = gltf::extension(material, "KHR_materials_anisotropy");
    std::string text = gltf::frameText(material) + '\n' + std::to_string(int(gltf::expansionOf(material)));
    for (const Json* part : {map, coat, anisotropy})
        text += '\n' + (part ? part->dump(-1, ' ', false, Json::error_handler_t::replace) : std::string());
    return text;
}

// Sets the material of limits.variant on each primitive that has one (KHR_materials_variants); the others keep theirs.
// Throws GltfProblem: ErrorKind::usage if there is no such variant; ErrorKind::input for damaged mappings.
void chooseGltfVariant(GltfModel& model)
{
    Json& root = model.file.json;
    if (model.limits.variant.empty())
        return;
    const std::size_t variant = findVariant(root, model.limits.variant), materials = countOf(root, "materials");
    const auto meshes = root.find("meshes");
    for (std::size_t m = 0; meshes != root.end() && m < meshes->size(); ++m) {
        Json& primitives = (*meshes)[m]["primitives"];
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const Json* const mappings = gltf::member(gltf::extension(primitives[p], kVariants), "mappings");
            if (!mappings || !mappings->is_array())
                continue;
            const auto found = std::ranges::find_if(*mappings, [&](const Json& mapping) {
                const Json* const variants = gltf::member(mapping, "variants");
                return variants && variants->is_array()
                    && std::find(variants->begin(), variants->end(), variant) != variants->end();
            });
            if (found == mappings->end())
                continue;
            primitives[p]["material"] = materialOf(*found, materials, m, p);
        }
    }
}

} // namespace

void addVariantMaterials(GltfModel& model)
{
    const Json& root = model.file.json;
    const std::size_t materials = countOf(root, "materials");
    std::vector<std::string> normals;
    for (std::size_t i = 0; i < materials; ++i)
        normals.push_back(normalsOf(root["materials"][i]));
    for (std::size_t m = 0; m < model.structure.meshes.size(); ++m)
        for (std::size_t p = 0; p < model.structure.meshes[m].primitives.size(); ++p) {
            gltf::Primitive& primitive = model.structure.meshes[m].primitives[p];
            const Json* const mappings =
                gltf::member(gltf::extension(root["meshes"][m]["primitives"][p], kVariants), "mappings");
            if (!mappings || !mappings->is_array())
                continue;
            std::set<std::string_view> seen{""};
            if (primitive.material >= 0)
                seen.insert(normals[std::size_t(primitive.material)]);
            for (const Json& mapping : *mappings)
                if (const int material = materialOf(mapping, materials, m, p);
                    seen.insert(normals[std::size_t(material)]).second)
                    primitive.others.push_back(material);
        }
}

namespace {

// ---- accessors ------------------------------------------------------------------------------

// Accessors used only as texture coordinates: NaN in them is replaced instead of refused.
std::set<int> texcoordAccessors(const gltf::Structure& structure)
{
    std::set<int> texcoords, others;
    for (const gltf::Mesh& mesh : structure.meshes)
        for (const gltf::Primitive& primitive : mesh.primitives)
            for (const auto& [name, accessor] : primitive.attributes)
                (name.starts_with("TEXCOORD_") ? texcoords : others).insert(accessor);
    for (const int accessor : others)
        texcoords.erase(accessor);
    return texcoords;
}

// Fills GltfModel::accessors. Checks all accessors, sparse values included, against the views and the allowance. Throws
// GltfProblem for NaN and infinity in float accessors other than texture coordinates. All readers of accessors rely on
// these checks.
void findAccessors(GltfModel& model)
{
    const std::set<int> texcoords = texcoordAccessors(model.structure);
    // Accessors without a view are zeros that cost the file nothing, and many accessors may share one view, so their
    // total size bounds memory and time. Counts are below 2^53 and elements at most 64 bytes, so a single product
    // cannot overflow.
    const std::uint64_t limit = gltfAllowance(model);
    std::uint64_t total = 0;
    std::size_t i = 0;
    model.accessors = gltf::readAll(&model.file.json, "accessors", [&](const Json& json) {
        const std::string field = fmt::format("accessors[{}]", i);
        const Accessor a = gltf::readAccessor(json);
        Elements elements = gltf::findElements(
            a, [&](std::size_t view) { return model.views[view]; }, field);
        takeBytes(total, std::uint64_t(a.count) * gltf::elementSize(a), limit, "the accessors take", model.file.size,
                  field);
        gltf::checkSparse(elements, field);
        if (!texcoords.contains(int(i++)))
            gltf::checkFinite(elements, field);
        return elements;
    });
}

} // namespace

std::size_t findNamed(const std::vector<std::string>& names, const std::string& wanted, const char* what)
{
    if (const auto found = std::find(names.begin(), names.end(), wanted); found != names.end())
        return std::size_t(found - names.begin());
    std::size_t number = 0;
    if (parseNumber(std::string_view(wanted), number) && number < names.size())
        return number;
    throw GltfProblem{usageError(
        names.empty() ? fmt::format("expected a model with {} for \"{}\", found none", what, wanted)
                      : fmt::format("expected one of its {} {} by number or name ({}), found \"{}\"", names.size(),
                                    what, oneLine(fmt::format("{}", fmt::join(names, ", "))), wanted))};
}

void readGltfModel(GltfModel& model, const std::filesystem::path& path, const LoadLimits& limits)
{
    model.limits = limits;
    model.file = readGltfFile(path, limits, model.warnings);
    checkGltfShape(model.file.json, model.limits, model.warnings);
    loadGltfBuffers(model.file, model.limits);
    unpackGltf(model.file, model.limits);
    std::size_t at = 0; // index of the view, for messages
    model.views = gltf::readAll(&model.file.json, "bufferViews", [&](const Json& json) {
        const gltf::BufferView view = gltf::readBufferView(json);
        return gltf::ViewBytes{gltfViewBytes(model.file, view, fmt::format("bufferViews[{}]", at++)), view.stride};
    });
    interpretGltfModel(model);
}

void interpretGltfModel(GltfModel& model)
{
    chooseGltfVariant(model);
    model.structure = gltf::readStructure(model.file.json);
    findAccessors(model);
    poseGltf(model);
}

void takeGltfBytes(GltfModel& model, std::uint64_t bytes, const std::string& field)
{
    takeBytes(model.bytesTaken, bytes, gltfAllowance(model), "the geometry takes", model.file.size, field);
}

} // namespace cotan
