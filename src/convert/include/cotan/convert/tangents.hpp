// The tangents of a glTF file whose normal maps were converted: dropped where nothing else reads them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cotan/gltf/edit.hpp"
#include "cotan/lint/map_fit.hpp"

namespace cotan {

// How far highlights that are stretched along tangents (KHR_materials_anisotropy) turn when the new frame says where.
struct TurnedDirection {
    std::size_t mesh = 0, primitive = 0, material = 0;
    Spread degrees;     // directionTurn; empty where the new frame has no direction: no uv
    bool stays = false; // TANGENT, for it: turned by over kTurnedDirection, or nothing else has the direction
};

struct TangentBytes {
    std::size_t vertices = 0; // that had TANGENT
    std::size_t bytes = 0;    // of their accessors, morph targets included
    std::size_t primitives = 0;
    std::vector<TurnedDirection> directions; // of all primitives with TANGENT and stretched highlights
};

// Takes TANGENT from all primitives but those whose materials need it: for a normal map in a format that is not read
// here, or for a direction that frames.to turns (`notes` says so, one line each).
// Errors (ErrorKind::input): compressed geometry.
Result<TangentBytes> dropTangents(GltfDocument& document, const FramePair& frames, std::vector<std::string>& notes);

} // namespace cotan
