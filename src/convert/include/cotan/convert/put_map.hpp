// A new normal map for a glTF file, with the tangents that its readers need.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cotan/frame.hpp"
#include "cotan/gltf/edit.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan {

struct PutMapOptions {
    Frame frame = Frame::mikktspace;     // that the map was made for
    std::optional<std::string> material; // name of the one that gets it; none: all, and primitives without one get one
    Expansion expansion = Expansion::exact; // how the map stores signed numbers; the materials say it
    bool keepTangents = false; // for mikktspace and vertex: the file's TANGENT is what the map was made with. Else
                               // it is generated. For other frames it goes, as dropTangents has it
};

// Makes materials read a PNG as their normal map at full strength, by the uv set, the transform and the place in the
// file of the map that was there. `notes`: what the user should know, one line each.
// Errors (ErrorKind::input): "document: ..." where not exactly one material has that name; compressed geometry.
Status putNormalMap(GltfDocument& document, std::vector<std::byte> png, const PutMapOptions& options,
                    std::vector<std::string>& notes);

// A model with a new map in it: one named as glTF keeps all else as it was, another, which `scene` is from, becomes
// glTF. GltfWritten::notes begin with what putNormalMap has to say. Errors: as putNormalMap, openGltfDocument,
// encodePng and writeGltf.
Result<GltfWritten> writeModelWithMap(const Scene& scene, const std::filesystem::path& model, const Image& map,
                                      const PutMapOptions& options, const std::filesystem::path& output);

} // namespace cotan
