#include "model_textures.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <assimp/scene.h>
#include <assimp/texture.h>
#include <fmt/format.h>

#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "files/folder.hpp"
#include "image/component_types.hpp"
#include "maps/texels.hpp"

namespace cotan {

namespace {

// Whether the picture is grey, as a height map is and a normal map is not: red and blue differ by
// less than 3 % on average (compression leaves some colour in grey pictures).
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

// The normal map of a height map by central differences, wrapping at the borders: xyz, exact
// expansion, green against +v (glTF's form). White is 1 % of the picture's width above black,
// times `strength`; material files give no unit. 8 bit for 8-bit heights, otherwise 16.
Image normalMapFromHeight(const Image& height, float strength)
{
    constexpr double kDepth = 0.01; // of white over black, in widths of the picture
    maps::FromHeightSettings settings;
    settings.scaleX = settings.scaleY = kDepth * height.width * double(strength);
    settings.type = height.type == PixelType::unorm8 ? PixelType::unorm8 : PixelType::unorm16;
    std::size_t invalid = 0;
    Image map = maps::normalsFromHeight(height, settings, invalid);
    map.name += " (bump)";
    return map;
}

// The red component at the texel of `image` nearest to (x, y) of a picture of w x h.
std::uint8_t redNearest(const Image& image, int x, int y, int w, int h)
{
    const auto sx = std::int64_t(x) * image.width / w;
    const auto sy = std::int64_t(y) * image.height / h;
    return image.bytes8()[4 * (std::size_t(sy) * std::size_t(image.width) + std::size_t(sx))];
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
    const auto addOrWarn = [&](Result<Image> image) {
        return image ? add(*std::move(image)) : leaveOut(path, material, image.error().message);
    };
    if (const aiTexture* texture = source_ ? source_->GetEmbeddedTexture(path.c_str()) : nullptr)
        return addOrWarn(embedded(*texture, fmt::format("{} {}", scene_.name, path)));

    bool outside = false, ignored = false;
    auto file = findInFolder(folder_, path, outside);
    if (!file) {
        const std::size_t slash = path.find_last_of("/\\");
        if (slash != std::string::npos)
            file = findInFolder(folder_, path.substr(slash + 1), ignored);
    }
    if (!file)
        return leaveOut(path, material, outside ? "outside the model's folder, not opened" : "no such file");
    const auto [entry, isNew] = known_.try_emplace(file->string(), -1); // another name for it
    if (!isNew)
        return entry->second;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(*file, error);
    const LoadLimits limits = withinBudget(error ? 0 : size);
    if (limits.imageBytes == 0)
        return leaveOut(path, material, overBudget());
    return entry->second = addOrWarn(readImage(*file, limits));
}

// The limits for an image of so many bytes: what is left for all of them together.
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

Result<Image> TextureReader::embedded(const aiTexture& texture, const std::string& name)
{
    if (!texture.pcData || texture.mWidth == 0)
        return inputError("the embedded texture is empty");
    if (texture.mHeight != 0) // 0: a whole image file of mWidth bytes, as all formats that are read here have it
        return inputError("expected an embedded image file, found plain texels");
    const LoadLimits limits = withinBudget(texture.mWidth);
    if (limits.imageBytes == 0)
        return inputError(overBudget());
    return decodeImage(std::as_bytes(std::span(reinterpret_cast<const char*>(texture.pcData), texture.mWidth)), name,
                       limits);
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
        entry->second = add(normalMapFromHeight(scene_.images[std::size_t(source)], strength));
        scene_.warnings.push_back(fmt::format(
            "material {}: texture {} is grey: taken as a height map and converted to a normal map", material, path));
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

} // namespace cotan
