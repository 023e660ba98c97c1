// The files of shaders/cotan/, embedded, in the order in which they are joined.
#pragma once

#include <span>
#include <string_view>

namespace cotan::shader_text {

struct PortablePart {
    std::string_view name; // without ".h"
    std::string_view text;
};

std::span<const PortablePart> portableParts();

} // namespace cotan::shader_text
