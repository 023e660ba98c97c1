// cotan.h: baking, from arrays and from models.
#include <algorithm>
#include <cstddef>
#include <cstring>

#include "bake/bake_kinds.hpp"
#include "bake/name_pairs.hpp"
#include "call.hpp"
#include "core/one_line.hpp"
#include "cotan/bake.hpp"
#include "image_views.hpp"
#include "meshes.hpp"
#include "scene/normal_maps.hpp"
#include "scene/texture_sample.hpp"

using namespace cotan;
using namespace cotan::c;

namespace {

constexpr Named<HighNormals> kHighNormals[] = {{"smooth", HighNormals::smooth},
                                               {"curved", HighNormals::curved},
                                               {"face", HighNormals::face},
                                               {"map", HighNormals::smooth}};

// Sets how the normals of the detailed models are found.
void readHigh(const cotan_bake_options& o, BakeModelOptions& options, HighModel& high)
{
    const std::string_view wanted = o.high_normals ? o.high_normals : "smooth";
    options.ownMaps = wanted == "map";
    options.bake.highNormals = valueOf(kHighNormals, wanted, "options.high_normals");
    if (!options.ownMaps && (o.high_map_count > 0 || o.high_frame || o.high_convention))
        fail(ErrorKind::usage, "options.high_normals: expected map where a map, frame or convention is given, found '",
             wanted, "'");
    options.highFrame = frameOr(o.high_frame, Frame::mikktspace, "options.high_frame");
    if (o.high_convention)
        options.highFormat = inScene(conventionOf(o.high_convention, "options.high_convention"));
    require(o.high_map_count == 0 || o.high_maps, "options.high_maps: expected an array, found null");
    for (std::size_t i = 0; i < o.high_map_count; ++i)
        high.maps.push_back(imageOf(o.high_maps[i], ("options.high_maps[" + std::to_string(i) + "]").c_str()));
}

std::string_view kindOf(const char* word)
{
    const std::string_view kind = word ? word : "normal";
    return kind == "occlusion" ? "ao" : kind; // its name before version 9
}

// A map that a call makes.
struct MapOutput {
    std::string_view kind; // a word of options.kind
    cotan_image_view* map;
    cotan_bake_result* result;                    // may be null
    std::string kindField, mapField, resultField; // their names in messages
    std::size_t at = 0;                           // of the library's maps
};

// Checks the images of a call, which are of the same size.
void checkOutputs(const std::vector<MapOutput>& outputs)
{
    for (const MapOutput& output : outputs) {
        const cotan_image_view &map = checkedView(output.map, output.mapField.c_str()), &first = *outputs[0].map;
        if (map.width != first.width || map.height != first.height)
            fail(ErrorKind::usage, output.mapField, ": expected ", first.width, " x ", first.height, " pixels as ",
                 outputs[0].mapField, ", found ", map.width, " x ", map.height);
        if (output.result)
            requireSize(output.result->size, offsetof(cotan_bake_result, further), output.resultField.c_str());
        for (const MapOutput& other : outputs)
            if (&other < &output && other.kind == output.kind)
                fail(ErrorKind::usage, output.kindField, ": expected each map once, found '", output.kind, "' twice");
    }
}

// Sets which maps are made and how they are stored; first those of one kind, as the library orders them.
void readOutputs(const cotan_bake_options& o, std::vector<MapOutput>& outputs, BakeModelOptions& options)
{
    for (const bool packs : {false, true})
        for (MapOutput& output : outputs) {
            const std::string_view kind = output.kind;
            if (packs != (kind == kPackedOrm || kind.find('=') != std::string_view::npos))
                continue;
            if (packs)
                options.packed.push_back(valueOf(parsePackedMap(kind), output.kindField.c_str()));
            else
                options.kinds.push_back(valueOf(kBakeKinds, kind, output.kindField.c_str()));
            output.at = options.types.size();
            options.types.push_back(typeOf(*output.map, output.mapField.c_str()));
            options.stored.format =
                inScene(storableAs(o.convention ? o.convention : "opengl", "options.convention", options.types.back()));
        }
}

BakeModelOptions bakeOptionsOf(const cotan_bake_options& o, std::vector<MapOutput>& outputs)
{
    BakeModelOptions options;
    const std::string_view search = o.search ? o.search : "first";
    require(search == "first" || search == "nearest", "options.search: expected first or nearest");
    require(o.threads >= 0, "options.threads: expected 0 or more");
    require(o.padding >= -1, "options.padding: expected -1 or more");
    require(o.occlusion_rays >= 0 && o.occlusion_rays <= 1 << 16, "options.occlusion_rays: expected 0 to 65536");
    require(o.material >= 0, "options.material: expected 0 or more");
    const std::string_view tangents = o.tangents ? o.tangents : "generated";
    require(tangents == "stored" || tangents == "generated", "options.tangents: expected stored or generated");
    BakeOptions& b = options.bake;
    readOutputs(o, outputs, options);
    b.frame = frameOr(o.frame, Frame::mikktspace, "options.frame");
    b.width = outputs[0].map->width;
    b.height = outputs[0].map->height;
    b.samples = o.samples != 0 ? o.samples : b.samples;
    b.search = search == "nearest" ? BakeSearch::nearest : BakeSearch::first;
    b.rays = valueOf(kRays, o.rays ? o.rays : "auto", "options.rays");
    b.extrusion = o.extrusion;
    b.maxDistance = o.max_distance;
    b.cageReach = o.cage_reach;
    b.occlusionRays = o.occlusion_rays != 0 ? o.occlusion_rays : b.occlusionRays;
    b.occluders = valueOf(kOccluders, o.occluders ? o.occluders : "matched", "options.occluders");
    b.thicknessDistance = o.thickness_distance;
    b.curvatureRadius = o.curvature_radius;
    b.idBy = valueOf(kIdBy, o.id_by ? o.id_by : "material", "options.id_by");
    b.threads = o.threads;
    if (o.tile != 0)
        options.tiles = {o.tile};
    options.material = o.material - 1;
    options.tangents = tangents == "stored" ? TangentOrigin::stored : TangentOrigin::generated;
    options.cage = o.cage ? &o.cage->scene : nullptr;
    options.matchByName = o.match_by_name != 0;
    options.wrap = o.wrap != 0;
    options.padding = o.padding;
    options.stored.dither = o.dither != 0;
    options.mask = o.mask;
    return options;
}

// Returns an error of bakeModel with its field, also in the message, renamed to the field of cotan.h.
Error aboutFieldOfC(Error error)
{
    constexpr Named<std::string_view> kFields[] = {
        {"options.bake.width", "map"},
        {"options.bake.samples", "options.samples"},
        {"options.bake.frame", "options.frame"},
        {"options.bake.occlusionRays", "options.occlusion_rays"},
        {"options.highFrame", "options.high_frame"},
        {"options.maxDistance", "options.max_distance"},
        {"options.cageReach", "options.cage_reach"},
        {"options.thicknessDistance", "options.thickness_distance"},
        {"options.curvatureRadius", "options.curvature_radius"},
        {"options.matchByName", "options.match_by_name"},
        {"options.raysMask", "options.rays_mask"},
        {"options.tiles", "options.tile"},
        {"high.maps", "options.high_maps"},
    };
    if (const auto ours = cotan::valueOf(kFields, error.field)) {
        error.message.replace(0, error.field.size(), *ours);
        error.field = *ours;
    }
    return error;
}

// Fills the result of a map, as far as its caller knows it.
void setResult(const BakedMap& map, cotan_bake_result& result)
{
    const BakeStatistics& s = map.statistics;
    const std::size_t size = result.size;
    const auto& [from, to] = map.box;
    const cotan_bake_result all{size,
                                s.texels,
                                s.covered,
                                s.missed,
                                s.negative,
                                s.twice,
                                s.rays,
                                s.rayDistance,
                                s.further,
                                s.nearer,
                                s.rayStart,
                                map.unit,
                                {from.x, from.y, from.z, to.x, to.y, to.z},
                                s.disputed,
                                map.problems.size()};
    std::memcpy(&result, &all, std::min(size, sizeof all));
}

// Bakes maps and writes the results.
void bakeInto(const Scene& low, HighModel high, const cotan_bake_options& o, std::vector<MapOutput> outputs,
              cotan_bytes** ids, cotan_bytes** warnings)
{
    checkOutputs(outputs);
    if (o.mask) {
        const cotan_image_view& mask = checkedView(o.mask, "options.mask");
        require(mask.bits == 8 && mask.width == outputs[0].map->width && mask.height == outputs[0].map->height,
                "options.mask: expected 8 bits and the size of the map");
    }
    BakeModelOptions options = bakeOptionsOf(o, outputs);
    readHigh(o, options, high);
    if (o.rays_mask)
        options.bake.raysMask = std::make_shared<const Image>(imageOf(o.rays_mask, "options.rays_mask"));
    if (options.material >= int(low.materials.size()))
        fail(ErrorKind::usage, "options.material: expected 0 to ", low.materials.size(), ", found ", o.material);
    auto done = bakeModel(low, std::move(high), options, progressOf(o.progress, o.user));
    if (!done)
        throw aboutFieldOfC(done.error());
    BakedModel baked = *std::move(done);
    for (std::string& line : baked.warnings)
        line = aboutFieldOfC({.message = line, .field = line.substr(0, line.find(':'))}).message;
    std::vector<std::string> colors;
    for (const BakedMap& map : baked.maps)
        for (const IdColor& id : map.ids) {
            std::string& line = colors.emplace_back("#");
            for (int bit = 20; bit >= 0; bit -= 4)
                line += "0123456789abcdef"[id.color >> bit & 15];
            line += ' ' + oneLine(id.name);
        }
    giveText(joined(colors), ids);
    giveText(joined(baked.warnings), warnings);
    if (o.mask)
        put(baked.maps[0].mask, *o.mask);
    for (const MapOutput& output : outputs) {
        put(baked.maps[output.at].image, *output.map);
        if (output.result)
            setResult(baked.maps[output.at], *output.result);
    }
}

// The map of a call that makes one.
std::vector<MapOutput> oneOutput(const cotan_bake_options& o, cotan_image_view* map, cotan_bake_result* result)
{
    return {{kindOf(o.kind), map, result, "options.kind", "map", "result"}};
}

void bakeModels(const cotan_model* low, size_t highCount, const cotan_model* const* high, const cotan_bake_options& o,
                std::vector<MapOutput> outputs, cotan_bytes** ids, cotan_bytes** warnings)
{
    Scene simple = sceneOf(low, "low");
    restoreDeclaredGreen(simple); // the new map is used with the stored tangents
    require(high || highCount == 0, "high: expected models, found null");
    HighModel model;
    for (std::size_t i = 0; i < highCount; ++i)
        model.scenes.push_back(sceneOf(high[i], ("high[" + std::to_string(i) + "]").c_str()));
    bakeInto(simple, std::move(model), o, std::move(outputs), ids, warnings);
}

} // namespace

