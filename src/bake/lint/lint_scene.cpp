#include "cotan/lint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "bake/lint/map_fit.hpp"
#include "lint_parts.hpp"
#include "scene/geometry.hpp"
#include "scene/hard_edges.hpp"
#include "scene/normal_maps.hpp"
#include "scene/scene_check.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

constexpr double kFieldOfView = 45; // degrees, vertical
constexpr double kImageRows = 1080; // of the image
constexpr double kHalfDegree = 0.5;

// The distinct linear maps by which instances place each mesh; the identity for a mesh without instances.
std::vector<std::vector<glm::dmat3>> placings(const Scene& scene)
{
    std::vector<std::vector<glm::dmat3>> result(scene.meshes.size());
    for (const Instance& i : scene.instances)
        addDistinctLinearMap(result[std::size_t(i.mesh)], glm::dmat3(glm::dmat4(i.toWorld)));
    addIdentityWhereEmpty(result);
    return result;
}

// The distance from which a sphere around the scene just fits into the image.
double fittingDistance(const Scene& scene)
{
    const Bounds box = bounds(scene);
    if (box.empty())
        return 1;
    const double radius = glm::length(glm::dvec3(box.high) - glm::dvec3(box.low)) / 2;
    return radius > 0 ? radius / std::sin(glm::radians(kFieldOfView / 2)) : 1;
}

// Sets the error from float derivatives of uv: about 1 degree times uv * 1e-6 / footprint, with the footprint in uv
// (docs/explanation/theory.md, "Rounding"). It is proportional to 1 / distance.
void addPrecision(PrimitiveLint& p, double distance)
{
    const double footprintPerDistance = 2 * std::tan(glm::radians(kFieldOfView / 2)) / kImageRows * p.uv.gradient;
    if (!(footprintPerDistance > 0))
        return;
    const double error = std::max(p.uv.largestUv, 1.0) * 1e-6 / footprintPerDistance;
    p.precision = std::min(error / distance, 180.0);
    p.closest = error / kHalfDegree;
}

std::string whyNotJudged(const PrimitiveLint& p, const Image& map)
{
    if (p.unread)
        return map.name.empty() ? "its pixels were not read" : map.name + " was not read";
    if (!p.hasUv)
        return "no uv";
    return p.readings.front().error.count == 0 ? "no triangle has an area both in space and in uv" : "";
}

// The frame of a material's maps: the one that the file names, otherwise glTF's.
Frame madeFor(const Material& material) { return material.normalFrame.value_or(Frame::mikktspace); }

// The frames that lint reads at vertices: MikkTSpace, meshoptimizer's that engines may have instead, the maps' own, and
// `smooth`, which may be advised.
FrameSet framesOfLint(const Material& material)
{
    FrameSet frames;
    for (const Frame frame : {Frame::mikktspace, Frame::smooth, madeFor(material)})
        frames.set(std::size_t(frame));
    frames.set(std::size_t(Frame::areaWeighted), madeFor(material) == Frame::mikktspace);
    return frames;
}

// Reports progress in triangles, and remembers a request to stop.
struct TriangleProgress {
    const Progress& progress;
    double all = 1, done = 0;
    bool stopped = false;

    // Returns whether to go on.
    bool add(double triangles)
    {
        done += triangles;
        stopped = stopped || (progress && !progress(std::min(done / all, 1.0)));
        return !stopped;
    }
};

// Fractions of the time of one mesh: its surface, each of three steps for placings, and each of three for all meshes.
constexpr double kOfSurface = 0.4, kOfLook = 0.15, kOfWhole = 0.05;

// Incomplete if `counted` is stopped. Counts three steps of that many triangles. surfaces: of the whole scene.
PrimitiveLint lintPrimitive(const Scene& scene, const Mesh& mesh, const MappedSurface& surface, double distance,
                            std::size_t surfaces, TriangleProgress& counted, double triangles)
{
    // Limit of lint::visibility, lower if there are many surfaces, so that the total time is limited.
    const double maxPixels =
        std::min(lint::kMaxPixels, 10 * lint::kMaxPixels / double(std::max<std::size_t>(surfaces, 1)));
    const Material& material = scene.materials[std::size_t(mesh.material)];
    PrimitiveLint p;
    p.mesh = mesh.name;
    p.material = material.name;
    p.tangentsFor = material.tangentsFor;
    const std::vector<MeshPoint> points = pointsOver(surface, pointsOfEach(surfaces));
    const auto rotationWith = [&](Frame to) {
        return directionTurn(surface, points, {.from = Frame::mikktspace, .to = to});
    };
    if (!p.tangentsFor.empty())
        p.rotation = {rotationWith(Frame::orthonormal), rotationWith(Frame::cotangent), rotationWith(Frame::smooth)};
    const Texture& coat = material.coat.normalMap;
    // Not converted; or tangents are required, as gltf::tangentRequirement says.
    if (coat.present() && (!hasPixels(scene.images[std::size_t(coat.image)]) || !material.normalMap.present()))
        p.tangentsFor = "KHR_materials_clearcoat";
    if (p.tangentsFor == "KHR_materials_clearcoat" || !material.normalMap.present())
        p.rotation = {};
    p.madeFor = madeFor(material);
    p.triangles = mesh.triangleCount();
    p.hasUv = surface.hasUv();
    p.uv = lint::uvQuality(surface);
    if (!counted.add(kOfLook * triangles))
        return p;
    p.steps = lint::edgeSteps(surface);
    p.stored = lint::storedTangents(surface);
    if (!counted.add(kOfLook * triangles))
        return p;
    if (material.greenReversed) // w of the file, not of the scene
        p.stored.reversedW = 1 - p.stored.reversedW;
    addPrecision(p, distance);
    if (material.normalMap.present()) {
        p.image = material.normalMap.image;
        const Image& map = scene.images[std::size_t(p.image)];
        p.unread = !hasPixels(map);
        if (p.hasUv && !p.unread)
            p.readings = lint::readings(surface, points, p.madeFor, material, map, maxPixels);
        p.notJudged = whyNotJudged(p, map);
    }
    counted.add(kOfLook * triangles);
    return p;
}

