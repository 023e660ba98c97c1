// One picture as the normal map of a scene's materials.
#pragma once

#include <utility>

#include "cotan/scene/scene.hpp"

namespace cotan {

// Adds the image to the scene and makes the materials read it as their normal map, at full strength,
// repeated, by the uv set and transform of the map that it takes the place of; where there was none, by
// uv set 0 as it is. material: index into scene.materials, which the caller has checked; -1: all of them.
inline void putNormalMap(Scene& scene, Image image, const Convention& format, int material = -1)
{
    const int number = int(scene.images.size());
    scene.images.push_back(std::move(image));
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (material >= 0 && int(i) != material)
            continue;
        Material& m = scene.materials[i];
        m.normalMap.image = number;
        m.normalMap.sampler = {};
        m.normalScale = 1;
        m.normalFormat = format;
    }
}

} // namespace cotan
