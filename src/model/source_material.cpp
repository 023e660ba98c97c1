#include "source_material.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "core/named_values.hpp"
#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "cotan/vector.hpp"
#include "files/bytes.hpp"
#include "image/component_types.hpp"
#include "maps/texels.hpp"
#include "scene/geometry.hpp"

namespace cotan {

namespace {

// ---- images ----------------------------------------------------------------------------------

// Whether the image is grey, like a height map but unlike a normal map: red and blue differ by less than 3 % on
// average, a tolerance for colour from compression.
bool looksLikeHeight(const Image& image)
{
    double difference = 0;
    std::vector<glm::vec4> row(static_cast<std::size_t>(image.width));
    for (int y = 0; y < image.height; ++y) {
        maps::loadRow(image, y, row);
        for (const glm::vec4& texel : row)
            if (const float apart = std::abs(texel.x - texel.z); std::isfinite(apart))
                difference += double(apart);
    }
    return difference < 0.03 * double(image.pixelCount());
}

// Converts a height map to a normal map by central differences with wrapping borders: xyz, exact expansion, green
// against +v as in glTF. White is 1 % of the image width above black, times `strength`, because material files give no
// unit. 8 bit for 8-bit heights, otherwise 16 bit.
Image normalMapFromHeight(const Image& height, float strength)
{
    constexpr double kDepth = 0.01; // height of white above black, in image widths
    maps::FromHeightSettings settings;
    settings.scaleX = settings.scaleY = kDepth * height.width * double(strength);
    settings.type = height.type == PixelType::unorm8 ? PixelType::unorm8 : PixelType::unorm16;
    std::size_t invalid = 0;
    Image map = maps::normalsFromHeight(height, settings, invalid);
    map.name += " (bump)";
    return map;
}

// The red value of `image` at the texel nearest to (x, y) of an image of size w x h.
std::uint8_t redNearest(const Image& image, int x, int y, int w, int h)
{
    const auto sx = std::int64_t(x) * image.width / w;
    const auto sy = std::int64_t(y) * image.height / h;
    return image.bytes8()[4 * (std::size_t(sy) * std::size_t(image.width) + std::size_t(sx))];
}

// ---- materials -------------------------------------------------------------------------------

Texture use(const SourceMap& map, int image)
{
    Texture texture = map.use;
    texture.image = image;
    return texture;
}

Texture read(const SourceMap& map, TextureReader& textures, const std::string& material)
{
    return map.path.empty() ? Texture{} : use(map, textures.image(map.path, material));
}

// A Blinn-Phong lobe with exponent e is about as wide as GGX with alpha^2 = 2/(e + 2), alpha = roughness^2.
float roughnessFromShininess(float shininess)
{
    constexpr float kUnknown = 0.7f;
    return shininess > 0 ? std::pow(2.0f / (shininess + 2.0f), 0.25f) : kUnknown;
}

void setSurface(const SourceMaterial& source, TextureReader& textures, Material& material)
{
    const SourceMap &rough = source.roughnessMap, &metal = source.metalnessMap;
    const int roughImage = rough.path.empty() ? -1 : textures.image(rough.path, material.name);
    const int metalImage = metal.path.empty() ? -1 : textures.image(metal.path, material.name);
    const float roughness = roughImage >= 0 ? 1 : roughnessFromShininess(source.shininess);
    material.roughness = std::clamp(source.roughness.value_or(roughness), 0.0f, 1.0f);
    material.metallic = std::clamp(source.metallic.value_or(metalImage >= 0 ? 1.0f : 0.0f), 0.0f, 1.0f);
    // With only one map the other channel is white, so its factor stays in effect.
    material.metallicRoughnessMap =
        use(roughImage >= 0 ? rough : metal, textures.metallicRoughness(roughImage, metalImage));
}

void setBaseColor(const SourceMaterial& source, TextureReader& textures, Scene& scene, Material& material)
{
    material.baseColorMap = read(source.colorMap, textures, material.name);
    glm::vec3 base = source.color;
    if (base == glm::vec3(0) && material.baseColorMap.present())
        base = glm::vec3(1); // some exporters leave the factor black although only the map counts

    float opacity = source.opacity;
    if (opacity <= 0) {
        scene.warnings.push_back(fmt::format("material {}: its opacity is 0; treated as opaque", material.name));
        opacity = 1;
    }
    material.baseColor = glm::vec4(base, std::min(opacity, 1.0f));
    if (opacity < 1)
        material.alphaMode = AlphaMode::blend;

    if (source.opacityMap.path.empty())
        return;
    if (source.opacityMap.path == source.colorMap.path)
        material.alphaMode = AlphaMode::mask;
    else
        scene.warnings.push_back(
            fmt::format("material {}: the opacity map {} is left out; alpha is read from the colour map", material.name,
                        source.opacityMap.path));
}

// Whether the file name says that green points down: it contains "directx", or "dx" as a word or after "normal".
bool namesDirectX(const std::string& path)
{
    const std::string name = lowerCase(path.substr(path.find_last_of("/\\") + 1));
    const auto letter = [&](std::size_t i) { return i < name.size() && isLetter(name[i]); };
    if (name.find("directx") != std::string::npos)
        return true;
    for (std::size_t at = name.find("dx"); at != std::string::npos; at = name.find("dx", at + 1)) {
        const bool starts = at == 0 || !letter(at - 1) || std::string_view(name).substr(0, at).ends_with("normal");
        if (starts && !letter(at + 2))
            return true;
    }
    return false;
}

void setNormalMap(const SourceMaterial& source, TextureReader& textures, Scene& scene, Material& material)
{
    const SourceMap& map = source.normalMap;
    if (map.path.empty())
        return;
    bool converted = false;
    material.normalMap = use(map, textures.normalMap(map.path, material.name, map.strength, converted));
    if (!material.normalMap.present() || converted)
        return; // the conversion has applied the strength
    material.normalScale = map.strength;
    if (namesDirectX(map.path)) {
        material.normalFormat.greenUp = false;
        scene.warnings.push_back(fmt::format(
            "material {}: normal map {} is read as green down (DirectX), as its name says", material.name, map.path));
    }
}

} // namespace

int TextureReader::add(Image image)
{
    bytes_ += image.data.size();
    scene_.images.push_back(std::move(image));
    return int(scene_.images.size()) - 1;
}

int TextureReader::image(const std::string& path, const std::string& material)
{
    const auto [entry, isNew] = known_.try_emplace(path, -1);
    if (isNew)
        entry->second = load(path, material);
    return entry->second;
}

int TextureReader::leaveOut(const std::string& path, const std::string& material, const std::string& why)
{
    scene_.warnings.push_back(fmt::format("material {}: texture {}: {}; left out", material, path, why));
    return -1;
}

int TextureReader::load(const std::string& path, const std::string& material)
{
    const auto take = [&](std::uint64_t bytes, const auto& read) {
        const LoadLimits limits = withinBudget(bytes);
        if (limits.imageBytes == 0)
            return leaveOut(path, material, overBudget());
        Result<Image> image = read(limits);
        return image ? add(*std::move(image)) : leaveOut(path, material, image.error().message);
    };
    if (const auto embedded = embedded_ ? embedded_(path) : std::nullopt) {
        if (!*embedded)
            return leaveOut(path, material, embedded->error().message);
        return take((*embedded)->size(), [&](const LoadLimits& limits) {
            return decodeImage(**embedded, fmt::format("{} {}", scene_.name, path), limits);
        });
    }
    bool outside = false, ignored = false;
    auto file = findInFolder(folder_, path, outside);
    if (!file) {
        const std::size_t slash = path.find_last_of("/\\");
        if (slash != std::string::npos)
            file = findInFolder(folder_, path.substr(slash + 1), ignored);
    }
    if (!file)
        return leaveOut(path, material, outside ? "outside the model's folder, not opened" : "no such file");
    const auto [entry, isNew] = known_.try_emplace(file->string(), -1); // another path to the same file
    if (!isNew)
        return entry->second;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(*file, error);
    return entry->second = take(error ? 0 : size, [&](const LoadLimits& limits) { return readImage(*file, limits); });
}

// Limits for an image whose file has `bytes` bytes, within the remaining budget for all images.
LoadLimits TextureReader::withinBudget(std::uint64_t bytes)
{
    fileBytes_ += bytes;
    LoadLimits limits = limits_;
    const std::size_t all = imageBudget(limits_, fileBytes_);
    limits.imageBytes = std::min(limits_.imageBytes, all - std::min(all, bytes_));
    return limits;
}

std::string TextureReader::overBudget() const
{
    return fmt::format("the images are over the limit of {} bytes", imageBudget(limits_, fileBytes_));
}

int TextureReader::normalMap(const std::string& path, const std::string& material, float strength, bool& converted)
{
    converted = false;
    const int source = image(path, material);
    if (source < 0 || !looksLikeHeight(scene_.images[std::size_t(source)]))
        return source;
    const Image& heights = scene_.images[std::size_t(source)];
    if (withinBudget(0).imageBytes < heights.pixelCount() * 4)
        return leaveOut(path, material, overBudget());
    converted = true;
    const auto [entry, isNew] = known_.try_emplace(fmt::format("bump\n{}\n{}", source, strength), -1);
    if (isNew) {
        entry->second = add(normalMapFromHeight(heights, strength));
        scene_.warnings.push_back(fmt::format(
            "material {}: texture {} is grey: treated as a height map and converted to a normal map", material, path));
    }
    return entry->second;
}

int TextureReader::metallicRoughness(int roughness, int metallic)
{
    if (roughness < 0 && metallic < 0)
        return -1;
    const auto [entry, isNew] = known_.try_emplace(fmt::format("roughness\n{}\nmetallic\n{}", roughness, metallic), -1);
    if (!isNew)
        return entry->second;
    const auto imageOrWhite = [&](int image) {
        if (image >= 0)
            return toUnorm8(scene_.images[std::size_t(image)]);
        Image white = makeImage(1, 1, PixelType::unorm8);
        std::ranges::fill(white.data, std::byte(255));
        return white;
    };
    const Image rough = imageOrWhite(roughness), metal = imageOrWhite(metallic);
    const int w = std::max(rough.width, metal.width), h = std::max(rough.height, metal.height);
    Image out = makeImage(w, h, PixelType::unorm8, scene_.name + " (metallic, roughness)");
    std::uint8_t* texel = out.bytes8();
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x, texel += 4) {
            texel[0] = texel[3] = 255;
            texel[1] = redNearest(rough, x, y, w, h);
            texel[2] = redNearest(metal, x, y, w, h);
        }
    return entry->second = add(std::move(out));
}

