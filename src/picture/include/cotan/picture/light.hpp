// The light of a picture: surroundings, lamps, what is behind the model and beneath it.
#pragma once

#include <memory>
#include <vector>

#include "cotan/picture/options.hpp"
#include "cotan/scene/view.hpp"

namespace cotan {

// The surroundings that the options name; null for none. Errors: those of readImage and environmentOfPicture;
// ErrorKind::usage for a name that is none.
Result<std::shared_ptr<const EnvironmentMap>> openSurroundings(const PictureOptions& options);

// Sets what else the view has of light, by the options; all but the lights and the ground, which the scene has a part
// in. Errors: ErrorKind::usage for options that need surroundings where there are none.
Status lightPicture(const PictureOptions& options, View& view);

// The lights of the scene, or those that the options give it.
std::vector<Light> lightsOf(const PictureOptions& options, const Scene& scene);

// The shadow on the ground, if the options want it; where the view has a ground, at its height.
std::shared_ptr<const GroundMap> groundOf(const PictureOptions& options, const Scene& scene, const View& view);

} // namespace cotan
