// The frame that a glTF file names for its normal maps (gltf::kFrameExtra), read before a conversion and written after.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "cotan/frame.hpp"
#include "cotan/gltf/edit.hpp"

namespace cotan {

// The frame that the materials with a normal map name; none where they name none, or what is no frame.
// Errors (ErrorKind::input): they name different ones, so that no one conversion serves all.
Result<std::optional<Frame>> namedFrame(const GltfDocument& document);

// Makes a material say that its normal maps are for the frame; for mikktspace, which glTF means without a name, it says
// nothing. What else is in its extras stays, but extras that are no object.
void nameFrame(GltfDocument& document, std::size_t material, Frame frame);

} // namespace cotan
