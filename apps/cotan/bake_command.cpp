#include "commands.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include "bake_options.hpp"
#include "cotan/files/extension.hpp"
#include "cotan/image/file.hpp"
#include "gltf_open.hpp"
#include "parse.hpp"
#include "progress.hpp"

namespace cotan::app {

namespace {

double peakMegabytes()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024;
}

nlohmann::ordered_json describe(const BakeStatistics& s)
{
    return {{"texels", s.texels},       {"covered", s.covered},       {"touched", s.touched},
            {"missed", s.missed},       {"negative_z", s.negative},   {"claimed_twice", s.twice},
            {"rays", s.rays},           {"ray_distance", s.rayDistance},
            {"triangles_mirrored", s.mirroredTriangles},              {"triangles_without_uv_area", s.degenerateTriangles},
            {"seconds", s.seconds},     {"rays_per_second", s.seconds > 0 ? double(s.rays) / s.seconds : 0}};
}

double percent(std::size_t part, std::size_t whole) { return whole == 0 ? 0 : 100.0 * double(part) / double(whole); }

// What the statistics mean for the one who baked.
void explain(const BakeCommandOptions& o, const BakeJob& job, const BakeStatistics& s)
{
    say(o.common, fmt::format("{} of {} texels covered, {} more filled at the edges of charts; {:.1f} s, {:.1f} million rays a second",
                              s.covered, s.texels, s.touched, s.seconds, double(s.rays) / s.seconds / 1e6));
    if (s.covered == 0)
        warn(o.common, fmt::format("no triangle covers the centre of a texel on tile {}; only edges touch it (--udim, --size)", o.udim));
    if (s.missed > 0)
        warn(o.common, fmt::format("{:.2f} % of the covered texels found no high surface within {:g} units (--max-distance, --cage; --mask shows where)",
                                   percent(s.missed, s.covered), s.rayDistance));
    if (s.negative > 0)
        warn(o.common, fmt::format("{:.2f} % of the covered texels look below the frame's horizon (negative z): the low mesh is too coarse there, or rays hit another part",
                                   percent(s.negative, s.covered)));
    if (s.twice > 0)
        warn(o.common, fmt::format("{:.2f} % of the covered texels are claimed by several triangles; the first in the file won",
                                   percent(s.twice, s.covered)));
    const bool perTriangle = !readsVertices(job.frame()) && job.frame() != Frame::orthonormal;
    if (job.setup.options.bake.kind == BakeKind::normal && perTriangle)
        warn(o.common, fmt::format("the frame {} changes from triangle to triangle: filtering shows a crease one texel wide at "
                                   "edges of curved meshes; bake and draw with smooth to avoid it", name(job.frame())));
}

// Hours may pass before anything is written: what would fail then fails now.
Status checkOutputs(const BakeCommandOptions& o)
{
    if (o.common.output.empty())
        return usageError("-o: expected the file to write the map to");
    if (!o.verify.empty() && o.kind != "normal")
        return usageError("--verify: only maps of the kind normal can be drawn and compared");
    if (Status ok = checkModelOutput(o); !ok)
        return ok;
    const std::string extension = lowerExtension(o.common.output);
    if (o.bits == 32 && extension != ".exr" && extension != ".tif" && extension != ".tiff")
        return usageError(fmt::format("--bits 32: expected a map named .exr, .tif or .tiff; found '{}'", o.common.output.string()));
    std::vector<PlannedOutput> files = {{"-o", o.common.output}, {"--mask", o.mask}};
    if (!o.verify.empty())
        for (const PlannedOutput& picture : plannedIn("--verify", o.verify, bakePictures()))
            files.push_back(picture);
    warnIfLossy(o.common, o.common.output);
    return planOutputs(o.common, files);
}

Status run(const BakeCommandOptions& o)
{
    if (Status ok = checkOutputs(o); !ok)
        return ok;
    Stopwatch watch;
    const auto job = [&] {
        const Progress loading(o.common, 0, "loading the meshes");
        return loadBake(o);
    }();
    if (!job)
        return job.error();
    for (const std::string& line : job->warnings)
        warn(o.common, line);
    const double loadSeconds = watch.lap();
    const auto baked = [&] {
        Progress progress(o.common, 1, "baking");
        return bakeTile(job->setup, o.udim, progress.within());
    }();
    if (!baked)
        return inWordsOfCommand(o, baked.error());
    const Image& image = baked->image;
    explain(o, *job, baked->statistics);
    if (!o.mask.empty())
        if (Status w = writeImage(o.mask, baked->mask); !w)
            return w;
    watch.lap();
    if (Status w = namedAsGltf(o.common.output) ? writeBakedModel(o, *job, image) : writeImage(o.common.output, image); !w)
        return w;
    const double writeSeconds = watch.lap();
    say(o.common, fmt::format("map in {} ({}, {}, {} bit); peak memory {:.0f} MiB", o.common.output.string(), o.kind,
                              o.kind == "normal" ? o.frame + ", " + o.convention : "world axes", o.bits, peakMegabytes()));
    nlohmann::ordered_json report{{"command", "bake"}, {"low", o.low}, {"high", o.high}, {"frame", o.frame},
                                  {"kind", o.kind}, {"size", {image.width, image.height}},
                                  {"high_normals", o.highNormals},
                                  {"triangles_high", job->setup.high.triangleCount()},
                                  {"triangles_low", job->setup.low.triangleCount()},
                                  {"bake", describe(baked->statistics)},
                                  {"seconds", {{"load", loadSeconds}, {"pad", baked->statistics.padSeconds}, {"write", writeSeconds}}},
                                  {"peak_megabytes", peakMegabytes()}};
    if (!o.verify.empty()) {
        const auto verified = verifyBake(o, *job, image);
        if (!verified)
            return verified.error();
        report["verify"] = *verified;
    }
    return writeReport(o.common, report);
}

} // namespace

