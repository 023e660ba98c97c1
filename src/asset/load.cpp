#include "cotan/asset/load.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "extension.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 6> kAssimpExtensions = {".obj", ".ply", ".stl",
                                                               ".dae", ".fbx", ".3ds"};

// What can be said about a file before anyone reads it.
Status checkFile(const fs::path& file, const LoadLimits& limits)
{
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status))
        return inputError(fmt::format("{}: no such file", file.string()));
    if (fs::is_directory(status))
        return inputError(fmt::format("{}: expected a model file, found a folder", file.string()));
    if (!fs::is_regular_file(status))
        return inputError(fmt::format("{}: expected a regular file", file.string()));
    const std::uintmax_t size = fs::file_size(file, error);
    if (error)
        return inputError(fmt::format("{}: {}", file.string(), error.message()));
    if (size == 0)
        return inputError(fmt::format("{}: the file is empty", file.string()));
    if (size > limits.fileBytes)
        return inputError(fmt::format("{}: the file has {} bytes, the limit is {}", file.string(),
                                      size, limits.fileBytes));
    return Done{};
}

} // namespace

Result<Scene> loadScene(const fs::path& file, const LoadLimits& limits)
{
    if (Status usable = checkFile(file, limits); !usable)
        return usable.error();
    const std::string extension = lowerExtension(file);
    if (extension == ".gltf" || extension == ".glb")
        return loadGltf(file, limits);
    if (std::ranges::find(kAssimpExtensions, extension) != kAssimpExtensions.end())
        return loadWithAssimp(file, limits);
    return inputError(fmt::format(
        "{}: expected the extension .gltf .glb .obj .ply .stl .dae .fbx or .3ds, found \"{}\"",
        file.string(), file.extension().string()));
}

} // namespace cotan
