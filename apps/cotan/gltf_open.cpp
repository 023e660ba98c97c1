#include "gltf_open.hpp"

#include <fmt/format.h>

#include "cotan/model.hpp"
#include "files/bytes.hpp"
#include "loading.hpp"
#include "maps/textures/make_texture.hpp"

namespace cotan::app {

bool namedAsGltf(const std::filesystem::path& file)
{
    const std::string extension = lowerExtension(file);
    return extension == ".gltf" || extension == ".glb";
}

Status checkGltfNames(const std::string& model, const std::filesystem::path& output)
{
    if (!namedAsGltf(model))
        return usageError(fmt::format("{}: expected a .gltf or .glb model", model));
    if (output.empty())
        return Done{};
    if (!namedAsGltf(output))
        return usageError(fmt::format("-o: expected a file that ends in .glb or .gltf; found '{}'", output.string()));
    return Done{};
}

Result<OpenGltf> openGltfToEdit(const std::string& model, const LoadLimits& limits, const CommonOptions& common)
{
    const ProgressLine loading(common.quiet, 0, "loading " + model);
    auto opened = openGltf(model, limits);
    if (opened)
        for (const std::string& line : opened->scene.warnings)
            warn(common, line);
    return opened;
}

std::vector<std::string> fileNames(const GltfWritten& written)
{
    std::vector<std::string> names;
    for (const auto& file : written.files)
        names.push_back(file.string());
    return names;
}

void addModelCompress(Arguments& command, std::string& compress)
{
    command
        .option("--compress", compress,
                "store the normal maps of a model as KTX2 with all their levels: none; uastc (KHR_texture_basisu, for "
                "every browser and device) or astc-4x4 to astc-8x8 (EXT_texture_astc, for phones)")
        .in("NAME")
        .offers(maps::modelCompressionWords());
}

Status checkModelCompress(const std::string& compress)
{
    const Status known = maps::checkModelCompression(compress);
    return known ? known : withOptionNames(known.error());
}

} // namespace cotan::app
