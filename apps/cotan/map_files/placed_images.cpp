#include "placed_images.hpp"

#include <optional>
#include <utility>

#include "core/loops.hpp"
#include "core/try.hpp"
#include "image/pending.hpp"

namespace cotan::app {

Result<std::vector<OutputFile>> writePending(std::span<const PlacedImage> images)
{
    std::vector<std::optional<Result<OutputFile>>> outputs(images.size());
    parallelFor(std::size_t(0), images.size(),
                [&](std::size_t i) { outputs[i].emplace(writePending(images[i].file, *images[i].image)); });
    std::vector<OutputFile> pending;
    for (std::optional<Result<OutputFile>>& output : outputs) {
        if (!*output)
            return output->error();
        pending.push_back(std::move(**output));
    }
    return pending;
}

Status writeTogether(std::span<const PlacedImage> images)
{
    auto pending = writePending(images);
    return pending ? commitTogether(*pending) : pending.error();
}

} // namespace cotan::app
