// Between a glTF file and the conversion of its normal maps: which primitives read which image, and
// how what comes out goes back in.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cotan/convert/reencode.hpp"
#include "cotan/gltf/edit.hpp"

namespace cotan {

// A normal map's place in a material.
struct MapPlace {
    std::size_t material = 0;
    NormalSlot slot = NormalSlot::surface;

    bool operator==(const MapPlace&) const = default;
};

// An image and everything that reads it as its normal map.
struct MapJob {
    std::size_t image = 0; // index into the file's images
    std::string name;
    std::vector<MapUse> uses;
    std::vector<MapPlace> places; // where it is read so
    bool alsoElsewhere = false;   // another slot of a material reads it too: it has to stay as it is
};

// The jobs of a file, in the order of its images. A mesh that nodes show under several maps that are not
// rotations and uniform scales of one another is several surfaces; so is one that KHR_materials_variants
// gives several materials. A coat's map is read on a surface of its own (makeCoatSurface). What is left out goes to
// `notes`. Errors (ErrorKind::input): compressed geometry.
Result<std::vector<MapJob>> mapJobs(const GltfDocument& document, std::vector<std::string>& notes);

// Puts a job's new image in place of the old one where normal maps read it. Other forms of the old one
// (EXT_texture_webp, KHR_texture_basisu) go, and `notes` says so: readers would prefer them.
void replaceMap(GltfDocument& document, const MapJob& job, std::vector<std::byte> png, std::vector<std::string>& notes);

// The places of normal maps in a format that is not read here, named by an extension or, against the specification, by
// the texture itself.
std::vector<MapPlace> foreignNormalMaps(const GltfDocument& document);

// A normal map that stays as it is, since its format is not read here.
struct UnreadMap {
    std::size_t image = 0; // index into the file's images
    std::string name;
    std::string format; // "KTX2 with BasisU (ETC1S)"
    std::string advice; // what to do, one line
};
// In the order of the file's images.
std::vector<UnreadMap> unreadNormalMaps(const GltfDocument& document);

} // namespace cotan
