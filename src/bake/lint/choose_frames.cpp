#include "cotan/frame_choice.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bake/lint/map_fit.hpp"
#include "core/loops.hpp"
#include "lint_parts.hpp"
#include "scene/geometry.hpp"
#include "scene/normal_maps.hpp"
#include "scene/parts.hpp"
#include "scene/scene_check.hpp"

namespace cotan {

namespace {

constexpr std::size_t kMaxJudged = 200'000; // triangles of a primitive

// In the order of cost.
constexpr Frame kCandidates[] = {Frame::orthonormal, Frame::triangle, Frame::smooth, Frame::mikktspace};

// The mesh, or a part of it if it has very many triangles.
std::shared_ptr<const Mesh> judgedPart(const Mesh& mesh)
{
    if (mesh.triangleCount() <= kMaxJudged)
        return {std::shared_ptr<void>(), &mesh}; // the scene outlives it
    return std::make_shared<Mesh>(partOfMesh(mesh, kMaxJudged));
}

// The frame that engines show with tangents at the vertices: they normalise what they interpolate, which mikktspace.h
// does not.
f64::cotan_frame frameInEngines(const MappedSurface& s, Frame frame, TangentOrigin tangents, const MeshPoint& p)
{
    const f64::cotan_frame f = frameAt(s, frame, tangents, p.triangle, p.barycentric);
    if (info(frame).normal != FrameNormal::nobody)
        return f;
    const glm::dvec4 t = tangentAt(s, frame, tangents, p.triangle, p.barycentric);
    return f64::cotan_frame_mikktspace(f64::cotan_normalize_or(f.n, f.n),
                                       f64::cotan_normalize_or(glm::dvec3(t), glm::dvec3(0)), t.w);
}

// A map that a primitive shows: its own, or that of its coat.
struct ShownMap {
    const Image* image;
    const Sampler* sampler;
    f64::cotan_normal_format format;
};

std::vector<ShownMap> mapsOf(const Scene& scene, const Material& m)
{
    std::vector<ShownMap> maps;
    const auto add = [&](const Texture& texture, const Convention& stored, float scale) {
        const Image& image = scene.images[std::size_t(texture.image)];
        if (hasPixels(image) && std::abs(scale) > kFlattened)
            maps.push_back(
                {&image, &texture.sampler, toFormat<f64::cotan_normal_format>(stored, image.type, double(scale))});
    };
    const auto sameUv = [](const Texture& a, const Texture& b) {
        return a.texcoord == b.texcoord && a.uRow == b.uRow && a.vRow == b.vRow;
    };
    if (m.normalMap.present())
        add(m.normalMap, m.normalFormat, m.normalScale);
    if (m.coat.normalMap.present() && m.coat.strength > 0
        && (!m.normalMap.present() || sameUv(m.normalMap, m.coat.normalMap)))
        add(m.coat.normalMap, m.coat.normalFormat, m.coat.normalScale);
    return maps;
}

class Chooser {
public:
    Chooser(const Scene& scene, std::size_t mesh, std::vector<glm::dmat3> stretches, std::size_t points,
            const ChoiceOptions& options)
        : scene_(scene), mesh_(scene.meshes[mesh]), material_(scene.materials[std::size_t(mesh_.material)]),
          stretches_(std::move(stretches)), pointCount_(points), options_(options)
    {
        decision_.mesh = mesh;
    }

