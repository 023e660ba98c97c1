// Whole .gltf and .glb files to a scene, and the tangents of its meshes.
#include "scene_checks.hpp"

using namespace cotan;
using namespace cotan::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const Scratch scratch;
    const std::span bytes(data, size);
    const auto scene =
        loadGltf(scratch.write(startsWith(bytes, "glTF") ? "model.glb" : "model.gltf", bytes), smallLimits());
    if (!scene) {
        checkError(scene.error());
        return 0;
    }
    checkScene(*scene);
    for (const Mesh& mesh : scene->meshes)
        checkTangents(viewOf(mesh));
    return 0;
}
