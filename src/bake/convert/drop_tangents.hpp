// The tangents of a glTF file whose normal maps were converted: dropped where nothing else reads them.
#pragma once

#include <string>
#include <vector>

#include "bake/lint/map_fit.hpp"
#include "cotan/convert.hpp"
#include "cotan/gltf.hpp"

namespace cotan {

// Takes TANGENT from all primitives but those whose materials need it: for a normal map in a format that is not read
// here, or for a direction that frames.to turns (`notes` says so, one line each).
// Errors (ErrorKind::input): compressed geometry.
Result<TangentBytes> dropTangents(GltfDocument& document, const FramePair& frames, std::vector<std::string>& notes);

} // namespace cotan
