// Pictures of light on the device: the environment, the ground.
#include <array>
#include <span>
#include <utility>
#include <vector>

#include <glm/gtc/packing.hpp>

#include "draw_passes.hpp"

namespace cotan {

void HeldPicture::hold(const Device& device, std::shared_ptr<const void> newOwner, const Image& picture)
{
    if (newOwner == owner)
        return;
    std::vector<glm::uint64> halves(picture.pixelCount());
    for (std::size_t i = 0; i < halves.size(); ++i) {
        const float* p = picture.floats() + 4 * i;
        halves[i] = glm::packHalf4x16(glm::vec4(p[0], p[1], p[2], p[3]));
    }
    owner.reset();
    texture = {};
    memory = std::make_unique<Memory>(device);
    TextureInfo info;
    info.format = vk::Format::eR16G16B16A16Sfloat;
    info.extent = vk::Extent2D(std::uint32_t(picture.width), std::uint32_t(picture.height));
    info.usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst;
    texture = makeTexture(device, *memory, info);
    const std::array levels{std::as_bytes(std::span(halves))};
    Uploader uploader(device, halves.size() * sizeof(glm::uint64));
    uploader.image(texture, levels, sizeof(glm::uint64));
    uploader.finish();
    owner = std::move(newOwner);
}

} // namespace cotan
