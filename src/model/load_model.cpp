#include "cotan/model.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include "files/bytes.hpp"
#include "files/file_registry.hpp"
#include "sandboxed_models.hpp"
#include "scene/up.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 5> kAssimpExtensions = {".ply", ".stl", ".dae", ".fbx", ".3ds"};

Result<Scene> loadAny(const fs::path& file, const LoadLimits& limits)
{
    if (limits.readFile)
        return loadGltf(file, limits);
    if (const auto size = usableFileSize(file, limits.fileBytes); !size)
        return size.error();
    const std::string extension = lowerExtension(file);
    if (extension == ".gltf" || extension == ".glb")
        return loadGltf(file, limits);
    if (!limits.pose.animation.empty())
        return usageError(fmt::format("{}: animations are read from glTF alone", file.string()));
    const bool assimp = std::ranges::find(kAssimpExtensions, extension) != kAssimpExtensions.end();
    if (assimp || extension == ".obj") {
        if (!limits.sandbox.program.empty())
            return loadSandboxed(file, limits);
        return assimp ? loadWithAssimp(file, limits) : loadObj(file, limits);
    }
    return inputError(
        fmt::format("{}: expected the extension .gltf .glb .obj .ply .stl .dae .fbx or .3ds, found \"{}\"",
                    file.string(), file.extension().string()));
}

} // namespace

Result<Scene> loadScene(const fs::path& file, const LoadLimits& limits)
{
    auto scene = loadAny(file, limits);
    // A model is read on without a texture that must not be read, with a warning; that is not enough here.
    if (const auto refused = refusal())
        return *refused;
    if (scene && limits.up == Up::z)
        turnZUp(*scene);
    return scene;
}

} // namespace cotan
