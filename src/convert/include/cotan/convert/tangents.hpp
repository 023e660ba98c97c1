// The tangents of a glTF file whose normal maps were converted: dropped where nothing else reads them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cotan/gltf/edit.hpp"

namespace cotan {

struct TangentBytes {
    std::size_t vertices = 0; // that had TANGENT
    std::size_t bytes = 0;    // of their accessors, morph targets included
    std::size_t primitives = 0;
};

// Takes TANGENT from all primitives but those whose materials need it for something that is not converted,
// a map in an extension or a normal map in a format that is not read here (`notes` says so, one line each).
// Errors (ErrorKind::input): compressed geometry.
Result<TangentBytes> dropTangents(GltfDocument& document, std::vector<std::string>& notes);

} // namespace cotan
