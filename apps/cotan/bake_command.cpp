#include "commands.hpp"

#include <algorithm>
#include <iterator>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bake_objects.hpp"
#include "bake_options.hpp"
#include "bake_report.hpp"
#include "core/file_names.hpp"
#include "core/try.hpp"
#include "cotan/convert.hpp"
#include "gltf_open.hpp"
#include "image/format_table.hpp"
#include "map_files/placed_images.hpp"
#include "maps/textures/make_texture.hpp"
#include "verify.hpp"

namespace cotan::app {

namespace {

// Whether the stored tangents are used, and all baked meshes have them.
bool hasStoredTangents(const Scene& low, const BakeModelOptions& options)
{
    return options.tangents == TangentOrigin::stored
        && std::all_of(low.meshes.begin(), low.meshes.end(), [&](const Mesh& mesh) {
               return (options.material >= 0 && mesh.material != options.material) || mesh.indices.empty()
                   || !mesh.tangents.empty();
           });
}

// The maps of a model's materials.
MaterialImages imagesOf(const std::vector<BakedMap>& baked)
{
    MaterialImages images;
    for (const BakedMap& map : baked)
        if (map.packed) // orm
            images.occlusion = images.roughnessMetallic = &map.image;
        else
            (map.kind == BakeKind::normal                  ? images.normal
                 : map.kind == BakeKind::occlusion         ? images.occlusion
                 : map.kind == BakeKind::roughnessMetallic ? images.roughnessMetallic
                 : map.kind == BakeKind::baseColor         ? images.baseColor
                                                           : images.emissive) = &map.image;
    return images;
}

// A map as a texture; says what it costs. file: for its extension; name: of the map in what is said.
Result<std::vector<std::byte>> textureOf(const BakeJob& job, const Image& map, const Convention& convention,
                                         const std::filesystem::path& file, const std::string& name)
{
    COTAN_TRY(texture,
              maps::makeTexture(map, {.from = convention, .to = convention, .compress = job.compress, .file = file}));
    if (texture->cost && job.compress != "none")
        say(job.common, "{}: {} bytes in blocks; mean {:.3f}, 99 % {:.2f} degrees", name, texture->bytes.size(),
            texture->cost->mean, texture->cost->percentile99);
    return std::move(texture->bytes);
}

// Puts the maps into the low model. Warns if readers that generate MikkTSpace tangents would show them wrongly.
Status writeBakedModel(const BakeJob& job, GltfDocument& document, const Scene& low, const std::vector<BakedMap>& baked)
{
    const BakeModelOptions& options = job.options;
    PutMapOptions put{.frame = options.bake.frame,
                      .material = {},
                      .expansion = options.stored.format.expansion,
                      .keepTangents = hasStoredTangents(low, options)};
    if (options.material >= 0) // by name, since a scene numbers its materials in the order in which meshes use them
        put.material = low.materials[std::size_t(options.material)].name;
    if (job.compress != "none") {
        put.extension = maps::extensionOf(job.compress);
        put.encode = [&](const Image& map, const std::string& name) {
            return textureOf(job, map, {.expansion = put.expansion}, "map.ktx2", name);
        };
    }
    const auto written = writeModelWithMaps(document, imagesOf(baked), put, job.files.maps.front());
    if (!written)
        return withBakeOptionNames(job, written.error());
    for (const std::string& note : written->notes)
        warn(job.common, note);
    return Done{};
}

// The output files of one bake of these tiles.
std::vector<PlannedOutput> plannedFor(const BakeJob& job, const BakeFiles& given, const std::vector<int>& tiles)
{
    std::vector<PlannedOutput> planned;
    for (const int tile : tiles) {
        const BakeFiles files = filesOfTile(job, given, tile);
        const bool isModel = namedAsGltf(files.maps.front()); // of all maps
        for (std::size_t i = 0; i < (isModel ? 1 : files.maps.size()); ++i)
            planned.push_back({"-o", files.maps[i], /*makesFolder*/ !files.folder.empty()});
        planned.push_back({"--mask", files.mask});
    }
    if (!given.verify.empty())
        for (const PlannedOutput& picture : plannedIn("--verify", given.verify, imageNames(kBakeNames, kBakeViews)))
            planned.push_back(picture);
    return planned;
}

// ---- from the job to the report --------------------------------------------------------------

// The maps of the job: one, or with --per-object one for each object, whose files are planned here.
Result<std::vector<MapJob>> mapsOf(const BakeJob& job, const Scene& low)
{
    if (!job.perObject)
        return std::vector<MapJob>{{job.object, job.files}};
    std::vector<MapJob> maps;
    std::vector<PlannedOutput> planned;
    const std::vector<std::string> names = objectNames(low), parts = fileNameParts(names);
    for (std::size_t i = 0; i < names.size(); ++i) {
        maps.push_back({names[i], filesOfObject(job.files, parts[i])});
        if (fileNamePart(names[i]) != parts[i])
            warn(job.common, "the name of the object '{}' is that of another one in file names: its files are named {}",
                 names[i], parts[i]);
        if (!job.allTiles)
            for (PlannedOutput& file : plannedFor(job, maps.back().files, job.options.tiles))
                planned.push_back(std::move(file));
    }
    COTAN_CHECK(planOutputs(std::move(planned)));
    return maps;
}

Status writeMaps(const BakeJob& job, const BakeFiles& files, OpenBake& open, const Scene& low,
                 const std::vector<BakedMap>& baked)
{
    std::vector<PlacedImage> images;
    if (!files.mask.empty())
        images.push_back({files.mask, &baked.front().mask});
    for (std::size_t i = 0; i < baked.size() && !open.document; ++i)
        if (!maps::isTextureFile(files.maps[i]))
            images.push_back({files.maps[i], &baked[i].image});
    if (!files.folder.empty())
        COTAN_CHECK(makeFolder(files.folder));
    COTAN_TRY(pending, writePending(images));
    for (std::size_t i = 0; i < baked.size() && !open.document; ++i) {
        const std::filesystem::path& file = files.maps[i];
        if (!maps::isTextureFile(file))
            continue;
        COTAN_TRY(bytes, textureOf(job, baked[i].image, baked[i].format, file, file.string()));
        COTAN_TRY(output, OutputFile::begin(file));
        COTAN_CHECK(writeBytes(*output, {*bytes}));
        pending->push_back(*std::move(output));
    }
    if (open.document)
        COTAN_CHECK(writeBakedModel(job, *open.document, low, baked));
    return commitTogether(*pending);
}

// The tiles to bake, of those that the low mesh covers. Plans the files if they were not known before. Errors: those of
// planOutputs; ErrorKind::input if there is no tile.
Result<std::vector<int>> chooseTiles(const BakeJob& job, const MapJob& one, const LowSurface& low,
                                     std::vector<std::string>& warnings)
{
    const std::vector<int> there = tilesOf(low);
    const std::vector<int>& wanted = job.allTiles ? there : job.options.tiles;
    if (!job.choosesTiles && there.size() > 1 && !one.files.verify.empty())
        warnings.push_back("--verify: what lies on other tiles shows the map of tile 1001, repeated");
    for (const int tile : wanted)
        if (wanted.size() > 1 && std::ranges::find(there, tile) == there.end())
            return inputError(
                fmt::format("{}: no triangle lies on tile {} of the texture coordinates (--udim)", job.low, tile));
    if (wanted.empty())
        return inputError(
            fmt::format("{}: expected triangles on the tiles 1001 to 1999 (--udim all); found none", job.low));
    if (job.allTiles)
        COTAN_CHECK(planOutputs(plannedFor(job, one.files, wanted)));
    return wanted;
}

// Bakes, writes and tells of the maps of one tile.
Result<MapReport> bakeTileMaps(const BakeJob& job, const MapJob& one, int tile, OpenBake& open, const PreparedMap& map)
{
    MapReport done;
    done.job = {one.object, filesOfTile(job, one.files, tile)};
    done.tile = tile;
    const BakeSetup& setup = map.setup;
    const auto baked = withProgress(job.common, 1, "baking",
                                    [&](const Progress& progress) { return bakeTile(setup, tile, progress); });
    if (!baked)
        return withBakeOptionNames(job, baked.error());
    Stopwatch watch;
    COTAN_CHECK(writeMaps(job, done.job.files, open, map.low, *baked));
    done.writeSeconds = watch.lap();
    done.statistics = baked->front().statistics;
    done.problems = baked->front().problems;
    done.verdict = baked->front().verdict;
    done.box = baked->front().box;
    for (const BakedMap& written : *baked) {
        done.units.push_back(written.unit);
        done.ids.insert(done.ids.end(), written.ids.begin(), written.ids.end());
    }
    done.highTriangles = setup.high.triangleCount();
    done.lowTriangles = setup.low.triangleCount();
    done.objects = objectNames(map.low).size();
    tell(job, done);
    if (one.files.verify.empty())
        return done;
    const BakedMap& normals = *std::ranges::find(*baked, BakeKind::normal, &BakedMap::kind);
    COTAN_TRY(verified,
              verifyBake({map.low, setup.low, setup.high, setup.options.bake, normals.image,
                          setup.options.stored.format, setup.options.material, setup.options.tangents},
                         job.device, one.files.verify, job.common));
    done.verified = std::move(*verified);
    return done;
}

// Prepares the meshes of one bake, then bakes each tile; appends the reports.
Status bakeMaps(const BakeJob& job, const MapJob& one, OpenBake& open, std::vector<MapReport>& reports)
{
    std::vector<std::string> warnings = open.warnings;
    Stopwatch watch;
    COTAN_TRY(map, withProgress(job.common, 0, "preparing the meshes", [&](const Progress&) {
                  return prepareMap(job, open, one.object);
              }));
    COTAN_TRY(tiles, chooseTiles(job, one, map->setup.low, map->warnings));
    warnings.insert(warnings.end(), map->warnings.begin(), map->warnings.end());
    for (const std::string& line : reports.empty() ? warnings : map->warnings) // an error so far is the only line
        warn(job.common, line);
    const double prepareSeconds = watch.lap();
    for (const int tile : *tiles) {
        if (job.makesSeveralTiles())
            say(job.common, "tile {}:", tile);
        COTAN_TRY(done, bakeTileMaps(job, one, tile, open, *map));
        done->warnings = warnings;
        done->prepareSeconds = tile == tiles->front() ? prepareSeconds : 0;
        reports.push_back(std::move(*done));
    }
    if (job.makes(BakeKind::normal))
        say(job.common, readersOf(job.options.bake.frame));
    for (const MapReport& done : std::span(reports).last(tiles->size()))
        say(job.common, "{}{}", job.makesSeveralTiles() ? fmt::format("tile {}: ", done.tile) : "", done.verdict);
    return Done{};
}

// Reads each model once, for all maps.
Result<std::vector<MapReport>> bakeAll(const BakeJob& job)
{
    warnIfLossy(job.common, job.files.maps.front());
    Stopwatch watch;
    COTAN_TRY(open, withProgress(job.common, 0, "loading the meshes", [&](const Progress&) { return openBake(job); }));
    const double openSeconds = watch.lap();
    COTAN_TRY(maps, mapsOf(job, open->low));
    std::vector<MapReport> reports;
    for (const MapJob& one : *maps) {
        if (job.perObject)
            say(job.common, "{}:", one.object);
        COTAN_CHECK(bakeMaps(job, one, *open, reports));
    }
    reports.front().prepareSeconds += openSeconds;
    return reports;
}

Status run(const BakeCommandOptions& o)
{
    COTAN_TRY(job, bakeJobOf(o));
    const bool known = !job->perObject && !job->allTiles;
    COTAN_CHECK(
        beginOutputs(o, known ? plannedFor(*job, job->files, job->options.tiles) : std::vector<PlannedOutput>()));
    if (const Status fits = checkMapMemory(job->options); !fits) // known before the models are read
        return withBakeOptionNames(*job, fits.error());
    COTAN_TRY(baked, bakeAll(*job));
    Json report = {{"command", "bake"}};
    if (!job->perObject && !job->makesSeveralTiles()) {
        report.update(toJson(*job, baked->front()));
        return writeReport(job->common, report);
    }
    Json bakes = Json::array();
    for (const MapReport& one : *baked)
        bakes.push_back(toJson(*job, one));
    report[job->perObject ? "objects" : "tiles"] = bakes;
    return writeReport(job->common, report);
}

} // namespace

void addBakeCommand(Arguments& tool)
{
    addCommand<BakeCommandOptions>(
        tool,
        {"bake",
         "Bake a normal map from a high-poly mesh onto a low-poly mesh.",
         "the map: " + imageEndings([](const ImageFormat& f) { return f.writes || f.texture; }, ", ")
             + "; or the low model with the maps in it: .glb, .gltf",
         {"cotan bake --high statue.obj --low statue_low.obj --frame smooth -o normal.png",
          "cotan bake --high statue.obj --low statue_low.obj --maps normal,ao,curvature,thickness -o maps/",
          "cotan bake --high statue.obj --low statue_low.obj --maps normal,ao -o statue_low.glb",
          "cotan bake --high statue.obj --low statue_low.obj --kind ao --size 256x256 --ao-rays 16 -o ao.png"},
         /*needsOutput=*/true},
        declareBakeOptions, run);
}

} // namespace cotan::app
