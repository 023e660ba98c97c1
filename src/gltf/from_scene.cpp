// Converts a scene to a glTF document, for writing other formats as glTF.
#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/type_ptr.hpp>

#include "core/try.hpp"
#include "cotan/image.hpp"
#include "edit_state.hpp"
#include "gltf/json/lookup.hpp"
#include "scene/geometry.hpp"
#include "scene/scene_check.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

using namespace gltf_edit;

namespace {

Json array(const glm::vec3& v) { return Json::array({v.x, v.y, v.z}); }

std::size_t addPositions(GltfDocument& document, const std::vector<glm::vec3>& positions)
{
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const glm::vec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const std::size_t added = addElements(document, positions, "VEC3");
    rootOf(document)["accessors"][added].update({{"min", array(low)}, {"max", array(high)}});
    return added;
}

// The tangents as in the file that they were read from: for the stored uv, and with the sign change of
// reconcileGreenWithTangents undone.
std::vector<glm::vec4> storedTangents(const Mesh& mesh, const Material& material)
{
    std::vector<glm::vec4> tangents = mesh.tangents;
    const Texture& map = material.normalMap;
    if (map.present() && (map.uRow != glm::vec3(1, 0, 0) || map.vRow != glm::vec3(0, 1, 0))) {
        const glm::dvec2 u(map.uRow), v(map.vRow);
        const double determinant = u.x * v.y - u.y * v.x;
        transformTangents(tangents, {mesh.positions, mesh.normals, textureUv(map, mesh), mesh.indices},
                          glm::dvec2(v.y, -u.y) / determinant, glm::dvec2(-v.x, u.x) / determinant);
    }
    for (glm::vec4& tangent : tangents) {
        tangent = withUnitTangent(tangent);
        tangent.w = material.greenReversed ? -tangent.w : tangent.w;
    }
    return tangents;
}

Json primitiveOf(GltfDocument& document, const Mesh& mesh, const Material& material)
{
    Json attributes = {{"POSITION", addPositions(document, mesh.positions)}};
    const auto add = [&](const char* name, const auto& elements, const char* type) {
        if (!elements.empty())
            attributes[name] = addElements(document, elements, type);
    };
    add("NORMAL", mesh.normals, "VEC3");
    add("TANGENT", storedTangents(mesh, material), "VEC4");
    add("TEXCOORD_0", mesh.texcoords[0], "VEC2");
    add("TEXCOORD_1", mesh.texcoords[1], "VEC2");
    add("COLOR_0", mesh.colors, "VEC4");
    return {
        {"attributes", std::move(attributes)},
        {"indices", addElements(document, mesh.indices, "SCALAR", 0, gltf::kUnsignedInt, gltf::kElementArrayBuffer)},
        {"material", std::size_t(mesh.material)}};
}

std::size_t addTexture(GltfDocument& document, const Texture& texture)
{
    const std::size_t sampler = addItem(document, "samplers", gltf::writeSampler(texture.sampler));
    return addItem(document, "textures", {{"source", std::size_t(texture.image)}, {"sampler", sampler}});
}

// KHR_texture_transform has one rotation and two scales: uRow = (c sx, s sy, ox), vRow = (-s sx, c sy, oy). It cannot
// represent a shear.
Json transformOf(const Texture& t, bool& sheared)
{
    const double scaleU = std::hypot(double(t.uRow.x), double(t.vRow.x));
    const double c = scaleU > 0 ? t.uRow.x / scaleU : 1, s = scaleU > 0 ? -t.vRow.x / scaleU : 0;
    const double scaleV = s * t.uRow.y + c * t.vRow.y;
    sheared = std::abs(c * t.uRow.y - s * t.vRow.y) > 1e-5 * (scaleU + std::abs(scaleV));
    return {{"offset", {t.uRow.z, t.vRow.z}}, {"rotation", std::atan2(s, c)}, {"scale", {scaleU, scaleV}}};
}

// Adds a texture info to `owner`, an object of a material, if the texture is present.
void putTexture(GltfDocument& document, const Texture& texture, Json& owner, const char* slot)
{
    if (!texture.present())
        return;
    Json info = {{"index", addTexture(document, texture)}};
    if (texture.texcoord != 0)
        info["texCoord"] = std::size_t(texture.texcoord);
    if (texture.uRow != glm::vec3(1, 0, 0) || texture.vRow != glm::vec3(0, 1, 0)) {
        bool sheared = false;
        info["extensions"]["KHR_texture_transform"] = transformOf(texture, sheared);
        if (sheared)
            document.notes.push_back(
                fmt::format("{}: the shear of its texture coordinates cannot be stored in glTF", slot));
    }
    owner[slot] = std::move(info);
}

Json materialOf(GltfDocument& document, const Material& m)
{
    Json pbr = {{"baseColorFactor", {m.baseColor.x, m.baseColor.y, m.baseColor.z, m.baseColor.w}},
                {"metallicFactor", m.metallic},
                {"roughnessFactor", m.roughness}};
    putTexture(document, m.baseColorMap, pbr, "baseColorTexture");
    putTexture(document, m.metallicRoughnessMap, pbr, "metallicRoughnessTexture");
    Json material = {{"name", m.name}, {"pbrMetallicRoughness", std::move(pbr)}};
    putTexture(document, m.normalMap, material, "normalTexture");
    if (m.normalMap.present() && m.normalScale != 1)
        material["normalTexture"]["scale"] = m.normalScale;
    putTexture(document, m.occlusionMap, material, "occlusionTexture");
    if (m.occlusionMap.present())
        material["occlusionTexture"]["strength"] = m.occlusionStrength;
    putTexture(document, m.emissiveMap, material, "emissiveTexture");
    const float strength = std::max({1.0f, m.emissive.x, m.emissive.y, m.emissive.z});
    if (m.emissive != glm::vec3(0))
        material["emissiveFactor"] = array(m.emissive / strength);
    if (strength > 1)
        material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
    if (m.unlit)
        material["extensions"]["KHR_materials_unlit"] = Json::object();
    if (m.alphaMode != AlphaMode::opaque)
        material["alphaMode"] = m.alphaMode == AlphaMode::mask ? "MASK" : "BLEND";
    if (m.alphaMode == AlphaMode::mask)
        material["alphaCutoff"] = m.alphaCutoff;
    if (m.doubleSided)
        material["doubleSided"] = true;
    if (m.normalFrame)
        material["extras"][gltf::kFrameExtra] = name(*m.normalFrame);
    setExpansion(material, m.normalFormat.expansion);
    return material;
}

Json nodeOf(const Instance& instance)
{
    Json node = {{"mesh", std::size_t(instance.mesh)}};
    if (!instance.name.empty())
        node["name"] = instance.name;
    if (instance.toWorld != glm::mat4(1)) {
        const float* const matrix = glm::value_ptr(instance.toWorld);
        node["matrix"] = std::vector(matrix, matrix + 16);
    }
    return node;
}

} // namespace

