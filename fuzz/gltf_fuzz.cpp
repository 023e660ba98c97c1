// Loads whole .gltf and .glb files and generates tangents for their meshes; also loads a pose of the first animation.
#include "scene_checks.hpp"

using namespace cotan;
using namespace cotan::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const Scratch scratch;
    const std::span bytes(data, size);
    const auto file = scratch.write(startsWith(bytes, "glTF") ? "model.glb" : "model.gltf", bytes);
    LoadLimits limits = smallLimits();
    const auto scene = loadGltf(file, limits);
    if (!scene) {
        checkError(scene.error());
        return 0;
    }
    checkScene(*scene);
    for (const Mesh& mesh : scene->meshes)
        checkTangents(viewOf(mesh));
    if (std::string_view(reinterpret_cast<const char*>(data), size).find("animations") == std::string_view::npos)
        return 0;
    limits.pose = {"0", 0.4};
    if (const auto posed = loadGltf(file, limits))
        checkScene(*posed);
    else
        checkError(posed.error());
    return 0;
}
