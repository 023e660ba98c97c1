// The light of a picture: surroundings, lamps, what is behind the model and beneath it.
#pragma once

#include "arguments.hpp"
#include "picture.hpp"

namespace cotan::app {

void addLightOptions(Arguments& a, PictureOptions& options);

// Sets what the view has of light, by the options, for a picture of the scene.
Status lightPicture(const PictureOptions& options, const Scene& scene, View& view);

// The lights and the shadow of another pose of the scene, under the same sky.
void relightPicture(const PictureOptions& options, const Scene& scene, View& view);

} // namespace cotan::app
