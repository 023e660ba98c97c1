#include "bake_options.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "cotan/image/file.hpp"
#include "cotan/scene/put_normal_map.hpp"
#include "parse.hpp"

namespace cotan::app {

namespace {

// Makes the materials say what --high-map and --high-convention say.
Status applyMapOptions(const BakeCommandOptions& o, std::vector<Scene>& scenes)
{
    for (std::size_t i = 0; i < scenes.size() && !o.highMaps.empty(); ++i) {
        auto image = readImageWithin(o.memory, o.highMaps[std::min(i, o.highMaps.size() - 1)]);
        if (!image)
            return image.error();
        for (Material& material : scenes[i].materials)
            material.normalMap = {}; // the image is read by uv set 0 as it is
        putNormalMap(scenes[i], std::move(*image), {});
    }
    if (o.highConvention.empty())
        return Done{};
    const auto format = formatFromName("--high-convention", o.highConvention);
    if (!format)
        return format.error();
    for (Scene& scene : scenes)
        for (Material& material : scene.materials)
            material.normalFormat = *format;
    return Done{};
}

} // namespace

Status checkHighOptions(const BakeCommandOptions& o)
{
    const bool map = o.highNormals == "map";
    for (const auto& [option, given] : {std::pair("--high-map", !o.highMaps.empty()), {"--high-convention", !o.highConvention.empty()},
                                        {"--high-frame", !o.highFrame.empty()}})
        if (given && !map)
            return usageError(fmt::format("{}: expected --high-normals map with it; found {}", option, o.highNormals));
    if (o.highMaps.size() > 1 && o.highMaps.size() != o.high.size())
        return usageError(fmt::format("--high-map: expected one, or one for each of the {} --high; found {}", o.high.size(),
                                      o.highMaps.size()));
    if (!o.highConvention.empty())
        if (const auto format = formatFromName("--high-convention", o.highConvention); !format)
            return format.error();
    if (o.highFrame.empty())
        return Done{};
    const auto frame = frameFromName(o.highFrame);
    if (!frame)
        return usageError(fmt::format("--high-frame: expected one of {}; found '{}'", frameNames(), o.highFrame));
    if (dependsOnView(*frame))
        return usageError(fmt::format("--high-frame: the frame {} depends on the view: no map can be made for it", o.highFrame));
    return Done{};
}

Status prepareHigh(const BakeCommandOptions& o, BakeJob& job)
{
    std::vector<Scene> scenes;
    for (const std::string& file : o.high) {
        auto scene = loadSceneWithin(o.memory, file, o.highNormals == "map" ? Pixels::all : Pixels::none);
        if (!scene)
            return scene.error();
        scenes.push_back(std::move(*scene));
    }
    auto high = HighSurface::make(scenes, o.common.threads);
    if (!high)
        return high.error();
    job.options.highNormals = o.highNormals == "curved" ? HighNormals::curved
        : o.highNormals == "face"                       ? HighNormals::face
                                                        : HighNormals::smooth;
    if (job.options.highNormals == HighNormals::curved)
        high->curve(o.common.threads);
    job.high.push_back(std::move(*high));
    if (o.highNormals != "map")
        return Done{};
    if (job.options.kind == BakeKind::height || job.options.kind == BakeKind::occlusion) {
        job.warnings.push_back(fmt::format("--high-normals map changes nothing in a map of the kind {}", o.kind));
        return Done{};
    }
    if (Status applied = applyMapOptions(o, scenes); !applied)
        return applied.error();
    for (const Scene& scene : scenes)
        for (const std::string& line : scene.warnings)
            if (std::find(job.lowScene.warnings.begin(), job.lowScene.warnings.end(), line) == job.lowScene.warnings.end())
                job.warnings.push_back(line); // once where both are one file
    const Frame frame = o.highFrame.empty() ? Frame::mikktspace : *frameFromName(o.highFrame);
    auto maps = HighNormalMaps::make(scenes, frame);
    if (!maps)
        return maps.error();
    if (const std::size_t bare = maps->instanceCount() - maps->mappedCount(); bare > 0)
        job.warnings.push_back(fmt::format("{} of {} high meshes have no normal map or no texture coordinates for it: smooth normals there",
                                           bare, maps->instanceCount()));
    job.options.highMaps = std::make_shared<const HighNormalMaps>(std::move(*maps));
    return Done{};
}

} // namespace cotan::app
