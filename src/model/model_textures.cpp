#include "model_textures.hpp"

#include <algorithm>
#include <cstring>
#include <span>

#include <assimp/scene.h>
#include <assimp/texture.h>
#include <fmt/format.h>

#include "bump_map.hpp"
#include "cotan/image.hpp"
#include "files/bytes.hpp"
#include "image/component_types.hpp"

namespace cotan {

namespace fs = std::filesystem;

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

int TextureReader::load(const std::string& path, const std::string& material)
{
    const auto unusable = [&](const std::string& why) {
        scene_.warnings.push_back(fmt::format("material {}: texture {}: {}; left out", material, path, why));
        return -1;
    };
    if (const aiTexture* texture = source_ ? source_->GetEmbeddedTexture(path.c_str()) : nullptr) {
        std::string problem;
        if (auto image = embedded(*texture, fmt::format("{} {}", scene_.name, path), problem))
            return add(*std::move(image));
        return unusable(problem);
    }

    bool outside = false, ignored = false;
    auto file = findInFolder(folder_, path, outside);
    if (!file) {
        const std::size_t slash = path.find_last_of("/\\");
        if (slash != std::string::npos)
            file = findInFolder(folder_, path.substr(slash + 1), ignored);
    }
    if (!file)
        return unusable(outside ? "outside the model's folder, not opened" : "no such file");
    const auto [entry, isNew] = known_.try_emplace(file->string(), -1); // another name for it
    if (!isNew)
        return entry->second;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(*file, error);
    const LoadLimits limits = withinBudget(error ? 0 : size);
    if (limits.imageBytes == 0)
        return unusable(overBudget());
    auto image = readImage(*file, limits);
    if (!image)
        return unusable(image.error().message);
    return entry->second = add(*std::move(image));
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

std::optional<Image> TextureReader::embedded(const aiTexture& texture, const std::string& name, std::string& problem)
{
    if (!texture.pcData || texture.mWidth == 0) {
        problem = "the embedded texture is empty";
        return std::nullopt;
    }
    if (texture.mHeight != 0) { // 0: a whole image file of mWidth bytes, as all formats that are read here have it
        problem = "expected an embedded image file, found plain texels";
        return std::nullopt;
    }
    const LoadLimits limits = withinBudget(texture.mWidth);
    if (limits.imageBytes == 0) {
        problem = overBudget();
        return std::nullopt;
    }
    auto image = decodeImage(std::as_bytes(std::span(reinterpret_cast<const char*>(texture.pcData), texture.mWidth)),
                             name, limits);
    if (image)
        return *std::move(image);
    problem = image.error().message;
    return std::nullopt;
}

int TextureReader::normalMap(const std::string& path, const std::string& material, float strength, bool& converted)
{
    converted = false;
    const int source = image(path, material);
    if (source < 0 || !looksLikeHeight(scene_.images[std::size_t(source)]))
        return source;
    const Image& heights = scene_.images[std::size_t(source)];
    if (withinBudget(0).imageBytes < heights.pixelCount() * 4) {
        scene_.warnings.push_back(fmt::format("material {}: texture {}: {}; left out", material, path, overBudget()));
        return -1;
    }
    converted = true;
    const auto [entry, isNew] = known_.try_emplace(fmt::format("bump\n{}\n{}", source, strength), -1);
    if (isNew) {
        entry->second = add(normalMapFromHeight(scene_.images[std::size_t(source)], strength));
        scene_.warnings.push_back(fmt::format(
            "material {}: texture {} is grey: taken as a height map and converted to a normal map", material, path));
    }
    return entry->second;
}

namespace {

// The red component at the texel of `image` nearest to (x, y) of a picture of w x h.
std::uint8_t redNearest(const Image* image, int x, int y, int w, int h)
{
    if (!image)
        return 255;
    const auto sx = std::int64_t(x) * image->width / w;
    const auto sy = std::int64_t(y) * image->height / h;
    return image->bytes8()[4 * (std::size_t(sy) * std::size_t(image->width) + std::size_t(sx))];
}

} // namespace

int TextureReader::metallicRoughness(int roughness, int metallic)
{
    if (roughness < 0 && metallic < 0)
        return -1;
    const auto [entry, isNew] = known_.try_emplace(fmt::format("roughness\n{}\nmetallic\n{}", roughness, metallic), -1);
    if (!isNew)
        return entry->second;
    std::optional<Image> rough, metal;
    if (roughness >= 0)
        rough = toUnorm8(scene_.images[std::size_t(roughness)]);
    if (metallic >= 0)
        metal = toUnorm8(scene_.images[std::size_t(metallic)]);
    const int w = std::max(rough ? rough->width : 1, metal ? metal->width : 1);
    const int h = std::max(rough ? rough->height : 1, metal ? metal->height : 1);
    Image out = makeImage(w, h, PixelType::unorm8, scene_.name + " (metallic, roughness)");
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const std::uint8_t rgba[4] = {255, redNearest(rough ? &*rough : nullptr, x, y, w, h),
                                          redNearest(metal ? &*metal : nullptr, x, y, w, h), 255};
            std::memcpy(out.bytes8() + 4 * (std::size_t(y) * std::size_t(w) + std::size_t(x)), rgba, 4);
        }
    }
    return entry->second = add(std::move(out));
}

} // namespace cotan
