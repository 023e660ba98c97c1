#include "bake/high_materials.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "bake/bake_kinds.hpp"
#include "bake/surface/surface_triangle.hpp"
#include "cotan/vector.hpp"
#include "scene/geometry.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

struct HighMaterials::Corners {
    const std::uint32_t* vertex;
    float b1, b2;
};

// The texels that the last map was read from.
struct HighMaterials::Square {
    int number = -1;
    TexelSquare texels;
};

namespace {

float linearOf(float srgb) { return f32::cotan_srgb_to_linear(srgb); }

// What bytes stand for.
template<class Value> std::array<float, 256> bytesAs(const Value& value)
{
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = value(i);
    return values;
}
const std::array<float, 256> kLinearBytes = bytesAs([](std::size_t i) { return linearOf(float(i) / 255); });
const std::array<float, 256> kFractionBytes = bytesAs([](std::size_t i) { return float(i) * (1.0f / 255); });

// Numbers of floats: negative ones and those that are none become 0.
glm::vec3 finite(glm::vec3 c)
{
    for (int k = 0; k < 3; ++k)
        c[k] = c[k] > 0 ? std::min(c[k], 1e30f) : 0.0f;
    return c;
}

// The red, green and blue of a texel; of a colour in linear light.
glm::vec3 componentsOf(const Image& image, bool isColor, int x, int y)
{
    const glm::vec3 c(storedComponents(image, x, y));
    if (image.type == PixelType::float32) // is linear
        return finite(c);
    return isColor ? glm::vec3(linearOf(c.x), linearOf(c.y), linearOf(c.z)) : c;
}

std::uint32_t srgbBytes(glm::vec3 linear)
{
    std::uint32_t color = 0;
    for (int k = 0; k < 3; ++k)
        color = color << 8 | std::uint32_t(f32::cotan_linear_to_srgb(std::clamp(linear[k], 0.0f, 1.0f)) * 255 + 0.5f);
    return color;
}

// What a kind needs of the high meshes, for messages.
const char* neededFor(BakeKind kind)
{
    return kind == BakeKind::baseColor ? "a base colour map, a colour or vertex colours"
        : kind == BakeKind::emissive   ? "light that the material emits"
        : kind == BakeKind::id         ? "vertex colours"
                                       : "a map or numbers of roughness and metallic";
}

} // namespace

std::uint32_t idColor(std::uint32_t n)
{
    std::uint32_t color = 0;
    for (unsigned bit = 0; bit < 24; ++bit) // the bits 0, 1, 2 are the highest of red, green, blue
        color |= (n >> bit & 1u) << (8 * (2 - bit % 3) + 7 - bit / 3);
    return color;
}

glm::vec3 linearColor(std::uint32_t color)
{
    const auto of = [&](int shift) { return kLinearBytes[color >> shift & 255u]; };
    return {of(16), of(8), of(0)};
}

// Makes the parts of one scene after another.
struct HighMaterials::Maker {
    HighMaterials& all;
    const HighSurface& surface;
    const std::vector<BakeKind>& kinds;
    std::map<std::string, std::uint32_t> named = {}; // colours of names
    std::vector<bool> found = std::vector<bool>(kinds.size());
    std::string unread = {}; // name of an image without pixels

    bool wants(BakeKind kind) const { return std::find(kinds.begin(), kinds.end(), kind) != kinds.end(); }

    std::uint32_t colorOf(const std::string& name)
    {
        std::uint32_t fresh = 0;
        std::uint32_t& color = name.empty() ? fresh : named[name];
        if (color == 0) {
            color = idColor(std::uint32_t(all.ids_.size()) + 1);
            all.ids_.push_back({name, color});
        }
        return color;
    }

