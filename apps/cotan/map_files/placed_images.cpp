#include "placed_images.hpp"

#include <utility>

#include "core/try.hpp"
#include "image/pending.hpp"

namespace cotan::app {

Result<std::vector<OutputFile>> writePending(std::span<const PlacedImage> images)
{
    std::vector<OutputFile> pending;
    for (const auto& [file, image] : images) {
        COTAN_TRY(output, writePending(file, *image));
        pending.push_back(std::move(*output));
    }
    return pending;
}

Status writeTogether(std::span<const PlacedImage> images)
{
    auto pending = writePending(images);
    return pending ? commitTogether(*pending) : pending.error();
}

} // namespace cotan::app
