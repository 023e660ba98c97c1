// Images of models other than glTF: found, decoded once, converted where they must be.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include "cotan/model.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

struct aiScene;
struct aiTexture;

namespace cotan {

// Fills Scene::images. Whatever cannot be used becomes a warning and no image (-1).
class TextureReader {
public:
    // source: where embedded textures are; null: there are none. folder: canonical. Everything passed
    // must outlive this.
    TextureReader(Scene& scene, const aiScene* source, const std::filesystem::path& folder, const LoadLimits& limits)
        : scene_(scene), source_(source), folder_(folder), limits_(limits)
    {
    }

    // The image that `path` names: a file in the folder, or "*N", the Nth texture of the file.
    // A path from another machine is looked up by its last part. material: for messages.
    int image(const std::string& path, const std::string& material);

    // As image(); a grey picture is taken as heights and becomes a normal map, `strength` times as
    // deep, and `converted` is set.
    int normalMap(const std::string& path, const std::string& material, float strength, bool& converted);

    // One image with the roughness in green and the metalness in blue, from the red of two.
    // Either may be -1: it counts as white. Both -1: -1. The larger one gives the size.
    int metallicRoughness(int roughness, int metallic);

private:
    int load(const std::string& path, const std::string& material);
    Result<Image> embedded(const aiTexture& texture, const std::string& name);
    int leaveOut(const std::string& path, const std::string& material, const std::string& why); // with a warning: -1
    LoadLimits withinBudget(std::uint64_t bytes);
    std::string overBudget() const; // why an image is left out
    int add(Image image);

    Scene& scene_;
    const aiScene* source_;
    const std::filesystem::path& folder_;
    const LoadLimits& limits_;
    std::size_t bytes_ = 0;            // of all images
    std::uint64_t fileBytes_ = 0;      // of their files
    std::map<std::string, int> known_; // what a path, or a conversion, gave
};

} // namespace cotan