// Primitives with the same normal map share its texels; one without a map is measured alone. Placings count once.
void addOverlaps(LintReport& report, const std::vector<MapUse>& uses)
{
    std::map<int, std::pair<std::vector<const MappedSurface*>, std::vector<UvQuality*>>> groups;
    auto& primitives = report.primitives;
    for (std::size_t i = 0; i < uses.size(); ++i) {
        if (primitives[i].placing > 0)
            continue;
        const int key = primitives[i].image >= 0 ? primitives[i].image : -1 - int(i);
        groups[key].first.push_back(&uses[i].surface);
        groups[key].second.push_back(&primitives[i].uv);
    }
    // Very many groups get coarser rasters: all together have no more texels than 64 fine ones.
    const double scale = std::sqrt(64 / std::max(double(groups.size()), 64.0));
    for (const auto& [key, group] : groups)
        lint::countOverlaps(group.first, group.second, int(512 * scale));
    for (std::size_t i = 0; i < uses.size(); ++i)
        if (primitives[i].placing > 0) {
            primitives[i].uv.overlapping = primitives[i - 1].uv.overlapping;
            primitives[i].uv.overlappingMirrored = primitives[i - 1].uv.overlappingMirrored;
        }
}

void addMaps(LintReport& report, const Scene& scene)
{
    std::map<int, std::array<bool, 2>> readers; // by image: some material reads green as declared, reversed
    for (const Material& m : scene.materials)
        for (const int image : {m.normalMap.image, m.coat.normalMap.image})
            readers[image][m.greenReversed] = true;
    std::set<int> done;
    const auto add = [&](const Material& m, int image, bool greenUp) {
        if (image < 0 || !done.insert(image).second)
            return;
        const Image& map = scene.images[std::size_t(image)];
        GreenEvidence& g = report.maps.emplace_back(
            GreenEvidence{.image = image, .name = map.name, .declaredUp = greenUp != m.greenReversed});
        g.reversedByTangents = readers[image][true];
        g.reversedEverywhere = g.reversedByTangents && !readers[image][false];
        if (!hasPixels(map))
            return;
        g.verdict = maps::greenOf(map, maps::AlphaUse::ignored);
        const maps::NormalStatistics s = maps::statisticsOfSample(map);
        g.faults = maps::faultsInModel(s, &g.verdict);
        std::erase_if(g.faults, [](const maps::Fault& f) { return f.kind == maps::Fault::Kind::greenDown; });
        g.sentence = maps::sentenceOf(map.name.empty() ? fmt::format("Image {}", image) : map.name, g.faults, s);
        g.note = maps::noteOf(s);
    };
    for (const Material& m : scene.materials)
        add(m, m.normalMap.image, m.normalFormat.greenUp);
    for (const Material& m : scene.materials)
        add(m, m.coat.normalMap.image, m.coat.normalFormat.greenUp);
}

// A clear coat's image, and how a primitive reads it.
using CoatUse = std::pair<int, MapUse>;

// Measures each map as it is with the frames that may be advised.
void addFits(LintReport& report, const Scene& scene, std::vector<MapUse> uses, std::vector<CoatUse> coats)
{
    std::map<int, std::vector<MapUse>> readers;
    for (std::size_t i = 0; i < uses.size(); ++i)
        if (report.primitives[i].image >= 0)
            readers[report.primitives[i].image].push_back(std::move(uses[i]));
    for (auto& [image, use] : coats)
        readers[image].push_back(std::move(use));
    const TangentOrigin from = lint::distrustStored(report) ? TangentOrigin::generated : TangentOrigin::stored;
    std::map<int, Frame> frames; // of each image: that of the first material with it
    for (const Material& m : scene.materials)
        for (const Texture* const texture : {&m.normalMap, &m.coat.normalMap})
            frames.emplace(texture->image, madeFor(m));
    for (auto& [image, mapUses] : readers) {
        const Image& map = scene.images[std::size_t(image)];
        MapFit fit{{}, image, map.name};
        std::erase_if(mapUses, [](const MapUse& use) { return !use.surface.hasUv(); });
        if (hasPixels(map)) {
            std::vector<FramePair> pairs;
            for (const Frame frame : {Frame::orthonormal, Frame::cotangent, Frame::smooth})
                pairs.push_back({frames.at(image), frame, from, TangentOrigin::generated});
            const std::vector<ValueSummary> errors = mapErrors(map, map, mapUses, pairs, {}, pointsOfEach(uses.size()));
            fit.orthonormal = errors[0];
            fit.cotangent = errors[1];
            fit.smooth = errors[2];
        }
        report.fits.push_back(std::move(fit));
    }
}

} // namespace

