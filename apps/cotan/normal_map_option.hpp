// --normal-map: a map of one's own on a model, as `render`, `compare` and `lint` take it.
#pragma once

#include <string>

#include "common.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan::app {

struct NormalMapOption {
    std::string file; // empty: the model's own maps
    std::string convention = "gltf";
    int material = -1; // number of the only material that gets it; -1: all
};

void addNormalMapOption(Arguments& a, NormalMapOption& option);

// memory: MiB that it may take. Puts the map on the scene's materials in place of what they have; does nothing where
// none was given. Errors: ErrorKind::usage for words that are no convention of a tangent-space map, a material that is
// not there, options without --normal-map; ErrorKind::input where the picture cannot be read or no mesh that would show
// it has texture coordinates.
Status applyNormalMap(const NormalMapOption& option, int memory, Scene& scene);

} // namespace cotan::app
