// `cotan map mips`: writes mip levels as one texture or as a file per level.
#include <fmt/format.h>

#include "core/named_values.hpp"
#include "core/try.hpp"
#include "files/file_registry.hpp"
#include "map_files/mips.hpp"
#include "map_options.hpp"

namespace cotan::app {

namespace {

constexpr Named<maps::VarianceModel> kModels[] = {
    {"toksvig", maps::VarianceModel::toksvig}, {"vmf", maps::VarianceModel::vmf}, {"lean", maps::VarianceModel::lean}};

struct MapMipsCommandOptions : MapOptions {
    MipFileOptions mips;
};

Status run(const MapMipsCommandOptions& o)
{
    const std::filesystem::path first = firstMipFile(o.output);
    COTAN_CHECK(needOutput(o, "mips", first));
    MipFileOptions options = o.mips;
    options.mayWrite = [&](const std::filesystem::path& file) {
        return file == first ? Status(Done{}) : planOutput("-o", file);
    };
    const auto done = onFiles(o, "filtering levels",
                              [&](const FileOptions& files) { return writeMips(o.file, o.output, options, files); });
    if (!done)
        return done.error();
    const std::vector<std::string> warnings = warned(o, done->notes);
    Json levels = Json::array();
    for (const MipLevelFigures& level : done->levels) {
        levels.push_back({{"width", level.width},
                          {"height", level.height},
                          {"mean_length", level.meanLength},
                          {"mean_roughness", level.meanRoughness}});
        say(o, "{} x {}: mean length {:.4f}, roughness {:.3f}", level.width, level.height, level.meanLength,
            level.meanRoughness);
    }
    return writeReport(o,
                       {{"command", "map mips"},
                        {"file", o.file},
                        {"output", o.output.string()},
                        {"from", describe(done->from)},
                        {"to", describe(done->to)},
                        {"model", wordOf(kModels, options.model)},
                        {"roughness", options.roughness},
                        {"levels", levels},
                        {"warnings", warnings}});
}

void declare(Arguments& a, MapMipsCommandOptions& o)
{
    addFile(a, o, "FILE", "the map");
    addConvention(a, "--from", o.mips.from, "gltf", "how the map is stored: " + conventionWords());
    addConvention(a, "--to", o.mips.to, "", "how to store the levels; as the map if not given")
        .under(HelpGroup::output);
    a.option("--roughness", o.mips.roughness, "perceptual roughness of the material, 0 to 1")
        .within(0.0, 1.0)
        .in("X")
        .main();
    a.choice("--model", o.mips.model, kModels, "how lost detail becomes roughness: toksvig, vmf or lean").main();
    a.flag("--keep-lengths", o.mips.keepLengths, "with three channels: store mean vectors with their shortened lengths")
        .under(HelpGroup::output);
    addBits(a, o.mips.bits, " (as the map)");
    addCompress(a, o.mips.compress);
}

} // namespace

void addMapMips(Arguments& map)
{
    addCommand<MapMipsCommandOptions>(
        map,
        {"mips",
         "Make mip levels, filtered as vectors, and the roughness that each needs.",
         "OUT.dds or OUT.ktx2 (all levels, roughness in alpha, or with bc5 in OUT_roughness.dds), or OUT.png and "
         "others: "
         "OUT_0.png, OUT_roughness_0.png, ...",
         {"cotan map mips rocks.png -o rocks.dds", "cotan map mips rocks.png --compress bc5 -o rocks.ktx2",
          "cotan map mips rocks.png --roughness 0.4 -o level.png"},
         /*needsOutput=*/true},
        declare, run);
}

} // namespace cotan::app
