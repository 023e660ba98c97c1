// Scenes to draw: images, materials, meshes, instances, lights and cameras as plain structs. No files, no GPU.
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
// World space is right-handed, with y up, in metres. loadScene of cotan/model.hpp reads scenes from files.
#pragma once

#include <array>
#include <compare>
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

// Four components per pixel (red, green, blue, alpha), rows from the top, no padding. Grey files are expanded to RGB; a
// missing alpha is 1. Values are as stored in the file: how they are used decides whether they are sRGB or linear.
struct Image {
    std::string name; // for messages: the file name, or how the image was made
    int width = 0;    // pixels
    int height = 0;   // pixels
    PixelType type = PixelType::unorm8;
    std::vector<std::byte> data; // width * height * 4 * bytesPerComponent(type)
    // Name of the frame that a normal map was made for, from the file's metadata (key cotanFrame of PNG, EXR and KTX2):
    // any word of up to 64 characters, not only names that frameFromName accepts. Empty if the file does not name one.
    std::string frame = {};
    // Number of channels in the file: 1 grey, 2 (KTX2 and DDS: red and green; others: grey and alpha), 3 or 4. 4 if
    // unknown.
    int channels = 4;
    // The word of --compress for the blocks that the file holds, bc1, etc2 or etc1s. Empty: pixels, or other blocks.
    std::string blocks = {};
    std::vector<std::byte> jpeg = {}; // the file, if it is a JPEG and LoadLimits::keepsJpeg is set

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

// Whether every texel of an integer image has the maximum alpha; false for floats. Requires hasPixels(image).
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

// Returns an image of the given size with all bytes zero.
Image makeImage(int width, int height, PixelType type, std::string name = {});

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

// How a material samples an image. The mesh's (u,v) becomes (dot(uRow.xy, uv) + uRow.z, dot(vRow.xy, uv) + vRow.z):
// KHR_texture_transform as a matrix. v = 0 is the top row of the image.
struct Texture {
    int image = -1;   // index into Scene::images; -1: none
    int texcoord = 0; // uv set, 0 or 1
    Sampler sampler;
    glm::vec3 uRow{1, 0, 0};
    glm::vec3 vRow{0, 1, 0};

    bool present() const { return image >= 0; }
};

enum class AlphaMode { opaque, mask, blend };

// A clear layer over the material (KHR_materials_clearcoat).
struct Coat {
    float strength = 0; // 0 to 1
    float roughness = 0;
    float normalScale = 1;   // factor on the slopes
    Convention normalFormat; // how normalMap is stored
    Texture map;             // linear: r, times strength
    Texture roughnessMap;    // linear: g, times roughness
    Texture normalMap;       // linear
};

// Anisotropic highlights (KHR_materials_anisotropy).
struct Anisotropy {
    float strength = 0; // 0 to 1
    float rotation = 0; // radians, from +u towards -v
    Texture map;        // linear: r and g direction, 2c - 1, along +u and -v; b times strength
};

// Reflection of dielectrics (KHR_materials_ior, KHR_materials_specular).
struct Specular {
    float ior = 1.5f;         // index of refraction, at least 1; 0: infinite
    float strength = 1;       // 0 to 1
    glm::vec3 color{1, 1, 1}; // linear, reflection at normal incidence
    Texture map;              // linear: a, times strength
    Texture colorMap;         // sRGB
};

// Reflection of cloth fibres (KHR_materials_sheen).
struct Sheen {
    glm::vec3 color{0, 0, 0}; // linear, 0 to 1; black: none
    float roughness = 0;      // 0 to 1
    Texture colorMap;         // sRGB
    Texture roughnessMap;     // linear: a, times roughness

    bool present() const { return color != glm::vec3(0); }
};

// Transmission as through a thin sheet (KHR_materials_transmission).
struct Transmission {
    float strength = 0; // 0 to 1
    Texture map;        // linear: r, times strength
};

// Heights below the surface. Renderers look up all maps of the material where the line of sight meets the heights, and
// let them shadow each other (shaders/cotan/parallax.h). Seen from the front only; depth and outline stay the
// surface's.
struct HeightMap {
    Texture map;     // linear: r, 1 is the surface and 0 lies `depth` below it
    float depth = 0; // world units, at least 0; 0: the surface as it is

    bool present() const { return map.present() && depth > 0; }
};

// Steps of a ray through heights: the power of two, within these limits, at which a step is at most a texel. The first
// reading below the heights ends them, and the last step is halved. Details thinner than a step can be missed.
inline constexpr int kMinHeightSteps = 16, kMaxHeightSteps = 256, kHeightHalvings = 8;

struct Material {
    std::string name;
    glm::vec4 baseColor{1, 1, 1, 1}; // linear, alpha
    float metallic = 1;
    float roughness = 1;
    glm::vec3 emissive{0, 0, 0}; // linear, KHR_materials_emissive_strength multiplied in
    float occlusionStrength = 1;
    float normalScale = 1;            // factor on the slopes
    Convention normalFormat;          // how normalMap is stored; v runs down, as everywhere in a scene
    std::optional<Frame> normalFrame; // frame of the normal maps, if the file names one
    // Whether green of the normal maps and w of the meshes' tangents are flipped relative to the file
    // (scene/normal_maps.hpp).
    bool greenReversed = false;
    int copyOf = -1;      // index of the material that this one was copied from, for the same reason; -1: it is no copy
    Texture baseColorMap; // sRGB, alpha linear
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
    HeightMap heightMap;
    std::string tangentsFor; // an extension that reads tangents and whose maps are not converted; or empty

