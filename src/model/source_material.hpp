// Materials of formats other than glTF: what such files say, and one reading of it; and what their meshes share.
#pragma once

#include <optional>
#include <string>

#include <glm/vec3.hpp>

#include "cotan/scene.hpp"
#include "model_textures.hpp"

namespace cotan {

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

inline constexpr float kCreaseDegrees = 60; // where the normals of a mesh are made

// Says, once, where a mesh lacks the texture coordinates that a map of its material needs.
void warnAboutTexcoords(const Mesh& mesh, Scene& scene);

} // namespace cotan
