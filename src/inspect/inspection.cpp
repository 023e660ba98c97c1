#include "cotan/inspect.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

#include "bake/lint/lint_parts.hpp"
#include "image/component_types.hpp"
#include "inspect/angles.hpp"
#include "scene/normal_maps.hpp"
#include "scene/render_text.hpp"

namespace cotan {

namespace {

constexpr std::array<std::string_view, 18> kNames = {
    "checker",         "density",    "stretch",  "shear",      "mirrored",       "w",
    "facing",          "base-color", "alpha",    "normal-map", "normal-map-red", "normal-map-green",
    "normal-map-blue", "roughness",  "metallic", "occlusion",  "emissive",       "mask"};

constexpr glm::vec3 kBlue{0.20f, 0.45f, 0.85f}, kOrange{0.95f, 0.55f, 0.15f}, kRed{0.85f, 0.15f, 0.15f},
    kGrey{0.5f}; // sRGB

glm::vec3 linear(glm::vec3 srgb)
{
    for (int i = 0; i < 3; ++i)
        srgb[i] = f32::cotan_srgb_to_linear(srgb[i]);
    return srgb;
}

// The colours of a heat map: black, blue, green, yellow, red, white.
std::vector<glm::vec3> heatColors(const std::vector<float>& degrees)
{
    const Image heat = heatMap(degrees, int(degrees.size()), 1);
    std::vector<glm::vec3> colors;
    for (std::size_t i = 0; i < degrees.size(); ++i) {
        const std::uint8_t* p = heat.bytes8() + 4 * i;
        colors.push_back(glm::vec3(p[0], p[1], p[2]) / 255.0f);
    }
    return colors;
}

// Maps a value to the degrees of equal heat colour, linearly between the values at its six colour stops.
float asDegrees(double value, const std::array<double, 6>& stops)
{
    constexpr std::array<double, 6> kDegrees = {0, 0.5, 2, 5, 15, 45};
    for (std::size_t i = 1; i < stops.size(); ++i)
        if (value < stops[i])
            return float(kDegrees[i - 1]
                         + (kDegrees[i] - kDegrees[i - 1]) * std::max(0.0, value - stops[i - 1])
                             / (stops[i] - stops[i - 1]));
    return 45;
}

Material unlit(const Material& from)
{
    Material m;
    m.name = from.name;
    m.unlit = true;
    m.doubleSided = from.doubleSided;
    m.alphaMode = from.alphaMode == AlphaMode::mask ? AlphaMode::mask : AlphaMode::opaque;
    m.alphaCutoff = from.alphaCutoff;
    return m;
}

// Brighter above than below, to give uniform colours some shading.
float shapeOf(const glm::vec3& normal) { return 0.7f + 0.3f * normal.y; }

// Gives every triangle its own corners in the triangle's colour.
void paintTriangles(Mesh& mesh, const std::vector<glm::vec3>& colors, bool shaped)
{
    Mesh flat;
    flat.name = mesh.name;
    flat.material = mesh.material;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::size_t v = mesh.indices[i];
        flat.positions.push_back(mesh.positions[v]);
        flat.normals.push_back(mesh.normals[v]);
        flat.colors.emplace_back(linear(colors[i / 3]) * (shaped ? shapeOf(mesh.normals[v]) : 1.0f), 1.0f);
        flat.indices.push_back(std::uint32_t(i));
    }
    mesh = std::move(flat);
}

// The map that determines texel density and uv set: the normal map, else the base colour map.
const Texture& mapOf(const Material& m) { return m.normalMap.present() ? m.normalMap : m.baseColorMap; }

double texelsOf(const Scene& scene, const Material& m)
{
    if (!mapOf(m).present())
        return 1;
    const Image& image = scene.images[std::size_t(mapOf(m).image)];
    return std::sqrt(double(std::max(image.width, 1)) * std::max(image.height, 1));
}

using Values = std::vector<std::vector<float>>; // by mesh and triangle

Values degreesOf(const Scene& scene, Inspection inspection)
{
    const float none = inspection == Inspection::mirrored ? 0.0f : -1.0f; // value of triangles without area in uv
    std::vector<glm::mat3> toWorld(scene.meshes.size(), glm::mat3(1));    // of the first instance of each mesh
    for (auto instance = scene.instances.rbegin(); instance != scene.instances.rend(); ++instance)
        toWorld[std::size_t(instance->mesh)] = glm::mat3(instance->toWorld);
    Values values(scene.meshes.size());
    std::vector<double> densities;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        const Material& material = scene.materials[std::size_t(mesh.material)];
        const std::shared_ptr<const Mesh> held(std::shared_ptr<void>(), &mesh); // the scene outlives the surface
        const MappedSurface surface = makeSurface(held, mapOf(material), glm::dmat3(toWorld[m]), {});
        values[m].assign(mesh.triangleCount(), none);
        for (std::size_t i = 0; surface.hasUv() && i < mesh.triangleCount(); ++i) {
            const TriangleUv t = triangleUv(surface, i, edgesOf(surface, i));
            if (!t.usable || t.degenerate)
                continue;
            values[m][i] = inspection == Inspection::stretch ? asDegrees(t.stretch, {1, 1.1, 1.4, 2, 4, 10})
                : inspection == Inspection::shear            ? float(t.shear)
                : inspection == Inspection::density          ? float(t.density * texelsOf(scene, material))
                                                             : float(t.orientation);
            if (inspection == Inspection::density)
                densities.push_back(values[m][i]);
        }
    }
    if (inspection != Inspection::density || densities.empty())
        return values;
    const auto middle = densities.begin() + std::ptrdiff_t(densities.size() / 2);
    std::nth_element(densities.begin(), middle, densities.end());
    for (auto& mesh : values)
        for (float& v : mesh)
            v = v < 0 ? v : asDegrees(double(v) / *middle, {0, 0.25, 1, 2, 4, 16});
    return values;
}