    FrameDecision run()
    {
        if (!material_.normalMap.present() && !material_.coat.normalMap.present())
            return decision_;
        const bool stored = options_.tangents == TangentOrigin::stored && mesh_.tangents.size() == mesh_.vertexCount()
            && !mesh_.tangents.empty();
        if (const std::optional<Frame> named = namedFrameOf(scene_, mesh_)) {
            decision_.meaning = MapMeaning::named;
            decision_.reason = ChoiceReason::named;
            decision_.frame = *named;
            decision_.tangents = readsTangents(*named) && stored ? TangentOrigin::stored : TangentOrigin::generated;
            return decision_;
        }
        decision_.meaning = stored ? MapMeaning::stored : MapMeaning::mikktspace;
        prepare();
        if (!decision_.notJudged.empty()) {
            keep(ChoiceReason::notJudged, stored);
            return decision_;
        }
        std::size_t first = std::size(kCandidates) + 1;
        for (const Frame frame : kCandidates) {
            if (first < decision_.candidates.size() && !options_.all)
                break;
            decision_.candidates.push_back(measured(frame, TangentOrigin::generated));
            if (decision_.candidates.back().within(options_.limits))
                first = std::min(first, decision_.candidates.size() - 1);
        }
        if (stored && (first > std::size(kCandidates) || options_.all))
            decision_.candidates.push_back(measured(Frame::mikktspace, TangentOrigin::stored));
        if (first > std::size(kCandidates)) {
            keep(ChoiceReason::keeps, stored);
            return decision_;
        }
        decision_.reason = ChoiceReason::fits;
        decision_.frame = decision_.candidates[first].frame;
        return decision_;
    }

private:
    void keep(ChoiceReason reason, bool stored)
    {
        decision_.reason = reason;
        decision_.frame = stored ? Frame::mikktspace : Frame::orthonormal;
        decision_.tangents = stored ? TangentOrigin::stored : TangentOrigin::generated;
    }

    const Texture& uvOf() const
    {
        return material_.normalMap.present() ? material_.normalMap : material_.coat.normalMap;
    }

    // Sets the points and the texels there, or why there are none.
    void prepare()
    {
        maps_ = mapsOf(scene_, material_);
        const bool pixels = hasPixels(scene_.images[std::size_t(uvOf().image)]);
        if (mesh_.texcoords[uvSetOf(uvOf())].empty())
            decision_.notJudged = "no uv";
        else if (!pixels)
            decision_.notJudged = "the pixels of its map were not read";
        if (!decision_.notJudged.empty())
            return;
        part_ = judgedPart(mesh_);
        surface_ = makeSurface(part_, uvOf(), glm::dmat3(1), {});
        for (const glm::dmat3& stretch : stretches_) {
            points_.push_back(pointsOver(placedBy(surface_, stretch), pointCount_));
            if (points_.back().empty())
                decision_.notJudged = "no triangle has an area both in space and in uv";
        }
    }

    // The surface with the vertex data of a frame, made on first use.
    const MappedSurface& surfaceFor(Frame frame, TangentOrigin tangents)
    {
        if (!readsVertices(frame) || tangents == TangentOrigin::stored)
            return surface_;
        const auto [made, isNew] = made_.try_emplace(frame);
        if (isNew) {
            FrameSet wanted;
            wanted.set(std::size_t(frame));
            made->second = makeSurface(part_, uvOf(), glm::dmat3(1), wanted);
        }
        return made->second;
    }

    FrameCandidate measured(Frame frame, TangentOrigin tangents)
    {
        FrameCandidate worst{.frame = frame, .tangents = tangents};
        const TangentOrigin meant =
            decision_.meaning == MapMeaning::stored ? TangentOrigin::stored : TangentOrigin::generated;
        const MappedSurface &read = surfaceFor(frame, tangents), &meaning = surfaceFor(Frame::mikktspace, meant);
        for (const ShownMap& map : maps_)
            for (std::size_t k = 0; k < stretches_.size(); ++k) {
                const MappedSurface r = placedBy(read, stretches_[k]), e = placedBy(meaning, stretches_[k]);
                ValueStatistics errors;
                for (const MeshPoint& p : points_[k]) {
                    const glm::dvec3 m = decodedAt(*map.image, map.sampler->wrapU, map.sampler->wrapV, map.format,
                                                   uvAt(surface_, p.triangle, p.barycentric));
                    const auto normal = [&](const MappedSurface& s, Frame f, TangentOrigin t) {
                        const f64::cotan_frame frameThere = frameInEngines(s, f, t, p);
                        return f64::cotan_normalize_or(f64::cotan_apply(frameThere, m), frameThere.n);
                    };
                    errors.add(lint::degreesBetween(normal(r, frame, tangents), normal(e, Frame::mikktspace, meant)));
                }
                if (!(worst.mean >= errors.mean())) // also if there is none yet
                    worst = {frame,
                             tangents,
                             errors.count(),
                             errors.mean(),
                             errors.percentile(0.95),
                             std::max(errors.percentile(0.99), worst.points > 0 ? worst.percentile99 : 0),
                             std::max(errors.maximum(), worst.points > 0 ? worst.maximum : 0)};
                else
                    worst.percentile99 = std::max(worst.percentile99, errors.percentile(0.99));
            }
        if (maps_.empty()) // flattened
            worst = {frame, tangents, points_.front().size(), 0, 0, 0, 0};
        return worst;
    }

