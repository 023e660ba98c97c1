// Materials and images of formats other than glTF, converted in one common way, and mesh functions that these formats
// share.
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

// Throws an error about a file, without the file name, which the catching reader prepends.
template<class... Args> [[noreturn]] void failModel(fmt::format_string<Args...> text, Args&&... args)
{
    throw inputError(fmt::format(text, std::forward<Args>(args)...));
}

// Returns the image file embedded in a model under `path`; nothing if there is none and `path` names a separate file.
using EmbeddedImage = std::function<std::optional<Result<std::span<const std::byte>>>(const std::string& path)>;

// Finds the images of a model, decodes each once, converts them if necessary, and fills Scene::images. An unusable
// image becomes a warning and the index -1.
class TextureReader {
public:
    // folder: canonical. References must outlive this object. embedded: empty if the format has no embedded images.
    TextureReader(Scene& scene, const std::filesystem::path& folder, const LoadLimits& limits,
                  EmbeddedImage embedded = {})
        : scene_(scene), folder_(folder), limits_(limits), embedded_(std::move(embedded))
    {
    }

    // Returns the image that `path` names, embedded or a file in the folder. A path that does not exist, for example of
    // another machine, is looked up by its file name. material: for messages.
    int image(const std::string& path, const std::string& material);

    // Like image(), but a grey image is taken as a height map and converted to a normal map with its depth scaled by
    // `strength`; `converted` is set.
    int normalMap(const std::string& path, const std::string& material, float strength, bool& converted);

    // Combines two images into one: green is the red of `roughness`, blue the red of `metallic`. -1 counts as white; if
    // both are -1, returns -1. The result has the larger width and height.
    int metallicRoughness(int roughness, int metallic);

private:
    int load(const std::string& path, const std::string& material);
    int leaveOut(const std::string& path, const std::string& material, const std::string& why); // warns; returns -1
    LoadLimits withinBudget(std::uint64_t bytes);
    std::string overBudget() const; // the reason for leaving an image out
    int add(Image image);

    Scene& scene_;
    const std::filesystem::path& folder_;
    const LoadLimits& limits_;
    EmbeddedImage embedded_;
    std::size_t bytes_ = 0;            // of all decoded images
    std::uint64_t fileBytes_ = 0;      // of all image files
    std::map<std::string, int> known_; // image by path or by description of a conversion
};

// A texture reference of a file.
struct SourceMap {
    std::string path;   // empty: none
    Texture use;        // transform, sampler and uv set; its image is not set
    float strength = 1; // of a bump or normal map
};

struct SourceMaterial {
    std::string name;
    glm::vec3 color{0.8f};
    float opacity = 1;
    float shininess = 0; // Blinn-Phong exponent; 0: unknown
    std::optional<float> roughness, metallic;
    glm::vec3 emission{0};
    SourceMap colorMap, opacityMap, roughnessMap, metalnessMap, normalMap, emissionMap, occlusionMap;
};

// Makes the material and reads its images. Material colours count as linear. Unusual or unsupported content becomes a
// warning of the scene. Ambiguous cases: a black base colour with a map means the map alone; opacity 0 means opaque; a
// grey normal map is a height map; a normal map with a DirectX name has green down.
Material makeMaterial(const SourceMaterial& source, TextureReader& textures, Scene& scene);

// Normalises the stored normals of a mesh; if there are none, or one has no direction, all are generated from the
// triangles. Merges equal vertices. unusable: the format's word for bad normals other than zero, for a warning.
void finishMesh(Mesh& mesh, std::string_view unusable, Scene& scene);

// Warns once if a mesh lacks the texture coordinates that a map of its material needs.
void warnAboutTexcoords(const Mesh& mesh, Scene& scene);

} // namespace cotan
