// Reads the models of `cotan bake`.
#include "bake_options.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bake_objects.hpp"
#include "core/try.hpp"
#include "cotan/gltf.hpp"
#include "files/file_registry.hpp"
#include "gltf_open.hpp"
#include "model/model_formats.hpp"
#include "scene/geometry.hpp"
#include "scene/normal_maps.hpp"
#include "scene/texture_sample.hpp"
#include "up_mismatch.hpp"

namespace cotan::app {

namespace {

Result<Scene> loadUp(int memory, const std::string& file, Up up, Pixels pixels)
{
    LoadLimits limits = limitsFor(memory, pixels);
    limits.up = up;
    return loadSceneWithin(limits, file);
}

// Loads the high meshes and, if maps are used, the images of --high-map.
Result<HighModel> loadHigh(const BakeJob& job)
{
    HighModel high;
    for (const std::string& file : job.high) {
        const bool readsImages = job.options.ownMaps || job.readsMaterials();
        COTAN_TRY(scene, loadUp(job.memory, file, job.highUp, readsImages ? Pixels::all : Pixels::none));
        high.scenes.push_back(std::move(*scene));
        high.scenes.back().name = file; // for messages
    }
    for (std::size_t i = 0; job.readsHighMaps() && i < job.highMaps.size(); ++i) {
        COTAN_TRY(image, readImageWithin(job.memory, job.highMaps[i]));
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
std::string upOptions(const BakeJob& job, UpMismatch turn)
{
    Up low = job.up, high = job.highUp;
    const bool rotateHigh = turn == UpMismatch::first
        || (turn == UpMismatch::either && (mayHaveZUp(job.high.front()) || !mayHaveZUp(job.low)));
    Up &other = rotateHigh ? low : high, &rotated = rotateHigh ? high : low;
    if (other == Up::z) // the given option of the other side may be the wrong one
        other = Up::y;
    else if (rotated == Up::y)
        rotated = Up::z;
    else
        return {};
    return low == high    ? "--up " + wordOf(kUps, low)
        : low == Up::z    ? "--up z --high-up y"
        : job.up == Up::z ? "--up y --high-up z"
                          : "--high-up z";
}

// A warning if the meshes do not overlap, but would if one were rotated; else empty.
std::string upWarning(const BakeJob& job, const Scene& low, const HighModel& high)
{
    Bounds highBox = emptyBounds();
    for (const Scene& scene : high.scenes) {
        const Bounds more = bounds(scene);
        highBox = {glm::min(highBox.low, more.low), glm::max(highBox.high, more.high)};
    }
    const UpMismatch turn = findUpMismatch(highBox, bounds(low));
    const std::string options = turn == UpMismatch::none ? "" : upOptions(job, turn);
    return options.empty()
        ? ""
        : fmt::format("the low and the high mesh do not overlap, but would if one were rotated by 90 degrees: it "
                      "probably has z up; try {}",
                      options);
}

// The warnings of all files, without duplicates if low and high are the same file.
std::vector<std::string> warningsOf(const BakeJob& job, const Scene& low, const HighModel& high)
{
    std::vector<std::string> warnings = low.warnings;
    if (job.options.ownMaps && !job.readsHighMaps())
        warnings.push_back(
            fmt::format("--high-normals map has no effect on a map of kind {}", fmt::join(namesOf(job.options), ", ")));
    for (const Scene& scene : high.scenes)
        for (const std::string& line : scene.warnings)
            if (std::find(low.warnings.begin(), low.warnings.end(), line) == low.warnings.end())
                warnings.push_back(line);
    if (std::string turn = upWarning(job, low, high); !turn.empty())
        warnings.push_back(std::move(turn));
    return warnings;
}

Status checkObjects(const BakeJob& job, const Scene& low)
{
    const std::vector<std::string> names = objectNames(low);
    if (job.perObject && names.empty())
        return inputError(fmt::format("{}: expected objects with triangles; found none", job.low));
    if (job.object.empty() || std::ranges::find(names, job.object) != names.end())
        return Done{};
    return inputError(fmt::format("--object: {} has no object '{}'; expected {}", job.low, job.object,
                                  names.size() == 1 ? fmt::format("'{}'", names[0])
                                                    : fmt::format("one of '{}'", fmt::join(names, "', '"))));
}

// Reads the low mesh; and its file to edit, for a map that is put into it, by the same reading if it is a glTF file.
Status readLow(const BakeJob& job, OpenBake& open)
{
    const bool writesModel = namedAsGltf(job.files.maps.front());
    if (!writesModel || !namedAsGltf(job.low)) {
        COTAN_TRY(low, loadUp(job.memory, job.low, job.up, Pixels::all));
        open.low = std::move(*low);
        return Done{};
    }
    auto opened = openGltf(job.low, limitsFor(job.memory, Pixels::all));
    if (const auto refused = firstRefusal()) // as loadScene
        return *refused;
    if (!opened)
        return withOptionNames(opened.error());
    if (job.up == Up::z)
        rotateZUpToYUp(opened->scene);
    open.low = std::move(opened->scene);
    open.document = std::move(opened->document);
    return Done{};
}

// Reads the low mesh and its cage, and opens its file for a map that is put into it.
Status openLow(const BakeJob& job, OpenBake& open)
{
    COTAN_CHECK(readLow(job, open));
    restoreDeclaredGreen(open.low); // the new map replaces the old one, next to the stored tangents
    COTAN_CHECK(checkObjects(job, open.low));
    if (namedAsGltf(job.files.maps.front()) && !open.document) {
        COTAN_TRY(document, gltfDocumentOf(open.low));
        open.document = std::move(*document);
    }
    if (job.files.verify.empty())
        for (Image& image : open.low.images) { // only drawing reads their pixels
            image.width = image.height = 0;
            image.data = {};
        }
    if (!job.raysMask.empty()) {
        COTAN_TRY(mask, readImageWithin(job.memory, job.raysMask));
        open.options.bake.raysMask = std::make_shared<const Image>(std::move(*mask));
    }
    if (job.cage.empty())
        return Done{};
    COTAN_TRY(cage, loadUp(job.memory, job.cage, job.up, Pixels::none));
    open.cage = std::move(*cage);
    return Done{};
}

} // namespace

Error withBakeOptionNames(const BakeJob& job, const Error& error)
{
    const struct {
        std::string_view field;
        std::string words, hint;
    } all[] = {
        {"options.cage", job.cage, ""},
        {"options.tiles", job.low, " (--udim)"},
        {"document", job.low, ""},
    };
    for (const auto& [field, words, hint] : all)
        if (error.field == field)
            return {error.kind, words + error.message.substr(field.size()) + hint};
    return withOptionNames(error);
}

Result<OpenBake> openBake(const BakeJob& job)
{
    if (const auto why = HighSurface::unavailable())
        return *why;
    OpenBake open;
    open.options = job.options;
    COTAN_CHECK(openLow(job, open));
    COTAN_TRY(high, loadHigh(job));
    if (job.readsHighMaps() && !job.namesHighFrame)
        open.options.highFrame = namedHighFrame(*high).value_or(open.options.highFrame);
    open.warnings = warningsOf(job, open.low, *high);
    open.high = std::move(*high);
    if (!job.perObject)
        return open;
    auto detailed = openDetailed(std::move(open.high), open.options);
    if (!detailed)
        return withBakeOptionNames(job, detailed.error());
    open.detailed = std::move(*detailed);
    return open;
}

Result<PreparedMap> prepareMap(const BakeJob& job, OpenBake& open, const std::string& object)
{
    SplitScene split = object.empty() ? SplitScene{std::move(open.low), {}} : splitObject(open.low, object);
    BakeModelOptions options = open.options;
    if (!job.choosesTiles)
        options.tiles = {};
    options.others = object.empty() ? nullptr : &split.others;
    options.cage = open.cage ? &*open.cage : nullptr;
    auto setup = open.detailed ? prepareBake(split.object, open.detailed, options)
                               : prepareBake(split.object, std::move(open.high), options);
    if (!setup)
        return withBakeOptionNames(job, setup.error());
    std::vector<std::string> warnings;
    for (const std::string& line : setup->warnings)
        warnings.push_back(
            withBakeOptionNames(job, {.message = line, .field = line.substr(0, line.find(':'))}).message);
    return PreparedMap{std::move(split.object), std::move(*setup), std::move(warnings)};
}

} // namespace cotan::app
