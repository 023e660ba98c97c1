// Between a glTF file and the conversion of its normal maps: which primitives read which image, and
// how what comes out goes back in.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cotan/convert/reencode.hpp"
#include "cotan/gltf/edit.hpp"

namespace cotan {

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

// By material: whether its normal map is in a format that is not read here, named by an extension or, against the
// specification, by the texture itself. False where it has none.
std::vector<bool> foreignNormalMaps(const GltfDocument& document);

} // namespace cotan
