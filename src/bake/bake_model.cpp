#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "bake/bake_hints.hpp"
#include "bake/bake_kinds.hpp"
#include "bake/bake_surfaces.hpp"
#include "bake/name_pairs.hpp"
#include "bake/surface/nearest_texels.hpp"
#include "bake/verdict.hpp"
#include "core/named_values.hpp"
#include "core/try.hpp"
#include "cotan/covector.hpp"
#include "cotan/maps.hpp"
#include "files/system/system.hpp"
#include "image/component_types.hpp"
#include "scene/geometry.hpp"
#include "scene/normal_maps.hpp"
#include "scene/parts.hpp"
#include "scene/scene_check.hpp"

namespace cotan {

namespace {

constexpr int kMaxOcclusionRays = 1 << 16;
constexpr SceneRules kRules{.pixels = false};
constexpr float kFarthest = 1e17f; // model units: Embree terminates the program for rays that start beyond 1.8e18

// The error for an option that is out of range.
template<class... Found> Error wrong(const char* option, fmt::format_string<Found...> text, Found&&... found)
{
    return about(option, usageError(fmt::format(text, std::forward<Found>(found)...)));
}

// How each map is stored: those of the kinds, then the packed ones.
std::vector<StoredAs> storedOf(const BakeModelOptions& options)
{
    const bool onlyOne = options.kinds.empty() && options.packed.empty();
    std::vector<StoredAs> stored(options.kinds.size() + options.packed.size() + onlyOne, options.stored);
    for (std::size_t i = 0; i < std::min(stored.size(), options.types.size()); ++i)
        stored[i].type = options.types[i];
    return stored;
}

// How the map of each kind is stored, if its texels can be stored one by one while it is baked, and always alike.
std::vector<std::optional<StoredAs>> storedAtOnce(const BakeModelOptions& options, const std::vector<BakeKind>& kinds)
{
    const std::vector<StoredAs> stored = storedOf(options);
    const bool alike = options.packed.empty()
        || std::ranges::all_of(stored, [&](const StoredAs& as) { return as.type == stored[0].type; });
    std::vector<std::optional<StoredAs>> images(kinds.size());
    for (std::size_t m = 0; m < kinds.size(); ++m) {
        const StoredAs& as = stored[std::min(m, stored.size() - 1)];
        const bool needsAll = as.dither || (kinds[m] == BakeKind::height && as.type != PixelType::float32);
        if (alike && !needsAll)
            images[m] = as;
    }
    return images;
}

Status checkRanges(const Scene& low, const BakeModelOptions& options)
{
    const BakeOptions& b = options.bake;
    if (b.width < 1 || b.height < 1 || b.width > kLargestSide || b.height > kLargestSide)
        return wrong("options.bake.width", "expected a width and a height from 1 to {}; found {}x{}", kLargestSide,
                     b.width, b.height);
    if (b.samples != 1 && b.samples != 2 && b.samples != 4)
        return wrong("options.bake.samples", "expected 1, 2 or 4 samples per texel and axis; found {}", b.samples);
    for (const auto& [frame, what] :
         {std::pair(b.frame, "options.bake.frame"), {options.highFrame, "options.highFrame"}})
        if (!isFrame(int(frame)))
            return wrong(what, "expected 0 to {}; found {}", kFrameCount - 1, int(frame));
    if (b.occlusionRays < 1 || b.occlusionRays > kMaxOcclusionRays)
        return wrong("options.bake.occlusionRays", "expected 1 to {} rays for occlusion; found {}", kMaxOcclusionRays,
                     b.occlusionRays);
    for (const auto& [distance, what] : {std::pair(b.maxDistance, "options.maxDistance"),
                                         {b.cageReach, "options.cageReach"},
                                         {b.thicknessDistance, "options.thicknessDistance"},
                                         {b.curvatureRadius, "options.curvatureRadius"},
                                         {b.extrusion, "options.extrusion"}})
        if (!(distance >= 0 && distance <= kFarthest))
            return wrong(what, "expected 0 to {:g}; found {:g}", kFarthest, distance);
    if (options.cage && (b.search == BakeSearch::nearest || b.extrusion > 0))
        return wrong(b.extrusion > 0 ? "options.extrusion" : "options.search",
                     "a cage already defines where rays start, and the first surface that they hit counts");
    if (b.search == BakeSearch::nearest && b.extrusion > 0)
        return wrong("options.extrusion", "the search nearest already looks to both sides of the low surface");
    if (b.raysMask && (options.cage || b.search == BakeSearch::nearest || b.rays != BakeRays::automatic))
        return wrong("options.raysMask", "expected neither a cage nor the search nearest nor options.rays with it");
    if (b.raysMask && !hasPixels(*b.raysMask))
        return wrong("options.raysMask", "expected an image; found {}x{} texels in {} bytes", b.raysMask->width,
                     b.raysMask->height, b.raysMask->data.size());
    for (const PackedMap& map : options.packed) {
        if (std::ranges::none_of(map.kinds, [](const auto& kind) { return kind.has_value(); }))
            return wrong("options.packed", "expected a map in one of the channels; found constants only");
        for (const std::optional<BakeKind>& kind : map.kinds)
            if (kind && !holdsScalars(*kind))
                return wrong("options.packed", "expected maps of one value per texel; found {}",
                             wordOf(kBakeKinds, *kind));
    }
    if (!options.types.empty() && options.types.size() != storedOf(options).size())
        return wrong("options.types", "expected none, or one for each of the maps; found {}", options.types.size());
    if (options.material >= int(low.materials.size()))
        return wrong("options.material", "expected 0 to {}; found {}", int(low.materials.size()) - 1, options.material);
    return Done{};
}

Status checkHigh(const HighModel& high)
{
    if (high.maps.size() > 1 && high.maps.size() != high.scenes.size())
        return wrong("high.maps", "expected none, one, or one for each of the {} scenes; found {}", high.scenes.size(),
                     high.maps.size());
    Status sound = Done{};
    for (std::size_t i = 0; sound && i < high.scenes.size(); ++i)
        sound = checkScene(high.scenes[i], fmt::format("high.scenes[{}]", i), kRules);
    return sound;
}

// Whether the scenes of the simple side are consistent.
Status checkLow(const Scene& low, const BakeModelOptions& options)
{
    Status sound = checkScene(low, "low", kRules);
    for (const auto& [scene, what] : {std::pair(options.cage, "options.cage"), {options.others, "options.others"}})
        if (sound && scene)
            sound = checkScene(*scene, what, kRules);
    return sound;
}

// Positions of the cage's corners, assigned to the vertices of the low surface; empty without a cage.
Result<std::vector<glm::vec3>> cagePositions(const Scene* cage, const LowSurface& low)
{
    std::vector<glm::vec3> corners, positions;
    if (!cage)
        return positions;
    for (const Instance& instance : cage->instances) {
        const Mesh& mesh = cage->meshes[std::size_t(instance.mesh)];
        for (std::uint32_t i : mesh.indices)
            corners.push_back(glm::vec3(instance.toWorld * glm::vec4(mesh.positions[i], 1)));
    }
    if (corners.size() != low.indices.size())
        return about("options.cage",
                     inputError(fmt::format("expected a cage of {} triangles, as the low mesh has; found {}",
                                            low.triangleCount(), corners.size() / 3)));
    positions.resize(low.positions.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
        positions[low.indices[i]] = corners[i];
    return positions;
}

// Whether rays can start at all of these points.
Status checkPositions(const std::vector<glm::vec3>& points, const char* what)
{
    for (const glm::vec3& p : points)
        for (const float x : {p.x, p.y, p.z})
            if (!(std::abs(x) <= kFarthest))
                return about(
                    what,
                    inputError(fmt::format("expected positions up to {:g} from the origin; found {:g}", kFarthest, x)));
    return Done{};
}

// Refuses a surface without area, for example under a transform of zero.
Status checkArea(const LowSurface& low)
{
    for (std::size_t f = 0; f < low.triangleCount(); ++f)
        if (const TriangleEdges edges = edgesOf(low, f); glm::cross(edges.p1, edges.p2) != glm::dvec3(0))
            return Done{};
    return inputError(
        fmt::format("low: expected a triangle with an area; all {} have none in world space", low.triangleCount()));
}

// Refuses a high surface of which a typical ray crosses thousands of triangles, since every ray of a bake would.
Status checkCrowded(const LowSurface& low, const HighSurface& high)
{
    constexpr std::size_t kTried = 256, kCrowded = 2000;
    const float diagonal = glm::length(high.box().high - high.box().low);
    std::vector<std::size_t> met;
    for (std::size_t f = 0; f < low.triangleCount(); f += 1 + low.triangleCount() / kTried) {
        const std::uint32_t* const c = &low.indices[3 * f];
        const glm::vec3 n = low.normals[c[0]];
        const glm::vec3 point = (low.positions[c[0]] + low.positions[c[1]] + low.positions[c[2]]) / 3.0f;
        if (glm::dot(n, n) > 0)
            met.push_back(high.countHits({point + n * diagonal, -n, 0, 2 * diagonal}));
    }
    if (met.empty())
        return Done{};
    const auto middle = met.begin() + std::ptrdiff_t(met.size() / 2);
    std::nth_element(met.begin(), middle, met.end());
    if (*middle > kCrowded)
        return inputError(fmt::format("high: a ray crosses about {} of its triangles; expected at most {}: remove "
                                      "hidden triangles",
                                      *middle, kCrowded));
    return Done{};
}

// Applies HighModel::maps and highFormat to the materials.
void applyMaps(HighModel& high, const std::optional<Convention>& format)
{
    for (std::size_t i = 0; i < high.scenes.size() && !high.maps.empty(); ++i) {
        Scene& scene = high.scenes[i];
        for (Material& material : scene.materials)
            material.normalMap = {}; // the image is read as it is, with uv set 0
        putNormalMap(scene, high.maps.size() > 1 ? std::move(high.maps[i]) : high.maps.front(), {});
    }
    if (format)
        for (Scene& scene : high.scenes) {
            restoreDeclaredGreen(scene);
            for (Material& material : scene.materials)
                material.normalFormat = *format;
        }
}

// Reads the normal maps of the detailed scenes, whose images are moved out.
Status readOwnMaps(HighModel& high, DetailedSurface& open)
{
    const Convention stated = open.options.highFormat.value_or(Convention());
    for (Image& map : high.maps) {
        COTAN_TRY(read, maps::makeReadable(map, stated, map.name, "options.highFormat"));
        if (stated.channels == Channels::xyz) // z of two channels
            completeNormals(map);
        if (const std::string found = maps::contradictionOf(map, stated); !found.empty())
            open.warnings.push_back(fmt::format("{}: {}; it is read as {}", map.name, found, describe(stated)));
    }
    applyMaps(high, open.options.highFormat);
    COTAN_TRY(maps, HighNormalMaps::make(high.scenes, open.options.highFrame));
    if (const std::size_t bare = maps->instanceCount() - maps->mappedCount(); bare > 0)
        open.warnings.push_back(fmt::format(
            "{} of {} high meshes have no normal map or no texture coordinates for it: their smooth normals are used",
            bare, maps->instanceCount()));
    open.maps = std::make_shared<const HighNormalMaps>(std::move(*maps));
    return Done{};
}

// Appends an instance's triangles in world space.
void add(LowRest& rest, const Scene& scene, const Instance& instance, std::uint32_t number)
{
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    const auto base = std::uint32_t(rest.positions.size());
    const glm::mat3 covectors = LinearMap<float>(glm::mat3(instance.toWorld)).planeMatrix();
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        rest.positions.push_back(glm::vec3(instance.toWorld * glm::vec4(mesh.positions[v], 1)));
        rest.normals.push_back(covectors * mesh.normals[v]);
    }
    for (const std::uint32_t v : mesh.indices)
        rest.indices.push_back(base + v);
    rest.triangleInstance.insert(rest.triangleInstance.end(), mesh.triangleCount(), number);
}

// The triangles of other materials and, unless matchByName limits each mesh to its own detail, of options.others.
LowRest restOf(const Scene& low, const BakeModelOptions& options, bool matchByName)
{
    LowRest rest;
    for (std::size_t i = 0; i < low.instances.size() && options.material >= 0; ++i)
        if (low.meshes[std::size_t(low.instances[i].mesh)].material != options.material)
            add(rest, low, low.instances[i], std::uint32_t(i));
    if (options.others && !matchByName)
        for (const Instance& instance : options.others->instances)
            add(rest, *options.others, instance, 0);
    return rest;
}

// Appends the names of the instances: their own, or those of their meshes if only these say what the mesh is.
void addNames(const Scene& scene, bool withEmpty, std::vector<std::string>& names)
{
    for (const Instance& instance : scene.instances) {
        const std::string &own = objectName(scene, instance), &mesh = scene.meshes[std::size_t(instance.mesh)].name;
        if (withEmpty || !scene.meshes[std::size_t(instance.mesh)].indices.empty())
            names.push_back(roleOfName(own) == NameRole::none && roleOfName(mesh) != NameRole::none ? mesh : own);
    }
}

// Pairs the instances of the simple scene, then of options.others, with those of the detailed scenes that have
// triangles.
NamePairs pairsOf(const Scene& low, const DetailedSurface& high, const BakeModelOptions& options)
{
    std::vector<std::string> names;
    addNames(low, true, names);
    if (options.others)
        addNames(*options.others, true, names);
    return pairNames(names, high.names);
}

// Limits each instance of the simple scene to the detail of its name.
Status match(const Scene& low, const NamePairs& pairs, BakeSetup& setup)
{
    for (std::size_t i = 0; i < low.instances.size(); ++i)
        if (const Mesh& mesh = low.meshes[std::size_t(low.instances[i].mesh)];
            pairs.low[i] < 0 && (setup.options.material < 0 || mesh.material == setup.options.material))
            return about("options.matchByName",
                         inputError(fmt::format("no high mesh matches the name of the low mesh '{}'",
                                                objectName(low, low.instances[i]))));
    setup.options.bake.matched.assign(pairs.low.begin(), pairs.low.begin() + std::ptrdiff_t(low.instances.size()));
    setup.high.setGroups({pairs.high.begin(), pairs.high.end()});
    setup.warnings.insert(setup.warnings.end(), pairs.notes.begin(), pairs.notes.end());
    return Done{};
}

bool hasUv(const Scene& scene)
{
    return std::ranges::all_of(scene.meshes,
                               [](const Mesh& mesh) { return mesh.indices.empty() || !mesh.texcoords[0].empty(); });
}

// highHasUv: the detailed meshes have texture coordinates. open: called after the simple side was found to be sound,
// since it is slower.
Result<BakeSetup> prepared(const Scene& low, const BakeModelOptions& options, bool highHasUv,
                           const std::function<Result<std::shared_ptr<const DetailedSurface>>(const LowSurface&)>& open)
{
    COTAN_CHECK(checkRanges(low, options));
    COTAN_CHECK(checkMapMemory(options));
    COTAN_CHECK(checkLow(low, options));
    auto surface = makeLowSurface(low, options.material, options.bake.frame, options.tangents);
    if (!surface && surface.error().kind == ErrorKind::input && highHasUv && !hasUv(low)) {
        Error error = surface.error();
        error.message += "; the high model has them: exchange the two if they are mixed up";
        return error;
    }
    if (!surface)
        return surface.error();
    if (options.bake.rays == BakeRays::vertexColor && surface->reds.empty())
        return about("options.rays", inputError("expected vertex colours in the low mesh; found none"));
    COTAN_TRY(cage, cagePositions(options.cage, *surface));
    for (const Status& placed :
         {checkPositions(surface->positions, "low"), checkArea(*surface), checkPositions(*cage, "options.cage")})
        if (!placed)
            return placed.error();
    COTAN_TRY(opened, open(*surface));
    const DetailedSurface& high = **opened;
    COTAN_CHECK(checkCrowded(*surface, high.surface));
    BakeSetup setup{std::move(*surface), high.surface, options, high.warnings};
    BakeOptions& bake = setup.options.bake;
    setup.options.cage = setup.options.others = nullptr;
    setup.options.matchByName = high.options.matchByName;
    bake.highNormals = high.options.bake.highNormals;
    bake.highMaps = high.maps;
    bake.highMaterials = high.materials;
    bake.cage = std::move(*cage);
    bake.matched.clear();
    bake.starts = nullptr;
    const NamePairs pairs = pairsOf(low, high, options);
    if (setup.options.matchByName) {
        COTAN_CHECK(match(low, pairs, setup));
    } else if (!pairs.example.empty()) {
        setup.warnings.push_back(fmt::format(
            "options.matchByName: the names of the meshes pair, such as {}; with it each is baked from its own only",
            pairs.example));
    }
    for (std::string& hint : bakeHints(setup.low, setup.high, options, kindsOf(options)))
        setup.warnings.push_back(std::move(hint));
    if (setup.options.tiles.empty())
        setup.options.tiles = {kFirstUdim};
    const LowRest rest = restOf(low, options, setup.options.matchByName);
    COTAN_CHECK(measureRayStarts(setup.low, setup.high, bake, rest));
    return setup;
}

} // namespace

Status checkMapMemory(const BakeModelOptions& options)
{
    const std::vector<BakeKind> kinds = kindsOf(options);
    const std::vector<std::optional<StoredAs>> atOnce = storedAtOnce(options, kinds);
    std::size_t perTexel = 2 * sizeof(std::uint8_t)        // states, and where there are values
        + (options.packed.empty() ? 0 : 4 * sizeof(float)) // the image of a channel
        + (options.mask ? 4 : 0) + sizeof(std::uint32_t);  // nearest, for padding
    for (std::size_t m = 0; m < kinds.size(); ++m)
        if (!atOnce[m] || m >= options.kinds.size()) // else the image that is counted below
            perTexel += atOnce[m] ? 4 * bytesPerComponent(atOnce[m]->type) : sizeof(glm::vec3);
    for (const StoredAs& stored : storedOf(options))
        perTexel += 4 * bytesPerComponent(stored.type);
    const double bytes = double(options.bake.width) * options.bake.height * double(perTexel);
    const double limit = options.memory != 0 ? double(options.memory) : machineMemory();
    constexpr double kMiB = 1 << 20;
    if (limit == 0 || bytes <= limit)
        return Done{};
    return memoryError(fmt::format("{} maps of {}x{} take {:.0f} MiB together; the limit is {:.0f} MiB", kinds.size(),
                                   options.bake.width, options.bake.height, std::ceil(bytes / kMiB), limit / kMiB));
}

Result<std::shared_ptr<const DetailedSurface>> openDetailed(HighModel high, const BakeModelOptions& options)
{
    COTAN_CHECK(checkHigh(high));
    std::vector<std::string> names;
    const std::vector<BakeKind> kinds = kindsOf(options);
    const bool namesObjects =
        options.bake.idBy == IdBy::object && std::ranges::find(kinds, BakeKind::id) != kinds.end();
    for (Scene& scene : high.scenes) {
        addNames(scene, false, names);
        if (!options.matchByName && !namesObjects) // these need single instances
            joinParts(scene);
    }
    COTAN_TRY(surface, HighSurface::make(high.scenes, options.bake.threads, options.matchByName));
    COTAN_CHECK(checkPositions({surface->box().low, surface->box().high}, "high"));
    if (options.bake.highNormals == HighNormals::curved || std::ranges::find(kinds, BakeKind::curvature) != kinds.end())
        surface->curve(options.bake.threads);
    DetailedSurface open{std::move(*surface), nullptr, nullptr, std::move(names), options, {}};
    open.options.cage = open.options.others = nullptr;
    if (std::ranges::any_of(kinds, readsMaterials)) { // before the normal maps, which are moved out of the scenes
        COTAN_TRY(materials, HighMaterials::make(high.scenes, open.surface, kinds, options.bake.idBy));
        open.materials = std::make_shared<const HighMaterials>(std::move(*materials));
    }
    if (options.ownMaps && std::ranges::any_of(kinds, showsNormals))
        COTAN_CHECK(readOwnMaps(high, open));
    return std::make_shared<const DetailedSurface>(std::move(open));
}

Result<BakeSetup> prepareBake(const Scene& low, HighModel high, const BakeModelOptions& options)
{
    return prepared(
        low, options, std::ranges::all_of(high.scenes, hasUv),
        [&](const LowSurface& surface) -> Result<std::shared_ptr<const DetailedSurface>> {
            if (options.wrap) {
                const auto tile = flatTileOf(surface);
                if (!tile)
                    return about("options.wrap",
                                 inputError("expected a flat low mesh that fills the square of its texture coordinates "
                                            "once; found another"));
                COTAN_CHECK(checkHigh(high));
                repeatAround(*tile, high);
            }
            return openDetailed(std::move(high), options);
        });
}

Result<BakeSetup> prepareBake(const Scene& low, std::shared_ptr<const DetailedSurface> high,
                              const BakeModelOptions& options)
{
    if (options.wrap)
        return wrong("options.wrap", "expected detailed models that were not opened before; found opened ones");
    return prepared(low, options, false, [&](const LowSurface&) { return Result(std::move(high)); });
}

Result<std::vector<BakedMap>> bakeTile(const BakeSetup& setup, int tile, const Progress& progress)
{
    if (tile < kFirstUdim)
        return wrong("options.tiles", "expected numbers of at least {}; found {}", kFirstUdim, tile);
    BakeOptions options = setup.options.bake;
    const std::vector<BakeKind> kinds = kindsOf(setup.options);
    const int n = tile - kFirstUdim;
    options.tile = {n % kUdimColumns, -(n / kUdimColumns)}; // here v runs down from the top of the first tile
    COTAN_TRY(baked, bakeMaps(setup.low, setup.high, options, kinds, progress, storedAtOnce(setup.options, kinds)));
    const std::vector<BakeProblem> problems = problemsOf(setup.low, setup.high, options, kinds, *baked);
    BakeStatistics statistics = baked->front().statistics;
    if (statistics.covered + statistics.touched == 0)
        return about("options.tiles",
                     inputError(fmt::format("no triangle lies on tile {} of the texture coordinates", tile)));
    const auto start = std::chrono::steady_clock::now();
    if (setup.options.padding >= 0)
        padCharts(*baked, setup.options.padding);
    statistics.padSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const BakedMap each{.tile = tile,
                        .image = {},
                        .box = baked->front().box,
                        .statistics = statistics,
                        .problems = problems,
                        .verdict = verdictOf(problems, statistics)};
    const std::vector<StoredAs> stored = storedOf(setup.options);
    const std::size_t packedCount = setup.options.packed.size(), unpacked = stored.size() - packedCount;
    std::vector<BakedMap> maps(stored.size(), each);
    for (std::size_t i = 0; i < packedCount; ++i) { // first, while all values are there
        const PackedMap& packed = setup.options.packed[i];
        BakedMap& map = maps[unpacked + i];
        map.kind = **std::ranges::find_if(packed.kinds, [](const auto& kind) { return kind.has_value(); });
        map.packed = packed;
        map.image = packMaps(*baked, kinds, packed, stored[unpacked + i]);
    }
    for (std::size_t i = 0; i < unpacked; ++i) {
        Baked& one = (*baked)[i];
        BakedMap& map = maps[i];
        map.kind = kinds[i];
        map.image = one.values.empty() ? std::move(one.image) : storeBaked(one, kinds[i], stored[i]);
        map.unit = one.unit;
        map.format = storedFormat(kinds[i], setup.options.stored.format);
        if (kinds[i] == BakeKind::id)
            map.ids = options.highMaterials->ids();
        if (kinds[i] == BakeKind::normal || kinds[i] == BakeKind::bentNormal)
            map.image.frame = name(options.frame);
        one.values = {};
    }
    if (setup.options.mask)
        maps.front().mask = maskOf(baked->front());
    return maps;
}

namespace {

Result<BakedModel> bakeTiles(Result<BakeSetup> setup, const Progress& progress)
{
    if (!setup)
        return setup.error();
    BakedModel model;
    model.warnings = std::move(setup->warnings);
    const std::vector<int>& tiles = setup->options.tiles;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        COTAN_TRY(maps, bakeTile(*setup, tiles[i], partOf(progress, i, tiles.size())));
        for (const BakeProblem& problem : maps->front().problems)
            model.warnings.push_back(problem.text);
        std::move(maps->begin(), maps->end(), std::back_inserter(model.maps));
    }
    return model;
}

} // namespace

Result<BakedModel> bakeModel(const Scene& low, HighModel high, const BakeModelOptions& options,
                             const Progress& progress)
{
    return bakeTiles(prepareBake(low, std::move(high), options), progress);
}

Result<BakedModel> bakeModel(const Scene& low, std::shared_ptr<const DetailedSurface> high,
                             const BakeModelOptions& options, const Progress& progress)
{
    return bakeTiles(prepareBake(low, std::move(high), options), progress);
}

} // namespace cotan
