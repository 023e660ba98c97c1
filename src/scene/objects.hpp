// What an object of a scene is called.
#pragma once

#include <string>

#include "cotan/scene.hpp"

namespace cotan {

// The name of an instance, or where it has none of its mesh; may be empty.
inline const std::string& objectName(const Scene& scene, const Instance& instance)
{
    return !instance.name.empty() ? instance.name : scene.meshes[std::size_t(instance.mesh)].name;
}

} // namespace cotan
