// Typed views of the JSON of a glTF file, shared by loading, editing and converting.
//
// All functions require objects of a root that openGltfDocument has checked. Missing members have the default of the
// specification. References to accessors, nodes and so on are indices into the root's collections; -1: none.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/scene.hpp"
#include "files/json.hpp"

namespace cotan::gltf {

using cotan::Json;

// ---- OpenGL constants for types and modes ---------------------------------------------------

inline constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125,
                     kFloat = 5126;

inline constexpr int kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6;

// Targets of buffer views.
inline constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;

inline constexpr int kNearest = 9728, kLinear = 9729, kNearestMipmapNearest = 9984, kLinearMipmapNearest = 9985,
                     kNearestMipmapLinear = 9986, kLinearMipmapLinear = 9987;

inline constexpr int kRepeat = 10497, kClampToEdge = 33071, kMirroredRepeat = 33648;

// ---- JSON -----------------------------------------------------------------------------------

// A member of an object; null if it is missing, or if `object` is null or no object.
const Json* member(const Json& object, std::string_view name);
inline const Json* member(const Json* object, std::string_view name)
{
    return object ? member(*object, name) : nullptr;
}

// A key of a material's extras: how its normal map stores signed numbers in unsigned ones. "biased": 2c - 1; any other
// value, or none, is Cotan's default, whose zero is the middle code (docs/reference/conventions.md). The map of a clear
// coat always has the default.
inline constexpr const char* kUnsignedKey = "cotanUnsigned";
Expansion expansionOf(const Json& material);

// The object of an extension; null if the extension is missing or is no object.
const Json* extension(const Json& object, std::string_view name);

template<class T> T valueOr(const Json& object, std::string_view name, T otherwise)
{
    const Json* const found = member(object, name);
    return found ? found->get<T>() : otherwise;
}

// The numbers of an array as a vector. T: the type that they are read as.
template<glm::length_t N, class T>
glm::vec<N, T> vectorOr(const Json& object, std::string_view name, glm::vec<N, T> otherwise)
{
    const Json* const numbers = member(object, name);
    for (glm::length_t i = 0; numbers && i < N; ++i)
        otherwise[i] = (*numbers)[std::size_t(i)].get<T>();
    return otherwise;
}

// ---- numbers in buffers ---------------------------------------------------------------------

enum class ElementType { scalar, vec2, vec3, vec4, mat2, mat3, mat4 };

struct BufferView {
    std::size_t buffer = 0, offset = 0, length = 0;
    std::size_t stride = 0; // bytes between the starts of two elements; 0: tightly packed
};

struct Sparse {
    std::size_t count = 0;
    int indicesView = -1, valuesView = -1;
    std::size_t indicesOffset = 0, valuesOffset = 0;
    int indicesType = 0; // component type
};

struct Accessor {
    int view = -1; // -1: all zero
    std::size_t offset = 0;
    int componentType = 0; // 5120 ... 5126
    std::size_t count = 0;
    ElementType type = ElementType::scalar;
    bool normalized = false;
    std::optional<Sparse> sparse;
};

// Size of a component in bytes; number of components of an element; size of an element in bytes, where the columns of
// matrices of bytes and shorts are padded to four bytes.
std::size_t componentSize(int componentType);
std::size_t componentCount(ElementType type);
std::size_t elementSize(const Accessor& accessor);

BufferView readBufferView(const Json& view);
Accessor readAccessor(const Json& accessor);

// ---- meshes and nodes -----------------------------------------------------------------------

using Attributes = std::map<std::string, int, std::less<>>; // name to accessor

// The accessor of an attribute; -1 if it is missing.
int accessorOf(const Attributes& attributes, std::string_view name);

struct Primitive {
    Attributes attributes;
    std::vector<Attributes> targets; // morph targets
    int indices = -1, material = -1;
    int mode = 4;              // 4: triangles, 5: strip, 6: fan; below: points and lines
    std::string frame;         // frameText
    std::vector<int> others{}; // further materials, of variants, that the scene shows too: see addVariantMaterials
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<double> weights; // of morph targets
};

struct Node {
    std::string name;
    int mesh = -1, skin = -1, camera = -1;
    int light = -1; // KHR_lights_punctual
    std::vector<int> children;
    std::vector<double> weights;      // empty: those of the mesh
    std::optional<glm::dmat4> matrix; // replaces the next three members
    glm::dvec3 translation{0}, scale{1};
    glm::dvec4 rotation{0, 0, 0, 1}; // x y z w
    Attributes instances;            // EXT_mesh_gpu_instancing; empty: one instance
};

// Joints are node indices.
struct Skin {
    int inverseBindMatrices = -1;
    std::vector<int> joints;
};

Primitive readPrimitive(const Json& primitive);
Mesh readMesh(const Json& mesh);
Node readNode(const Json& node);
Skin readSkin(const Json& skin);

// rotation: quaternion x y z w of any length; a zero quaternion means no rotation.
glm::dmat4 composed(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale);

// The transform from the node to its parent.
glm::dmat4 localMatrix(const Node& node);

// ---- textures -------------------------------------------------------------------------------

// A texture as used by a material, with KHR_texture_transform applied to uv set and rows (see moveUv).
struct TextureUse {
    int texture = -1;
    int texcoord = 0; // TEXCOORD_n
    glm::dvec3 uRow{1, 0, 0}, vRow{0, 1, 0};
    double scale = 1;    // of a normal map
    double strength = 1; // of an occlusion map

    bool moves() const { return uRow != glm::dvec3(1, 0, 0) || vRow != glm::dvec3(0, 1, 0); }
};

struct Texture {
    int sampler = -1;
    int image = -1;   // its own; else that of the first of kReadImageExtensions that it has
    int foreign = -1; // replaces an `image` of -1: that of the first other extension, in order of names
};

// Extensions that supply a texture's image in another format, which is read here.
inline constexpr std::array<std::string_view, 4> kReadImageExtensions{"EXT_texture_webp", "MSFT_texture_dds",
                                                                      "KHR_texture_basisu", "EXT_texture_astc"};

struct Image {
    std::string name;
    std::optional<std::string_view> uri; // points into the JSON
    int view = -1;
    bool named = false; // messages have `name`, not that of the file
};

// info: a material's "normalTexture" or other texture info; null: none.
TextureUse readTextureUse(const Json* info);

// images: the number of images.
Texture readTexture(const Json& texture, std::size_t images);
Image readImage(const Json& image);

Sampler readSampler(const Json& sampler);
Json writeSampler(const Sampler& sampler);

// The string member of extras that names a frame: in a material, the one that its normal maps were made for; in a
// primitive, the one that reads its normal map. three.js and glTF-Transform keep both, Blender those of materials.
inline constexpr const char* kFrameExtra = "cotanFrame";

// The value of kFrameExtra; empty if missing. A value that is no string is printed as JSON.
std::string frameText(const Json& owner);

// The extension that makes a material read tangents, among those not drawn here; empty: none.
std::string tangentReader(const Json& material);

// The extension because of which glTF requires TANGENT: that of anisotropy, or of a normal map of the clear coat, in a
// material without normalTexture; empty: none. Sources: both; MESH_PRIMITIVE_NO_TANGENT_SPACE of Khronos' validator.
std::string tangentRequirement(const Json& material);

} // namespace cotan::gltf
