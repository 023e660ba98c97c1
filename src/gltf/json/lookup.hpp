// The JSON of a glTF file, and finding one's way in it. All functions want a root as openGltfDocument has checked it.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>

#include "cotan/gltf.hpp"
#include "cotan/result.hpp"
#include "gltf/json/views.hpp"

namespace cotan {

// Members are in the order of the file. May be changed at will but for `accessors`, `bufferViews` and `buffers`: the
// functions of cotan/gltf.hpp take care of those.
struct GltfJson {
    gltf::Json root;
};
inline gltf::Json& rootOf(GltfDocument& document) { return document.root.json->root; }
inline const gltf::Json& rootOf(const GltfDocument& document) { return document.root.json->root; }

// The length of a collection of the root; 0 where it is missing.
inline std::size_t countOf(const gltf::Json& root, const char* collection)
{
    const auto found = root.find(collection);
    return found == root.end() ? 0 : found->size();
}

// "model.glb: " before what is said of the document; nothing where it is of no file.
inline std::string fileOf(const GltfDocument& document)
{
    const std::filesystem::path& file = gltfPath(document);
    return file.empty() ? "" : file.string() + ": ";
}

// What messages call a primitive: "meshes[0].primitives[1]".
std::string primitiveField(std::size_t mesh, std::size_t primitive);

// Calls visit(mesh, primitive), which returns a Status, for every primitive of the file in order, up to the first
// error.
template<class Visit> Status forEachPrimitive(const gltf::Json& root, const Visit& visit)
{
    for (std::size_t m = 0; m < countOf(root, "meshes"); ++m)
        for (std::size_t p = 0; p < root["meshes"][m]["primitives"].size(); ++p)
            if (Status status = visit(m, p); !status)
                return status;
    return Done{};
}

// Indices of the materials that a primitive is seen with: its own, then those of KHR_materials_variants. Empty where it
// has none.
std::vector<std::size_t> materialsOf(const gltf::Json& root, const gltf::Json& primitive);

// How a material uses a normal map; no texture where it has none. And the texture info itself, of one that it has.
gltf::TextureUse normalMapOf(const gltf::Json& root, std::size_t material, NormalSlot slot = NormalSlot::surface);
gltf::Json& normalSlotOf(gltf::Json& root, std::size_t material, NormalSlot slot);

// Adds an item to a collection of the root; returns its index. The file's first moves the other collections in memory.
std::size_t addItem(GltfDocument& document, const char* collection, gltf::Json item);

// Says something in a material's extras; an empty text: that nothing is said. What else is in them stays, but extras
// that are no object.
void setExtra(gltf::Json& material, const char* key, std::string_view text);
// Says in a material's extras how its normal map stores signed numbers (kUnsignedKey); for `exact` nothing is said.
void setExpansion(gltf::Json& material, Expansion expansion);

// A texture of the root, and the sampler that it is read with.
gltf::Texture textureAt(const gltf::Json& root, int texture);
Sampler samplerOf(const gltf::Json& root, const gltf::Texture& texture);

// Indices of the textures that slots of an object, or of anything below it, read. glTF's slots all end in "Texture".
std::set<std::size_t> texturesReadBy(const gltf::Json& object);

// The same for a material, its normal maps left out.
std::set<std::size_t> texturesBesideNormalMaps(const gltf::Json& material);

// Takes a member out of an object in `owner`, and the object too where nothing is left in it.
void takeOut(gltf::Json& owner, const char* object, const std::string& name);

// Takes an extension out of the lists of those used and required.
void takeOffExtension(gltf::Json& root, const std::string& name);

// ---- the geometry as it stands in the world -------------------------------------------------

// For each mesh the linear maps under which nodes show it; of those that differ by rotations, mirroring and uniform
// scale only one, since all frames go along with these. The identity for a mesh that no node shows.
std::vector<std::vector<glm::dmat3>> gltfPlacings(const gltf::Json& root);

// Makes normals unit; those of length 0 stay so. Those that are unit up to rounding keep their bits, which MikkTSpace's
// welding compares.
void makeUnit(std::vector<glm::vec3>& normals);

// The geometry as a mesh whose uv set 0 is what the normal map reads, with unit normals. Without NORMAL each triangle
// gets vertices of its own with its flat normal, as glTF asks; zero where it has no area.
Mesh gltfMesh(GltfGeometry geometry);

} // namespace cotan