void showTriangles(Scene& scene, Inspection inspection)
{
    const bool twoColors = inspection == Inspection::mirrored || inspection == Inspection::w;
    Values values = inspection == Inspection::w ? Values(scene.meshes.size()) : degreesOf(scene, inspection);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        Mesh& mesh = scene.meshes[m];
        if (inspection == Inspection::w)
            for (std::size_t i = 0; i < mesh.triangleCount(); ++i)
                values[m].push_back(mesh.tangents.empty() ? 0.0f : mesh.tangents[mesh.indices[3 * i]].w);
        std::vector<glm::vec3> colors;
        if (twoColors)
            for (const float side : values[m])
                colors.push_back(side == 0 ? kGrey : side > 0 ? kBlue : kOrange);
        else
            colors = heatColors(values[m]);
        paintTriangles(mesh, colors, twoColors);
    }
    for (Material& material : scene.materials)
        material = unlit(material);
    scene.images.clear();
}

// Draws each surface twice: as it is, and flipped in another colour; back faces are culled.
void showFacing(Scene& scene)
{
    const std::size_t meshes = scene.meshes.size(), instances = scene.instances.size();
    Material outside, inside;
    outside.unlit = inside.unlit = true;
    outside.baseColor = glm::vec4(linear(kBlue), 1);
    inside.baseColor = glm::vec4(linear(kRed), 1);
    scene.materials = {outside, inside};
    scene.images.clear();
    for (std::size_t m = 0; m < meshes; ++m) {
        Mesh& mesh = scene.meshes[m];
        mesh.material = 0;
        mesh.colors.clear();
        for (const glm::vec3& normal : mesh.normals)
            mesh.colors.emplace_back(glm::vec3(shapeOf(normal)), 1.0f);
        Mesh flipped = mesh;
        flipped.material = 1;
        for (std::size_t i = 0; i + 2 < flipped.indices.size(); i += 3)
            std::swap(flipped.indices[i + 1], flipped.indices[i + 2]);
        scene.meshes.push_back(std::move(flipped));
    }
    for (std::size_t i = 0; i < instances; ++i) {
        Instance flipped = scene.instances[i];
        flipped.mesh += int(meshes);
        scene.instances.push_back(std::move(flipped));
    }
}

