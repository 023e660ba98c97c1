// Tables of the glTF JSON, limited to the members that the reader uses. Source: the JSON schemas of the glTF 2.0
// specification and of the supported extensions.
#pragma once

#include <array>
#include <cfloat>
#include <cstddef>
#include <span>
#include <string_view>

#include "gltf/json/views.hpp"

namespace cotan::gltf_schema {

enum class Shape {
    boolean,
    integer, // low to high
    number,  // low to high
    text,
    index,    // index into the collection `refers`
    object,   // with the fields `inner`
    indexMap, // an object whose values are indices into `refers`
};

struct Field;
using Fields = std::span<const Field>;

inline constexpr double kMaxInt = 2147483647.0;
// Offsets, lengths and counts up to this limit can be added and multiplied by a stride (at most 252) in 64 bits: 2^53,
// or the maximum of a 32-bit std::size_t.
inline constexpr double kMaxSize = sizeof(std::size_t) < 8 ? 4294967295.0 : 9007199254740992.0;
// Real lights and maps stay below these, and products with them stay finite in float.
inline constexpr double kBrightest = 1e12;
inline constexpr double kSteepest = 1e6;

struct Field {
    std::string_view name;
    Shape shape;
    bool required = false;
    bool list = false;      // an array of such values
    std::size_t length = 0; // of the list; 0: any
    Fields inner = {};
    std::string_view refers = {};
    double low = -FLT_MAX;
    double high = FLT_MAX;
    std::span<const std::string_view> texts = {}; // allowed values; empty: any
    std::span<const int> integers = {};           // allowed values; empty: any in range
    unsigned multipleOf = 1;                      // integers
};

constexpr Field boolean(std::string_view n) { return {n, Shape::boolean}; }
constexpr Field number(std::string_view n, double low = -FLT_MAX, double high = FLT_MAX)
{
    return {.name = n, .shape = Shape::number, .low = low, .high = high};
}
constexpr Field integer(std::string_view n, double low = 0, double high = kMaxInt)
{
    return {.name = n, .shape = Shape::integer, .low = low, .high = high};
}
constexpr Field size(std::string_view n) { return integer(n, 0, kMaxSize); }
constexpr Field oneOf(std::string_view n, std::span<const int> values)
{
    return {.name = n, .shape = Shape::integer, .low = 0, .high = kMaxInt, .integers = values};
}
constexpr Field text(std::string_view n, std::span<const std::string_view> values = {})
{
    return {.name = n, .shape = Shape::text, .texts = values};
}
constexpr Field index(std::string_view n, std::string_view refers)
{
    return {.name = n, .shape = Shape::index, .refers = refers};
}
constexpr Field indexMap(std::string_view n, std::string_view refers)
{
    return {.name = n, .shape = Shape::indexMap, .refers = refers};
}
constexpr Field object(std::string_view n, Fields inner) { return {.name = n, .shape = Shape::object, .inner = inner}; }
constexpr Field list(Field field, std::size_t length = 0)
{
    field.list = true;
    field.length = length;
    return field;
}
constexpr Field indices(std::string_view n, std::string_view refers) { return list(index(n, refers)); }
constexpr Field numbers(std::string_view n, std::size_t length = 0) { return list(number(n), length); }
constexpr Field objects(std::string_view n, Fields inner) { return list(object(n, inner)); }
constexpr Field required(Field field)
{
    field.required = true;
    return field;
}

// ---- the tables, innermost first ------------------------------------------------------------

inline constexpr std::array kComponentTypes{gltf::kByte,          gltf::kUnsignedByte, gltf::kShort,
                                            gltf::kUnsignedShort, gltf::kUnsignedInt,  gltf::kFloat};
inline constexpr std::array kIndexTypes{gltf::kUnsignedByte, gltf::kUnsignedShort, gltf::kUnsignedInt};
inline constexpr std::array kMagFilters{gltf::kNearest, gltf::kLinear};
inline constexpr std::array kMinFilters{gltf::kNearest,
                                        gltf::kLinear,
                                        gltf::kNearestMipmapNearest,
                                        gltf::kLinearMipmapNearest,
                                        gltf::kNearestMipmapLinear,
                                        gltf::kLinearMipmapLinear};
inline constexpr std::array kWraps{gltf::kRepeat, gltf::kClampToEdge, gltf::kMirroredRepeat};
inline constexpr std::string_view kElementTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
inline constexpr std::string_view kAlphaModes[] = {"OPAQUE", "MASK", "BLEND"};
inline constexpr std::string_view kLightTypes[] = {"directional", "point", "spot"};
inline constexpr std::string_view kCameraTypes[] = {"perspective", "orthographic"};

inline constexpr std::array kAsset{required(text("version")), text("minVersion"), text("generator")};
inline constexpr std::array kScene{text("name"), indices("nodes", "nodes")};

inline constexpr std::array kNodeLight{required(index("light", "lights"))};
inline constexpr std::array kNodeInstancing{required(indexMap("attributes", "accessors"))};
inline constexpr std::array kNodeExtensions{object("KHR_lights_punctual", kNodeLight),
                                            object("EXT_mesh_gpu_instancing", kNodeInstancing)};
inline constexpr std::array kNode{text("name"),
                                  index("mesh", "meshes"),
                                  index("skin", "skins"),
                                  index("camera", "cameras"),
                                  indices("children", "nodes"),
                                  numbers("matrix", 16),
                                  numbers("rotation", 4),
                                  numbers("scale", 3),
                                  numbers("translation", 3),
                                  numbers("weights"),
                                  object("extensions", kNodeExtensions)};

inline constexpr std::array kDraco{required(index("bufferView", "bufferViews")), required(object("attributes", {}))};
inline constexpr std::array kPrimitiveExtensions{object("KHR_draco_mesh_compression", kDraco)};
inline constexpr std::array kPrimitive{required(indexMap("attributes", "accessors")),
                                       index("indices", "accessors"),
                                       index("material", "materials"),
                                       integer("mode", 0, 6),
                                       list(indexMap("targets", "accessors")),
                                       object("extensions", kPrimitiveExtensions)};
inline constexpr std::array kMesh{text("name"), required(objects("primitives", kPrimitive)), numbers("weights")};

inline constexpr std::array kSparseIndices{required(index("bufferView", "bufferViews")), integer("byteOffset"),
                                           required(oneOf("componentType", kIndexTypes))};
inline constexpr std::array kSparseValues{required(index("bufferView", "bufferViews")), integer("byteOffset")};
inline constexpr std::array kSparse{required(integer("count")), required(object("indices", kSparseIndices)),
                                    required(object("values", kSparseValues))};
inline constexpr std::array kAccessor{index("bufferView", "bufferViews"),
                                      size("byteOffset"),
                                      required(oneOf("componentType", kComponentTypes)),
                                      required(size("count")),
                                      required(text("type", kElementTypes)),
                                      boolean("normalized"),
                                      object("sparse", kSparse),
                                      numbers("min"),
                                      numbers("max")};
inline constexpr std::string_view kMeshoptModes[] = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
inline constexpr std::string_view kMeshoptFilters[] = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"};
inline constexpr std::array kMeshopt{
    required(index("buffer", "buffers")),    size("byteOffset"),      required(size("byteLength")),
    required(integer("byteStride", 1, 256)), required(size("count")), required(text("mode", kMeshoptModes)),
    text("filter", kMeshoptFilters)};
inline constexpr std::array kViewExtensions{object("EXT_meshopt_compression", kMeshopt),
                                            object("KHR_meshopt_compression", kMeshopt)};
inline constexpr std::array kBufferView{
    required(index("buffer", "buffers")), size("byteOffset"), required(size("byteLength")),
    Field{.name = "byteStride", .shape = Shape::integer, .low = 0, .high = 252, .multipleOf = 4},
    object("extensions", kViewExtensions)};
inline constexpr std::array kFallback{boolean("fallback")};
inline constexpr std::array kBufferExtensions{object("EXT_meshopt_compression", kFallback),
                                              object("KHR_meshopt_compression", kFallback)};
inline constexpr std::array kBuffer{required(size("byteLength")), text("uri"), object("extensions", kBufferExtensions)};

inline constexpr std::array kTransform{numbers("offset", 2), number("rotation"), numbers("scale", 2),
                                       integer("texCoord")};
inline constexpr std::array kTextureExtensions{object("KHR_texture_transform", kTransform)};
inline constexpr std::array kTextureInfo{required(index("index", "textures")), integer("texCoord"),
                                         number("scale", -kSteepest, kSteepest), number("strength"),
                                         object("extensions", kTextureExtensions)};
inline constexpr std::array kRoughness{numbers("baseColorFactor", 4), object("baseColorTexture", kTextureInfo),
                                       number("metallicFactor"), number("roughnessFactor"),
                                       object("metallicRoughnessTexture", kTextureInfo)};
inline constexpr std::array kStrength{number("emissiveStrength", 0, kBrightest)};
inline constexpr std::array kCoat{number("clearcoatFactor"), object("clearcoatTexture", kTextureInfo),
                                  number("clearcoatRoughnessFactor"), object("clearcoatRoughnessTexture", kTextureInfo),
                                  object("clearcoatNormalTexture", kTextureInfo)};
inline constexpr std::array kAnisotropy{number("anisotropyStrength"), number("anisotropyRotation"),
                                        object("anisotropyTexture", kTextureInfo)};
inline constexpr std::array kIor{number("ior")};
inline constexpr std::array kSpecular{number("specularFactor"), object("specularTexture", kTextureInfo),
                                      numbers("specularColorFactor", 3), object("specularColorTexture", kTextureInfo)};
inline constexpr std::array kSheen{numbers("sheenColorFactor", 3), object("sheenColorTexture", kTextureInfo),
                                   number("sheenRoughnessFactor"), object("sheenRoughnessTexture", kTextureInfo)};
inline constexpr std::array kTransmission{number("transmissionFactor"), object("transmissionTexture", kTextureInfo)};
inline constexpr std::array kMaterialExtensions{object("KHR_materials_emissive_strength", kStrength),
                                                object("KHR_materials_unlit", {}),
                                                object("KHR_materials_clearcoat", kCoat),
                                                object("KHR_materials_anisotropy", kAnisotropy),
                                                object("KHR_materials_ior", kIor),
                                                object("KHR_materials_specular", kSpecular),
                                                object("KHR_materials_sheen", kSheen),
                                                object("KHR_materials_transmission", kTransmission)};
inline constexpr std::array kMaterial{text("name"),
                                      object("pbrMetallicRoughness", kRoughness),
                                      object("normalTexture", kTextureInfo),
                                      object("occlusionTexture", kTextureInfo),
                                      object("emissiveTexture", kTextureInfo),
                                      numbers("emissiveFactor", 3),
                                      text("alphaMode", kAlphaModes),
                                      number("alphaCutoff"),
                                      boolean("doubleSided"),
                                      object("extensions", kMaterialExtensions)};
inline constexpr std::array kTexture{index("sampler", "samplers"), index("source", "images")};
inline constexpr std::array kImage{text("name"), text("uri"), text("mimeType"), index("bufferView", "bufferViews")};
inline constexpr std::array kSampler{oneOf("magFilter", kMagFilters), oneOf("minFilter", kMinFilters),
                                     oneOf("wrapS", kWraps), oneOf("wrapT", kWraps)};

inline constexpr std::array kSkin{text("name"), index("inverseBindMatrices", "accessors"), index("skeleton", "nodes"),
                                  required(indices("joints", "nodes"))};
inline constexpr std::array kPerspective{required(number("yfov")), required(number("znear")), number("aspectRatio"),
                                         number("zfar")};
inline constexpr std::array kOrthographic{required(number("xmag")), required(number("ymag")), required(number("zfar")),
                                          required(number("znear"))};
inline constexpr std::array kCamera{text("name"), required(text("type", kCameraTypes)),
                                    object("perspective", kPerspective), object("orthographic", kOrthographic)};
inline constexpr std::array kSpot{number("innerConeAngle"), number("outerConeAngle")};
inline constexpr std::array kLight{text("name"),        required(text("type", kLightTypes)),
                                   numbers("color", 3), number("intensity", 0, kBrightest),
                                   number("range", 0),  object("spot", kSpot)};
inline constexpr std::array kLights{required(objects("lights", kLight))};
inline constexpr std::array kRootExtensions{object("KHR_lights_punctual", kLights)};

// Animations are checked only when one is requested.
inline constexpr std::string_view kInterpolations[] = {"LINEAR", "STEP", "CUBICSPLINE"};
inline constexpr std::array kAnimationSampler{required(index("input", "accessors")),
                                              required(index("output", "accessors")),
                                              text("interpolation", kInterpolations)};
inline constexpr std::array kTarget{index("node", "nodes"), required(text("path"))};
inline constexpr std::array kChannel{required(integer("sampler")), required(object("target", kTarget))};
inline constexpr std::array kAnimation{text("name"), required(objects("channels", kChannel)),
                                       required(objects("samplers", kAnimationSampler))};
inline constexpr std::array kAnimated{objects("animations", kAnimation)};

inline constexpr std::array kRoot{required(object("asset", kAsset)),
                                  index("scene", "scenes"),
                                  objects("scenes", kScene),
                                  objects("nodes", kNode),
                                  objects("meshes", kMesh),
                                  objects("accessors", kAccessor),
                                  objects("bufferViews", kBufferView),
                                  objects("buffers", kBuffer),
                                  objects("materials", kMaterial),
                                  objects("textures", kTexture),
                                  objects("images", kImage),
                                  objects("samplers", kSampler),
                                  objects("skins", kSkin),
                                  objects("cameras", kCamera),
                                  objects("animations", {}),
                                  object("extensions", kRootExtensions),
                                  list(text("extensionsUsed")),
                                  list(text("extensionsRequired"))};

} // namespace cotan::gltf_schema
