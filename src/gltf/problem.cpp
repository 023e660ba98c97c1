#include "problem.hpp"

#include <algorithm>

namespace cotan {

void failGltfVersion1(const std::string& field)
{
    failGltf("{}: glTF version 1 is not supported, expected 2.0; gltf-pipeline (npm) converts it: "
             "npx gltf-pipeline -i OLD.gltf -o NEW.glb",
             field);
}

void GltfWarnings::add(const std::string& where, const std::string& what, std::size_t count, const std::string& unit)
{
    if (count == 0 && !unit.empty())
        return;
    auto same = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.what == what; });
    // Names from the file may make every line different, so the number of lines is limited.
    constexpr std::size_t kMax = 100;
    if (same == entries_.end() && entries_.size() >= kMax) {
        ++leftOut_;
        return;
    }
    if (same == entries_.end())
        same = entries_.insert(entries_.end(), Entry{where, what, unit, 0, 0});
    ++same->places;
    same->count += count;
}

std::vector<std::string> GltfWarnings::lines() const
{
    std::vector<std::string> lines;
    for (const Entry& e : entries_) {
        std::string line = e.where;
        if (e.places > 1)
            line += fmt::format(" and {} more", e.places - 1);
        line += ": " + e.what;
        if (e.count > 0)
            line += fmt::format(" ({}: {})", e.unit, e.count);
        lines.push_back(oneLine(line));
    }
    if (leftOut_ > 0)
        lines.push_back(fmt::format("{} more warnings are left out", leftOut_));
    return lines;
}

} // namespace cotan
