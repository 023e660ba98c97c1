// Layouts and pipelines. Pipelines are made on demand: on CPU drivers each compiles the whole fragment shader.
#pragma once

#include <compare>
#include <future>
#include <map>
#include <vector>

#include "cotan/view.hpp"
#include "device.hpp"

namespace cotan {

inline constexpr auto kBothStages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;

// Number of images in set 0.
inline constexpr std::uint32_t kImagesInViewSet = 4;

struct Layouts {
    explicit Layouts(const Device& device);

    // Set 0: view, lights, shadow map (or opaque depth while layers are composed), lists, layers, environment, shadow
    // map as depth, ground.
    vk::raii::DescriptorSetLayout viewSet{nullptr};
    // Set 1 of materials without and with extensions, and the layouts of the pipelines that draw them.
    vk::raii::DescriptorSetLayout material{nullptr}, extendedMaterial{nullptr};
    vk::raii::PipelineLayout pipeline{nullptr}, extendedPipeline{nullptr};

    const vk::raii::DescriptorSetLayout& materialOf(bool extended) const
    {
        return extended ? extendedMaterial : material;
    }
    vk::PipelineLayout pipelineOf(bool extended) const { return extended ? *extendedPipeline : *pipeline; }
};

// Allocates a set that lives as long as its pool.
vk::DescriptorSet allocateSet(const Device& device, const vk::raii::DescriptorPool& pool,
                              const vk::raii::DescriptorSetLayout& layout);

// shadowMask: surfaces that cover texels of the shadow map by alpha. layers: translucent fragments into their lists;
// compose: these lists over the image. surround: the background with one sample and without depth; resolve: the samples
// of a pixel into one. depth, marks: the two steps of dropHidden.
enum class Pass { shadow, shadowMask, depth, marks, forward, background, surround, layers, compose, resolve };

constexpr bool isShadow(Pass pass) { return pass == Pass::shadow || pass == Pass::shadowMask; }
constexpr bool isPrepass(Pass pass) { return pass == Pass::depth || pass == Pass::marks; }

// All specialisations of a pipeline. Fields that a pass ignores keep their defaults, so that equal pipelines have equal
// keys.
struct PipelineKey {
    Pass pass = Pass::forward;
    AlphaMode alphaMode = AlphaMode::opaque;
    Frame frame = Frame::cotangent;
    bool framesOfMeshes = false; // each mesh's own, instead of `frame`
    Output output = Output::shaded;
    Shading shading = Shading::pbr;
    bool normalMaps = true;
    bool environment = true;
    bool environmentMap = false; // environment map instead of the formula
    bool shadows = true;
    bool specularAntialiasing = false;
    bool separateSamples = false; // each sample is shaded at its own position: scene/sample_positions.hpp
    bool softShadows = false;
    bool toneMap = true; // false: linear output
    ToneMapping tone = ToneMapping::aces;
    int backdrop = 0; // BACKDROP_... of background.frag
    bool ground = false;
    std::uint32_t maps = 0;          // COTAN_MAP_..., COTAN_LAYER_...: what the drawn materials may have
    bool extended = false;           // draws materials with extensions
    bool levels = false;             // writes an 8-bit image
    bool multisampledSource = false; // of Pass::resolve
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
    vk::Format format = vk::Format::eUndefined;

    auto operator<=>(const PipelineKey&) const = default;
};

class Pipelines {
public:
    Pipelines(const Device& device, const Layouts& layouts) : device_(&device), layouts_(&layouts) {}
    Pipelines(const Pipelines&) = delete; // its threads refer to it

    // Starts to make missing pipelines concurrently, and returns.
    void begin(const std::vector<PipelineKey>& keys);
    // Returns the pipeline, waiting for it if it was begun, else making it.
    vk::Pipeline get(const PipelineKey& key);

private:
    vk::raii::Pipeline make(const PipelineKey& key) const;

    const Device* device_;
    const Layouts* layouts_;
    std::map<PipelineKey, std::shared_future<vk::raii::Pipeline>> made_;
    std::vector<std::future<void>> workers_; // the last member, because they use the others
};

} // namespace cotan
