// The objects of a scene: instances with the same name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cotan/scene.hpp"

namespace cotan::app {

// The names of all instances without duplicates, in scene order. Instances with the same name are one object.
std::vector<std::string> objectNames(const Scene& scene);

struct SplitScene {
    Scene object; // the instances with the name, and everything else in the scene
    Scene others; // the other instances with their meshes; no images, one plain material
};

// Splits a scene. Meshes without instances are dropped; meshes used by both parts are copied. If no instance has the
// name, `object` has no instances.
SplitScene splitObject(Scene scene, std::string_view name);

} // namespace cotan::app
