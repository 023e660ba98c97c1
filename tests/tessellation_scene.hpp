// Tessellated surfaces as scenes.
#pragma once

#include "cotan/scene.hpp"
#include "truth/tessellation.hpp"

namespace cotan {

// A scene named "low" of one tessellated surface.
inline Scene sceneOf(const Tessellation& mesh)
{
    Scene scene;
    scene.name = "low";
    Mesh m;
    m.positions = mesh.positions;
    m.normals = mesh.normals;
    m.texcoords[0] = mesh.texcoords;
    m.indices = mesh.indices;
    scene.meshes.push_back(std::move(m));
    scene.materials.emplace_back();
    scene.instances.push_back({});
    return scene;
}

} // namespace cotan
