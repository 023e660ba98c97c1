#include "cotan/convert.hpp"

#include <fmt/format.h>

#include "gltf/json/lookup.hpp"
#include "gltf/json/views.hpp"

namespace cotan {

namespace {

bool hasNormalMap(const GltfDocument& document, std::size_t material)
{
    for (const NormalSlot slot : {NormalSlot::surface, NormalSlot::coat})
        if (normalMapOf(rootOf(document), material, slot).texture >= 0)
            return true;
    return false;
}

} // namespace

Result<std::optional<Frame>> namedFrame(const GltfDocument& document)
{
    std::optional<Frame> named;
    std::size_t first = 0;
    for (std::size_t m = 0; m < countOf(rootOf(document), "materials"); ++m) {
        const auto frame = frameFromName(gltf::frameText(rootOf(document)["materials"][m]));
        if (!frame || !hasNormalMap(document, m))
            continue;
        if (named && *named != *frame)
            return inputError(fmt::format("{}: materials[{}].extras.{}: expected {}, as materials[{}] has it; found {}",
                                          gltfPath(document).string(), m, gltf::kFrameExtra, name(*named), first,
                                          name(*frame)));
        if (!named)
            first = m;
        named = frame;
    }
    return named;
}

void nameFrame(GltfDocument& document, std::size_t material, Frame frame)
{
    nlohmann::ordered_json& m = rootOf(document)["materials"][material];
    if (frame != Frame::mikktspace) {
        if (!m.contains("extras") || !m["extras"].is_object())
            m["extras"] = nlohmann::ordered_json::object();
        m["extras"][gltf::kFrameExtra] = name(frame);
    } else if (m.contains("extras") && m["extras"].is_object()) {
        m["extras"].erase(gltf::kFrameExtra);
        if (m["extras"].empty())
            m.erase("extras");
    }
}

} // namespace cotan