// ---- maps ------------------------------------------------------------------------------------

struct MapOf {
    Texture Material::*slot;
    int channel; // -1: red, green and blue
};

MapOf mapFor(Inspection inspection)
{
    switch (inspection) {
    case Inspection::alpha: return {&Material::baseColorMap, 3};
    case Inspection::normalMap: return {&Material::normalMap, -1};
    case Inspection::normalMapRed: return {&Material::normalMap, 0};
    case Inspection::normalMapGreen: return {&Material::normalMap, 1};
    case Inspection::normalMapBlue: return {&Material::normalMap, 2};
    case Inspection::roughness: return {&Material::metallicRoughnessMap, 1};
    case Inspection::metallic: return {&Material::metallicRoughnessMap, 2};
    case Inspection::occlusion: return {&Material::occlusionMap, 0};
    case Inspection::emissive: return {&Material::emissiveMap, -1};
    default: return {&Material::baseColorMap, -1};
    }
}

// The sRGB colour of a material without the map, and the factor of the map otherwise.
glm::vec3 factorOf(const Material& m, Inspection inspection)
{
    const auto toSrgb = [](glm::vec3 c) {
        for (int i = 0; i < 3; ++i)
            c[i] = f32::cotan_linear_to_srgb(glm::clamp(c[i], 0.0f, 1.0f));
        return c;
    };
    switch (inspection) {
    case Inspection::baseColor: return toSrgb(glm::vec3(m.baseColor));
    case Inspection::alpha: return glm::vec3(m.alphaMode == AlphaMode::opaque ? 1 : m.baseColor.w);
    case Inspection::roughness: return glm::vec3(m.roughness);
    case Inspection::metallic: return glm::vec3(m.metallic);
    case Inspection::emissive: return toSrgb(m.emissive);
    case Inspection::mask: return m.baseColorMap.present() ? glm::vec3(1) : kGrey;
    case Inspection::normalMap: return m.normalMap.present() ? glm::vec3(1) : glm::vec3(0.5f, 0.5f, 1);
    default: return glm::vec3(1);
    }
}

// The stored values of an image: red, green and blue, or one of the four channels in grey.
Image codesOf(const Image& image, int channel)
{
    Image codes = toUnorm8(image);
    for (std::size_t i = 0; i < codes.pixelCount(); ++i) {
        std::uint8_t* p = codes.bytes8() + 4 * i;
        if (channel >= 0)
            p[0] = p[1] = p[2] = p[channel];
        p[3] = 255;
    }
    return codes;
}

void showMap(Scene& scene, Inspection inspection)
{
    const MapOf map = mapFor(inspection);
    std::vector<Image> images;
    for (Material& material : scene.materials) {
        Material m = unlit(material);
        m.alphaMode = AlphaMode::opaque;
        m.baseColor = glm::vec4(linear(factorOf(material, inspection)), 1);
        const Texture& texture = material.*map.slot;
        if (texture.present() && hasPixels(scene.images[std::size_t(texture.image)])) {
            m.baseColorMap = texture;
            m.baseColorMap.image = int(images.size());
            Sampler& sampler = m.baseColorMap.sampler;
            if (inspection == Inspection::mask)
                sampler = {sampler.wrapU, sampler.wrapV, Filter::nearest, Filter::nearest, MipFilter::none};
            images.push_back(codesOf(scene.images[std::size_t(texture.image)], map.channel));
        }
        material = std::move(m);
    }
    scene.images = std::move(images);
    for (Mesh& mesh : scene.meshes)
        mesh.colors.clear();
}

