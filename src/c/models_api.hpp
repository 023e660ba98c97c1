// Models of cotan.h.
#pragma once

#include "cotan/scene.hpp"
#include "meshes.hpp"

struct cotan_model {
    cotan::Scene scene;
    std::string warnings; // of it, as cotan_model_warnings gives them
};

namespace cotan::c {

// One mesh, checked, as the library has it; its material is the first.
inline Mesh meshOf(const cotan_mesh& m)
{
    const MeshView view = arraysOf(m);
    Mesh mesh;
    mesh.positions.assign(view.positions.begin(), view.positions.end());
    mesh.normals.assign(view.normals.begin(), view.normals.end());
    mesh.texcoords[0].assign(view.texcoords.begin(), view.texcoords.end());
    mesh.indices.assign(view.indices.begin(), view.indices.end());
    return mesh;
}

// A scene of such meshes, each placed once. name: for messages.
inline Scene sceneOf(std::vector<Mesh> meshes, const std::string& name)
{
    Scene scene;
    scene.name = name;
    scene.materials.resize(1);
    scene.instances.resize(meshes.size());
    for (std::size_t i = 0; i < meshes.size(); ++i)
        scene.instances[i].mesh = int(i);
    scene.meshes = std::move(meshes);
    return scene;
}

inline const Scene& sceneOf(const cotan_model* model, const char* name)
{
    if (!model)
        fail(ErrorKind::usage, std::string(name) + ": expected a model, found null");
    return model->scene;
}

} // namespace cotan::c
