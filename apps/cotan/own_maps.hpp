// Pictures of one's own on a model: --normal-map as `render`, `compare` and `lint` take it, and for models that come
// without --base-color, --metallic-roughness and --occlusion.
#pragma once

#include <string>

#include "common.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan::app {

struct OwnMaps { // files; empty: what the model has
    std::string normal, baseColor, metallicRoughness, occlusion;
    std::string convention = "gltf"; // of the normal map
    int material = -1;               // number of the only material that gets them; -1: all
};

// Adds --normal-map, --convention and --material.
void addOwnNormalMap(Arguments& a, OwnMaps& maps);

// Adds those and the other three.
void addOwnMaps(Arguments& a, OwnMaps& maps);

// memory: MiB that one picture may take. Puts the maps on the scene's materials in place of what they have; does
// nothing where none was given. A colour or roughness of the material that would be multiplied with a new picture
// becomes one. Errors: ErrorKind::usage for words that are no convention of a tangent-space map, a material that is not
// there, options without a map; ErrorKind::input where a picture cannot be read or no mesh that would show it has
// texture coordinates.
Status applyOwnMaps(const OwnMaps& maps, int memory, Scene& scene);

} // namespace cotan::app
