#include "gltf_model.hpp"

#include <algorithm>

#include "animate.hpp"
#include "unpack.hpp"
#include "variant.hpp"

namespace cotan {

void readGltfModel(GltfModel& model)
{
    checkGltfShape(model.file.json, model.limits, model.warnings);
    loadGltfBuffers(model.file, model.limits);
    unpackGltf(model.file, model.limits);
    chooseGltfVariant(model);
    model.structure = gltf::readStructure(model.file.json);
    findGltfAccessors(model);
    poseGltf(model);
}

void takeGltfBytes(GltfModel& model, std::size_t bytes, const std::string& field)
{
    const std::size_t most = gltfAllowance(model);
    if (bytes > most - std::min(model.bytesTaken, most))
        failGltf("{}: the geometry takes {} bytes with it, the limit is {} for a file of {}", field,
                 model.bytesTaken + bytes, most, model.file.size);
    model.bytesTaken += bytes;
}

} // namespace cotan
