#include "commands.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <sys/resource.h>

#include "bake_options.hpp"
#include "core/file_names.hpp"
#include "cotan/convention.hpp"
#include "cotan/convert.hpp"
#include "cotan/image.hpp"
#include "gltf_open.hpp"
#include "image/format_table.hpp"
#include "map_files/placed_images.hpp"
#include "parse.hpp"
#include "verify.hpp"

namespace cotan::app {

namespace {

double peakMegabytes()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024;
}

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
            {"rays", s.rays},
            {"ray_distance", s.rayDistance},
            {"ray_start", s.rayStart},
            {"triangles_mirrored", s.mirroredTriangles},
            {"triangles_without_uv_area", s.degenerateTriangles},
            {"seconds", s.seconds},
            {"rays_per_second", s.seconds > 0 ? double(s.rays) / s.seconds : 0}};
}

// Warns of covered texels where rays found nothing, or another surface than the nearest one.
void explainRays(const BakeCommandOptions& o, const BakeStatistics& s)
{
    if (s.further > 0 && o.cage.empty())
        warn(o,
             "{} of {} covered texels found no high surface within {:g} units; there is one further away "
             "(--max-distance, --cage; --mask shows where)",
             s.further, s.covered, s.rayDistance);
    else if (s.further > 0)
        warn(o,
             "{} of {} covered texels found no high surface within the reach of the cage; there is one further away "
             "(--mask shows where)",
             s.further, s.covered);
    if (s.missed > s.further)
        warn(o,
             "{} of {} covered texels have no high surface in front or behind at any distance: it has holes, or "
             "ends before the low mesh does (--mask shows where)",
             s.missed - s.further, s.covered);
    if (s.nearer > 0)
        warn(o,
             "{} of {} covered texels show the first surface from outside, not the nearest one: parts are detached "
             "there "
             "({})",
             s.nearer, s.covered,
             s.rayStart > 0 && o.extrusion == 0
                 ? fmt::format("measured, up to {:.3g} units; --extrusion sets how far; --search nearest", s.rayStart)
                 : "--search nearest");
}

// Prints the statistics, and warns of what they reveal.
void explain(const BakeCommandOptions& o, const BakeJob& job, const BakeStatistics& s)
{
    say(o, "{} of {} texels covered, {} more filled at the edges of charts; {:.1f} s, {:.1f} million rays per second",
        s.covered, s.texels, s.touched, s.seconds, double(s.rays) / s.seconds / 1e6);
    if (s.covered == 0)
        warn(o, "no triangle covers the centre of a texel on tile {}; only edges touch it (--udim, --size)", o.udim);
    explainRays(o, s);
    if (s.negative > 0)
        warn(o,
             "{} of {} covered texels point below the frame's horizon (negative z): the low mesh is too coarse there, "
             "or rays hit another part",
             s.negative, s.covered);
    if (s.twice > 0)
        warn(o, "{} of {} covered texels are claimed by several triangles; the first in the file won{}", s.twice,
             s.covered,
             job.objects > 1 ? fmt::format("; the low mesh has {} objects: --per-object makes a map for each, --object "
                                           "NAME one",
                                           job.objects)
                             : "");
    const bool perTriangle = !readsVertices(job.frame()) && job.frame() != Frame::orthonormal;
    if (job.setup.options.bake.kind == BakeKind::normal && perTriangle)
        warn(o,
             "the frame {} changes from triangle to triangle: filtering shows a crease one texel wide at "
             "edges of curved meshes; bake and draw with smooth to avoid it",
             name(job.frame()));
}

// Checks the options for an -o that is a glTF model, before anything is loaded. Errors: ErrorKind::usage.
Status checkModelOutput(const BakeCommandOptions& o)
{
    if (!namedAsGltf(o.output))
        return Done{};
    if (o.kind != "normal")
        return usageError(
            fmt::format("-o {}: expected --kind normal for a map in a model; found {}", o.output.string(), o.kind));
    if (o.bits == 32)
        return usageError(
            fmt::format("-o {}: expected --bits 8 or 16 for an image in a model; found 32", o.output.string()));
    if (o.udim != 1001)
        return usageError(
            fmt::format("-o {}: one map covers tile 1001 of the texture coordinates only; found --udim {}",
                        o.output.string(), o.udim));
    return Done{};
}

// Whether the stored tangents are used, and all baked meshes have them.
bool hasStoredTangents(const Scene& low, const BakeModelOptions& options)
{
    return options.tangents == TangentOrigin::stored
        && std::all_of(low.meshes.begin(), low.meshes.end(), [&](const Mesh& mesh) {
               return (options.material >= 0 && mesh.material != options.material) || mesh.indices.empty()
                   || !mesh.tangents.empty();
           });
}

