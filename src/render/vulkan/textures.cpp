#include "scene_upload.hpp"

#include <algorithm>

#include <glm/gtc/packing.hpp>

#include "core/loops.hpp"
#include "core/named_values.hpp"

namespace cotan {

namespace {

// Limit for the chains that are built before an upload; bounds host memory.
constexpr std::size_t kBatchBytes = std::size_t(256) << 20;

// Size limit for normal maps that are widened to 16 bits if 8-bit filtering is too coarse.
constexpr std::size_t kMaxWidenedBytes = std::size_t(128) << 20;

// In the order of TexelFormat and of Wrap.
constexpr vk::Format kFormats[] = {vk::Format::eR8G8B8A8Srgb, vk::Format::eR8G8B8A8Unorm,
                                   vk::Format::eR16G16B16A16Unorm, vk::Format::eR16G16B16A16Sfloat,
                                   vk::Format::eR32G32B32A32Sfloat};
constexpr vk::SamplerAddressMode kAddressModes[] = {
    vk::SamplerAddressMode::eRepeat, vk::SamplerAddressMode::eMirroredRepeat, vk::SamplerAddressMode::eClampToEdge};

vk::Filter filterOf(Filter filter) { return filter == Filter::nearest ? vk::Filter::eNearest : vk::Filter::eLinear; }

// Bytes of all levels of a chain on the device.
std::size_t chainBytes(const MipRequest& r) { return r.image->pixelCount() * bytesPerTexel(r.format) / 3 * 4; }

} // namespace

vk::Sampler Samplers::get(const Sampler& s, bool pointSampled)
{
    const Key key{s.wrapU, s.wrapV, s.magnify, s.minify, s.mip, pointSampled};
    const auto found = made_.find(key);
    if (found != made_.end())
        return *found->second;
    vk::SamplerCreateInfo info;
    info.addressModeU = textAt(kAddressModes, s.wrapU);
    info.addressModeV = textAt(kAddressModes, s.wrapV);
    info.magFilter = pointSampled ? vk::Filter::eNearest : filterOf(s.magnify);
    info.minFilter = pointSampled ? vk::Filter::eNearest : filterOf(s.minify);
    info.mipmapMode =
        s.mip == MipFilter::linear && !pointSampled ? vk::SamplerMipmapMode::eLinear : vk::SamplerMipmapMode::eNearest;
    // 0.25 keeps the choice between magnification and minification, but not a second level.
    info.maxLod = pointSampled ? 0.0f : s.mip == MipFilter::none ? 0.25f : VK_LOD_CLAMP_NONE;
    const bool anisotropic = device_->anisotropy && !pointSampled && s.mip != MipFilter::none
        && s.minify == Filter::linear && s.magnify == Filter::linear;
    info.anisotropyEnable = anisotropic;
    info.maxAnisotropy = anisotropic ? std::min(8.0f, device_->limits.maxSamplerAnisotropy) : 1.0f;
    return *made_.emplace(key, vk::raii::Sampler(device_->device, info)).first->second;
}

void HeldTexture::hold(const Device& device, std::shared_ptr<const void> newOwner, const Image& values)
{
    if (newOwner == owner)
        return;
    std::vector<glm::uint64> halves(values.pixelCount());
    for (std::size_t i = 0; i < halves.size(); ++i) {
        const float* p = values.floats() + 4 * i;
        halves[i] = glm::packHalf4x16(glm::vec4(p[0], p[1], p[2], p[3]));
    }
    owner.reset();
    image.reset(); // frees its memory first
    image.emplace(device,
                  TextureInfo{.format = vk::Format::eR16G16B16A16Sfloat,
                              .extent = {std::uint32_t(values.width), std::uint32_t(values.height)},
                              .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst});
    const std::array levels{std::as_bytes(std::span(halves))};
    Uploader uploader(device, halves.size() * sizeof(glm::uint64));
    uploader.image(image->texture, levels, sizeof(glm::uint64));
    uploader.finish();
    owner = std::move(newOwner);
}

std::array<MapUse, COTAN_MAP_COUNT> mapUses(const Material& m)
{
    using K = TextureKind;
    using G = gpu::CotanMaterial;
    return {{{&m.baseColorMap, K::color, {}, &G::baseColorMap},
             {&m.metallicRoughnessMap, K::data, {}, &G::metallicRoughnessMap},
             {&m.normalMap, K::normal, m.normalFormat, &G::normalMapUse},
             {&m.occlusionMap, K::data, {}, &G::occlusionMap},
             {&m.emissiveMap, K::color, {}, &G::emissiveMap},
             {&m.coat.map, K::data, {}, &G::coatMap},
             {&m.coat.roughnessMap, K::data, {}, &G::coatRoughnessMap},
             {&m.coat.normalMap, K::normal, m.coat.normalFormat, &G::coatNormalMapUse},
             {&m.anisotropy.map, K::data, {}, &G::anisotropyMap},
             {&m.specular.map, K::data, {}, &G::specularMap},
             {&m.specular.colorMap, K::color, {}, &G::specularColorMap},
             {&m.sheen.colorMap, K::color, {}, &G::sheenColorMap},
             {&m.sheen.roughnessMap, K::data, {}, &G::sheenRoughnessMap},
             {&m.transmission.map, K::data, {}, &G::transmissionMap},
             {&m.heightMap.map, K::data, {}, &G::heightMapUse}}};
}

Textures::Key Textures::keyOf(const MapUse& use)
{
    return {use.texture->image, use.kind, use.format.expansion, use.format.channels};
}

void Textures::request(const Scene& scene, const MapUse& use, std::vector<MipRequest>& missing)
{
    if (!use.texture->present() || std::size_t(use.texture->image) >= scene.images.size())
        return;
    const Image& image = scene.images[std::size_t(use.texture->image)];
    if (!hasPixels(image))
        return;
    const auto [made, isNew] = made_.emplace(keyOf(use), textures_.size() + missing.size());
    index_.insert(*made);
    if (!isNew)
        return;
    TexelFormat format = texelFormat(image.type, use.kind, device_->filterable16, device_->filterable32);
    // Mesa's CPU driver rounds filtered 8-bit texels to 8 bits, which is 0.2 degrees of a normal. With 16 bits, a map
    // of 8192 x 8192 would take 1.7 GiB.
    if (use.kind == TextureKind::normal && image.data.size() <= kMaxWidenedBytes && format == TexelFormat::unorm8
        && device_->cpu && device_->filterable16)
        format = TexelFormat::unorm16;
    missing.push_back({&image, use.kind, use.format, format, int(device_->limits.maxImageDimension2D)});
}

Texture2D Textures::upload(const MipChain& chain, Uploader& uploader)
{
    const MipLevel& finest = chain.levels[0];
    Texture2D texture = makeTexture(memory_,
                                    {.format = textAt(kFormats, chain.format),
                                     .extent = {std::uint32_t(finest.width), std::uint32_t(finest.height)},
                                     .levels = std::uint32_t(chain.levels.size()),
                                     .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst});
    std::vector<std::span<const std::byte>> levels;
    for (const MipLevel& level : chain.levels)
        levels.push_back(level.data);
    uploader.image(texture, levels, bytesPerTexel(chain.format));
    return texture;
}

void Textures::load(const Scene& scene, Uploader& uploader)
{
    std::vector<MipRequest> missing;
    Image white = makeImage(1, 1, PixelType::unorm8, "white");
    std::fill(white.data.begin(), white.data.end(), std::byte{255});
    if (textures_.empty())
        missing.emplace_back().image = &white;
    index_.clear();
    for (const Material& m : scene.materials)
        for (const MapUse& use : mapUses(m))
            if (!m.unlit || use.texture == &m.baseColorMap || use.texture == &m.normalMap
                || use.texture == &m.heightMap.map)
                request(scene, use, missing);
    for (std::size_t first = 0; first < missing.size();) {
        std::size_t end = first;
        for (std::size_t bytes = 0;
             end < missing.size() && (end == first || bytes + chainBytes(missing[end]) <= kBatchBytes); ++end)
            bytes += chainBytes(missing[end]);
        std::vector<MipChain> chains(end - first);
        runTasks(chains.size(), threadsFor(chains.size(), 1),
                 [&](std::size_t i) { chains[i] = buildMips(missing[first + i]); });
        for (const MipChain& chain : chains)
            textures_.push_back(upload(chain, uploader));
        first = end;
    }
}

bool Textures::present(const MapUse& use) const { return use.texture->present() && index_.contains(keyOf(use)); }

vk::ImageView Textures::view(const MapUse& use) const
{
    return *(present(use) ? textures_[index_.at(keyOf(use))] : textures_.front()).view;
}

} // namespace cotan
