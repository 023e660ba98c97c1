#include "choose_primitives.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "core/try.hpp"
#include "cotan/gltf.hpp"
#include "gltf/json/lookup.hpp"
#include "map_jobs.hpp"

namespace cotan {

using gltf::Json;

namespace {

bool hasVariants(const Json& root) { return gltf::extension(root, "KHR_materials_variants") != nullptr; }

// Whether the primitive has TANGENT and a material with a normal map, but not the uv to read it at.
bool lacksUv(const Json& root, const SourcePrimitive& p)
{
    const Json& primitive = root["meshes"][p.mesh]["primitives"][p.primitive];
    const Json& attributes = primitive["attributes"];
    if (!attributes.contains("TANGENT"))
        return false;
    for (const std::size_t material : materialsOf(root, primitive))
        if (const gltf::TextureUse map = normalMapOf(root, material, NormalSlot::surface);
            map.texture >= 0 && !attributes.contains("TEXCOORD_" + std::to_string(map.texcoord)))
            return true;
    return false;
}

bool isWorse(const FrameCandidate& a, const FrameCandidate& b)
{
    return std::pair(a.percentile99, a.mean) > std::pair(b.percentile99, b.mean);
}

// Adds another way to draw the primitive: each candidate is as good as the worst of both.
void add(FrameDecision& known, const FrameDecision& other, const ChoiceLimits& limits)
{
    if (other.reason == ChoiceReason::noMap)
        return;
    const bool both = known.reason == ChoiceReason::fits && other.reason == ChoiceReason::fits;
    const bool judged = known.candidates.size() > 0 && known.candidates.size() == other.candidates.size();
    if (known.reason == ChoiceReason::noMap || (!judged && known.dropsTangents() && !other.dropsTangents())) {
        known = other;
        return;
    }
    if (!judged)
        return;
    for (std::size_t i = 0; i < known.candidates.size(); ++i)
        if (FrameCandidate& c = known.candidates[i]; isWorse(other.candidates[i], c))
            c = {c.frame,
                 c.tangents,
                 other.candidates[i].points,
                 std::max(c.mean, other.candidates[i].mean),
                 std::max(c.percentile95, other.candidates[i].percentile95),
                 other.candidates[i].percentile99,
                 std::max(c.maximum, other.candidates[i].maximum)};
    const auto first = std::ranges::find_if(known.candidates, [&](const FrameCandidate& c) {
        return c.tangents == TangentOrigin::generated && c.within(limits);
    });
    if (both && first != known.candidates.end())
        known.frame = first->frame;
    else if (!other.dropsTangents() || (both && known.meaning == MapMeaning::stored))
        std::tie(known.reason, known.frame, known.tangents) =
            std::tuple(ChoiceReason::keeps, Frame::mikktspace, TangentOrigin::stored);
}

} // namespace

Result<std::vector<PrimitiveDecision>> choosePrimitives(const GltfDocument& document, const ChoiceLimits& limits,
                                                        const FramePair& frames, const LoadLimits& load,
                                                        std::optional<Scene> opened)
{
    LoadLimits normalMaps = load;
    normalMaps.pixels = Pixels::normalMaps;
    normalMaps.variant.clear();
    COTAN_TRY(scene,
              opened && !hasVariants(rootOf(document)) ? Result<Scene>(*std::move(opened))
                                                       : gltfSceneOfVariants(document, normalMaps));
    for (Mesh& mesh : scene->meshes)
        if (!readsTangents(frames.from) && !namedFrameOf(*scene, mesh))
            mesh.named = frames.from;
    std::map<SourcePrimitive, FrameDecision> found;
    for (FrameDecision& d : chooseFrames(*scene, {.limits = limits, .all = true, .tangents = frames.fromTangents}))
        if (const auto& source = scene->meshes[d.mesh].source) {
            const auto [known, isNew] = found.try_emplace(*source, d);
            if (!isNew)
                add(known->second, d, limits);
        }
    std::vector<PrimitiveDecision> decisions;
    for (auto& [primitive, decision] : found) {
        if (decision.reason == ChoiceReason::noMap && lacksUv(rootOf(document), primitive)) {
            decision.reason = ChoiceReason::notJudged;
            decision.notJudged = "no uv";
            decision.tangents = frames.fromTangents;
        }
        decisions.push_back({primitive, std::move(decision)});
    }
    return decisions;
}

void nameFrameOfPrimitive(GltfDocument& document, const SourcePrimitive& p, std::optional<Frame> frame)
{
    setExtra(rootOf(document)["meshes"][p.mesh]["primitives"][p.primitive], gltf::kFrameExtra,
             frame ? name(*frame) : std::string_view());
}

std::string namesOf(const std::vector<Frame>& frames)
{
    std::string names;
    for (const Frame frame : frames)
        names += (names.empty() ? "" : ", ") + std::string(name(frame));
    return names;
}

} // namespace cotan
