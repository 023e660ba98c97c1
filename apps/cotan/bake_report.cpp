#include "bake_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "files/system/system.hpp"

namespace cotan::app {

namespace {

double peakMegabytes() { return peakMemory() / (1 << 20); }

Json describe(const BakeStatistics& s)
{
    return {{"texels", s.texels},
            {"covered", s.covered},
            {"touched", s.touched},
            {"missed", s.missed},
            {"further_away", s.further},
            {"not_the_nearest", s.nearer},
            {"negative_z", s.negative},
            {"claimed_twice", s.twice},
            {"disputed", s.disputed},
            {"rays", s.rays},
            {"ray_distance", s.rayDistance},
            {"ray_start", s.rayStart},
            {"triangles_mirrored", s.mirroredTriangles},
            {"triangles_without_uv_area", s.degenerateTriangles},
            {"seconds", s.seconds},
            {"rays_per_second", s.seconds > 0 ? double(s.rays) / s.seconds : 0}};
}

constexpr Named<BakeProblem::Kind> kProblems[] = {{"no_surface", BakeProblem::Kind::noSurface},
                                                  {"too_far", BakeProblem::Kind::tooFar},
                                                  {"below_horizon", BakeProblem::Kind::belowHorizon},
                                                  {"disputed", BakeProblem::Kind::disputed},
                                                  {"beyond_part", BakeProblem::Kind::beyondPart}};

// The options that help against a problem. objects: that share the map.
std::string optionsAgainst(const BakeJob& job, std::size_t objects, const BakeProblem& problem)
{
    const std::string mask = job.files.mask.empty() ? "--mask shows where" : job.files.mask.string() + " shows where";
    switch (problem.kind) {
    case BakeProblem::Kind::tooFar: return job.cage.empty() ? "--max-distance, --cage; " + mask : mask;
    case BakeProblem::Kind::belowHorizon:
        return (job.cage.empty() ? "--cage" : "the cage")
            + std::string(job.options.matchByName ? "" : ", --match-by-name") + "; " + mask;
    case BakeProblem::Kind::disputed:
        return objects > 1
            ? fmt::format("--per-object makes a map for each of the {} objects, --object NAME one; {}", objects, mask)
            : mask;
    case BakeProblem::Kind::beyondPart: return "--extrusion";
    default: return mask;
    }
}

Json problemsToJson(const std::vector<BakeProblem>& problems)
{
    Json list = Json::array();
    for (const BakeProblem& p : problems)
        list.push_back({{"kind", wordOf(kProblems, p.kind)},
                        {"texels", p.texels},
                        {"degrees", p.degrees > 0 ? Json(p.degrees) : Json(nullptr)},
                        {"at", {p.at.x, p.at.y}},
                        {"text", p.text}});
    return list;
}

// Prints the statistics, and warns of problems.
void explain(const BakeJob& job, const MapReport& done)
{
    const BakeStatistics& s = done.statistics;
    say(job.common,
        "{} of {} texels covered, {} more filled at the edges of charts; {:.1f} s, {:.1f} million rays per second",
        s.covered, s.texels, s.touched, s.seconds, double(s.rays) / s.seconds / 1e6);
    if (s.covered == 0)
        warn(job.common, "no triangle covers the centre of a texel on tile {}; only edges touch it (--udim, --size)",
             done.tile);
    for (const BakeProblem& problem : done.problems)
        warn(job.common, "{} ({})", problem.text, optionsAgainst(job, done.objects, problem));
    const Frame frame = job.options.bake.frame;
    const bool perTriangle = !readsVertices(frame) && frame != Frame::orthonormal;
    if ((job.makes(BakeKind::normal) || job.makes(BakeKind::bentNormal)) && perTriangle)
        warn(job.common,
             "the frame {} changes from triangle to triangle: filtering shows a crease one texel wide at "
             "edges of curved meshes; bake and draw with smooth to avoid it",
             name(frame));
}

// The kind or the constant of each channel.
std::vector<std::string> channelsOf(const PackedMap& map)
{
    std::vector<std::string> words;
    for (std::size_t i = 0; i < map.kinds.size(); ++i)
        words.push_back(map.kinds[i] ? wordOf(kBakeKinds, *map.kinds[i]) : fmt::format("{:g}", map.constants[i]));
    return words;
}

// What the numbers of a map mean.
std::string meaningOf(const BakeJob& job, const MapReport& done, std::size_t map)
{
    const BakeModelOptions& options = job.options;
    const bool isFloat = options.stored.type == PixelType::float32;
    if (map >= options.kinds.size())
        return fmt::format("{}", fmt::join(channelsOf(options.packed[map - options.kinds.size()]), ", "));
    switch (options.kinds[map]) {
    case BakeKind::normal:
    case BakeKind::bentNormal: return fmt::format("{}, {}", name(options.bake.frame), job.convention);
    case BakeKind::thickness: return isFloat ? "in units" : fmt::format("1 is {:.3g} units", done.units[map]);
    case BakeKind::curvature:
        return isFloat ? "1 over units" : fmt::format("0.5 is flat, 1 a ball of {:.3g} units", done.units[map]);
    case BakeKind::baseColor:
    case BakeKind::emissive:
    case BakeKind::id: return isFloat ? "linear" : "sRGB";
    case BakeKind::roughnessMetallic: return "green, blue";
    case BakeKind::occlusion:
    case BakeKind::roughness:
    case BakeKind::metallic: return "0 to 1";
    case BakeKind::height: return isFloat ? "in units" : "from the lowest to the highest";
    default: return "world axes";
    }
}

// Of each map: its kind and file, and what its numbers mean where they are scaled.
Json mapsToJson(const BakeJob& job, const MapReport& done)
{
    Json maps = Json::array();
    const std::vector<std::string> names = namesOf(job.options);
    for (std::size_t i = 0; i < names.size(); ++i) {
        Json map{{"kind", names[i]}, {"output", done.job.files.maps[i].string()}};
        if (i >= job.options.kinds.size()) {
            map["channels"] = channelsOf(job.options.packed[i - job.options.kinds.size()]);
            maps.push_back(std::move(map));
            continue;
        }
        const BakeKind kind = job.options.kinds[i];
        if (done.units[i] > 0 && job.options.stored.type != PixelType::float32)
            map["unit"] = done.units[i];
        if (kind == BakeKind::position && job.options.stored.type != PixelType::float32)
            map["box"] = {{done.box.low.x, done.box.low.y, done.box.low.z},
                          {done.box.high.x, done.box.high.y, done.box.high.z}};
        for (const IdColor& id : done.ids)
            if (kind == BakeKind::id)
                map["ids"].push_back({{"name", id.name}, {"color", fmt::format("#{:06x}", id.color)}});
        maps.push_back(std::move(map));
    }
    return maps;
}

} // namespace

std::string readersOf(Frame frame)
{
    if (frame == Frame::mikktspace)
        return "the map is for the frame mikktspace: Unity, Unreal, Godot, Blender and glTF viewers read it with "
               "tangents that they generate or import, Cotan's shaders without tangents with the frame orthonormal";
    if (frame == Frame::areaWeighted)
        return "the map is for the frame area-weighted: engines that make tangents by meshoptimizer's defaults read "
               "it, "
               "and glTF viewers with the tangents of this frame in the file (cotan tangents --frame area-weighted)";
    return fmt::format("the map is for the frame {0}: read it with that; engines use MikkTSpace tangents and show it "
                       "wrongly (--frame mikktspace is for them)",
                       name(frame));
}

void tell(const BakeJob& job, const MapReport& done)
{
    const BakeModelOptions& options = job.options;
    explain(job, done);
    const std::vector<std::string> names = namesOf(options);
    for (std::size_t i = 0; i < names.size(); ++i)
        say(job.common, "map in {} ({}, {}, {} bit){}", done.job.files.maps[i].string(), names[i],
            meaningOf(job, done, i), wordOf(kBitCounts, options.stored.type),
            i + 1 == names.size() ? fmt::format("; peak memory {:.0f} MiB", peakMegabytes()) : "");
}

Json toJson(const BakeJob& job, const MapReport& done)
{
    const BakeOptions& bake = job.options.bake;
    Json report{
        {"low", job.low},
        {"high", job.high},
        {"object", done.job.object.empty() ? Json(nullptr) : Json(done.job.object)},
        {"tile", done.tile},
        {"output", done.job.files.maps.front().string()},
        {"frame", name(bake.frame)},
        {"kind", namesOf(job.options).front()},
        {"maps", mapsToJson(job, done)},
        {"size", {bake.width, bake.height}},
        {"high_normals", wordOf(kHighSources, job.highNormals)},
        {"warnings", done.warnings},
        {"triangles_high", done.highTriangles},
        {"triangles_low", done.lowTriangles},
        {"usable", done.problems.empty()},
        {"problems", problemsToJson(done.problems)},
        {"bake", describe(done.statistics)},
        {"seconds", {{"load", done.prepareSeconds}, {"pad", done.statistics.padSeconds}, {"write", done.writeSeconds}}},
        {"peak_megabytes", peakMegabytes()}};
    if (done.verified)
        report["verify"] = *done.verified;
    return report;
}

} // namespace cotan::app
