// Materials of formats other than glTF, with their images: what such files say, and one reading of it; and what their
// meshes share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include "cotan/model.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// Throws what is wrong with a file, without its name: what reads the file catches that and puts the name in front.
template<class... Args> [[noreturn]] void failModel(fmt::format_string<Args...> text, Args&&... args)
{
    throw inputError(fmt::format(text, std::forward<Args>(args)...));
}

// The image file that a model holds under a path; nothing where it holds none, and a file beside the model is meant.
using EmbeddedImage = std::function<std::optional<Result<std::span<const std::byte>>>(const std::string& path)>;

// Finds the images of a model, decodes each once, converts those that must be, and fills Scene::images. Whatever cannot
// be used becomes a warning and no image (-1).
class TextureReader {
public:
    // folder: canonical. All that is passed by reference must outlive this. embedded: empty where files hold none.
    TextureReader(Scene& scene, const std::filesystem::path& folder, const LoadLimits& limits,
                  EmbeddedImage embedded = {})
        : scene_(scene), folder_(folder), limits_(limits), embedded_(std::move(embedded))
    {
    }

    // The image that `path` names: an embedded one, or a file in the folder.
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
    int leaveOut(const std::string& path, const std::string& material, const std::string& why); // with a warning: -1
    LoadLimits withinBudget(std::uint64_t bytes);
    std::string overBudget() const; // why an image is left out
    int add(Image image);

    Scene& scene_;
    const std::filesystem::path& folder_;
    const LoadLimits& limits_;
    EmbeddedImage embedded_;
    std::size_t bytes_ = 0;            // of all images
    std::uint64_t fileBytes_ = 0;      // of their files
    std::map<std::string, int> known_; // what a path, or a conversion, gave
};

// A texture as a file names it, and how it is laid on.
struct SourceMap {
    std::string path;   // empty: none
    Texture use;        // without its image
    float strength = 1; // of a bump or normal map
};

struct SourceMaterial {
    std::string name;
    glm::vec3 color{0.8f};
    float opacity = 1;
    float shininess = 0; // Blinn-Phong's exponent; 0: unknown
    std::optional<float> roughness, metallic;
    glm::vec3 emission{0};
    SourceMap colorMap, opacityMap, roughnessMap, metalnessMap, normalMap, emissionMap, occlusionMap;
};

// The material, its images read. Colours of materials count as linear. What is odd or left out
// becomes a warning of the scene. Doubtful cases: black with a map means the map alone; opacity 0
// means opaque; a grey normal map is a height map; a normal map named for DirectX has green down.
Material makeMaterial(const SourceMaterial& source, TextureReader& textures, Scene& scene);

// Makes the stored normals of a mesh unit; where it has none, or one is no direction, all are made of its triangles.
// Merges equal vertices. unusable: what such normals are beside zero, for a warning.
void finishMesh(Mesh& mesh, std::string_view unusable, Scene& scene);

// Says, once, where a mesh lacks the texture coordinates that a map of its material needs.
void warnAboutTexcoords(const Mesh& mesh, Scene& scene);

} // namespace cotan