std::size_t lintBytes(const Scene& scene)
{
    std::size_t kept = 0, most = 0;
    for (const Mesh& mesh : scene.meshes) {
        const FrameSet frames = framesOfLint(scene.materials[std::size_t(mesh.material)]);
        const SurfaceBytes bytes = surfaceBytes(mesh.vertexCount(), mesh.triangleCount(), frames);
        kept += bytes.kept + kRasterBytes * mesh.triangleCount();
        most = std::max(most, bytes.making);
    }
    return kept + most;
}

LintReport lintScene(const Scene& scene, const LintOptions& options)
{
    return *lintScene(scene, {.distance = options.distance, .limits = options.limits}, {});
}

Result<LintReport> lintScene(const Scene& scene, const LintOptions& options, const Progress& progress)
{
    LintReport report;
    if (const Status sound = checkScene(scene, "scene", {.finite = false, .pixels = false}); !sound) {
        report.recommendation = report.defects = "Nothing was checked: " + sound.error().message + ".";
        return report;
    }
    if (const std::size_t bytes = lintBytes(scene); options.memory > 0 && bytes > options.memory)
        return memoryError(fmt::format("{}: its triangles take {} MiB to judge, the limit is {} MiB", scene.name,
                                       bytes >> 20, options.memory >> 20));
    report.distance = options.distance > 0 ? options.distance : fittingDistance(scene);
    report.hints = hardEdgeHints(scene, /*beforeBaking*/ true);
    std::vector<MapUse> uses;
    std::vector<CoatUse> coats;
    const auto placed = placings(scene);
    std::size_t triangles = 0;
    for (const Mesh& mesh : scene.meshes)
        triangles += mesh.triangleCount();
    TriangleProgress counted{progress, double(std::max<std::size_t>(triangles, 1))};
    std::size_t surfaces = 0;
    for (const auto& transforms : placed)
        surfaces += std::min(transforms.size(), kMaxPlacings);
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        const Material& material = scene.materials[std::size_t(mesh.material)];
        const std::shared_ptr<const Mesh> held(std::shared_ptr<void>(), &mesh); // the scene outlives the surfaces
        const FrameSet frames = framesOfLint(material);
        const MappedSurface own = makeSurface(held, frameTexture(material), glm::dmat3(1), frames);
        MappedSurface ofCoat;
        if (material.coat.normalMap.present())
            ofCoat = makeCoatSurface(held, frameTexture(material), material.coat.normalMap, frames);
        const std::size_t count = std::min(placed[i].size(), kMaxPlacings);
        const double perPlacing = double(mesh.triangleCount()) / double(count);
        if (!counted.add(kOfSurface * double(mesh.triangleCount())))
            return stoppedError();
        for (std::size_t k = 0; k < count; ++k) {
            const auto useOf = [&](const MappedSurface& surface, const auto& reader) { // reader: material or coat
                const Sampler& sampler = reader.normalMap.sampler;
                return MapUse{placedBy(surface, placed[i][k]), reader.normalFormat, double(reader.normalScale),
                              sampler.wrapU, sampler.wrapV};
            };
            uses.push_back(useOf(own, material));
            PrimitiveLint p =
                lintPrimitive(scene, mesh, uses.back().surface, report.distance, surfaces, counted, perPlacing);
            if (counted.stopped)
                return stoppedError();
            p.meshIndex = i;
            p.placing = k;
            p.placings = placed[i].size();
            report.primitives.push_back(std::move(p));
            if (const Texture& coat = material.coat.normalMap; coat.present())
                coats.push_back({coat.image, useOf(ofCoat, material.coat)});
        }
    }
    addOverlaps(report, uses);
    if (!counted.add(kOfWhole * counted.all))
        return stoppedError();
    addMaps(report, scene);
    if (!counted.add(kOfWhole * counted.all))
        return stoppedError();
    addFits(report, scene, std::move(uses), std::move(coats));
    report.decisions = chooseFrames(scene, {.limits = options.limits, .all = true});
    counted.done = counted.all; // also without triangles
    if (!counted.add(0))
        return stoppedError();
    if (const auto named = namedFrame(scene))
        report.named = named->frame;
    lint::recommend(report);
    return report;
}

} // namespace cotan
