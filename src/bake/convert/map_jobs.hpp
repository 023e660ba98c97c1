// Between a glTF file and the conversion of its normal maps: which primitives read which image, how what comes out goes
// back in, and which tangents are dropped then.
#pragma once

#include <compare>
#include <cstddef>
#include <string>
#include <vector>

#include "bake/convert/reencode.hpp"
#include "cotan/convert.hpp"
#include "cotan/gltf.hpp"

namespace cotan {

// A normal map's place in a material.
struct MapSlot {
    std::size_t material = 0;
    NormalSlot slot = NormalSlot::surface;

    auto operator<=>(const MapSlot&) const = default;
};

// A primitive that reads a map, with one of its materials.
struct MapReader {
    std::size_t mesh = 0, primitive = 0;
    MapSlot place;
    double strength = 1; // the material's factor on the slopes
    Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
    std::vector<glm::dmat3> placed; // each is a surface
    std::size_t vertices = 0, triangles = 0;
    bool stored = false; // it has TANGENT
};

// An image and everything that reads it as its normal map.
struct MapJob {
    std::size_t image = 0; // index into the file's images
    std::string name;
    std::vector<MapReader> readers;
    std::vector<MapSlot> places;       // where it is read so
    std::vector<std::size_t> textures; // of the file, that show the image
    bool alsoElsewhere = false;        // another slot of a material reads it too: it has to stay as it is
};

// The jobs of a file, in the order of its images. A mesh that nodes show under several maps that are not
// rotations and uniform scales of one another is several surfaces; so is one that KHR_materials_variants
// gives several materials. A coat's map is read on a surface of its own (makeCoatSurface). What is left out goes to
// `notes`. Errors (ErrorKind::input): compressed geometry.
Result<std::vector<MapJob>> mapJobs(const GltfDocument& document, std::vector<std::string>& notes);

// How many surfaces read the job's image.
std::size_t surfacesOf(const MapJob& job);

// The surfaces, with what frames.from and frames.to read at their vertices. Errors: as mapJobs.
Result<std::vector<MapUse>> usesOf(const GltfDocument& document, const MapJob& job, const FramePair& frames);

// About how many bytes the job takes at most besides the document, the image apart.
std::size_t bytesOf(const MapJob& job, const FramePair& frames);

// Puts a job's new image in place of the old one where normal maps read it; mime: "image/png", "image/jpeg", or
// "image/webp", which is then named by EXT_texture_webp. Other forms of the old one (EXT_texture_webp,
// KHR_texture_basisu) go, and `notes` says so: readers would prefer them.
void replaceMap(GltfDocument& document, const MapJob& job, std::vector<std::byte> bytes, const std::string& mime,
                std::vector<std::string>& notes);

// The places of normal maps in a format that is not read here, named by an extension or, against the specification, by
// the texture itself.
std::vector<MapSlot> foreignNormalMaps(const GltfDocument& document);

// In the order of the file's images.
std::vector<UnreadMap> unreadNormalMaps(const GltfDocument& document);

// Takes TANGENT from all primitives but those whose materials need it: for a normal map in a format that is not read
// here, or for a direction that frames.to turns (`notes` says so, one line each).
// Errors (ErrorKind::input): compressed geometry.
Result<TangentBytes> dropTangents(GltfDocument& document, const FramePair& frames, std::vector<std::string>& notes);

} // namespace cotan
