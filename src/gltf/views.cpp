#include "gltf/json/views.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "elements.hpp"
#include "schema.hpp"

namespace cotan::gltf {

namespace {

int indexOf(const Json& object, std::string_view name) { return valueOr(object, name, -1); }

std::string textOf(const Json& object, std::string_view name) { return valueOr(object, name, std::string()); }

template<class T> std::vector<T> listOf(const Json& object, std::string_view name)
{
    return valueOr(object, name, std::vector<T>());
}

ElementType elementTypeOf(std::string_view name)
{
    return ElementType(std::ranges::find(gltf_schema::kElementTypes, name) - gltf_schema::kElementTypes);
}

Sparse readSparse(const Json& sparse)
{
    const Json &indices = sparse["indices"], &values = sparse["values"];
    return {.count = sparse["count"].get<std::size_t>(),
            .indicesView = indexOf(indices, "bufferView"),
            .valuesView = indexOf(values, "bufferView"),
            .indicesOffset = valueOr(indices, "byteOffset", std::size_t(0)),
            .valuesOffset = valueOr(values, "byteOffset", std::size_t(0)),
            .indicesType = indices["componentType"].get<int>()};
}

// KHR_texture_transform: scale, rotate, then translate. The rotation is counter-clockwise as seen in the image, whose v
// points down, so its sine is positive in the first row. (The extension's example, offset (0,1), a quarter turn, scale
// 1/2, has to select the lower left quadrant.) The extension may name a uv set that overrides that of the texture.
void applyTransform(const Json& transform, TextureUse& use)
{
    const auto offset = vectorOr(transform, "offset", glm::dvec2(0)),
               scale = vectorOr(transform, "scale", glm::dvec2(1));
    const double angle = valueOr(transform, "rotation", 0.0), c = std::cos(angle), s = std::sin(angle);
    use.uRow = {c * scale.x, s * scale.y, offset.x};
    use.vRow = {-s * scale.x, c * scale.y, offset.y};
    use.texcoord = valueOr(transform, "texCoord", use.texcoord);
}

Wrap wrapOf(const Json& sampler, std::string_view name)
{
    const int code = valueOr(sampler, name, kRepeat);
    return code == kClampToEdge ? Wrap::clamp : code == kMirroredRepeat ? Wrap::mirror : Wrap::repeat;
}

int codeOf(Wrap wrap) { return wrap == Wrap::clamp ? kClampToEdge : wrap == Wrap::mirror ? kMirroredRepeat : kRepeat; }

struct MinifyCode {
    int code;
    Filter minify;
    MipFilter mip;
};
constexpr MinifyCode kMinifyCodes[] = {{kNearest, Filter::nearest, MipFilter::none},
                                       {kLinear, Filter::linear, MipFilter::none},
                                       {kNearestMipmapNearest, Filter::nearest, MipFilter::nearest},
                                       {kLinearMipmapNearest, Filter::linear, MipFilter::nearest},
                                       {kNearestMipmapLinear, Filter::nearest, MipFilter::linear},
                                       {kLinearMipmapLinear, Filter::linear, MipFilter::linear}};

} // namespace

const Json* member(const Json& object, std::string_view name)
{
    const auto found = object.find(name);
    return found == object.end() ? nullptr : &*found;
}

Expansion expansionOf(const Json& material)
{
    const Json* const stored = member(member(material, "extras"), kUnsignedKey);
    return stored && *stored == "biased" ? Expansion::biased : Expansion::exact;
}

const Json* extension(const Json& object, std::string_view name)
{
    const Json* const found = member(member(object, "extensions"), name);
    return found && found->is_object() ? found : nullptr;
}

// ---- numbers in buffers ---------------------------------------------------------------------

std::size_t componentSize(int componentType)
{
    std::size_t size = 0;
    withType(componentType, [&](auto value) { size = sizeof value; });
    return size;
}

std::size_t componentCount(ElementType type)
{
    constexpr std::array<std::size_t, 7> counts{1, 2, 3, 4, 4, 9, 16};
    return counts[std::size_t(type)];
}

std::string_view nameOf(ElementType type) { return gltf_schema::kElementTypes[std::size_t(type)]; }

std::size_t elementSize(const Accessor& accessor)
{
    const std::size_t size = componentSize(accessor.componentType);
    if (accessor.type == ElementType::mat2 && size == 1)
        return 8;
    if (accessor.type == ElementType::mat3 && size < 4)
        return size == 1 ? 12 : 24;
    return size * componentCount(accessor.type);
}

BufferView readBufferView(const Json& view)
{
    return {.buffer = view["buffer"].get<std::size_t>(),
            .offset = valueOr(view, "byteOffset", std::size_t(0)),
            .length = view["byteLength"].get<std::size_t>(),
            .stride = valueOr(view, "byteStride", std::size_t(0))};
}

Accessor readAccessor(const Json& accessor)
{
    Accessor read{.view = indexOf(accessor, "bufferView"),
                  .offset = valueOr(accessor, "byteOffset", std::size_t(0)),
                  .componentType = accessor["componentType"].get<int>(),
                  .count = accessor["count"].get<std::size_t>(),
                  .type = elementTypeOf(accessor["type"].get_ref<const std::string&>()),
                  .normalized = valueOr(accessor, "normalized", false),
                  .sparse = {}};
    if (const Json* const sparse = member(accessor, "sparse"))
        read.sparse = readSparse(*sparse);
    return read;
}

// ---- meshes and nodes -----------------------------------------------------------------------

int accessorOf(const Attributes& attributes, std::string_view name)
{
    const auto found = attributes.find(name);
    return found == attributes.end() ? -1 : found->second;
}

Primitive readPrimitive(const Json& primitive)
{
    return {.attributes = primitive["attributes"].get<Attributes>(),
            .targets = listOf<Attributes>(primitive, "targets"),
            .indices = indexOf(primitive, "indices"),
            .material = indexOf(primitive, "material"),
            .mode = valueOr(primitive, "mode", kTriangles),
            .frame = frameText(primitive)};
}

Mesh readMesh(const Json& mesh)
{
    Mesh read{textOf(mesh, "name"), {}, listOf<double>(mesh, "weights")};
    for (const Json& primitive : mesh["primitives"])
        read.primitives.push_back(readPrimitive(primitive));
    return read;
}

Node readNode(const Json& node)
{
    Node read;
    read.name = textOf(node, "name");
    read.mesh = indexOf(node, "mesh");
    read.skin = indexOf(node, "skin");
    read.camera = indexOf(node, "camera");
    read.children = listOf<int>(node, "children");
    read.weights = listOf<double>(node, "weights");
    if (const auto matrix = listOf<double>(node, "matrix"); !matrix.empty())
        read.matrix = glm::make_mat4(matrix.data());
    read.translation = vectorOr(node, "translation", read.translation);
    read.scale = vectorOr(node, "scale", read.scale);
    read.rotation = vectorOr(node, "rotation", read.rotation);
    if (const Json* const light = extension(node, "KHR_lights_punctual"))
        read.light = indexOf(*light, "light");
    if (const Json* const instancing = extension(node, "EXT_mesh_gpu_instancing"))
        read.instances = (*instancing)["attributes"].get<Attributes>();
    return read;
}

Skin readSkin(const Json& skin) { return {indexOf(skin, "inverseBindMatrices"), listOf<int>(skin, "joints")}; }

glm::dmat4 composed(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale)
{
    const double length = glm::length(rotation);
    const glm::dvec4 unit = length > 0 ? rotation / length : glm::dvec4(0, 0, 0, 1);
    const glm::dmat3 r = glm::mat3_cast(glm::dquat(unit.w, unit.x, unit.y, unit.z));
    return {glm::dvec4(r[0] * scale.x, 0), glm::dvec4(r[1] * scale.y, 0), glm::dvec4(r[2] * scale.z, 0),
            glm::dvec4(translation, 1)};
}

glm::dmat4 localMatrix(const Node& node)
{
    return node.matrix.value_or(composed(node.translation, node.rotation, node.scale));
}

// ---- textures -------------------------------------------------------------------------------

TextureUse readTextureUse(const Json* info)
{
    TextureUse use;
    if (!info)
        return use;
    use.texture = indexOf(*info, "index");
    use.texcoord = valueOr(*info, "texCoord", 0);
    use.scale = valueOr(*info, "scale", 1.0);
    use.strength = valueOr(*info, "strength", 1.0);
    if (const Json* const transform = extension(*info, "KHR_texture_transform"))
        applyTransform(*transform, use);
    return use;
}

Texture readTexture(const Json& texture, std::size_t images)
{
    Texture read;
    read.sampler = indexOf(texture, "sampler");
    read.image = indexOf(texture, "source");
    const Json* const extensions = member(texture, "extensions");
    if (!extensions)
        return read;
    std::map<std::string_view, int> named;
    for (const auto& [name, content] : extensions->items())
        if (const Json* const source = member(content, "source");
            source && source->is_number_unsigned() && source->get<std::size_t>() < images)
            named.emplace(name, source->get<int>());
    if (read.image < 0)
        for (const std::string_view extension : kReadImageExtensions)
            if (const auto found = named.find(extension); found != named.end()) {
                read.image = found->second;
                return read;
            }
    if (!named.empty())
        read.foreign = named.begin()->second;
    return read;
}

Image readImage(const Json& image)
{
    Image read{textOf(image, "name"), {}, indexOf(image, "bufferView")};
    if (const Json* const uri = member(image, "uri"))
        read.uri = uri->get_ref<const std::string&>();
    return read;
}

// Filters that the file leaves open become linear with mipmaps.
Sampler readSampler(const Json& sampler)
{
    Sampler read;
    read.wrapU = wrapOf(sampler, "wrapS");
    read.wrapV = wrapOf(sampler, "wrapT");
    if (valueOr(sampler, "magFilter", kLinear) == kNearest)
        read.magnify = Filter::nearest;
    const int code = valueOr(sampler, "minFilter", kLinearMipmapLinear);
    for (const MinifyCode& m : kMinifyCodes)
        if (m.code == code) {
            read.minify = m.minify;
            read.mip = m.mip;
        }
    return read;
}

Json writeSampler(const Sampler& s)
{
    Json sampler = {{"wrapS", codeOf(s.wrapU)}, {"wrapT", codeOf(s.wrapV)}};
    sampler["magFilter"] = s.magnify == Filter::nearest ? kNearest : kLinear;
    for (const MinifyCode& m : kMinifyCodes)
        if (m.minify == s.minify && m.mip == s.mip)
            sampler["minFilter"] = m.code;
    return sampler;
}

std::string frameText(const Json& owner)
{
    const Json* const frame = member(member(owner, "extras"), kFrameExtra);
    return !frame ? "" : frame->is_string() ? frame->get<std::string>() : frame->dump();
}

std::string tangentReader(const Json& material)
{
    return extension(material, "KHR_materials_anisotropy") ? "KHR_materials_anisotropy" : "";
}

std::string tangentRequirement(const Json& material)
{
    if (material.contains("normalTexture"))
        return "";
    const Json* const coat = extension(material, "KHR_materials_clearcoat");
    return coat && coat->contains("clearcoatNormalTexture") ? "KHR_materials_clearcoat" : tangentReader(material);
}

} // namespace cotan::gltf
