// glTF materials and the images they use.
#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "cotan/scene.hpp"
#include "gltf_model.hpp"

namespace cotan {

// Makes the scene's materials as meshes ask for them, so that only what is drawn is kept, and
// collects which images that needs.
class GltfMaterials {
public:
    GltfMaterials(GltfModel& model, Scene& scene) : model_(model), scene_(scene) {}

    // The index in Scene::materials of the file's material (-1: the default material) as this
    // mesh can use it: textures whose uv set the mesh lacks are left out and said.
    int use(int material, const Mesh& mesh);

    // Decodes all images that `use` met, in parallel. Throws GltfProblem for the first that cannot
    // be read, by its number in the file.
    void decodeImages();

    // Looks at the images that `use` has not met, without decoding them: those that are not inside
    // the model's folder, or are a PNG without its header, are named in a warning. Where nothing is
    // drawn, throws GltfProblem for the first.
    void checkUnusedImages() const;

private:
    Texture texture(const gltf::TextureUse& use, const Mesh& mesh, const std::string& field);
    Material make(int material, const Mesh& mesh);
    int firstEqual(int image);
    std::uint64_t bytesOfFiles() const;

    GltfModel& model_;
    Scene& scene_;
    std::map<std::pair<int, int>, int> made_; // (material, which uv sets) to scene material
    std::map<int, int> slots_;                // image of the file to Scene::images
    // Images in views: by where their bytes are, and by size and bytes.
    std::map<std::pair<const char*, std::size_t>, int> imagesAt_;
    std::map<std::pair<std::size_t, std::string_view>, int> imagesLike_;
};

} // namespace cotan
