#include "cotan/model.hpp"

#include <new>
#include <string>

#include <fmt/format.h>

#include "core/try.hpp"
#include "files/file_registry.hpp"
#include "files/sandbox/reader_process.hpp"
#include "files/sandbox/scene_wire.hpp"
#include "model/model_formats.hpp"
#include "scene/geometry.hpp"
#include "scene/scene_check.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

// Enforces limits that the child process should have enforced.
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

// Reads in a child process, limits.sandbox.program.
Result<Scene> loadSandboxed(const fs::path& file, std::size_t fileBytes, const LoadLimits& limits)
try {
    COTAN_TRY(process,
              ReaderProcess::start(
                  {.kind = ReaderKind::model, .name = file.string(), .fileBytes = fileBytes, .limits = limits}));
    Scene scene;
    exchangeScene((*process)->answer(), scene);
    if (!(*process)->answer().good())
        return (*process)->failure();
    COTAN_CHECK(checkScene(scene, file.string()));
    COTAN_CHECK(checkLimits(scene, file.string(), limits));
    return scene;
} catch (const std::bad_alloc&) {
    return inputError(fmt::format("{}: not enough memory for the model", file.string()));
}

Result<Scene> loadAny(const fs::path& file, const LoadLimits& limits)
{
    if (limits.readFile)
        return loadGltf(file, limits);
    COTAN_TRY(size, usableFileSize(file, limits.fileBytes));
    const ModelFormat* format = modelFormatOf(file);
    if (!format)
        return inputError(fmt::format("{}: expected the extension {}, found \"{}\"", file.string(), modelFormats(true),
                                      file.extension().string()));
    if (!format->assimp && format->name != "OBJ")
        return loadGltf(file, limits);
    if (!limits.pose.animation.empty())
        return usageError(fmt::format("{}: only glTF animations are supported", file.string()));
    if (!limits.sandbox.program.empty())
        return loadSandboxed(file, *size, limits);
    return format->assimp ? loadWithAssimp(file, limits) : loadObj(file, limits);
}

} // namespace

Result<Scene> loadScene(const fs::path& file, const LoadLimits& limits)
{
    auto scene = loadAny(file, limits);
    // Readers continue with a warning if a texture must not be read, but here that is an error.
    if (const auto refused = firstRefusal())
        return *refused;
    if (scene && limits.up == Up::z)
        rotateZUpToYUp(*scene);
    return scene;
}

} // namespace cotan