Material makeMaterial(const SourceMaterial& source, TextureReader& textures, Scene& scene)
{
    Material material;
    material.name = source.name;
    material.doubleSided = true; // unknown in these formats
    setBaseColor(source, textures, scene, material);
    setSurface(source, textures, material);
    setNormalMap(source, textures, scene, material);
    material.emissive = source.emission;
    material.emissiveMap = read(source.emissionMap, textures, material.name);
    if (material.emissiveMap.present() && material.emissive == glm::vec3(0))
        material.emissive = glm::vec3(1);
    material.occlusionMap = read(source.occlusionMap, textures, material.name);
    return material;
}

void finishMesh(Mesh& mesh, std::string_view unusable, Scene& scene)
{
    bool usable = !mesh.normals.empty();
    for (glm::vec3& stored : mesh.normals) {
        const glm::dvec3 normal(stored);
        const double length = glm::length(normal);
        usable = usable && isFinite(normal) && length > 0;
        stored = glm::vec3(normal / length);
    }
    if (!usable) {
        if (!mesh.normals.empty())
            scene.warnings.push_back(
                fmt::format("mesh {}: some normals are zero or {}; all are regenerated", mesh.name, unusable));
        mesh.normals.clear();
        generateNormals(mesh, /*creaseDegrees*/ 60);
    }
    weldVertices(mesh);
}

void warnAboutTexcoords(const Mesh& mesh, Scene& scene)
{
    const Material& material = scene.materials[std::size_t(mesh.material)];
    const Texture* const all[] = {&material.baseColorMap, &material.metallicRoughnessMap, &material.normalMap,
                                  &material.occlusionMap, &material.emissiveMap};
    for (const Texture* texture : all)
        if (texture->present() && mesh.texcoords[std::size_t(texture->texcoord)].empty()) {
            scene.warnings.push_back(
                fmt::format("mesh {}: it has no texture coordinates {}, which material {} needs; its textures "
                            "are not drawn",
                            mesh.name, texture->texcoord, material.name));
            return;
        }
}

} // namespace cotan
