// One picture in a slot of a scene's materials.
#pragma once

#include <utility>

#include "cotan/scene.hpp"
#include "scene/stored_green.hpp"

namespace cotan {

// Adds the image to the scene and makes the materials read it in `slot`, repeated, by the uv set and transform of the
// picture that it takes the place of; where there was none, by uv set 0 as it is. material: index into scene.materials,
// which the caller has checked; -1: all of them. change(Material&): what else a material becomes by it.
template<class Change>
void putPicture(Scene& scene, Image image, Texture Material::*slot, int material, const Change& change)
{
    const int number = int(scene.images.size());
    scene.images.push_back(std::move(image));
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (material >= 0 && int(i) != material)
            continue;
        Material& m = scene.materials[i];
        (m.*slot).image = number;
        (m.*slot).sampler = {};
        change(m);
    }
}

// The same for a normal map, at full strength and for the frame that the image names; the tangents of the meshes become
// those of the file again.
inline void putNormalMap(Scene& scene, Image image, const Convention& format, int material = -1)
{
    restoreDeclaredGreen(scene, material);
    const std::optional<Frame> named = frameFromName(image.frame);
    putPicture(scene, std::move(image), &Material::normalMap, material, [&](Material& m) {
        m.normalScale = 1;
        m.normalFormat = format;
        m.normalFrame = named;
    });
}

} // namespace cotan
