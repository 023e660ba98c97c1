// The JSON of a glTF file and look-ups in it. All functions require a root that openGltfDocument has checked.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/try.hpp"
#include "cotan/gltf.hpp"
#include "cotan/result.hpp"
#include "gltf/json/views.hpp"

namespace cotan {

// Members keep the order of the file. All may be edited except `accessors`, `bufferViews` and `buffers`, which the
// functions of cotan/gltf.hpp manage.
struct GltfJson {
    gltf::Json root;
};
inline gltf::Json& rootOf(GltfDocument& document) { return document.root.json->root; }
inline const gltf::Json& rootOf(const GltfDocument& document) { return document.root.json->root; }

// The length of a root collection; 0 if it is missing.
inline std::size_t countOf(const gltf::Json& root, const char* collection)
{
    const auto found = root.find(collection);
    return found == root.end() ? 0 : found->size();
}

// "model.glb: " as the start of a message about the document; empty if it was not read from a file.
inline std::string fileOf(const GltfDocument& document)
{
    const std::filesystem::path& file = gltfPath(document);
    return file.empty() ? "" : file.string() + ": ";
}

// The name of a primitive in messages: "meshes[0].primitives[1]".
std::string primitiveField(std::size_t mesh, std::size_t primitive);

// Calls visit(mesh, primitive), which returns a Status, for every primitive in file order, until the first error.
template<class Visit> Status forEachPrimitive(const gltf::Json& root, const Visit& visit)
{
    for (std::size_t m = 0; m < countOf(root, "meshes"); ++m)
        for (std::size_t p = 0; p < root["meshes"][m]["primitives"].size(); ++p)
            COTAN_CHECK(visit(m, p));
    return Done{};
}

// Indices of all materials of a primitive: its own, then those of KHR_materials_variants. Empty if it has none.
std::vector<std::size_t> materialsOf(const gltf::Json& root, const gltf::Json& primitive);

// How a material uses a normal map; without a texture if it has none. normalSlotOf: the texture info, which must exist.
gltf::TextureUse normalMapOf(const gltf::Json& root, std::size_t material, NormalSlot slot = NormalSlot::surface);
gltf::Json& normalSlotOf(gltf::Json& root, std::size_t material, NormalSlot slot);

// Appends an item to a root collection; returns its index. The first item of a new collection moves the others in
// memory.
std::size_t addItem(GltfDocument& document, const char* collection, gltf::Json item);

// Sets a string in a material's extras; empty text removes it. Other extras are kept, except extras that are no object.
void setExtra(gltf::Json& material, const char* key, std::string_view text);
// Records in a material's extras how its normal map stores signed numbers (kUnsignedKey); `exact` removes the entry.
void setExpansion(gltf::Json& material, Expansion expansion);

// A texture of the root, and its sampler.
gltf::Texture textureAt(const gltf::Json& root, int texture);
Sampler samplerOf(const gltf::Json& root, const gltf::Texture& texture);

// Indices of the textures used by slots of an object or anything nested in it. All glTF slot names end in "Texture".
std::set<std::size_t> texturesReadBy(const gltf::Json& object);

// The same for a material, without its normal maps.
std::set<std::size_t> texturesBesideNormalMaps(const gltf::Json& material);

// Removes a member from `object` in `owner`, and `object` itself if it is then empty.
void takeOut(gltf::Json& owner, const char* object, const std::string& name);

// Removes an extension from the lists of used and required extensions.
void takeOffExtension(gltf::Json& root, const std::string& name);

// Like gltfScene, and shows each primitive once more with every material of a variant that reads other normal maps: a
// mesh with the same source and at most eight instances, which differ in stretch. These meshes have a million triangles
// in all, or 64 each if they are very many; of larger primitives, parts.
Result<Scene> gltfSceneOfVariants(const GltfDocument& document, const LoadLimits& limits);

// ---- the geometry in world space ------------------------------------------------------------

// For each mesh, the linear maps of the nodes that show it. Maps that differ only by rotation, mirroring and uniform
// scale are listed once, because all frames are invariant to these. The identity for a mesh that no node shows.
std::vector<std::vector<glm::dmat3>> gltfMeshTransforms(const gltf::Json& root);

// Normalises the normals; zero normals stay zero. Normals that are unit up to rounding keep their bits, because the
// welding of MikkTSpace compares bits.
void makeUnit(std::vector<glm::vec3>& normals);

// Converts the geometry to a mesh with unit normals whose uv set 0 is the set that the normal map reads. Without
// NORMAL, each triangle gets vertices of its own with its flat normal, as glTF requires; the normal is zero if the
// triangle has no area.
Mesh gltfMesh(GltfGeometry geometry);

} // namespace cotan
