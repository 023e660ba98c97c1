// JSON text to a document.
#pragma once

#include <cstddef>
#include <span>

#include "gltf/json/views.hpp"

namespace cotan {

// Deeper JSON is refused: what walks through a document recurses once a level.
inline constexpr int kGltfDepth = 128;

// In time that grows with the length of the text alone. Of members of the same name the last counts. Throws
// GltfProblem where it is no JSON, and where it is nested too deep.
gltf::Json parseGltfJson(std::span<const std::byte> text);

} // namespace cotan