    void add(Scene& scene)
    {
        std::vector<const Attributes*> attributes(scene.meshes.size());
        std::vector<const Image*> images(scene.images.size());
        std::vector<std::uint32_t> materialColors(scene.materials.size()); // 0: none yet
        const auto mapOf = [&](const Texture& texture, const Attributes& of, bool isWanted, bool isColor) -> Map {
            if (!isWanted || !texture.present() || of.uv[uvSetOf(texture)].empty())
                return {};
            const Image*& image = images[std::size_t(texture.image)];
            if (!image) { // moved, unless the reader of normal maps also needs it
                Image& given = scene.images[std::size_t(texture.image)];
                const bool isShared =
                    std::any_of(scene.materials.begin(), scene.materials.end(),
                                [&](const Material& m) { return m.normalMap.image == texture.image; });
                image = &(isShared ? all.images_.emplace_back(given) : all.images_.emplace_back(std::move(given)));
                if (!hasPixels(*image))
                    unread = image->name;
            }
            return {image, texture, isColor};
        };
        for (const Instance& instance : scene.instances) {
            Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            if (mesh.indices.empty())
                continue; // as HighSurface does
            const Material& material = scene.materials[std::size_t(mesh.material)];
            const Attributes*& of = attributes[std::size_t(instance.mesh)];
            if (!of)
                of = &all.attributes_.emplace_back(Attributes{mesh.texcoords, std::move(mesh.colors)});
            Part& part = all.parts_.emplace_back();
            part.indices = surface.triangles(all.parts_.size() - 1).indices;
            part.attributes = of;
            part.baseColor = glm::vec3(material.baseColor);
            part.emissive = material.emissive;
            part.roughness = material.roughness;
            part.metallic = material.metallic;
            const bool readsSurface =
                wants(BakeKind::roughness) || wants(BakeKind::metallic) || wants(BakeKind::roughnessMetallic);
            part.baseColorMap = mapOf(material.baseColorMap, *of, wants(BakeKind::baseColor), /*isColor*/ true);
            part.surfaceMap = mapOf(material.metallicRoughnessMap, *of, readsSurface, /*isColor*/ false);
            part.emissiveMap = mapOf(material.emissiveMap, *of, wants(BakeKind::emissive), /*isColor*/ true);
            numberSquares(part);
            if (all.idBy_ == IdBy::object) {
                part.id = colorOf(objectName(scene, instance));
            } else if (all.idBy_ == IdBy::material) {
                std::uint32_t& color =
                    materialColors[std::size_t(material.copyOf >= 0 ? material.copyOf : mesh.material)];
                part.id = color = color != 0 ? color : colorOf(material.name);
            }
            for (std::size_t k = 0; k < kinds.size(); ++k)
                found[k] = found[k] || has(part, material, kinds[k]);
        }
    }

    // Whether the part has what a map of this kind shows.
    bool has(const Part& part, const Material& material, BakeKind kind) const
    {
        const bool hasColors = !part.attributes->colors.empty();
        // The readers give glTF's defaults to meshes without a material, or a grey material of this name and surface.
        const bool isRough = material.metallic == 0 && material.roughness == 0.7f;
        const bool isDefault = material.name == "default" && isRough;
        switch (kind) {
        case BakeKind::baseColor:
            return part.baseColorMap.image || hasColors || !(part.baseColor == glm::vec3(1) || isDefault);
        case BakeKind::emissive: return part.emissive != glm::vec3(0); // which also scales the map
        case BakeKind::id: return all.idBy_ != IdBy::vertexColor || hasColors;
        case BakeKind::roughness:
        case BakeKind::metallic:
        case BakeKind::roughnessMetallic:
            return part.surfaceMap.image || !(isDefault || (material.metallic == 1 && material.roughness == 1));
        default: return true;
        }
    }
};

Result<HighMaterials> HighMaterials::make(std::vector<Scene>& scenes, const HighSurface& surface,
                                          const std::vector<BakeKind>& kinds, IdBy idBy)
{
    HighMaterials all;
    all.idBy_ = idBy;
    Maker maker{all, surface, kinds};
    for (Scene& scene : scenes)
        maker.add(scene);
    if (!maker.unread.empty())
        return inputError(
            fmt::format("{}: expected an image with pixels; the model was read without them", maker.unread));
    for (std::size_t k = 0; k < kinds.size(); ++k)
        if (!maker.found[k])
            return inputError(fmt::format("{}: expected {} for a map of kind {}; found none",
                                          scenes.empty() ? "" : scenes[0].name, neededFor(kinds[k]),
                                          wordOf(kBakeKinds, kinds[k])));
    return all;
}

