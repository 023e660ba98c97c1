// What is drawn into, and how it comes back.
#pragma once

#include <optional>

#include "cotan/view.hpp"
#include "memory.hpp"

namespace cotan {

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

} // namespace cotan