Result<GltfDocument> gltfDocumentOf(const Scene& scene)
{
    COTAN_CHECK(checkScene(scene, "scene", {.pixels = false}));
    GltfDocument document;
    auto source = std::make_shared<GltfSource>();
    source->file.json = Json::object();
    document.source = std::move(source);
    Json& root = rootOf(document);
    root = {{"asset", {{"version", "2.0"}, {"generator", "cotan"}}}, {"scene", 0}};
    for (const Image& image : scene.images) {
        if (image.type == PixelType::float32 || image.pixelCount() == 0)
            return inputError(fmt::format("{}: expected pixels of 8 or 16 bits, which glTF can hold; found {}",
                                          image.name, image.pixelCount() == 0 ? "none" : "floats"));
        COTAN_TRY(png, encodePng(image));
        addGltfImage(document, std::move(*png), "image/png", image.name);
    }
    for (const Material& material : scene.materials)
        addItem(document, "materials", materialOf(document, material));
    for (const Mesh& mesh : scene.meshes) {
        Json primitive = primitiveOf(document, mesh, scene.materials[std::size_t(mesh.material)]);
        addItem(document, "meshes", {{"name", mesh.name}, {"primitives", Json::array({std::move(primitive)})}});
    }
    Json nodes = Json::array(), indices = Json::array();
    for (const Instance& instance : scene.instances) {
        indices.push_back(nodes.size());
        nodes.push_back(nodeOf(instance));
    }
    root["scenes"] = Json::array({Json{{"nodes", std::move(indices)}}});
    root["nodes"] = std::move(nodes);
    if (const std::vector<std::string> extensions = extensionsIn(root); !extensions.empty())
        root["extensionsUsed"] = extensions;
    return document;
}

} // namespace cotan
