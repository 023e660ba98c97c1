#include "sandboxed_models.hpp"

#include <new>

#include <fmt/format.h>

#include "files/bytes.hpp"
#include "files/sandbox/process.hpp"
#include "files/sandbox/scene_wire.hpp"
#include "scene/scene_check.hpp"

namespace cotan {

namespace {

// Over a limit that the child should have held.
Status checkLimits(const Scene& scene, const std::string& file, const LoadLimits& limits)
{
    std::size_t vertices = 0, triangles = 0;
    for (const Mesh& mesh : scene.meshes) {
        vertices += mesh.vertexCount();
        triangles += mesh.triangleCount();
    }
    if (vertices > limits.vertices)
        return inputError(fmt::format("{}: over the limit of {} vertices", file, limits.vertices));
    if (triangles > limits.triangles)
        return inputError(fmt::format("{}: over the limit of {} triangles", file, limits.triangles));
    if (scene.instances.size() > limits.vertices)
        return inputError(fmt::format("{}: over the limit of {} instances", file, limits.vertices));
    return Done{};
}

} // namespace

Result<Scene> loadSandboxed(const std::filesystem::path& file, const LoadLimits& limits)
try {
    const auto size = usableFileSize(file, limits.fileBytes);
    if (!size)
        return size.error();
    auto process =
        ReaderProcess::start({.kind = ReaderKind::model, .name = file.string(), .fileBytes = *size, .limits = limits});
    if (!process)
        return process.error();
    if (Status found = (*process)->await(); !found)
        return found.error();
    Scene scene;
    exchangeScene((*process)->answer(), scene);
    if (!(*process)->answer().good())
        return (*process)->failure();
    if (Status sound = checkScene(scene, file.string()); !sound)
        return sound.error();
    if (Status within = checkLimits(scene, file.string(), limits); !within)
        return within.error();
    return scene;
} catch (const std::bad_alloc&) {
    return inputError(fmt::format("{}: not enough memory for the model", file.string()));
}

} // namespace cotan
