#include "core/large_array.hpp"
#include "cotan/scene.hpp"

namespace cotan {

Image makeImage(int width, int height, PixelType type, std::string name)
{
    Image image{.name = std::move(name), .width = width, .height = height, .type = type, .data = {}};
    image.data = zeros<std::byte>(image.pixelCount() * image.bytesPerPixel());
    return image;
}

} // namespace cotan
