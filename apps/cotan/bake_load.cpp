// Checks the options of `cotan bake` and loads its files.
#include "bake_options.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bake_objects.hpp"
#include "cotan/convention.hpp"
#include "cotan/image.hpp"
#include "gltf_open.hpp"
#include "image/component_types.hpp"
#include "model/model_formats.hpp"
#include "parse.hpp"
#include "scene/geometry.hpp"
#include "scene/normal_maps.hpp"
#include "scene/texture_sample.hpp"
#include "up_mismatch.hpp"

namespace cotan::app {

namespace {

Result<Convention> formatFromName(const std::string& option, const std::string& name)
{
    const auto convention = parseConvention(name);
    if (!convention)
        return usageError(option + ": " + convention.error().message);
    if (convention->kind != MapKind::tangentSpace)
        return usageError(fmt::format("{}: expected a tangent-space map; found '{}'", option, name));
    return inScene(*convention);
}

Result<StoredAs> storedAs(const BakeCommandOptions& o)
{
    const auto format = formatFromName("--convention", o.convention);
    if (!format)
        return format.error();
    StoredAs as;
    as.format = *format;
    if (as.format.expansion == Expansion::signedValues)
        return usageError("--convention: expected exact or biased; found signed");
    if (o.expansion == "biased" || (o.expansion.empty() && namedAsGltf(o.output)))
        as.format.expansion = Expansion::biased;
    else if (o.expansion == "exact")
        as.format.expansion = Expansion::exact;
    if (namedAsGltf(o.output) && (greenAlongV(as.format) || as.format.channels != Channels::xyz))
        return usageError(
            fmt::format("--convention: a glTF model has three channels, green up; found {}", o.convention));
    as.type = o.bits == 8 ? PixelType::unorm8 : o.bits == 16 ? PixelType::unorm16 : PixelType::float32;
    as.dither = o.dither;
    return as;
}

BakeKind kindOf(const std::string& word)
{
    return word == "normal"       ? BakeKind::normal
        : word == "object-normal" ? BakeKind::objectNormal
        : word == "height"        ? BakeKind::height
                                  : BakeKind::occlusion;
}

// Parses --high-normals and its options.
Status parseHigh(const BakeCommandOptions& o, BakeModelOptions& options)
{
    const bool map = o.highNormals == "map";
    for (const auto& [option, given] : {std::pair("--high-map", !o.highMaps.empty()),
                                        {"--high-convention", !o.highConvention.empty()},
                                        {"--high-frame", !o.highFrame.empty()}})
        if (given && !map)
            return usageError(fmt::format("{}: expected --high-normals map with it; found {}", option, o.highNormals));
    if (o.highMaps.size() > 1 && o.highMaps.size() != o.high.size())
        return usageError(fmt::format("--high-map: expected one, or one for each of the {} --high; found {}",
                                      o.high.size(), o.highMaps.size()));
    if (!o.highConvention.empty()) {
        const auto format = formatFromName("--high-convention", o.highConvention);
        if (!format)
            return format.error();
        options.highFormat = *format;
    }
    options.ownMaps = map;
    options.bake.highNormals = o.highNormals == "curved" ? HighNormals::curved
        : o.highNormals == "face"                        ? HighNormals::face
                                                         : HighNormals::smooth;
    if (o.highFrame.empty())
        return Done{};
    const auto frame = parseFrame(o.highFrame, "--high-frame");
    if (!frame)
        return frame.error();
    if (dependsOnView(*frame))
        return usageError(
            fmt::format("--high-frame: the frame {} depends on the view: no map can be made for it", o.highFrame));
    options.highFrame = *frame;
    return Done{};
}

// Refuses ray options that contradict each other.
Status checkRays(const BakeCommandOptions& o)
{
    const bool nearest = o.search == "nearest";
    if (nearest && o.extrusion > 0)
        return usageError("--extrusion: expected --search first with it; found nearest, which needs no extrusion");
    if (!o.cage.empty() && (nearest || o.extrusion > 0))
        return usageError(fmt::format("--cage: rays start on it and stop at the first surface; expected no {} with it",
                                      nearest ? "--search nearest" : "--extrusion"));
    return Done{};
}

Result<BakeModelOptions> parseOptions(const BakeCommandOptions& o)
{
    BakeModelOptions options;
    const auto size = parseSize(o.size);
    if (!size)
        return size.error();
    const auto frame = parseFrame(o.frame, "--frame");
    if (!frame)
        return frame.error();
    const auto stored = storedAs(o);
    if (!stored)
        return stored.error();
    if (Status ok = parseHigh(o, options); !ok)
        return ok.error();
    if (Status ok = checkRays(o); !ok)
        return ok.error();
    options.bake.kind = kindOf(o.kind);
    options.bake.frame = *frame;
    options.bake.width = size->width;
    options.bake.height = size->height;
    options.bake.samples = o.samples == 1 ? 1 : o.samples == 4 ? 2 : 4;
    options.bake.search = o.search == "nearest" ? BakeSearch::nearest : BakeSearch::first;
    options.bake.extrusion = o.extrusion;
    options.bake.maxDistance = o.maxDistance;
    options.bake.occlusionRays = o.occlusionRays;
    options.bake.occluders = o.occluders == "all" ? Occluders::all : Occluders::matched;
    options.bake.threads = o.threads;
    options.tiles = {o.udim};
    options.material = o.material;
    options.tangents = o.tangents;
    options.matchByName = o.matchByName;
    options.padding = o.padding;
    options.stored = *stored;
    options.mask = !o.mask.empty();
    return options;
}

Up highUp(const BakeCommandOptions& o) { return o.highUp.value_or(o.up); }

Result<Scene> loadUp(const BakeCommandOptions& o, const std::string& file, Up up, Pixels pixels)
{
    LoadLimits limits = limitsFor(o.memory, pixels);
    limits.up = up;
    return loadSceneWithin(limits, file);
}

// Loads the high meshes and, if maps are used, the images of --high-map.
Result<HighModel> loadHigh(const BakeCommandOptions& o, bool mapsCount)
{
    HighModel high;
    for (const std::string& file : o.high) {
        auto scene = loadUp(o, file, highUp(o), o.highNormals == "map" ? Pixels::all : Pixels::none);
        if (!scene)
            return scene.error();
        high.scenes.push_back(std::move(*scene));
    }
    for (std::size_t i = 0; mapsCount && i < o.highMaps.size(); ++i) {
        auto image = readImageWithin(o.memory, o.highMaps[i]);
        if (!image)
            return image.error();
        if (image->channels == 2) // z is missing in the file
            completeNormals(*image);
        high.maps.push_back(std::move(*image));
    }
    return high;
}

// The frame named by the --high-map images, or without these by the high meshes' maps.
std::optional<Frame> namedHighFrame(const HighModel& high)
{
    for (const Image& map : high.maps)
        if (const auto frame = frameFromName(map.frame))
            return frame;
    for (const Scene& scene : high.scenes)
        if (const auto named = namedFrame(scene); named && high.maps.empty())
            return named->frame;
    return std::nullopt;
}

bool mayHaveZUp(const std::string& file)
{
    const ModelFormat* format = modelFormatOf(file);
    return format && format->upUnknown;
}

// The options that would align the meshes after the rotation `turn`; empty if there are none.
std::string upOptions(const BakeCommandOptions& o, UpMismatch turn)
{
    Up low = o.up, high = highUp(o);
    const bool rotateHigh =
        turn == UpMismatch::first || (turn == UpMismatch::either && (mayHaveZUp(o.high.front()) || !mayHaveZUp(o.low)));
    Up &other = rotateHigh ? low : high, &rotated = rotateHigh ? high : low;
    if (other == Up::z) // the given option of the other side may be the wrong one
        other = Up::y;
    else if (rotated == Up::y)
        rotated = Up::z;
    else
        return {};
    return low == high  ? "--up " + wordOf(kUps, low)
        : low == Up::z  ? "--up z --high-up y"
        : o.up == Up::z ? "--up y --high-up z"
                        : "--high-up z";
}

// A warning if the meshes do not overlap, but would if one were rotated; else empty.
std::string upWarning(const BakeCommandOptions& o, std::initializer_list<const Scene*> low, const HighModel& high)
{
    const auto add = [](Bounds& box, const Scene& scene) {
        const Bounds more = bounds(scene);
        box = {glm::min(box.low, more.low), glm::max(box.high, more.high)};
    };
    Bounds lowBox = emptyBounds(), highBox = emptyBounds();
    for (const Scene* scene : low)
        add(lowBox, *scene);
    for (const Scene& scene : high.scenes)
        add(highBox, scene);
    const UpMismatch turn = findUpMismatch(highBox, lowBox);
    const std::string options = turn == UpMismatch::none ? "" : upOptions(o, turn);
    return options.empty()
        ? ""
        : fmt::format("the low and the high mesh do not overlap, but would if one were rotated by 90 degrees: it "
                      "probably has z up; try {}",
                      options);
}

// The warnings of all files, without duplicates if low and high are the same file.
std::vector<std::string> warningsOf(const BakeCommandOptions& o, const Scene& low, const HighModel& high,
                                    bool mapsCount)
{
    std::vector<std::string> warnings = low.warnings;
    if (!mapsCount && o.highNormals == "map")
        warnings.push_back(fmt::format("--high-normals map has no effect on a map of kind {}", o.kind));
    for (const Scene& scene : high.scenes)
        for (const std::string& line : scene.warnings)
            if (std::find(low.warnings.begin(), low.warnings.end(), line) == low.warnings.end())
                warnings.push_back(line);
    return warnings;
}

Status checkObject(const BakeCommandOptions& o, const std::vector<std::string>& names)
{
    if (std::ranges::find(names, o.object) != names.end())
        return Done{};
    return inputError(fmt::format("--object: {} has no object '{}'; expected {}", o.low, o.object,
                                  names.size() == 1 ? fmt::format("'{}'", names[0])
                                                    : fmt::format("one of '{}'", fmt::join(names, "', '"))));
}

} // namespace

Result<std::vector<std::string>> lowObjects(const BakeCommandOptions& o)
{
    const auto low = loadSceneWithin(o.memory, o.low, Pixels::none);
    if (!low)
        return low.error();
    auto names = objectNames(*low);
    if (names.empty())
        return inputError(fmt::format("{}: expected objects with triangles; found none", o.low));
    return names;
}

Error withBakeOptionNames(const BakeCommandOptions& o, const Error& error)
{
    const struct {
        std::string_view field;
        std::string words, hint;
    } all[] = {
        {"options.cage", o.cage, ""},
        {"options.tiles", o.low, " (--udim)"},
        {"document", o.low, ""},
    };
    for (const auto& [field, words, hint] : all)
        if (error.field == field)
            return {error.kind, words + error.message.substr(field.size()) + hint};
    return withOptionNames(error);
}

Result<BakeJob> loadBake(const BakeCommandOptions& o)
{
    auto options = parseOptions(o);
    if (!options)
        return options.error();
    if (const auto why = HighSurface::unavailable())
        return *why;
    const bool mapsCount = options->ownMaps && showsNormals(options->bake.kind);
    auto low = loadUp(o, o.low, o.up, Pixels::all);
    if (!low)
        return low.error();
    restoreDeclaredGreen(*low); // the new map replaces the old one, next to the stored tangents
    Scene others;
    if (!o.object.empty()) {
        if (Status known = checkObject(o, objectNames(*low)); !known)
            return known.error();
        SplitScene split = splitObject(std::move(*low), o.object);
        *low = std::move(split.object);
        others = std::move(split.others);
        options->others = &others;
    }
    Scene cage;
    if (!o.cage.empty()) {
        auto scene = loadUp(o, o.cage, o.up, Pixels::none);
        if (!scene)
            return scene.error();
        cage = std::move(*scene);
        options->cage = &cage;
    }
    auto high = loadHigh(o, mapsCount);
    if (!high)
        return high.error();
    if (mapsCount && o.highFrame.empty())
        options->highFrame = namedHighFrame(*high).value_or(options->highFrame);
    std::vector<std::string> warnings = warningsOf(o, *low, *high, mapsCount);
    if (std::string turn = upWarning(o, {&*low, &others}, *high); !turn.empty())
        warnings.push_back(std::move(turn));
    auto setup = prepareBake(*low, std::move(*high), *options);
    if (!setup)
        return withBakeOptionNames(o, setup.error());
    for (const std::string& line : setup->warnings)
        warnings.push_back(withOptionNames({.message = line, .field = line.substr(0, line.find(':'))}).message);
    const std::size_t objects = objectNames(*low).size();
    return BakeJob{std::move(*low), std::move(*setup), std::move(warnings), objects};
}

} // namespace cotan::app
