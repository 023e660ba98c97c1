// The surroundings on the device.
#include <array>
#include <span>
#include <vector>

#include <glm/gtc/packing.hpp>

#include "cotan/scene/environment.hpp"
#include "draw.hpp"

namespace cotan {

// Kept from one picture to the next, as long as it is the same one.
void Drawer::prepareEnvironment(const View& view)
{
    if (!view.environmentMap || view.environmentMap == environmentMap_)
        return;
    const Image& atlas = view.environmentMap->atlas;
    std::vector<glm::uint64> halves(atlas.pixelCount());
    for (std::size_t i = 0; i < halves.size(); ++i) {
        const float* p = atlas.floats() + 4 * i;
        halves[i] = glm::packHalf4x16(glm::vec4(p[0], p[1], p[2], p[3]));
    }
    environmentMap_.reset();
    environmentTexture_ = {};
    environmentMemory_ = std::make_unique<Memory>(*device_);
    TextureInfo info;
    info.format = vk::Format::eR16G16B16A16Sfloat;
    info.extent = vk::Extent2D(std::uint32_t(atlas.width), std::uint32_t(atlas.height));
    info.usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst;
    environmentTexture_ = makeTexture(*device_, *environmentMemory_, info);
    const std::array levels{std::as_bytes(std::span(halves))};
    Uploader uploader(*device_, halves.size() * sizeof(glm::uint64));
    uploader.image(environmentTexture_, levels, sizeof(glm::uint64));
    uploader.finish();
    environmentMap_ = view.environmentMap;
}

} // namespace cotan