// Writes the low model with the map. Warns if readers that generate MikkTSpace tangents would show the map wrongly.
Status writeBakedModel(const BakeCommandOptions& o, const BakeJob& job, const Image& map)
{
    PutMapOptions options{.frame = job.frame(),
                          .material = {},
                          .expansion = job.setup.options.stored.format.expansion,
                          .keepTangents = hasStoredTangents(job.lowScene, job.setup.options)};
    if (o.material >= 0) // by name, since a scene numbers its materials in the order in which meshes use them
        options.material = job.lowScene.materials[std::size_t(o.material)].name;
    const auto written = writeModelWithMap(job.lowScene, o.low, map, options, o.output);
    if (!written)
        return withBakeOptionNames(o, written.error());
    for (const std::string& note : written->notes)
        warn(o, note);
    return Done{};
}

// The output files of one map.
std::vector<PlannedOutput> filesOf(const BakeCommandOptions& o)
{
    std::vector<PlannedOutput> files = {{"-o", o.output}, {"--mask", o.mask}};
    if (!o.verify.empty())
        for (const PlannedOutput& picture : plannedIn("--verify", o.verify, imageNames(kBakeNames, kBakeViews)))
            files.push_back(picture);
    return files;
}

// Checks the options for maps of single objects.
Status checkObjects(const BakeCommandOptions& o)
{
    const char* const option = o.perObject ? "--per-object" : "--object";
    if (!o.perObject && o.object.empty())
        return Done{};
    if (o.perObject && !o.object.empty())
        return usageError("--per-object: makes a map for each object; expected no --object with it");
    if (namedAsGltf(o.output))
        return usageError(fmt::format("-o {}: expected an image with {}; found a model", o.output.string(), option));
    if (o.perObject && !o.cage.empty())
        return usageError("--per-object: expected no --cage, which belongs to one object; --object NAME accepts one");
    return Done{};
}

// Baking may take hours, so that errors of the outputs must be found before.
Status checkOutputs(const BakeCommandOptions& o)
{
    if (o.output.empty())
        return usageError("bake needs -o FILE for the map");
    if (!o.verify.empty() && o.kind != "normal")
        return usageError("--verify: only maps of the kind normal can be drawn and compared");
    if (Status ok = checkModelOutput(o); !ok)
        return ok;
    if (Status ok = checkObjects(o); !ok)
        return ok;
    if (o.bits == 32 && !imageFormatHas(o.output, &ImageFormat::negative))
        return usageError(fmt::format("--bits 32: expected a file that ends in {}; found '{}'",
                                      imageEndings(&ImageFormat::negative, ", ", " or "), o.output.string()));
    warnIfLossy(o, o.output);
    return beginOutputs(o, o.perObject ? std::vector<PlannedOutput>() : filesOf(o));
}

// Tells which engines can use a map for this frame, and how.
std::string readersOf(Frame frame)
{
    if (frame == Frame::mikktspace)
        return "the map is for the frame mikktspace: Unity, Unreal, Godot, Blender and glTF viewers read it with "
               "tangents "
               "that they generate or import, Cotan's shaders without tangents with the frame orthonormal";
    return fmt::format("the map is for the frame {0}: read it with that; engines use MikkTSpace tangents and show it "
                       "wrongly (--frame mikktspace is for them)",
                       name(frame));
}

