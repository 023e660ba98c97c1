// Draws a scene on the device.
#pragma once

#include <memory>
#include <optional>

#include "cotan/render.hpp"
#include "pipeline.hpp"
#include "scene_upload.hpp"
#include "view_data.hpp"

namespace cotan {

// ---- render targets and read-back ----------------------------------------------------------

// Colour, depth and read-back buffer of one size and kind. 8-bit images are drawn as halfs and quantised when their
// samples are resolved.
class Targets {
public:
    struct Kind {
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        vk::Format format = vk::Format::eUndefined; // of the drawn samples
        vk::Format output = vk::Format::eUndefined; // of the image that is read back
        vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
        bool operator==(const Kind&) const = default;
    };

    // Bytes of device memory for targets of this kind.
    static vk::DeviceSize bytes(const Kind& kind);

    Targets(const Device& device, const Kind& kind);

    const Kind& kind() const { return kind_; }
    bool multisampled() const { return kind_.samples != vk::SampleCountFlagBits::e1; }
    // Whether the samples are resolved into a separate image.
    bool resolves() const { return multisampled() || kind_.output != kind_.format; }

    // Starts drawing into the resolved image, cleared to 0, without depth; ends with endRendering. Requires resolves().
    void beginSurround(const vk::raii::CommandBuffer& commands);
    // Starts drawing only depth in the area, cleared to 0 (far away in reversed depth); ends with endRendering.
    void beginDepth(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area);
    // Starts drawing in the area, cleared as above; ends with endOpaque if translucent layers
    // follow, else with endRendering.
    void begin(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area, bool layersFollow);
    // Ends drawing that began with layersFollow; afterwards the depth can be read.
    void endOpaque(const vk::raii::CommandBuffer& commands);
    // Starts drawing fragments that write no target and are depth tested; ends with endRendering.
    void beginLayers(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area);
    // Starts drawing over the colours of the area; ends with endRendering.
    void beginCompose(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area);
    // Starts drawing into the area of the resolved image, whose remainder beginSurround has covered. The samples can be
    // read from here on. Ends with endRendering. Requires resolves().
    void beginResolve(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area);
    // Ends drawing the image, and copies it into the read-back buffer if the host reads it.
    void finish(const vk::raii::CommandBuffer& commands, bool hostReads);
    // The resolved image. The next one is drawn into another, while anyone holds this one. Requires resolves().
    std::shared_ptr<const DeviceImage> share() const { return resolved_; }
    vk::ImageView depthView() const { return *depth_.view; }
    vk::ImageView colorView() const { return *color_.view; }
    // The image, first row at the top. Requires that the commands have completed.
    Image image(bool flipRows) const;

private:
    void setArea(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area) const;
    void beginColor(const vk::raii::CommandBuffer& commands, const Texture2D& target, vk::AttachmentLoadOp load,
                    const vk::Rect2D& area) const;

    // Makes the depth ready to be drawn, cleared to 0. kept: it is read later.
    vk::RenderingAttachmentInfo clearedDepth(const vk::raii::CommandBuffer& commands, bool kept) const;
    void chooseResolved();

    Memory memory_;
    Kind kind_;
    Texture2D color_;
    std::vector<std::shared_ptr<DeviceImage>> all_; // that were resolved into
    std::shared_ptr<DeviceImage> resolved_;
    Texture2D depth_;
    Buffer readBack_;
};

// The kind of targets that the view needs and the device supports. More than 4 samples per pixel are drawn one at a
// time, as floats.
Targets::Kind targetKind(const Device& device, const View& view);

inline vk::Rect2D rectangle(const PixelArea& a)
{
    return {{a.x0, a.y0}, {static_cast<std::uint32_t>(a.x1 - a.x0), static_cast<std::uint32_t>(a.y1 - a.y0)}};
}

// ---- drawing -------------------------------------------------------------------------------

// Pipelines for the passes of an image. Those that draw surfaces lack the material's maps, which keyOf adds.
struct PassKeys {
    PipelineKey depth, marks, forward, layers, compose, background, surround, resolve;
};

PassKeys keysOf(const View& view, const Targets& targets);

// Stores translucent fragments until they are composed: lists for a band of image rows.
struct LayerLists {
    // imageWidth: in pixels.
    LayerLists(const Device& device, std::uint32_t imageWidth);

    // Clears the lists for the band of `rows` rows from `top`.
    void clear(const vk::raii::CommandBuffer& commands, std::uint32_t top, std::uint32_t rows) const;
    // Makes the lists readable for later fragments, and the count for the host.
    void finish(const vk::raii::CommandBuffer& commands) const;

    Memory memory;
    std::uint32_t width;
    Buffer lists, layers;
    Buffer hostCount; // number of layers drawn; those over the capacity were not stored
};

// The triangles of a view that are not hidden, for drivers that render on the CPU: they shade the hidden ones, too.
struct VisibleTriangles {
    VisibleTriangles(const Device& device, std::uint32_t count);

