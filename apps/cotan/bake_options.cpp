#include "bake_options.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/try.hpp"
#include "cotan/convention.hpp"
#include "gltf_open.hpp"
#include "image/format_table.hpp"
#include "maps/textures/texel_code.hpp"
#include "parse.hpp"
#include "picture_options.hpp"
#include "scene/normal_maps.hpp"
#include "scene/texture_sample.hpp"

namespace cotan::app {

namespace {

constexpr Named<int> kSamples[] = {{"1", 1}, {"4", 2}, {"16", 4}}; // per texel, and per axis
constexpr Named<BakeSearch> kSearches[] = {{"first", BakeSearch::first}, {"nearest", BakeSearch::nearest}};

Result<Convention> formatFromName(const std::string& option, const std::string& name)
{
    const auto convention = parseConvention(name);
    if (!convention)
        return usageError(option + ": " + convention.error().message);
    if (convention->kind != MapKind::tangentSpace)
        return usageError(fmt::format("{}: expected a tangent-space map; found '{}'", option, name));
    return inScene(*convention);
}

// How the map is stored, but for its type. model: it is put into a glTF model.
Result<Convention> formatOfMap(const std::string& convention, std::optional<Expansion> expansion, bool model)
{
    auto format = formatFromName("--convention", convention);
    if (!format)
        return format;
    if (format->expansion == Expansion::signedValues)
        return usageError("--convention: expected exact or biased; found signed");
    format->expansion = expansion.value_or(model ? Expansion::biased : format->expansion);
    if (model && (greenAlongV(*format) || format->channels != Channels::xyz))
        return usageError(fmt::format("--convention: a glTF model has three channels, green up; found {}", convention));
    return format;
}

// Refuses maps that a glTF material has no texture for.
Status checkModelMaps(const BakeJob& job)
{
    constexpr BakeKind kOfMaterials[] = {BakeKind::normal, BakeKind::occlusion, BakeKind::baseColor,
                                         BakeKind::roughnessMetallic, BakeKind::emissive};
    const std::string output = job.files.maps.front().string();
    const std::vector<std::string> names = namesOf(job.options);
    const bool packs = !job.options.packed.empty();
    for (std::size_t i = 0; i < names.size(); ++i)
        if (i < job.options.kinds.size()
                ? std::ranges::count(kOfMaterials, job.options.kinds[i]) == 0
                : job.options.packed[i - job.options.kinds.size()].kinds != parsePackedMap(kPackedOrm)->kinds)
            return usageError(
                fmt::format("-o {}: a glTF material has no texture for {}; expected normal, ao, base-color, "
                            "roughness-metallic, emissive or orm",
                            output, names[i]));
    if (packs
        && (job.options.packed.size() > 1 || job.makes(BakeKind::occlusion) || job.makes(BakeKind::roughnessMetallic)))
        return usageError(fmt::format("-o {}: expected one map for each texture of a material; found {}", output,
                                      fmt::join(names, ", ")));
    if (std::ranges::any_of(job.files.maps, [&](const auto& file) { return file != job.files.maps.front(); }))
        return usageError(fmt::format("-o: a model holds all maps; expected no <MAP> in its name, found {}", output));
    return Done{};
}

// Checks the files and the objects of a job. Baking may take hours, so that errors of the outputs must be found before.
Status checkOutputs(const BakeJob& job)
{
    const BakeModelOptions& options = job.options;
    const std::filesystem::path& map = job.files.maps.front();
    const bool model = namedAsGltf(map);
    if (map.empty())
        return usageError("bake needs -o FILE for the map");
    if (!job.files.verify.empty() && !job.makes(BakeKind::normal))
        return usageError("--verify: only maps of the kind normal can be drawn and compared");
    if (model)
        COTAN_CHECK(checkModelMaps(job));
    if (model && options.stored.type == PixelType::float32)
        return usageError(
            fmt::format("-o {}: expected --bits 8 or 16 for an image in a model; found 32", map.string()));
    const std::string udim = job.allTiles ? "all" : fmt::format("{}", fmt::join(options.tiles, ","));
    if (model && udim != "1001")
        return usageError(fmt::format(
            "-o {}: one map covers tile 1001 of the texture coordinates only; found --udim {}", map.string(), udim));
    if (!job.files.verify.empty() && udim != "1001")
        return usageError(fmt::format("--verify: draws the map of tile 1001 only; found --udim {}", udim));
    if (job.perObject && !job.object.empty())
        return usageError("--per-object: makes a map for each object; expected no --object with it");
    if (model && (job.perObject || !job.object.empty()))
        return usageError(fmt::format("-o {}: expected an image with {}; found a model", map.string(),
                                      job.perObject ? "--per-object" : "--object"));
    if (job.perObject && options.wrap)
        return usageError("--wrap: the low mesh is one tile; expected no --per-object with it");
    if (job.perObject && !job.cage.empty())
        return usageError("--per-object: expected no --cage, which belongs to one object; --object NAME accepts one");
    if (options.stored.type == PixelType::float32 && !imageFormatHas(map, &ImageFormat::negative))
        return usageError(fmt::format("--bits 32: expected a file that ends in {}; found '{}'",
                                      imageEndings(&ImageFormat::negative, ", ", " or "), map.string()));
    // Baking may take hours, and only writing asks for these endings.
    for (const std::filesystem::path& file : job.files.maps)
        if (!model && !maps::isTextureFile(file))
            COTAN_CHECK(checkImageName(file));
    if (!job.files.mask.empty())
        COTAN_CHECK(checkImageName(job.files.mask));
    return Done{};
}

// Parses --high-normals and its options.
Status parseHigh(const BakeCommandOptions& o, BakeJob& job)
{
    BakeModelOptions& options = job.options;
    options.ownMaps = job.highNormals == HighSource::map;
    options.bake.highNormals = job.highNormals == HighSource::curved ? HighNormals::curved
        : job.highNormals == HighSource::face                        ? HighNormals::face
                                                                     : HighNormals::smooth;
    for (const auto& [option, given] : {std::pair("--high-map", !job.highMaps.empty()),
                                        {"--high-convention", !o.highConvention.empty()},
                                        {"--high-frame", !o.highFrame.empty()}})
        if (given && !options.ownMaps)
            return usageError(fmt::format("{}: expected --high-normals map with it; found {}", option,
                                          wordOf(kHighSources, job.highNormals)));
    if (job.highMaps.size() > 1 && job.highMaps.size() != job.high.size())
        return usageError(fmt::format("--high-map: expected one, or one for each of the {} --high; found {}",
                                      job.high.size(), job.highMaps.size()));
    if (!o.highConvention.empty()) {
        COTAN_TRY(format, formatFromName("--high-convention", o.highConvention));
        options.highFormat = *format;
    }
    if (o.highFrame.empty())
        return Done{};
    COTAN_TRY(frame, parseFrame(o.highFrame, "--high-frame"));
    if (dependsOnView(*frame))
        return usageError(
            fmt::format("--high-frame: the frame {} depends on the view: no map can be made for it", o.highFrame));
    options.highFrame = *frame;
    job.namesHighFrame = true;
    return Done{};
}

// Refuses ray options that contradict each other.
Status checkRays(const BakeJob& job)
{
    const bool nearest = job.options.bake.search == BakeSearch::nearest, extruded = job.options.bake.extrusion > 0;
    if (nearest && extruded)
        return usageError("--extrusion: expected --search first with it; found nearest, which needs no extrusion");
    if (!job.cage.empty() && (nearest || extruded))
        return usageError(fmt::format("--cage: rays start on it and stop at the first surface; expected no {} with it",
                                      nearest ? "--search nearest" : "--extrusion"));
    if (!job.raysMask.empty() && (nearest || !job.cage.empty() || job.options.bake.rays != BakeRays::automatic))
        return usageError(fmt::format("--rays-mask: expected no {} with it, which already says which way rays run",
                                      nearest                 ? "--search nearest"
                                          : !job.cage.empty() ? "--cage"
                                                              : "--rays"));
    return Done{};
}

// Texture files hold maps of directions, as pixels or blocks; models hold some of the blocks.
Status checkCompress(const BakeCommandOptions& o, const BakeJob& job)
{
    if (namedAsGltf(o.output))
        return checkModelCompress(job.compress);
    const std::filesystem::path& file = job.files.maps.front();
    const auto code = maps::codeFor(job.compress, "auto", job.options.stored.format, file);
    if (!maps::codeNamed(job.compress))
        return withOptionNames(code.error());
    if (!maps::isTextureFile(file))
        return job.compress == "none"
            ? Status(Done{})
            : usageError(fmt::format("--compress: expected -o MODEL.glb or .gltf, or a map in {}; found '{}'",
                                     imageEndings(&ImageFormat::texture, ", ", " or "), o.output.string()));
    for (const BakeKind kind : job.options.kinds)
        if (!holdsDirections(kind))
            return usageError(fmt::format("-o {}: {} files hold maps of normals; found {}", o.output.string(),
                                          file.extension().string(), wordOf(kBakeKinds, kind)));
    if (!job.options.packed.empty())
        return usageError(fmt::format("-o {}: {} files hold maps of normals; found {}", o.output.string(),
                                      file.extension().string(), job.options.packed.front().name));
    return code ? Status(Done{}) : withOptionNames(code.error());
}

} // namespace

Result<BakeJob> bakeJobOf(const BakeCommandOptions& o)
{
    BakeJob job = o.job;
    job.common = o;
    COTAN_CHECK(nameMaps(o, {}, job));
    job.highUp = o.highUp.value_or(job.up);
    job.convention = o.convention;
    BakeModelOptions& options = job.options;
    options.mask = !job.files.mask.empty();
    options.bake.threads = o.threads;
    options.memory = job.memory != kDefaultMemory ? std::size_t(job.memory) << 20 : 0;
    COTAN_CHECK(checkOutputs(job));
    COTAN_TRY(size, parseSize(o.size));
    options.bake.width = size->width;
    options.bake.height = size->height;
    COTAN_TRY(frame, parseFrame(o.frame, "--frame"));
    options.bake.frame = *frame;
    COTAN_TRY(format, formatOfMap(o.convention, o.expansion, namedAsGltf(o.output)));
    options.stored.format = *format;
    COTAN_CHECK(checkCompress(o, job));
    COTAN_CHECK(parseHigh(o, job));
    COTAN_CHECK(checkRays(job));
    return job;
}

void declareBakeOptions(Arguments& a, BakeCommandOptions& o)
{
    a.option("--high", o.job.high, "high-poly mesh; may be given several times").required().in("FILE").reads().main();
    a.option("--low", o.job.low, "low-poly mesh with texture coordinates").required().in("FILE").reads().main();
    a.option(
         "--frame", o.frame,
         "frame that the shader will use: " + usefulFrameNames()
             + ", or a historical one of --list-frames; mikktspace is that of Unity, Unreal, Godot, Blender and glTF")
        .in("NAME")
        .offers(frameWords())
        .main();
    addListOfFrames(a);
    a.group(HelpGroup::output);
    BakeModelOptions& model = o.job.options;
    const std::vector<std::string> kinds = wordsOf(kBakeKinds);
    std::vector<std::string> names = kinds;
    names.emplace_back(kPackedOrm);
    a.option(
         "--maps", o.maps,
         fmt::format("several maps from the same rays, separated by commas, each its own file: {}; -o map.png writes "
                     "map-ao.png, -o FOLDER/ ao.png, -o x_<MAP>.png x_ao.png",
                     fmt::join(names, ", ")))
        .in("NAMES")
        .offers(names)
        .main();
    a.option("--pack", o.packed,
             "a map from channels of others, which need not be written: R=ao,G=roughness,B=metallic,A=1, or orm for "
             "these; its name is packed, or MASK with MASK: before it; may be given several times")
        .in("CHANNELS");
    a.choice("--kind", model.bake.kind, kBakeKinds,
             "what to bake, if it is one map: " + fmt::format("{}", fmt::join(kinds, ", ")));
    a.option("--size", o.size, "width and height in texels; 512 is 512x512").in("WxH").main();
    a.group(HelpGroup::rays);
    a.choice("--samples", model.bake.samples, kSamples, "samples per texel: 1, 4 or 16").in("N");
    a.choice("--search", model.bake.search, kSearches,
             "surface to bake: first (that a ray from outside meets), or nearest (to the low mesh, on either side)");
    a.choice("--rays", model.bake.rays, kRays,
             "which way rays run: auto (straight, but averaged near hard edges), averaged (along normals averaged over "
             "hard edges: no gaps, but details lean), straight (along the low mesh's normals: gaps at hard edges) or "
             "vertex-color (straight where the red of the low mesh's vertex colours is 1, averaged where it is 0); no "
             "effect with --cage and --search nearest");
    a.option("--rays-mask", o.job.raysMask,
             "image in the low mesh's uv instead: rays are straight where its red is white, averaged where it is black")
        .in("FILE")
        .reads();
    a.option("--extrusion", model.bake.extrusion,
             "how far in front of the low mesh rays start, in model units; 0: measured from the high mesh")
        .within(0.0, 1e9)
        .in("D");
    a.option("--max-distance", model.bake.maxDistance,
             "ignore high surfaces further from the low mesh, in model units; 0: 10 % of the low mesh's diagonal "
             "(--search nearest: 5 % of the high mesh's)")
        .within(0.0, 1e9)
        .in("D");
    a.option("--cage", o.job.cage,
             "mesh with the triangles of the low one that encloses both; rays start on it and run inwards")
        .in("FILE")
        .reads();
    a.option("--ao-rays", model.bake.occlusionRays, "rays per texel for ao, bent normals and thickness")
        .within(1, 65536)
        .in("N");
    a.option("--thickness-distance", model.bake.thicknessDistance,
             "thickness that is stored as 1, in model units; 0: 50 % of the high mesh's diagonal")
        .within(0.0, 1e9)
        .in("D");
    a.option("--curvature-radius", model.bake.curvatureRadius,
             "radius of a ball whose curvature is stored as 1, in model units; 0: 1 % of the high mesh's diagonal")
        .within(0.0, 1e9)
        .in("D");
    a.choice("--id-by", model.bake.idBy, kIdBy,
             "what has a colour of its own in a map of ids: material, object or vertex-color of the high mesh");
    a.choice("--ao-occluders", model.bake.occluders, kOccluders,
             "with --match-by-name, what casts occlusion: matched (the high meshes of the same name) or all");
    a.group(HelpGroup::input);
    a.flag("--match-by-name", model.matchByName,
           "bake each low mesh NAME_low from its high meshes NAME_high, NAME_high_a only; NAME_low.001 from "
           "NAME_high.001");
    addUpOption(a, o.job.up, "the files");
    addHighUpOption(a, o.highUp);
    a.option("--object", o.job.object, "bake this object of the low mesh only: the name of its node, else of its mesh")
        .in("TEXT");
    a.flag("--per-object", o.job.perObject,
           "make a map for each object of the low mesh: -o map.png writes map-NAME.png")
        .under(HelpGroup::output);
    a.flag("--wrap", model.wrap,
           "the low mesh is one flat tile: what crosses a border of it comes in at the opposite one");
    a.option("--material", model.material, "number of the low mesh's material to bake; -1: all")
        .within(-1, 100000)
        .in("N");
    a.option(
         "--udim", o.udim,
         "tiles of the texture coordinates to bake: 1001 to 1999, separated by commas, or all that triangles cover; "
         "<UDIM> in -o and --mask is the number, else map.png of several becomes map.1002.png (default: 1001)")
        .in("N");
    addTangentsOption(
        a, model.tangents,
        "for frames of tangents (mikktspace, area-weighted, vertex): stored (generated where missing) or generated");
    a.choice("--high-normals", o.job.highNormals, kHighSources,
             "normals of the high mesh: smooth, curved (where its triangles are larger than texels), face (flat "
             "triangles) or map (its own normal map)");
    a.option(
         "--high-frame", o.highFrame,
         "frame that the high mesh's map was made for; default: mikktspace, from TANGENT or generated, as glTF says")
        .in("NAME")
        .offers(frameWords());
    a.option("--high-map", o.job.highMaps,
             "image that replaces the high mesh's normal maps; one, or one for each --high")
        .in("FILE")
        .reads();
    a.option("--high-convention", o.highConvention,
             "how the high mesh's map is stored, words as for --convention; default: as its material says, opengl for "
             "--high-map")
        .in("WORDS")
        .offers(conventionWordList());
    a.group(HelpGroup::output);
    a.choice("--bits", model.stored.type, kBitCounts,
             "bits per component: 8, 16 or 32 (float; " + imageEndings(&ImageFormat::negative, ", ", " or ") + ")")
        .in("N");
    a.option(
         "--compress", o.job.compress,
         "store normal maps as blocks with all their levels: in a model, as convert does; -o map.ktx2 and .dds take "
         "all formats of map convert")
        .in("NAME")
        .offers(maps::compressionWords());
    a.flag("--dither", model.stored.dither, "with 8 bits: dither with a fixed pattern, so that slopes show no steps");
    a.option("--convention", o.convention, "how the map is stored: " + conventionWords())
        .in("WORDS")
        .offers(conventionWordList());
    a.choice("--unsigned", o.expansion, kExpansions,
             "which code means zero: exact (128, or 32768 with 16 bits) or biased (none: 2c - 1) (default: biased in a "
             "glTF model, as its readers assume, else exact)")
        .withoutDefault();
    a.option("--padding", model.padding,
             "how many texels around charts are filled from the nearest chart; 0: all, -1: none")
        .within(-1, 65536)
        .in("N");
    a.option("--mask", o.job.files.mask, "write an image that shows the state of each texel as a colour")
        .in("FILE")
        .writes()
        .under(HelpGroup::diagnostics);
    addMemoryOption(a, o.job.memory,
                    ", and (if it is not 640; else the machine's memory) the maximum for all maps of a tile together");
    a.option("--verify", o.job.files.verify,
             "draw the low mesh with the map, compare it with the high one, and write the images into this folder")
        .in("DIR")
        .writes()
        .under(HelpGroup::diagnostics);
    addDeviceOption(a, o.job.device, "for --verify: ");
}

} // namespace cotan::app
