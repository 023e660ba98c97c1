// Draws a scene on the device.
#pragma once

#include <memory>
#include <optional>

#include "cotan/render.hpp"
#include "pipeline.hpp"
#include "scene_upload.hpp"
#include "view_data.hpp"

namespace cotan {

// ---- what is drawn into, and how it comes back ---------------------------------------------

// Colour, depth and the buffer for reading back, of one size and kind. Pictures of 8 bits are drawn as halfs, and
// become levels when their samples are resolved.
class Targets {
public:
    struct Kind {
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        vk::Format format = vk::Format::eUndefined; // of what is drawn into
        vk::Format shown = vk::Format::eUndefined;  // of what is read back
        vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
        bool operator==(const Kind&) const = default;
    };

    // Bytes of device memory that targets of that kind take.
    static vk::DeviceSize bytes(const Kind& kind);

    Targets(const Device& device, const Kind& kind);

    const Kind& kind() const { return kind_; }
    bool multisampled() const { return kind_.samples != vk::SampleCountFlagBits::e1; }
    // The picture is a target of its own, that the samples are resolved into.
    bool resolves() const { return multisampled() || kind_.shown != kind_.format; }

    // Starts drawing into the resolved picture, cleared to 0, without depths; ends with endRendering. Where it
    // resolves only.
    void beginSurround(const vk::raii::CommandBuffer& commands);
    // Starts drawing in the area: cleared to 0 (depth is reversed, so 0 is far away); ends with endOpaque where
    // translucent layers follow, else with endRendering.
    void begin(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area, bool layersFollow);
    // Ends drawing that began with layersFollow: the depth can be read from here on.
    void endOpaque(const vk::raii::CommandBuffer& commands);
    // Starts fragments that write no target and are tested against the depth; ends with endRendering.
    void beginLayers(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area);
    // Starts drawing over the colours of the area; ends with endRendering.
    void beginCompose(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area);
    // Starts drawing into the area of the resolved picture, after beginSurround, which has what is outside of it: the
    // samples can be read from here on; ends with endRendering. Where it resolves only.
    void beginResolve(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area);
    // Copies into the read-back buffer.
    void copy(const vk::raii::CommandBuffer& commands);
    vk::ImageView depthView() const { return *depth_.view; }
    vk::ImageView colorView() const { return *color_.view; }
    // The picture, upright. Only after the commands have been waited for.
    Image image(bool flipRows) const;

private:
    void setArea(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area) const;
    void beginColor(const vk::raii::CommandBuffer& commands, const Texture2D& target, vk::AttachmentLoadOp load,
                    const vk::Rect2D& area) const;

    Memory memory_;
    Kind kind_;
    Texture2D color_;
    std::optional<Texture2D> resolved_;
    Texture2D depth_;
    Buffer readBack_;
};

// The kind of targets for a view: what its output asks for and the device can do. Over 4 samples a pixel are drawn one
// after the other, as floats.
Targets::Kind targetKind(const Device& device, const View& view);

// ---- drawing -------------------------------------------------------------------------------

// The pipelines that a picture may be drawn with: those of surfaces without the maps, which keyOf adds.
struct PictureKeys {
    PipelineKey forward, layers, compose, background, surround, resolve;
};

PictureKeys keysOf(const View& view, const Targets& targets);

// Where translucent fragments are kept until they are composed: lists for a band of the picture's rows.
struct LayerLists {
    // pictureWidth: in pixels.
    LayerLists(const Device& device, std::uint32_t pictureWidth);

    // Empties the lists, for the band of `rows` that starts at `top`.
    void clear(const vk::raii::CommandBuffer& commands, std::uint32_t top, std::uint32_t rows) const;
    // Makes what was drawn readable for fragments to come, and the count for the host.
    void finish(const vk::raii::CommandBuffer& commands) const;

    Memory memory;
    std::uint32_t width;
    Buffer lists, layers;
    Buffer hostCount; // of the layers that were drawn: over the capacity, some were not kept
};

// What pictures share: constants, shadow map, targets; kept from one picture to the next.
class CommandRecorder {
    // What a shadow map depends on, besides the scene.
    struct ShadowView {
        gpu::vec4 x, y, z;
        bool pointSampled = false;
        bool operator==(const ShadowView&) const = default;
    };

public:
    CommandRecorder(const Device& device, const Layouts& layouts);

    Result<Image> draw(GpuScene& scene, const View& view, RenderTimings& timings);
    // What is kept of the scene before is of no use for the next one.
    void forgetScene() { shadowDrawn_.reset(); }

private:
    // One instance, ready to be drawn.
    struct Item {
        gpu::CotanDraw constants{};
        const GpuMesh* mesh = nullptr;
        vk::Buffer buffer; // that the mesh lies in
        const GpuMaterial* material = nullptr;
        bool clockwise = false; // front faces run clockwise over the raster
        double distance = 0;    // of the centre from the eye; 0 where that is not finite
    };
    // All of them, in the order in which they are drawn.
    struct DrawLists {
        std::vector<Item> opaque;      // near to far
        std::vector<Item> mask;        // near to far
        std::vector<Item> translucent; // as in the scene
        std::vector<Item> veils;       // of these what throws a shadow
        PixelArea area;                // of the picture, that all may cover
        PixelArea translucentArea;
    };

    // sample: the one of kPlaces that is drawn as the only one.
    Result<Image> drawOnce(GpuScene& scene, const View& view, std::optional<int> sample, RenderTimings& timings);
    static DrawLists makeLists(const GpuScene& scene, const View& view, const CameraAxes& axes,
                               const gpu::CotanView& constants);
    void beginPipelines(const DrawLists& lists, const View& view, bool layered);
    void prepare(const View& view, const CameraAxes& axes, const gpu::CotanView& constants, bool layered);
    void prepareShadowMap(bool needed);
    void writePictureSet(bool layered);
    void recordShadow(const vk::raii::CommandBuffer& commands, const DrawLists& lists, const ShadowView& shown);
    void recordPicture(const vk::raii::CommandBuffer& commands, const DrawLists& lists, const View& view);
    static PipelineKey keyOf(PipelineKey key, const Item& item);
    void recordSurround(const vk::raii::CommandBuffer& commands, const View& view, const PixelArea& a);
    void finish(const vk::raii::CommandBuffer& commands, const PixelArea& area);
    void drawOver(const vk::raii::CommandBuffer& commands, const PipelineKey& key);
    const vk::raii::CommandBuffer& begin();
    Status drawLayers(const DrawLists& lists);
    std::uint32_t keepLayers(const DrawLists& lists, const vk::Rect2D& band);
    void composeLayers(const vk::Rect2D& band);
    void drawItems(const vk::raii::CommandBuffer& commands, const std::vector<Item>& items, PipelineKey key);

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
    std::optional<ShadowView> shadowDrawn_; // what the map shows
    vk::raii::Sampler shadowSampler_{nullptr};
    HeldPicture environment_;
    HeldPicture ground_;
    vk::raii::Sampler pictureSampler_{nullptr};
    vk::raii::DescriptorPool pool_{nullptr};
    vk::DescriptorSet pictureSet_, composeSet_; // owned by the pool; the second reads the targets
    std::unique_ptr<Targets> targets_;
    PictureKeys keys_;
    std::unique_ptr<LayerLists> layers_; // once there is something translucent
    vk::raii::Sampler depthSampler_{nullptr};
};

} // namespace cotan