cotan_status cotan_bake(const cotan_mesh* low, const cotan_mesh* high, const cotan_bake_options* options,
                        cotan_image_view* map, cotan_bake_result* result, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const cotan_mesh simple = checkedMesh(low, "low", true), detailed = checkedMesh(high, "high", false);
        HighModel model;
        model.scenes.push_back(sceneOf({meshOf(detailed)}, "high"));
        const cotan_bake_options o = optionsOf(options, "options");
        bakeInto(sceneOf({meshOf(simple)}, "low"), std::move(model), o, oneOutput(o, map, result), nullptr, nullptr);
    });
}

cotan_status cotan_bake_models(const cotan_model* low, size_t high_count, const cotan_model* const* high,
                               const cotan_bake_options* options, cotan_image_view* map, cotan_bake_result* result,
                               cotan_bytes** warnings, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const cotan_bake_options o = optionsOf(options, "options");
        bakeModels(low, high_count, high, o, oneOutput(o, map, result), nullptr, warnings);
    });
}

cotan_status cotan_bake_maps(const cotan_model* low, size_t high_count, const cotan_model* const* high,
                             const cotan_bake_options* options, size_t map_count, const char* const* kinds,
                             cotan_image_view* const* maps, cotan_bake_result* const* results, cotan_bytes** ids,
                             cotan_bytes** warnings, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const cotan_bake_options o = optionsOf(options, "options");
        require(map_count > 0, "map_count: expected 1 or more");
        require(kinds, "kinds: expected an array, found null");
        require(maps, "maps: expected an array, found null");
        std::vector<MapOutput> outputs;
        for (std::size_t i = 0; i < map_count; ++i) {
            const std::string number = "[" + std::to_string(i) + "]";
            outputs.push_back({kindOf(kinds[i] ? kinds[i] : o.kind), maps[i], results ? results[i] : nullptr,
                               kinds[i] ? "kinds" + number : "options.kind", "maps" + number, "results" + number});
        }
        bakeModels(low, high_count, high, o, std::move(outputs), ids, warnings);
    });
}

const char* cotan_name_role(const char* name)
{
    constexpr const char* kRoles[] = {"", "low", "high", "cage"};
    return kRoles[std::size_t(roleOfName(name ? name : ""))];
}

cotan_status cotan_pair_names(size_t low_count, const char* const* low, size_t high_count, const char* const* high,
                              int64_t* low_groups, int64_t* high_groups, cotan_bytes** notes, char* message,
                              size_t message_size)
{
    return call(message, message_size, [&] {
        const NamePairs pairs = pairNames(textsOf(low_count, low, "low"), textsOf(high_count, high, "high"));
        require((low_groups || low_count == 0) && (high_groups || high_count == 0),
                "low_groups, high_groups: expected arrays, found null");
        std::copy(pairs.low.begin(), pairs.low.end(), low_groups);
        std::copy(pairs.high.begin(), pairs.high.end(), high_groups);
        giveText(joined(pairs.notes), notes);
    });
}
