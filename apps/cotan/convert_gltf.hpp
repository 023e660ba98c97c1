// Between a glTF file and the conversion of its normal maps: which primitives read which image, and
// how what comes out goes back in.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "cotan/gltf/edit.hpp"
#include "cotan/convert/reencode.hpp"

namespace cotan::app {

// An image and everything that reads it as its normal map.
struct MapJob {
    std::size_t image = 0; // index into the file's images
    std::string name;
    std::vector<MapUse> uses;
    std::vector<std::size_t> materials; // that read it so
    bool alsoElsewhere = false;         // another slot of a material reads it too: it has to stay as it is
};

// The jobs of a file, in the order of its images. A mesh that nodes show under several maps that are not
// rotations and uniform scales of one another is several surfaces; so is one that KHR_materials_variants
// gives several materials. What is left out goes to `notes`.
// Errors (ErrorKind::input): compressed geometry.
Result<std::vector<MapJob>> mapJobs(const GltfDocument& document, std::vector<std::string>& notes);

// Puts a job's new image in place of the old one where normal maps read it. Other forms of the old one
// (EXT_texture_webp, KHR_texture_basisu) go, and `notes` says so: readers would prefer them.
void replaceMap(GltfDocument& document, const MapJob& job, std::vector<std::byte> png, std::vector<std::string>& notes);

// Indices of the textures that slots of an object, or of anything below it, read. glTF's slots all end in "Texture".
std::set<std::size_t> texturesReadBy(const nlohmann::ordered_json& object);

struct TangentBytes {
    std::size_t vertices = 0; // that had TANGENT
    std::size_t bytes = 0;    // of their accessors, morph targets included
    std::size_t primitives = 0;
};

// Takes TANGENT from all primitives but those whose materials need it for something that is not converted,
// a map in an extension or a normal map that is neither PNG nor JPEG (`notes` says so).
Result<TangentBytes> dropTangents(GltfDocument& document, std::vector<std::string>& notes);

// Generates tangents of that frame (mikktspace or vertex) for all primitives with a normal map. Returns
// how many primitives got them.
Result<std::size_t> giveTangents(GltfDocument& document, Frame frame);

} // namespace cotan::app