Command addBakeCommand(CLI::App& app)
{
    auto o = std::make_shared<BakeCommandOptions>();
    CLI::App* c = app.add_subcommand("bake", "normal map of a detailed mesh for a simple one, in a named frame");
    addCommonOptions(*c, o->common, "the map: .png, .exr, .tif, .tga; or the low model with the map in it: .glb, .gltf");
    c->add_option("--high", o->high, "detailed mesh; may be given several times")->required()->type_name("FILE");
    c->add_option("--low", o->low, "simple mesh with texture coordinates")->required()->type_name("FILE");
    c->add_option("--frame", o->frame, "the frame that the shader will use: " + frameNames())->type_name("NAME")->capture_default_str();
    c->add_option("--kind", o->kind, "normal, object-normal, height (model units) or ao")
        ->check(CLI::IsMember({"normal", "object-normal", "height", "ao"}))->type_name("NAME")->capture_default_str();
    c->add_option("--size", o->size, "width and height in texels")->type_name("WxH")->capture_default_str();
    c->add_option("--samples", o->samples, "samples a texel: 1, 4 or 16")->check(CLI::IsMember({1, 4, 16}))->type_name("N")->capture_default_str();
    c->add_option("--max-distance", o->maxDistance, "how far rays look forward and back, model units; 0: 5 % of the high mesh's diagonal")
        ->check(CLI::Range(0.0f, 1e9f))->type_name("D")->capture_default_str();
    c->add_option("--cage", o->cage, "mesh of the same triangles as the low one, around both; rays run from it inwards")->type_name("FILE");
    c->add_flag("--match-by-name", o->matchByName, "a low mesh NAME_low sees only the high mesh NAME_high");
    c->add_option("--material", o->material, "number of the low mesh's material to bake; -1: all")->check(CLI::Range(-1, 100000))->type_name("N")->capture_default_str();
    c->add_option("--udim", o->udim, "tile of the texture coordinates to bake")->check(CLI::Range(1001, 1999))->type_name("N")->capture_default_str();
    c->add_option("--tangents", o->tangents, "for the frames vertex and mikktspace: stored (generated where missing) or generated")
        ->check(CLI::IsMember({"stored", "generated"}))->type_name("NAME")->capture_default_str();
    c->add_option("--high-normals", o->highNormals, "normals of the high mesh: smooth, curved (where its triangles are larger than texels), face (flat triangles) or map (its own normal map)")
        ->check(CLI::IsMember({"smooth", "curved", "face", "map"}))->type_name("NAME")->capture_default_str();
    c->add_option("--high-frame", o->highFrame, "frame that the high mesh's map was made for; default: mikktspace, from TANGENT or generated, as glTF says")->type_name("NAME");
    c->add_option("--high-map", o->highMaps, "image that takes the place of the high mesh's normal maps; one, or one for each --high")->type_name("FILE");
    c->add_option("--high-convention", o->highConvention, "how the high mesh's map is stored, names as for --convention; default: as its material says, opengl for --high-map")->type_name("NAME");
    c->add_option("--bits", o->bits, "8, 16 or 32 (float; .exr or .tif)")->check(CLI::IsMember({8, 16, 32}))->type_name("N")->capture_default_str();
    c->add_flag("--dither", o->dither, "8 bit: round by a fixed pattern");
    c->add_option("--convention", o->convention, "how the map is stored: opengl (green up), gltf, directx, unity, unreal, ...")->type_name("NAME")->capture_default_str();
    c->add_option("--unsigned", o->expansion, "which code is zero: exact (128; 32768 of 16 bits), biased (none: 2c - 1)")
        ->check(CLI::IsMember({"exact", "biased"}))->type_name("NAME")->capture_default_str();
    c->add_option("--padding", o->padding, "texels around charts that are filled from the nearest chart; 0: all, -1: none")
        ->check(CLI::Range(-1, 65536))->type_name("N")->capture_default_str();
    c->add_option("--ao-rays", o->occlusionRays, "rays a sample for ao")->check(CLI::Range(1, 65536))->type_name("N")->capture_default_str();
    c->add_option("--mask", o->mask, "picture of what became of each texel")->type_name("FILE");
    addMemoryOption(*c, o->memory);
    c->add_option("--verify", o->verify, "folder: draw the low mesh with the map and compare with the high one")->type_name("DIR");
    c->add_option("--device", o->device, "draws for --verify: auto, reference, or a part of a Vulkan device's name")->type_name("DEVICE")->capture_default_str();
    addExamples(*c, {"cotan bake --high statue.obj --low statue_low.obj --frame smooth -o normal.png",
                     "cotan bake --high statue.obj --low statue_low.obj --kind ao --size 256x256 --ao-rays 16 -o ao.png"});
    return {c, [o] { return run(*o); }};
}

} // namespace cotan::app