// Bakes one map, and returns its report.
Result<Json> bakeOne(const BakeCommandOptions& o)
{
    Stopwatch watch;
    const auto job = withProgress(o, 0, "loading the meshes", [&](const Progress&) { return loadBake(o); });
    if (!job)
        return job.error();
    for (const std::string& line : job->warnings)
        warn(o, line);
    const double loadSeconds = watch.lap();
    const auto baked =
        withProgress(o, 1, "baking", [&](const Progress& progress) { return bakeTile(job->setup, o.udim, progress); });
    if (!baked)
        return withBakeOptionNames(o, baked.error());
    const Image& image = baked->image;
    explain(o, *job, baked->statistics);
    watch.lap();
    std::vector<PlacedImage> images;
    if (!o.mask.empty())
        images.push_back({o.mask, &baked->mask});
    if (!namedAsGltf(o.output))
        images.push_back({o.output, &image});
    auto pending = writePending(images);
    if (!pending)
        return pending.error();
    if (namedAsGltf(o.output))
        if (Status w = writeBakedModel(o, *job, image); !w)
            return w.error();
    if (Status w = commitTogether(*pending); !w)
        return w.error();
    const double writeSeconds = watch.lap();
    say(o, "map in {} ({}, {}, {} bit); peak memory {:.0f} MiB", o.output.string(), o.kind,
        o.kind == "normal" ? o.frame + ", " + o.convention : "world axes", o.bits, peakMegabytes());
    if (o.kind == "normal")
        say(o, readersOf(job->frame()));
    Json report{{"low", o.low},
                {"high", o.high},
                {"object", o.object.empty() ? Json(nullptr) : Json(o.object)},
                {"output", o.output.string()},
                {"frame", o.frame},
                {"kind", o.kind},
                {"size", {image.width, image.height}},
                {"high_normals", o.highNormals},
                {"warnings", job->warnings},
                {"triangles_high", job->setup.high.triangleCount()},
                {"triangles_low", job->setup.low.triangleCount()},
                {"bake", describe(baked->statistics)},
                {"seconds", {{"load", loadSeconds}, {"pad", baked->statistics.padSeconds}, {"write", writeSeconds}}},
                {"peak_megabytes", peakMegabytes()}};
    if (!o.verify.empty()) {
        const auto verified =
            verifyBake({job->lowScene, job->setup.low, job->setup.high, job->setup.options.bake, image,
                        job->setup.options.stored.format, o.material, job->setup.options.tangents},
                       o.device, o.verify, o);
        if (!verified)
            return verified.error();
        report["verify"] = *verified;
    }
    return report;
}

// map.png for the object lid: map-lid.png. An empty file stays empty.
std::filesystem::path fileOf(const std::filesystem::path& file, const std::string& part)
{
    return file.empty()
        ? file
        : std::filesystem::path(file).replace_filename(file.stem().string() + "-" + part + file.extension().string());
}

// Bakes one map per object.
Result<Json> bakeEach(const BakeCommandOptions& o)
{
    const auto names = lowObjects(o);
    if (!names)
        return names.error();
    std::vector<BakeCommandOptions> all;
    std::vector<PlannedOutput> files;
    const std::vector<std::string> parts = fileNameParts(*names);
    for (std::size_t i = 0; i < names->size(); ++i) {
        BakeCommandOptions& one = all.emplace_back(o);
        one.object = (*names)[i];
        one.output = fileOf(o.output, parts[i]);
        one.mask = fileOf(o.mask, parts[i]).string();
        if (!o.verify.empty())
            one.verify = o.verify / parts[i];
        if (fileNamePart(one.object) != parts[i])
            warn(o, "the name of the object '{}' is that of another one in file names: its files are named {}",
                 one.object, parts[i]);
        for (PlannedOutput& file : filesOf(one))
            files.push_back(std::move(file));
    }
    if (const auto planned = planOutputs(std::move(files)); !planned)
        return planned.error();
    Json objects = Json::array();
    for (const BakeCommandOptions& one : all) {
        say(o, "{}:", one.object);
        auto report = bakeOne(one);
        if (!report)
            return report.error();
        objects.push_back(std::move(*report));
    }
    return Json{{"objects", objects}};
}

Status run(const BakeCommandOptions& o)
{
    if (Status ok = checkOutputs(o); !ok)
        return ok;
    const auto baked = o.perObject ? bakeEach(o) : bakeOne(o);
    if (!baked)
        return baked.error();
    Json report = {{"command", "bake"}};
    report.update(*baked);
    return writeReport(o, report);
}

