#include "gltf_open.hpp"

#include <algorithm>
#include <cctype>
#include <system_error>

#include <fmt/format.h>

#include "cotan/asset/load.hpp"

namespace cotan::app {

bool namedAsGltf(const std::filesystem::path& file)
{
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return extension == ".gltf" || extension == ".glb";
}

Status checkGltfNames(const std::string& model, const std::filesystem::path& output)
{
    if (!namedAsGltf(model))
        return usageError(fmt::format("{}: expected a .gltf or .glb model", model));
    if (output.empty())
        return Done{};
    const auto extension = output.extension();
    if (extension != ".glb" && extension != ".gltf")
        return usageError(fmt::format("-o: expected a file that ends in .glb or .gltf; found '{}'", output.string()));
    const std::filesystem::path folder = output.has_parent_path() ? output.parent_path() : ".";
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored))
        return outputError(fmt::format("{}: the folder {} does not exist", output.string(), folder.string()));
    return Done{};
}

Result<OpenedGltf> openGltfToEdit(const std::string& model, const CommonOptions& common)
{
    auto scene = loadGltf(model);
    if (!scene)
        return scene.error();
    for (const std::string& line : scene->warnings)
        warn(common, line);
    auto document = openGltfDocument(model);
    if (!document)
        return document.error();
    return OpenedGltf{std::move(*document), std::move(scene->warnings)};
}

} // namespace cotan::app
