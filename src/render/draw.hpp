// Draws a scene on the device.
#pragma once

#include <memory>

#include "cotan/frame.hpp"
#include "cotan/render/renderer.hpp"
#include "pipeline.hpp"
#include "scene_upload.hpp"
#include "targets.hpp"
#include "view_data.hpp"

namespace cotan {

// What pictures share: constants, shadow map, targets; kept from one picture to the next.
class Drawer {
public:
    Drawer(const Device& device, const Layouts& layouts);

    Result<Image> draw(GpuScene& scene, const View& view, RenderTimings& timings);

private:
    struct Item;      // one instance, ready to be drawn
    struct DrawLists; // all of them, in the order in which they are drawn

    DrawLists makeLists(const GpuScene& scene, const View& view, const Axes& axes) const;
    void prepare(const View& view, const Axes& axes, const Bounds& bounds);
    void prepareShadowMap(bool needed);
    void writePictureSet();
    void recordShadow(const vk::raii::CommandBuffer& commands, const GpuScene& scene,
                      const DrawLists& lists);
    void recordPicture(const vk::raii::CommandBuffer& commands, const GpuScene& scene,
                       const DrawLists& lists, const View& view);
    void drawItem(const vk::raii::CommandBuffer& commands, const GpuScene& scene,
                  const Item& item) const;
    void drawItems(const vk::raii::CommandBuffer& commands, const GpuScene& scene,
                   const std::vector<Item>& items, PipelineKey key);

    const Device* device_;
    const Layouts* layouts_;
    Pipelines pipelines_;
    Commands commands_;
    Memory memory_;
    Buffer viewBuffer_;
    std::unique_ptr<Memory> lightMemory_; // grows with the number of lights
    Buffer lightBuffer_;
    std::unique_ptr<Memory> shadowMemory_;
    Texture2D shadowMap_;
    vk::raii::Sampler shadowSampler_{nullptr};
    vk::raii::DescriptorPool pool_{nullptr};
    vk::DescriptorSet pictureSet_; // owned by the pool
    std::unique_ptr<Targets> targets_;
};

} // namespace cotan
