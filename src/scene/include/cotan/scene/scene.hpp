// What there is to draw. Plain data, no files, no GPU. World space is right-handed, y up, metres.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/convention.hpp"
#include "cotan/frame.hpp"
#include "cotan/packed_only.hpp"
#include "cotan/scene/image.hpp"

namespace cotan {

enum class Wrap { repeat, mirror, clamp };
enum class Filter { nearest, linear };
enum class MipFilter { none, nearest, linear };

struct Sampler {
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    Filter magnify = Filter::linear;
    Filter minify = Filter::linear;
    MipFilter mip = MipFilter::linear;
};

// A use of an image by a material. (u,v) of the mesh becomes
// (dot(uRow.xy, uv) + uRow.z, dot(vRow.xy, uv) + vRow.z): KHR_texture_transform, flattened.
// v = 0 is the top row of the image.
struct Texture {
    int image = -1;   // index into Scene::images; -1: none
    int texcoord = 0; // 0 or 1: which uv set
    Sampler sampler;
    glm::vec3 uRow{1, 0, 0};
    glm::vec3 vRow{0, 1, 0};

    bool present() const { return image >= 0; }
};

enum class AlphaMode { opaque, mask, blend };

// A clear layer over the whole (KHR_materials_clearcoat).
struct Coat {
    float strength = 0; // 0 to 1
    float roughness = 0;
    float normalScale = 1;   // factor on the slopes
    Convention normalFormat; // how normalMap is stored
    Texture map;             // linear: r, times strength
    Texture roughnessMap;    // linear: g, times roughness
    Texture normalMap;       // linear
};

// Highlights that are stretched along the surface (KHR_materials_anisotropy).
struct Anisotropy {
    float strength = 0; // 0 to 1
    float rotation = 0; // radians, from +u towards -v
    Texture map;        // linear: r and g the direction, 2c - 1, along +u and -v; b, times strength
};

// What a dielectric reflects (KHR_materials_ior, KHR_materials_specular).
struct Specular {
    float ior = 1.5f;         // index of refraction, at least 1; 0: as if infinite
    float strength = 1;       // 0 to 1
    glm::vec3 color{1, 1, 1}; // linear, of light from the front
    Texture map;              // linear: a, times strength
    Texture colorMap;         // sRGB
};

// The fibres of cloth (KHR_materials_sheen).
struct Sheen {
    glm::vec3 color{0, 0, 0}; // linear, 0 to 1; black: none
    float roughness = 0;      // 0 to 1
    Texture colorMap;         // sRGB
    Texture roughnessMap;     // linear: a, times roughness

    bool present() const { return color != glm::vec3(0); }
};

// Light that passes as through a thin sheet (KHR_materials_transmission).
struct Transmission {
    float strength = 0; // 0 to 1
    Texture map;        // linear: r, times strength
};

struct Material {
    std::string name;
    glm::vec4 baseColor{1, 1, 1, 1}; // linear, alpha
    float metallic = 1;
    float roughness = 1;
    glm::vec3 emissive{0, 0, 0}; // linear, KHR_materials_emissive_strength multiplied in
    float occlusionStrength = 1;
    float normalScale = 1;            // factor on the slopes
    Convention normalFormat;          // how normalMap is stored; v runs down, as everywhere in a scene
    std::optional<Frame> normalFrame; // that the normal maps were made for, where the file says so
    // Green of the normal maps is the other way than the file declares, and so is w of the meshes' tangents: see
    // cotan/scene/stored_green.hpp.
    bool greenReversed = false;
    Texture baseColorMap;         // sRGB, alpha linear
    Texture metallicRoughnessMap; // linear: g roughness, b metallic
    Texture normalMap;            // linear
    Texture occlusionMap;         // linear: r
    Texture emissiveMap;          // sRGB
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;
    bool unlit = false;
    Coat coat;
    Anisotropy anisotropy;
    Specular specular;
    Sheen sheen;
    Transmission transmission;
    std::string tangentsFor; // an extension that reads tangents and whose maps are not converted; empty if none

    // What is behind it shows.
    bool translucent() const { return alphaMode == AlphaMode::blend || transmission.strength > 0; }
    // It stops light, by its alpha: opaque ones all of it, masked ones what their mask leaves, blended ones their
    // alpha's share. What transmits counts as clear glass.
    bool throwsShadow() const { return !(transmission.strength > 0); }
    // Its reflections are others than those of metallic-roughness, or take less than all light.
    bool glossy() const
    {
        const bool plain = specular.ior == 1.5f && specular.strength == 1 && specular.color == glm::vec3(1)
            && !specular.map.present() && !specular.colorMap.present();
        return !plain || anisotropy.strength > 0 || transmission.strength > 0;
    }
};

// Triangles with one material. Every attribute array is empty or has vertexCount() entries.
struct Mesh {
    std::string name;
    int material = 0; // index into Scene::materials, always valid
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  // always present after loading; unit, or zero where unknown
    std::vector<glm::vec4> tangents; // as stored in the file: xyz, w = +-1; empty if none
    std::array<std::vector<glm::vec2>, 2> texcoords;
    std::vector<glm::vec4> colors;      // linear, multiply the base colour
    std::vector<glm::vec3> cotangentsU; // derived for the frame `smooth`; empty if not made
    std::vector<glm::vec3> cotangentsV;
    std::vector<std::uint32_t> indices; // three a triangle, each < vertexCount()

    std::size_t vertexCount() const { return positions.size(); }
    std::size_t triangleCount() const { return indices.size() / 3; }
};

struct Instance {
    std::string name;
    int mesh = 0;         // index into Scene::meshes
    glm::mat4 toWorld{1}; // affine; any scale, mirroring included
};

enum class LightKind { directional, point, spot };

struct Light {
    LightKind kind = LightKind::directional;
    glm::vec3 color{1, 1, 1};      // linear, times intensity
    float intensity = 3;           // directional: lux / pi-free radiometric; point, spot: candela
    glm::vec3 position{0, 0, 0};   // world
    glm::vec3 direction{0, -1, 0}; // world, unit, the way the light travels
    float range = 0;               // metres; 0: infinite
    float innerCone = 0;           // radians from the axis
    float outerCone = 0.785398f;
};

struct Camera {
    std::string name;
    bool orthographic = false;
    float verticalFieldOfView = 0.785398f; // radians, perspective
    float verticalExtent = 2;              // world units from bottom to top, orthographic
    glm::vec3 eye{0, 0, 5};
    glm::vec3 target{0, 0, 0};
    glm::vec3 up{0, 1, 0};
};

struct Scene {
    std::string name;
    std::vector<Image> images;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    // World points that what moves in an animation reaches at all of its moments, not only this one: what cameras frame
    // and the ground lies under. Empty: it stands as it is.
    std::vector<glm::vec3> reach;
    std::vector<std::string> warnings; // one line each: what was odd, and what was done about it
};

// The smallest box around all instances, in world space; low > high where there is nothing.
struct Bounds {
    glm::vec3 low{1e30f};
    glm::vec3 high{-1e30f};
    bool empty() const { return low.x > high.x; }
    glm::vec3 centre() const { return (low + high) * 0.5f; }
};

} // namespace cotan
