// The collections of a glTF file as plain values, in its order: all but accessors and buffer views, which
// model.hpp has with their bytes.
#pragma once

#include <utility>
#include <vector>

#include "gltf/json/views.hpp"

namespace cotan::gltf {

// A material without its textures, and how it uses those.
struct MaterialSource {
    Material factors;
    TextureUse baseColor, metallicRoughness, normal, occlusion, emissive;
    TextureUse coat, coatRoughness, coatNormal, anisotropy, specular, specularColor, sheenColor, sheenRoughness,
        transmission;
    std::string frame; // that the maps were made for, by the extras; empty if they say nothing
};

// Lights and cameras stand at the origin and look along -z, until a node places them.
struct Structure {
    std::vector<std::vector<int>> scenes; // the nodes that each lists
    int defaultScene = -1;
    std::vector<Node> nodes;
    std::vector<Mesh> meshes;
    std::vector<Skin> skins;
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    std::vector<MaterialSource> materials;
    std::vector<Texture> textures;
    std::vector<Image> images; // their URIs point into the JSON
    std::vector<Sampler> samplers;
};

// root: has passed checkGltfShape. Throws GltfProblem where a camera or a spot light is not described.
Structure readStructure(const Json& root);

// Calls read(object) for each of a collection of the root, or of an extension of it.
template<class Read> auto readAll(const Json* owner, const char* collection, const Read& read)
{
    std::vector<decltype(read(std::declval<const Json&>()))> all;
    if (const Json* const list = owner ? member(*owner, collection) : nullptr) {
        all.reserve(list->size());
        for (const Json& item : *list)
            all.push_back(read(item));
    }
    return all;
}

} // namespace cotan::gltf