    Memory memory;
    std::uint32_t capacity; // in triangles
    Buffer marks;           // for each triangle: not 0 if a sample of it is visible
    Buffer indices;         // of the visible ones
};

// Draws images. Keeps constants, shadow map and targets from one image to the next.
class CommandRecorder {
    // What a shadow map depends on, besides the scene.
    struct ShadowView {
        gpu::vec4 x, y, z;
        bool pointSampled = false;
        bool operator==(const ShadowView&) const = default;
    };

public:
    CommandRecorder(const Device& device, const Layouts& layouts);

    // host: gets the image. If null, share() does; only for views that staysOnDevice() accepts.
    Status draw(GpuScene& scene, const View& view, Image* host);
    static bool staysOnDevice(const View& view);
    std::shared_ptr<const DeviceImage> share() const { return targets_->share(); }
    // Discards what was kept for the previous scene.
    void forgetScene() { shadowDrawn_.reset(); }

private:
    // An instance to draw.
    struct Item {
        gpu::CotanDraw constants{};
        const GpuMesh* mesh = nullptr;
        const Buffer* buffer = nullptr; // contains the mesh
        vk::Buffer visible;             // contains the indices of its visible triangles; null: all are drawn
        vk::DeviceSize visibleOffset = 0;
        std::uint32_t visibleCount = 0; // of indices
        const GpuMaterial* material = nullptr;
        bool clockwise = false; // front faces are clockwise in the raster
        double distance = 0;    // from the eye to the box's centre; 0 if not finite
    };
    // All instances, in drawing order.
    struct DrawLists {
        std::vector<Item> opaque;             // near to far
        std::vector<Item> mask;               // near to far
        std::vector<Item> translucent;        // as in the scene
        std::vector<Item> translucentCasters; // translucent instances that cast a shadow
        PixelArea area;                       // of the image, covered by all instances at most
        PixelArea translucentArea;
    };

    // sample: the only one of the kSampleCount samples to draw; if empty, all.
    Status drawOnce(GpuScene& scene, const View& view, std::optional<int> sample, Image* host);
    static DrawLists makeLists(const GpuScene& scene, const View& view, const CameraAxes& axes,
                               const gpu::CotanView& constants);
    void beginPipelines(const DrawLists& lists, const View& view, bool layered);
    void prepare(const View& view, const CameraAxes& axes, const gpu::CotanView& constants, bool layered);
    void prepareShadowMap(bool needed);
    void writeViewSet(bool layered);
    bool dropsHidden(const View& view) const;
    void dropHidden(DrawLists& lists, const PixelArea& area);
    void recordShadow(const vk::raii::CommandBuffer& commands, const DrawLists& lists, const ShadowView& shadowView);
    void recordMain(const vk::raii::CommandBuffer& commands, const DrawLists& lists, const View& view);
    static PipelineKey keyOf(PipelineKey key, const Item& item);
    void recordSurround(const vk::raii::CommandBuffer& commands, const View& view, const PixelArea& a);
    void resolve(const vk::raii::CommandBuffer& commands, const PixelArea& area);
    int rowsAtOnce(const View& view, bool layered) const;
    void drawFullScreen(const vk::raii::CommandBuffer& commands, const PipelineKey& key);
    const vk::raii::CommandBuffer& begin();
    Status drawLayers(const DrawLists& lists);
    std::uint32_t storeLayers(const DrawLists& lists, const vk::Rect2D& band);
    void composeLayers(const vk::Rect2D& band);
    void drawItems(const vk::raii::CommandBuffer& commands, const std::vector<Item>& items, PipelineKey key);

    const Device* device_;
    const Layouts* layouts_;
    Pipelines pipelines_;
    Commands commands_;
    Memory memory_;
    Buffer viewBuffer_;
    std::unique_ptr<Memory> lightMemory_; // replaced when the number of lights grows
    Buffer lightBuffer_;
    std::unique_ptr<Memory> shadowMemory_;
    Texture2D shadowMap_;
    std::optional<ShadowView> shadowDrawn_; // contents of the shadow map
    vk::raii::Sampler shadowSampler_{nullptr};
    HeldTexture environment_;
    HeldTexture ground_;
    vk::raii::Sampler linearSampler_{nullptr};
    vk::raii::DescriptorPool pool_{nullptr};
    // Owned by the pool. composeSet_ reads the targets; with markSet_ triangles are marked.
    vk::DescriptorSet viewSet_, composeSet_, markSet_;
    std::unique_ptr<Targets> targets_;
    PassKeys keys_;
    std::unique_ptr<LayerLists> layers_; // created for the first translucent instance
    std::unique_ptr<VisibleTriangles> visible_;
    vk::raii::Sampler depthSampler_{nullptr};
};

} // namespace cotan