    // Whether surfaces behind this one are visible through it.
    bool translucent() const { return alphaMode == AlphaMode::blend || transmission.strength > 0; }
    // Whether the surface blocks light: all of it if opaque, where the mask keeps it if masked, the fraction alpha if
    // blended. Transmissive materials cast no shadow, like clear glass.
    bool castsShadow() const { return !(transmission.strength > 0); }
    // Whether reflections differ from plain metallic-roughness, or part of the light is transmitted.
    bool glossy() const
    {
        const bool plain = specular.ior == 1.5f && specular.strength == 1 && specular.color == glm::vec3(1)
            && !specular.map.present() && !specular.colorMap.present();
        return !plain || anisotropy.strength > 0 || transmission.strength > 0;
    }
};

// A primitive of a glTF file.
struct SourcePrimitive {
    std::size_t mesh = 0, primitive = 0; // indices in the file

    auto operator<=>(const SourcePrimitive&) const = default;
};

// Triangles with one material. Every attribute array is empty or has vertexCount() entries.
struct Mesh {
    std::string name;
    int material = 0; // index into Scene::materials, always valid
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  // always present after loading; unit, or zero if unknown
    std::vector<glm::vec4> tangents; // as in glTF, for the uv that the normal map reads: xyz, w = +-1; or empty
    std::array<std::vector<glm::vec2>, 2> texcoords;
    std::vector<glm::vec4> colors;      // linear; factors on the base colour
    std::vector<glm::vec3> cotangentsU; // derived for the frame `smooth`; otherwise empty
    std::vector<glm::vec3> cotangentsV;
    // A skinned mesh before its skin moved it, and the columns of the matrix that moved each vertex; otherwise empty.
    // Vectors at vertices are made there and then moved, as engines do.
    std::vector<glm::vec3> bindPositions, bindNormals;
    std::array<std::vector<glm::vec3>, 3> skin;
    std::vector<std::uint32_t> indices;    // three per triangle, each < vertexCount()
    std::optional<SourcePrimitive> source; // in the glTF file that it was read from
    std::optional<Frame> named;            // frame that the primitive names in the file; none: that of its material
    std::optional<Frame> readWith;         // frame for a view with View::framesOfMeshes; none: View::frame

    std::size_t vertexCount() const { return positions.size(); }
    std::size_t triangleCount() const { return indices.size() / 3; }
};

struct Instance {
    std::string name;
    int mesh = 0;         // index into Scene::meshes
    glm::mat4 toWorld{1}; // affine; any scale, including mirroring
};

enum class LightKind { directional, point, spot };

struct Light {
    LightKind kind = LightKind::directional;
    glm::vec3 color{1, 1, 1};      // linear, times intensity
    float intensity = 3;           // directional: lux, perpendicular to the light; point, spot: candela
    glm::vec3 position{0, 0, 0};   // world
    glm::vec3 direction{0, -1, 0}; // world, unit, direction in which the light travels
    float range = 0;               // metres; 0: infinite
    float innerCone = 0;           // radians from the axis
    float outerCone = 0.78539816f;
};

struct Camera {
    std::string name;
    bool orthographic = false;
    float verticalFieldOfView = 0.78539816f; // radians, perspective: 45 degrees
    float verticalExtent = 2;                // world units from bottom to top, orthographic
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
    // World points that bound the scene over a whole animation, not only at the current time. Cameras frame these
    // points, and the ground is placed below them. Empty if nothing moves.
    std::vector<glm::vec3> reach;
    std::vector<std::string> warnings; // one line each: the problem found, and how it was handled
};

// World-space bounding box of all instances; low > high if empty.
struct Bounds {
    glm::vec3 low{1e30f};
    glm::vec3 high{-1e30f};
    bool empty() const { return low.x > high.x; }
    glm::vec3 centre() const { return (low + high) * 0.5f; }
};

// ---- built-in shapes and maps --------------------------------------------------------------

// Analytic shapes. Each has outward normals, uv set 0, and triangles that are counter-clockwise seen from outside. As
// in glTF, v = 0 is the top row of the image. `segments` is the number of cells along u.
Mesh makePlane(float side, int segments, float uvRepeat); // in the xz plane, facing +y, centred
Mesh makeCube(float side, float uvRepeat);                // six faces, split at the edges
Mesh makeSphere(float radius, int segments);              // latitude-longitude, poles split
Mesh makeTorus(float majorRadius, float minorRadius, int segments, float repeatU, float repeatV);
// The 32 patches of M. Newell's teapot, one unit high, resting on y = 0, with the spout along +x. Every patch covers
// the unit square of uv: u runs around, v runs down the pot and along handle and spout.
Mesh makeTeapot(int segmentsPerPatch);
// A centred unit square in the xy plane facing +z. Its uv are L^-1 p with L = [stretch, shear; 0, 1], where p is
// measured right and down from the top left corner; `mirrored` negates u. (Figure 2.6.4 of the 2006 chapter.)
Mesh makePatch(float stretch, float shear, bool mirrored, int segments);

enum class Relief { domes, bricks, waves };

// A height and its derivatives at (u,v), periodic over the unit square, with v downwards.
struct HeightSample {
    double h = 0, hu = 0, hv = 0; // in uv units
};
HeightSample relief(Relief kind, double u, double v);

// The normal map of a relief, from its analytic derivatives: 8 bit, exact expansion, green against +v (glTF). side:
// pixels; each texel is sampled at its centre.
Image makeReliefMap(Relief kind, int side);

// A single shape of white plastic, for viewing maps: "plane" (upright), "sphere", "torus" or "teapot"; any other name
// gives the plane. It is about 2 units high. The torus repeats its texture six times around, the sphere twice.
Scene shapeScene(const std::string& shape);

// The scene of `cotan render` without a model: the teapot and a few shapes with normal maps. No tangents are stored.
Scene builtinScene();

} // namespace cotan
