// What a scene holds under one name: its objects.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cotan/scene.hpp"

namespace cotan::app {

// The names of all instances, each once, in the order of the scene. Instances of one name are one object.
std::vector<std::string> objectNames(const Scene& scene);

struct SplitScene {
    Scene object; // the instances of one name, with all else that the scene has
    Scene others; // the other instances with their meshes; no images, one plain material
};

// Takes a scene apart. Meshes that nothing places are left out; what both parts place is copied. A name that nothing
// has gives an object without instances.
SplitScene splitObject(Scene scene, std::string_view name);

} // namespace cotan::app