    const Scene& scene_;
    const Mesh& mesh_;
    const Material& material_;
    std::vector<glm::dmat3> stretches_;
    std::size_t pointCount_;
    const ChoiceOptions& options_;
    FrameDecision decision_;
    std::vector<ShownMap> maps_;
    std::shared_ptr<const Mesh> part_;
    MappedSurface surface_;
    std::vector<std::vector<MeshPoint>> points_; // for each stretch
    std::map<Frame, MappedSurface> made_;
};

std::string nameOf(const FrameCandidate& c)
{
    return c.tangents == TangentOrigin::stored ? "the file's tangents" : std::string(name(c.frame));
}

} // namespace

const FrameCandidate* FrameDecision::chosen() const
{
    const auto found = std::ranges::find_if(
        candidates, [&](const FrameCandidate& c) { return c.frame == frame && c.tangents == tangents; });
    return found != candidates.end() ? &*found : nullptr;
}

std::vector<FrameDecision> chooseFrames(const Scene& scene, const ChoiceOptions& options)
{
    std::vector<FrameDecision> decisions;
    if (!checkScene(scene, "scene", {.finite = false, .pixels = false}))
        return decisions;
    std::vector<std::vector<glm::dmat3>> stretches(scene.meshes.size());
    for (const Instance& i : scene.instances)
        if (auto& known = stretches[std::size_t(i.mesh)]; known.size() < kMaxStretches)
            addDistinctLinearMap(known, glm::dmat3(glm::dmat4(i.toWorld)));
    addIdentityWhereEmpty(stretches);
    const std::size_t points = pointsOfEach(scene.meshes.size());
    decisions.resize(scene.meshes.size());
    parallelFor(std::size_t(0), scene.meshes.size(), [&](std::size_t i) {
        decisions[i] = Chooser(scene, i, std::move(stretches[i]), points, options).run();
    });
    return decisions;
}

std::string textOf(const FrameDecision& d)
{
    const auto error = [](const FrameCandidate& c) {
        return fmt::format("{:.2f} degrees on average, {:.1f} on 1 % of the area", c.mean, c.percentile99);
    };
    switch (d.reason) {
    case ChoiceReason::noMap: return "no normal map";
    case ChoiceReason::named: return fmt::format("{}, as the file says", name(d.frame));
    case ChoiceReason::notJudged:
        return fmt::format("not judged: {}; {}", d.notJudged,
                           d.dropsTangents() ? std::string(name(d.frame)) : "its tangents stay");
    case ChoiceReason::fits: return fmt::format("{}: {}", nameOf(*d.chosen()), error(*d.chosen()));
    case ChoiceReason::keeps: break;
    }
    std::string text = d.dropsTangents() ? "no frame reads its map within the limits" : "its tangents stay";
    for (const FrameCandidate& c : d.candidates)
        if (c.tangents == TangentOrigin::generated)
            text +=
                fmt::format("{} {} {:.2f}", &c == &d.candidates.front() ? "; degrees on average without them:" : ",",
                            nameOf(c), c.mean);
    return text;
}

} // namespace cotan