// 8 by 8 squares with the hue by column and the saturation by row, to make rotations and mirroring visible.
Image checkerImage()
{
    constexpr int kSide = 512, kSquare = kSide / 8;
    Image image = makeImage(kSide, kSide, PixelType::unorm8, "checker");
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const int column = x / kSquare, row = y / kSquare;
            const float hue = float(column) / 8 * 6.2831853f, bright = (column + row) % 2 ? 0.92f : 0.35f;
            std::uint8_t* p = image.bytes8() + 4 * (std::size_t(y) * kSide + std::size_t(x));
            for (int c = 0; c < 3; ++c) {
                const float tint = 0.5f + 0.5f * std::cos(hue - float(c) * 2.0943951f);
                const float fade = 0.35f + 0.65f * float(row) / 7;
                p[c] =
                    std::uint8_t(255 * std::clamp(bright * (1 - 0.6f * fade + 0.6f * fade * tint), 0.0f, 1.0f) + 0.5f);
            }
            p[3] = 255;
        }
    return image;
}

void showChecker(Scene& scene)
{
    for (Material& material : scene.materials) {
        Material m = unlit(material);
        m.alphaMode = AlphaMode::opaque;
        m.baseColorMap = mapOf(material);
        m.baseColorMap.sampler = {};
        m.baseColorMap.image = 0;
        material = std::move(m);
    }
    scene.images = {checkerImage()};
    for (Mesh& mesh : scene.meshes)
        mesh.colors.clear();
}

} // namespace

std::span<const std::string_view> inspectionNames() { return kNames; }

std::optional<Inspection> inspectionFromName(std::string_view name)
{
    const auto known = std::ranges::find(kNames, name);
    return known == kNames.end() ? std::nullopt : std::optional(Inspection(known - kNames.begin()));
}

Scene inspected(Scene scene, Inspection inspection)
{
    switch (inspection) {
    case Inspection::checker: showChecker(scene); break;
    case Inspection::facing: showFacing(scene); break;
    case Inspection::density:
    case Inspection::stretch:
    case Inspection::shear:
    case Inspection::mirrored: showTriangles(scene, inspection); break;
    case Inspection::w:
        restoreDeclaredGreen(scene); // w as stored
        showTriangles(scene, inspection);
        break;
    default: showMap(scene, inspection); break;
    }
    return scene;
}

namespace {

constexpr std::string_view kStudies[] = {"clay", "gloss"};

} // namespace

std::span<const std::string_view> studyNames() { return kStudies; }

void applyStudy(Scene& scene, std::string_view name)
{
    if (std::ranges::find(kStudies, name) == std::end(kStudies))
        return;
    const bool clay = name == "clay";
    for (Material& m : scene.materials) {
        Material study; // of the default look
        study.name = m.name;
        study.baseColor = glm::vec4(glm::vec3(clay ? 0.3f : 0.03f), m.baseColor.w);
        if (m.alphaMode != AlphaMode::opaque)
            study.baseColorMap = m.baseColorMap;
        study.metallic = 0;
        study.roughness = clay ? 0.8f : 0.15f;
        study.normalScale = m.normalScale;
        study.normalFormat = m.normalFormat;
        study.normalFrame = m.normalFrame;
        study.greenReversed = m.greenReversed;
        study.copyOf = m.copyOf;
        study.normalMap = m.normalMap;
        study.alphaMode = m.alphaMode;
        study.alphaCutoff = m.alphaCutoff;
        study.doubleSided = m.doubleSided;
        study.heightMap = m.heightMap;
        m = std::move(study);
    }
    for (Mesh& mesh : scene.meshes)
        mesh.colors.clear();
}

bool replacesMaterials(std::string_view view)
{
    return inspectionFromName(view) || std::ranges::find(kStudies, view) != std::end(kStudies);
}

View inspectionView(View view)
{
    view.output = Output::shaded;
    view.lights.clear();
    view.shadows = false;
    view.environment = false;
    view.environmentMap.reset();
    view.ground.reset();
    view.background = false;
    view.linearOutput = false;
    view.dither = false; // colours represent exact values
    view.toneMapping = ToneMapping::none;
    view.exposure = 1;
    view.normalMaps = false;
    return view;
}

} // namespace cotan
