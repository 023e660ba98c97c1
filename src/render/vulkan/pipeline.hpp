// Layouts and pipelines. Pipelines are made when first needed: on a CPU driver each costs a compilation of the whole
// fragment shader.
#pragma once

#include <compare>
#include <future>
#include <map>
#include <vector>

#include "cotan/view.hpp"
#include "device.hpp"

namespace cotan {

inline constexpr auto kBothStages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;

// Of Layouts::picture.
inline constexpr std::uint32_t kImagesOfPicture = 4;

struct Layouts {
    explicit Layouts(const Device& device);

    // Set 0: view, lights, shadow map (or, where layers are composed, opaque depth), lists, layers, environment, shadow
    // map as depth, ground.
    vk::raii::DescriptorSetLayout picture{nullptr};
    // Set 1 of materials without extensions and with them, and the pipelines that draw them.
    vk::raii::DescriptorSetLayout material{nullptr}, extendedMaterial{nullptr};
    vk::raii::PipelineLayout pipeline{nullptr}, extendedPipeline{nullptr};

    const vk::raii::DescriptorSetLayout& materialOf(bool extended) const
    {
        return extended ? extendedMaterial : material;
    }
    vk::PipelineLayout pipelineOf(bool extended) const { return extended ? *extendedPipeline : *pipeline; }
};

// A set that lives as long as its pool.
vk::DescriptorSet allocateSet(const Device& device, const vk::raii::DescriptorPool& pool,
                              const vk::raii::DescriptorSetLayout& layout);

// shadowMask: of what covers texels of the shadow map by its alpha. layers: translucent fragments into their lists;
// compose: these lists over the picture. surround: the background in one sample, without depths; resolve: the samples
// of a pixel into one.
enum class Pass { shadow, shadowMask, forward, background, surround, layers, compose, resolve };

constexpr bool isShadow(Pass pass) { return pass == Pass::shadow || pass == Pass::shadowMask; }

// Everything that a pipeline is specialised for. Fields that a pass ignores stay at their
// defaults, so that equal pipelines have equal keys.
struct PipelineKey {
    Pass pass = Pass::forward;
    AlphaMode alphaMode = AlphaMode::opaque;
    Frame frame = Frame::cotangent;
    Output output = Output::shaded;
    Shading shading = Shading::pbr;
    bool coarse = false;
    bool normalMaps = true;
    bool environment = true;
    bool environmentMap = false; // a picture in place of the formula
    bool shadows = true;
    bool specularAntialiasing = false;
    bool separateSamples = false; // each lit at a place of its own: scene/sample_places.hpp
    bool softShadows = false;
    bool toneMap = true; // false: linear output
    ToneMapping tone = ToneMapping::aces;
    int backdrop = 0; // BACKDROP_... of background.frag
    bool ground = false;
    std::uint32_t maps = 0;          // COTAN_MAP_..., COTAN_LAYER_...: what the materials drawn with it may have
    bool extended = false;           // of materials with extensions
    bool levels = false;             // writes a picture of 8 bits
    bool multisampledSource = false; // of Pass::resolve
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
    vk::Format format = vk::Format::eUndefined;

    auto operator<=>(const PipelineKey&) const = default;
};

class Pipelines {
public:
    Pipelines(const Device& device, const Layouts& layouts) : device_(&device), layouts_(&layouts) {}
    Pipelines(const Pipelines&) = delete; // its threads know where it is

    // Begins to make those that are not there yet, side by side, while the caller does something else.
    void begin(const std::vector<PipelineKey>& keys);
    // Makes it where it was not begun, else waits for it.
    vk::Pipeline get(const PipelineKey& key);

private:
    vk::raii::Pipeline make(const PipelineKey& key) const;

    const Device* device_;
    const Layouts* layouts_;
    std::map<PipelineKey, std::shared_future<vk::raii::Pipeline>> made_;
    std::vector<std::future<void>> workers_; // the last member: they use the others
};

} // namespace cotan
