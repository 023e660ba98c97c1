// Chooses frames for the primitives of a glTF file.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "cotan/convert.hpp"
#include "cotan/frame_choice.hpp"

namespace cotan {

// One decision for each primitive with triangles that the file's nodes show, in the order of the file: that of
// chooseFrames. A primitive that is drawn in several ways (by skins, morph weights, or the materials of variants) is
// judged by the worst of them. frames: what maps were made for whose frame the file does not name. scene: of the
// document, with the pixels of its normal maps, if there is one; a file with variants needs another one. Errors: those
// of gltfScene.
Result<std::vector<PrimitiveDecision>> choosePrimitives(const GltfDocument& document, const ChoiceLimits& limits,
                                                        const FramePair& frames, const LoadLimits& load,
                                                        std::optional<Scene> scene = std::nullopt);

// The decision about a primitive, of those that choosePrimitives returned; null if there is none.
template<class Decisions> auto* decisionOf(Decisions& decisions, const SourcePrimitive& primitive)
{
    const auto found = std::ranges::lower_bound(decisions, primitive, {}, &PrimitiveDecision::primitive);
    return found != decisions.end() && found->primitive == primitive ? &found->decision : nullptr;
}

// Names the frame in the primitive's extras (gltf::kFrameExtra); none: removes the name.
void nameFrameOfPrimitive(GltfDocument& document, const SourcePrimitive& primitive, std::optional<Frame> frame);

// "orthonormal, smooth".
std::string namesOf(const std::vector<Frame>& frames);

} // namespace cotan
