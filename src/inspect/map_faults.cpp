#include "cotan/inspect.hpp"

#include <set>

#include <fmt/format.h>

#include "cotan/maps.hpp"

namespace cotan {

std::vector<std::string> mapFaults(const Scene& scene)
{
    std::vector<std::string> sentences;
    std::set<int> seen;
    for (const Material& m : scene.materials) {
        const int image = m.normalMap.image;
        if (!m.normalMap.present() || std::size_t(image) >= scene.images.size() || !seen.insert(image).second)
            continue;
        const Image& map = scene.images[std::size_t(image)];
        if (!hasPixels(map))
            continue;
        const maps::GreenVerdict verdict = maps::greenOf(map);
        const bool readUp = m.normalFormat.greenUp && !m.greenReversed; // else it is read as its tangents mean it
        const auto faults = maps::faultsOf(verdict.statistics, readUp ? &verdict : nullptr);
        if (!faults.empty())
            sentences.push_back(maps::sentenceOf(map.name.empty() ? fmt::format("Image {}", image) : map.name, faults,
                                                 verdict.statistics));
    }
    return sentences;
}

} // namespace cotan
