// What there is to draw: images, materials, meshes, instances, lights and cameras as plain structs. No files, no GPU.
//
//     cotan::Scene scene;
//     scene.images.push_back(cotan::makeReliefMap(cotan::Relief::waves, 512));
//     cotan::Material material;
//     material.normalMap.image = 0;
//     scene.materials.push_back(material);
//     scene.meshes.push_back(cotan::makeTorus(1, 0.4f, 96, 6, 2));
//     scene.instances.push_back({.name = "torus", .mesh = 0});
//     auto image = cotan::drawView(scene, view); // cotan/render.hpp; cotan/view.hpp has View
//
// World space is right-handed, y up, metres. Scenes also come from files: loadScene of cotan/model.hpp.
#pragma once

#include <array>
#include <cstddef>
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

namespace cotan {

// ---- images --------------------------------------------------------------------------------

enum class PixelType { unorm8, unorm16, float32 };

constexpr std::size_t bytesPerComponent(PixelType type)
{
    return type == PixelType::unorm8 ? 1 : type == PixelType::unorm16 ? 2 : 4;
}

constexpr int bitsPerComponent(PixelType type) { return int(8 * bytesPerComponent(type)); }

// Always four components a pixel, red green blue alpha, rows from the top, no padding.
// Grey files become r = g = b; a missing alpha becomes 1. The values are those of the file:
// whether they are sRGB or linear is decided by what they are used for.
struct Image {
    std::string name; // for messages: file name, or what it was made from
    int width = 0;    // pixels
    int height = 0;   // pixels
    PixelType type = PixelType::unorm8;
    std::vector<std::byte> data; // width * height * 4 * bytesPerComponent(type)
    // Name of the frame that a normal map was made for, as the file says it (key cotanFrame of PNG, EXR and KTX2): any
    // word of up to 64 characters, not only names that frameFromName knows. Empty: it is not said.
    std::string frame = {};
    // How many channels the file stores: 1 grey, 2 (red and green of KTX2 and DDS, others grey and alpha), 3, 4. 4 also
    // where nothing is known.
    int channels = 4;

    std::size_t pixelCount() const { return std::size_t(width) * std::size_t(height); }
    std::size_t bytesPerPixel() const { return 4 * bytesPerComponent(type); }

    std::uint8_t* bytes8() { return reinterpret_cast<std::uint8_t*>(data.data()); }
    const std::uint8_t* bytes8() const { return reinterpret_cast<const std::uint8_t*>(data.data()); }
    std::uint16_t* words() { return reinterpret_cast<std::uint16_t*>(data.data()); }
    const std::uint16_t* words() const { return reinterpret_cast<const std::uint16_t*>(data.data()); }
    float* floats() { return reinterpret_cast<float*>(data.data()); }
    const float* floats() const { return reinterpret_cast<const float*>(data.data()); }
};

// Whether an image has a size and all of its data.
inline bool hasPixels(const Image& image)
{
    return image.width > 0 && image.height > 0 && image.data.size() >= image.pixelCount() * image.bytesPerPixel();
}

// Whether every texel of an image of whole numbers has the largest alpha; false for floats. The image hasPixels.
inline bool isOpaque(const Image& image)
{
    const auto all = [&](const auto* components, auto largest) {
        for (std::size_t i = 3; i < 4 * image.pixelCount(); i += 4)
            if (components[i] != largest)
                return false;
        return true;
    };
    return image.type == PixelType::unorm8 ? all(image.bytes8(), 0xff)
        : image.type == PixelType::unorm16 ? all(image.words(), 0xffff)
                                           : false;
}

// An image of that size with every byte zero.
inline Image makeImage(int width, int height, PixelType type, std::string name = {})
{
    Image image;
    image.name = std::move(name);
    image.width = width;
    image.height = height;
    image.type = type;
    image.data.resize(image.pixelCount() * image.bytesPerPixel());
    return image;
}

// ---- the scene -----------------------------------------------------------------------------

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
    // scene/normal_maps.hpp.
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

// ---- built-in shapes and maps --------------------------------------------------------------

// Analytic, made in memory. Every shape has outward normals, uv set 0 and counter-clockwise triangles seen from
// outside. uv follow glTF: v = 0 at the top row of the image. `segments` is the number of cells along u.
Mesh makePlane(float side, int segments, float uvRepeat); // in xz, facing +y, centred
Mesh makeCube(float side, float uvRepeat);                // six faces, split at the edges
Mesh makeSphere(float radius, int segments);              // latitude-longitude, poles split
Mesh makeTorus(float majorRadius, float minorRadius, int segments, float repeatU, float repeatV);
// M. Newell's 32 patches, one high, resting on y = 0, the spout along +x. Every patch covers the
// unit square of uv: u around, v down the pot and along handle and spout.
Mesh makeTeapot(int segmentsPerPatch);
Mesh makeSpout(int segments); // bent, tapering, open tube; uv squashed at the tip
// A unit square patch in xy facing +z, centred, whose uv are p -> L^-1 p with L = [stretch, shear;
// 0, 1] and p measured rightwards and downwards from the top left corner; mirrored negates u.
// (Figure 2.6.4 of the 2006 chapter.)
Mesh makePatch(float stretch, float shear, bool mirrored, int segments);

enum class Relief { domes, bricks, waves };

// A height with its derivatives at (u,v), periodic in the unit square, v downwards.
struct HeightSample {
    double h = 0, hu = 0, hv = 0; // in uv units
};
HeightSample relief(Relief kind, double u, double v);

// The normal map of a relief from its analytic derivatives: 8 bit, exact expansion, green against
// +v (glTF). side: pixels, each texel sampled at its centre.
Image makeReliefMap(Relief kind, int side);

// One shape of white plastic alone, to look at maps on: "plane" (upright), "sphere", "torus" or "teapot"; the plane for
// all other names. It is about 2 units high; the torus repeats its texture six times around, the sphere twice.
Scene shapeScene(const std::string& shape);

// The built-in scene of `cotan render` without a model: a normal-mapped floor, the teapot and a
// few shapes; no tangent stored anywhere.
Scene builtinScene();

} // namespace cotan
