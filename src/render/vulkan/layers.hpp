// Where translucent fragments are kept until they are composed: lists for a band of the picture's rows.
#pragma once

#include "memory.hpp"

namespace cotan {

class LayerLists {
public:
    // width: of the picture, in pixels.
    LayerLists(const Device& device, std::uint32_t width);

    std::uint32_t width() const { return width_; }
    // Rows that a band may have, at least 1.
    std::uint32_t maxRows() const;
    std::uint32_t capacity() const; // in layers

    const Buffer& lists() const { return lists_; }
    const Buffer& layers() const { return layers_; }

    // Empties the lists, for the band of `rows` that starts at `top`.
    void clear(const vk::raii::CommandBuffer& commands, std::uint32_t top, std::uint32_t rows) const;
    // Makes what was drawn readable for fragments to come, and the count for the host.
    void finish(const vk::raii::CommandBuffer& commands) const;
    // How many layers were drawn. Only after the commands have been waited for. Over the capacity, some were not kept.
    std::uint32_t count() const;

private:
    Memory memory_;
    std::uint32_t width_;
    Buffer lists_;
    Buffer layers_;
    Buffer count_; // host
};

} // namespace cotan
