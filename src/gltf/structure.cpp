#include <limits>

#include "model.hpp"

namespace cotan {

tinygltf::Model parseGltfStructure(nlohmann::json& json)
{
    nlohmann::json structure = std::move(json);
    json = nlohmann::json::object();
    for (const char* const ours : {"buffers", "images"})
        if (structure.contains(ours))
            json[ours] = std::move(structure[ours]);
    for (const char* const unused : {"buffers", "images", "animations", "extras"})
        structure.erase(unused);
    const std::string text = structure.dump();
    structure = nullptr;
    if (text.size() > std::numeric_limits<unsigned>::max())
        failGltf("JSON: the structure has {} bytes, the limit is 4 GiB", text.size());
    tinygltf::Model model;
    tinygltf::TinyGLTF parser;
    std::string problem;
    std::string warning;
    if (!parser.LoadASCIIFromString(&model, &problem, &warning, text.data(),
                                    static_cast<unsigned>(text.size()), ""))
        failGltf("{}", problem.empty() ? "not a valid glTF structure" : problem);
    return model;
}

} // namespace cotan
