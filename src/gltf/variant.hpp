// Which of its materials a model shows (KHR_materials_variants).
#pragma once

#include "gltf_model.hpp"

namespace cotan {

// Gives every primitive that has one for limits.variant its material there; the others keep theirs. Nothing where no
// variant is asked for. The structure must not have been read yet.
// Throws GltfProblem: ErrorKind::usage where the model has no such variant; damaged mappings.
void chooseGltfVariant(GltfModel& model);

} // namespace cotan