void HighMaterials::numberSquares(Part& part)
{
    const auto isSame = [](const Map& a, const Map& b) {
        const Texture &s = a.texture, &t = b.texture;
        return a.image && b.image && a.image->width == b.image->width && a.image->height == b.image->height
            && uvSetOf(s) == uvSetOf(t) && s.uRow == t.uRow && s.vRow == t.vRow
            && s.sampler.magnify == t.sampler.magnify && s.sampler.wrapU == t.sampler.wrapU
            && s.sampler.wrapV == t.sampler.wrapV;
    };
    part.surfaceMap.square = isSame(part.surfaceMap, part.baseColorMap) ? 0 : 1;
    part.emissiveMap.square = isSame(part.emissiveMap, part.baseColorMap) ? 0
        : isSame(part.emissiveMap, part.surfaceMap)                       ? part.surfaceMap.square
                                                                          : 2;
}

// The red, green and blue of a map, of colours in linear light; 1 without.
glm::vec3 HighMaterials::texelAt(const Map& map, const Part& part, const Corners& at, Square& square) const
{
    if (!map.image)
        return glm::vec3(1);
    const Image& image = *map.image;
    if (square.number != map.square) {
        const std::vector<glm::vec2>& all = part.attributes->uv[uvSetOf(map.texture)];
        const auto corner = [&](std::size_t k) { return glm::dvec2(all[at.vertex[k]]); };
        const glm::dvec2 raw =
            corner(0) + (corner(1) - corner(0)) * double(at.b1) + (corner(2) - corner(0)) * double(at.b2);
        const auto row = [&](const glm::dvec3& r) {
            const double x = r.x * raw.x + r.y * raw.y + r.z;
            return std::abs(x) <= double(kFarthestUv) ? x : 0.0; // as renderers do
        };
        const glm::dvec2 uv(row(map.texture.uRow), row(map.texture.vRow));
        const Sampler& sampler = map.texture.sampler;
        square.number = map.square;
        if (sampler.magnify == Filter::linear)
            square.texels = texelsAround(image.width, image.height, sampler, uv);
        else
            nearestTexel(image.width, image.height, sampler, uv, [&](int x, int y) {
                square.texels = {x, x, y, y, 0, 0};
                return 0;
            });
    }
    if (image.type != PixelType::unorm8)
        return mixTexels(square.texels, [&](int x, int y) { return componentsOf(image, map.isColor, x, y); });
    const std::array<float, 256>& values = map.isColor ? kLinearBytes : kFractionBytes;
    return mixTexels(square.texels, [&](int x, int y) {
        const std::uint8_t* const c = image.bytes8() + 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
        return glm::vec3(values[c[0]], values[c[1]], values[c[2]]);
    });
}

void HighMaterials::read(const Hits& hits, MaterialValues& values) const
{
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (!hits.found(lane))
            continue;
        const Part& part = parts_[hits.instance[lane]];
        const Corners at{&part.indices[3 * std::size_t(hits.triangle[lane])], hits.b1[lane], hits.b2[lane]};
        const std::vector<glm::vec4>& colors = part.attributes->colors;
        Square square;
        const glm::vec3 base = part.baseColor * texelAt(part.baseColorMap, part, at, square);
        values.baseColor.set(
            lane, colors.empty() ? base : base * glm::vec3(atVertices(colors.data(), at.vertex, at.b1, at.b2)));
        values.emissive.set(lane, part.emissive * texelAt(part.emissiveMap, part, at, square));
        const glm::vec3 surface = texelAt(part.surfaceMap, part, at, square);
        values.surface.set(lane, {1, part.roughness * surface.y, part.metallic * surface.z});
        const float b0 = 1 - at.b1 - at.b2;
        const std::size_t nearest = b0 >= at.b1 && b0 >= at.b2 ? 0 : at.b1 >= at.b2 ? 1 : 2;
        values.id[lane] = float(idBy_ != IdBy::vertexColor ? part.id
                                    : colors.empty()       ? 0xffffffu
                                                           : srgbBytes(glm::vec3(colors[at.vertex[nearest]])));
    }
}

} // namespace cotan
