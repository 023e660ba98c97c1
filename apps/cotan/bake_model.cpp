// `cotan bake -o OUT.glb`: the low model with the map in it.
#include "bake_options.hpp"

#include <fmt/format.h>

#include "cotan/convert/put_map.hpp"
#include "cotan/image/file.hpp"
#include "gltf_open.hpp"

namespace cotan::app {

Status checkModelOutput(const BakeCommandOptions& o)
{
    if (!namedAsGltf(o.common.output))
        return Done{};
    if (o.kind != "normal")
        return usageError(fmt::format("-o {}: a model takes a map of the kind normal; found {}", o.common.output.string(), o.kind));
    if (o.bits == 32)
        return usageError(fmt::format("-o {}: expected --bits 8 or 16, as a picture in a model has; found 32", o.common.output.string()));
    if (o.udim != 1001)
        return usageError(fmt::format("-o {}: one map covers tile 1001 of the texture coordinates only; found --udim {}",
                                      o.common.output.string(), o.udim));
    return Done{};
}

Status writeBakedModel(const BakeCommandOptions& o, const BakeJob& job, const Image& map)
{
    auto document = namedAsGltf(o.low) ? openGltfDocument(o.low) : gltfDocumentOf(job.lowScene);
    if (!document)
        return document.error();
    auto png = encodePng(map);
    if (!png)
        return png.error();
    PutMapOptions options;
    options.frame = job.frame();
    if (o.material >= 0) // a scene numbers its materials as meshes use them
        options.material = job.lowScene.materials[std::size_t(o.material)].name;
    options.keepTangents = job.setup.storedTangents;
    std::vector<std::string> notes;
    if (Status put = putNormalMap(*document, std::move(*png), options, notes); !put)
        return inWordsOfCommand(o, put.error());
    const auto written = writeGltf(*document, o.common.output);
    if (!written)
        return written.error();
    for (const std::string& note : notes)
        warn(o.common, note);
    for (const std::string& note : written->notes)
        warn(o.common, note);
    return Done{};
}

} // namespace cotan::app
