#include "bake_options.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "cotan/convention.hpp"
#include "gltf_open.hpp"
#include "map_options.hpp"
#include "parse.hpp"

namespace cotan::app {

namespace {

constexpr int kFirstUdim = 1001; // 1001 + u + 10 v, v upwards
constexpr int kUdimColumns = 10;

// The unit square of uv of a UDIM tile. The numbers count v upwards from the bottom of the first
// tile, our v runs down from its top.
glm::ivec2 tileOf(int udim)
{
    const int n = udim - kFirstUdim;
    return {n % kUdimColumns, -(n / kUdimColumns)};
}

// "door_low" and "door_high" are of one name: what stands before the last low or high.
std::string stem(std::string name)
{
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    for (const char* word : {"low", "high"})
        if (const std::size_t at = name.rfind(word); at != std::string::npos)
            return name.substr(0, at);
    return name;
}

Result<std::vector<std::int64_t>> matches(const Scene& low, const HighSurface& high)
{
    std::vector<std::int64_t> result;
    for (const Instance& instance : low.instances) {
        const std::string& name =
            !instance.name.empty() ? instance.name : low.meshes[std::size_t(instance.mesh)].name;
        const auto& names = high.names();
        const auto found =
            std::find_if(names.begin(), names.end(), [&](const std::string& n) { return stem(n) == stem(name); });
        if (found == names.end())
            return inputError(fmt::format("--match-by-name: no high mesh is named like the low mesh '{}'", name));
        result.push_back(found - names.begin());
    }
    return result;
}

// The cage's corner positions, brought to the vertices of the low surface.
Result<std::vector<glm::vec3>> cagePositions(const std::string& file, const LowSurface& low)
{
    const auto cage = loadSceneWithin(kDefaultMemory, file, Pixels::none);
    if (!cage)
        return cage.error();
    std::vector<glm::vec3> corners;
    for (const Instance& instance : cage->instances) {
        const Mesh& mesh = cage->meshes[std::size_t(instance.mesh)];
        for (std::uint32_t i : mesh.indices)
            corners.push_back(glm::vec3(instance.toWorld * glm::vec4(mesh.positions[i], 1)));
    }
    if (corners.size() != low.indices.size())
        return inputError(fmt::format("{}: expected a cage of {} triangles, as the low mesh has; found {}", file,
                                      low.triangleCount(), corners.size() / 3));
    std::vector<glm::vec3> positions(low.positions.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
        positions[low.indices[i]] = corners[i];
    return positions;
}

Result<StoredAs> storedAs(const BakeCommandOptions& o)
{
    const auto format = formatFromName("--convention", o.convention);
    if (!format)
        return format.error();
    StoredAs as;
    as.format = *format;
    as.format.expansion = o.expansion == "biased" ? COTAN_EXPAND_BIASED : COTAN_EXPAND_EXACT;
    if (namedAsGltf(o.common.output) && (as.format.greenAlongV || as.format.channels != 0))
        return usageError(fmt::format("--convention: a glTF model has three channels, green up; found {}", o.convention));
    as.type = o.bits == 8 ? PixelType::unorm8 : o.bits == 16 ? PixelType::unorm16 : PixelType::float32;
    as.dither = o.dither;
    return as;
}

BakeKind kindOf(const std::string& word)
{
    return word == "normal" ? BakeKind::normal : word == "object-normal" ? BakeKind::objectNormal
        : word == "height"  ? BakeKind::height : BakeKind::occlusion;
}

} // namespace

Result<NormalMapFormat> formatFromName(const std::string& option, const std::string& name)
{
    const auto convention = conventionFromName(name);
    if (!convention) {
        std::string names;
        for (const ConventionPreset& preset : conventionPresets())
            names += (names.empty() ? "" : ", ") + std::string(preset.name);
        return usageError(fmt::format("{}: expected one of {}; found '{}'", option, names, name));
    }
    return formatInScene(*convention);
}

Result<BakeJob> prepareBake(const BakeCommandOptions& o)
{
    BakeJob job;
    const auto size = parseSize(o.size);
    if (!size)
        return size.error();
    const auto frame = parseFrame(o.frame);
    if (!frame)
        return frame.error();
    const auto stored = storedAs(o);
    if (!stored)
        return stored.error();
    if (Status ok = checkHighOptions(o); !ok)
        return ok.error();
    job.frame = *frame;
    job.stored = *stored;
    job.options.kind = kindOf(o.kind);
    job.options.frame = *frame;
    job.options.width = size->first;
    job.options.height = size->second;
    job.options.samples = o.samples == 1 ? 1 : o.samples == 4 ? 2 : 4;
    job.options.tile = tileOf(o.udim);
    job.options.maxDistance = o.maxDistance;
    job.options.occlusionRays = o.occlusionRays;
    job.options.threads = o.common.threads;

    auto lowScene = loadSceneWithin(o.memory, o.low);
    if (!lowScene)
        return lowScene.error();
    job.lowScene = std::move(*lowScene);
    if (o.material >= int(job.lowScene.materials.size()))
        return usageError(fmt::format("--material: expected 0 to {}; found {}", job.lowScene.materials.size() - 1, o.material));
    auto low = makeLowSurface(job.lowScene, o.material, *frame,
                              o.tangents == "stored" ? TangentSource::stored : TangentSource::generated);
    if (!low)
        return low.error();
    job.low = std::move(*low);
    if (!o.cage.empty()) {
        auto cage = cagePositions(o.cage, job.low);
        if (!cage)
            return cage.error();
        job.options.cage = std::move(*cage);
    }
    if (Status ok = prepareHigh(o, job); !ok)
        return ok.error();
    if (o.matchByName) {
        auto matched = matches(job.lowScene, job.high.front());
        if (!matched)
            return matched.error();
        job.options.matched = std::move(*matched);
    }
    return job;
}

} // namespace cotan::app