void declare(Arguments& a, BakeCommandOptions& o)
{
    a.option("--high", o.high, "high-poly mesh; may be given several times").required().in("FILE").reads().main();
    a.option("--low", o.low, "low-poly mesh with texture coordinates").required().in("FILE").reads().main();
    a.option(
         "--frame", o.frame,
         "frame that the shader will use: " + usefulFrameNames()
             + ", or a historical one of --list-frames; mikktspace is that of Unity, Unreal, Godot, Blender and glTF")
        .in("NAME")
        .offers(frameWords())
        .main();
    addListOfFrames(a);
    a.group(HelpGroup::output);
    a.option("--kind", o.kind, "what to bake: normal, object-normal, height (model units) or ao")
        .from({"normal", "object-normal", "height", "ao"})
        .in("NAME");
    a.option("--size", o.size, "width and height in texels; 512 is 512x512").in("WxH").main();
    a.group(HelpGroup::rays);
    a.option("--samples", o.samples, "samples per texel: 1, 4 or 16").from({1, 4, 16}).in("N");
    a.option("--search", o.search,
             "surface to bake: first (that a ray from outside meets), or nearest (to the low mesh, on either side)")
        .from({"first", "nearest"})
        .in("NAME");
    a.option("--extrusion", o.extrusion,
             "how far in front of the low mesh rays start, in model units; 0: measured from the high mesh")
        .within(0.0, 1e9)
        .in("D");
    a.option("--max-distance", o.maxDistance,
             "ignore high surfaces further from the low mesh, in model units; 0: 10 % of the low mesh's diagonal "
             "(--search nearest: 5 % of the high mesh's)")
        .within(0.0, 1e9)
        .in("D");
    a.option("--cage", o.cage,
             "mesh with the triangles of the low one that encloses both; rays start on it and run inwards")
        .in("FILE")
        .reads();
    a.option("--ao-rays", o.occlusionRays, "rays per sample for ao").within(1, 65536).in("N");
    a.option("--ao-occluders", o.occluders,
             "with --match-by-name, what casts occlusion: matched (the high meshes of the same name) or all")
        .from({"matched", "all"})
        .in("NAME");
    a.group(HelpGroup::input);
    a.flag("--match-by-name", o.matchByName,
           "bake each low mesh NAME_low from its high meshes NAME_high, NAME_high_a only; NAME_low.001 from "
           "NAME_high.001");
    addUpOption(a, o.up, "the files");
    a.choice("--high-up", o.highUp, kUps, "the same for the high mesh only, where it differs: y or z");
    a.option("--object", o.object, "bake this object of the low mesh only: the name of its node, else of its mesh")
        .in("TEXT");
    a.flag("--per-object", o.perObject, "make a map for each object of the low mesh: -o map.png writes map-NAME.png")
        .under(HelpGroup::output);
    a.option("--material", o.material, "number of the low mesh's material to bake; -1: all").within(-1, 100000).in("N");
    a.option("--udim", o.udim, "tile of the texture coordinates to bake").within(1001, 1999).in("N");
    addTangentsOption(a, o.tangents,
                      "for the frames vertex and mikktspace: stored (generated where missing) or generated");
    a.option("--high-normals", o.highNormals,
             "normals of the high mesh: smooth, curved (where its triangles are larger than texels), face (flat "
             "triangles) or map (its own normal map)")
        .from({"smooth", "curved", "face", "map"})
        .in("NAME");
    a.option(
         "--high-frame", o.highFrame,
         "frame that the high mesh's map was made for; default: mikktspace, from TANGENT or generated, as glTF says")
        .in("NAME")
        .offers(frameWords());
    a.option("--high-map", o.highMaps, "image that replaces the high mesh's normal maps; one, or one for each --high")
        .in("FILE")
        .reads();
    a.option("--high-convention", o.highConvention,
             "how the high mesh's map is stored, words as for --convention; default: as its material says, opengl for "
             "--high-map")
        .in("WORDS")
        .offers(conventionWordList());
    a.group(HelpGroup::output);
    a.option("--bits", o.bits,
             "bits per component: 8, 16 or 32 (float; " + imageEndings(&ImageFormat::negative, ", ", " or ") + ")")
        .from({8, 16, 32})
        .in("N");
    a.flag("--dither", o.dither, "with 8 bits: dither with a fixed pattern, so that slopes show no steps");
    a.option("--convention", o.convention, "how the map is stored: " + conventionWords())
        .in("WORDS")
        .offers(conventionWordList());
    a.option("--unsigned", o.expansion,
             "which code means zero: exact (128, or 32768 with 16 bits) or biased (none: 2c - 1) (default: biased in a "
             "glTF model, as its readers assume, else exact)")
        .from({"exact", "biased"})
        .in("NAME")
        .withoutDefault();
    a.option("--padding", o.padding,
             "how many texels around charts are filled from the nearest chart; 0: all, -1: none")
        .within(-1, 65536)
        .in("N");
    a.option("--mask", o.mask, "write an image that shows the state of each texel as a colour")
        .in("FILE")
        .writes()
        .under(HelpGroup::diagnostics);
    addMemoryOption(a, o.memory);
    a.option("--verify", o.verify,
             "draw the low mesh with the map, compare it with the high one, and write the images into this folder")
        .in("DIR")
        .writes()
        .under(HelpGroup::diagnostics);
    addDeviceOption(a, o.device, "for --verify: ");
}

} // namespace

void addBakeCommand(Arguments& tool)
{
    addCommand<BakeCommandOptions>(
        tool,
        {"bake",
         "Bake a normal map from a high-poly mesh onto a low-poly mesh.",
         "the map: " + imageEndings(&ImageFormat::writes, ", ") + "; or the low model with the map in it: .glb, .gltf",
         {"cotan bake --high statue.obj --low statue_low.obj --frame smooth -o normal.png",
          "cotan bake --high statue.obj --low statue_low.obj --kind ao --size 256x256 --ao-rays 16 -o ao.png"},
         /*needsOutput=*/true},
        declare, run);
}

} // namespace cotan::app
