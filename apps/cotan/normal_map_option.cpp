#include "normal_map_option.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "cotan/maps/texels.hpp"
#include "cotan/scene/normal_format.hpp"
#include "cotan/scene/put_normal_map.hpp"
#include "map_options.hpp"

namespace cotan::app {

namespace {

const NormalMapOption kDefaults;

// Whether a mesh with one of the chosen materials has the uv set that the map is read with.
bool anyMeshShows(const Scene& scene, int material)
{
    return std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& mesh) {
        const Texture& map = scene.materials[std::size_t(mesh.material)].normalMap;
        return (material < 0 || mesh.material == material)
            && !mesh.texcoords[std::size_t(map.present() ? map.texcoord : 0)].empty();
    });
}

} // namespace

void addNormalMapOption(Arguments& a, NormalMapOption& o)
{
    a.option("--normal-map", o.file,
             "image that takes the place of the model's normal maps, such as one that was just baked")
        .in("FILE");
    a.option("--convention", o.convention, "how that image is stored: " + conventionWords()).in("WORDS");
    a.option("--material", o.material, "number of the only material that gets it; -1: all").within(-1, 100000).in("N");
}

Status applyNormalMap(const NormalMapOption& o, int memory, Scene& scene)
{
    if (o.file.empty()) {
        if (o.convention != kDefaults.convention || o.material != kDefaults.material)
            return usageError(fmt::format("{}: expected --normal-map FILE with it; found none",
                                          o.material != kDefaults.material ? "--material" : "--convention"));
        return Done{};
    }
    const auto convention = parseConvention(o.convention, "--convention");
    if (!convention)
        return convention.error();
    if (convention->kind != MapKind::tangentSpace)
        return usageError(fmt::format("--convention: expected a map in tangent space; found '{}'", o.convention));
    if (o.material >= int(scene.materials.size()))
        return usageError(
            fmt::format("--material: expected 0 to {}; found {}", scene.materials.size() - 1, o.material));
    if (!anyMeshShows(scene, o.material))
        return inputError(
            fmt::format("{}: expected a mesh with texture coordinates to show {} on; found none", scene.name, o.file));
    auto image = readImageWithin(memory, o.file);
    if (!image)
        return image.error();
    if (convention->channels != Channels::xyz)
        maps::unswizzle(*image, maps::swizzleOf(*image));
    putNormalMap(scene, std::move(*image), inScene(*convention), o.material);
    return Done{};
}

} // namespace cotan::app
