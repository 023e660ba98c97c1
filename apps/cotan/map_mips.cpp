// `cotan map mips`: writes mip levels as one texture or as a file per level.
#include <fmt/format.h>

#include "core/try.hpp"
#include "files/file_registry.hpp"
#include "map_files/mips.hpp"
#include "map_options.hpp"
#include "parse.hpp"

namespace cotan::app {

namespace {

struct MapMipsCommandOptions : MapOptions {
    std::string file, from = "gltf,exact", to, model = "lean", compress = "none", swizzle = "auto";
    double roughness = 0.3;
    bool keepLengths = false;
};

Status run(const MapMipsCommandOptions& o)
{
    const std::filesystem::path first = firstMipFile(o.output);
    COTAN_CHECK(needOutput(o, "mips", first));
    std::optional<StatedConvention> to;
    if (!o.to.empty()) {
        COTAN_TRY(written, parseWrittenConvention(o.to, "--to"));
        to = *written;
    }
    using enum maps::VarianceModel;
    COTAN_TRY(model,
              valueOf<maps::VarianceModel>("--model", o.model, {{"toksvig", toksvig}, {"vmf", vmf}, {"lean", lean}}));
    COTAN_TRY(from, sourceOf(o, o.from, "--from", o.file, to.value_or(StatedConvention{})));
    const auto plan = [&](const std::filesystem::path& file) {
        return file == first ? Status(Done{}) : planOutput("-o", file);
    };
    const MipFileOptions options{from->from,    to ? std::optional(to->convention) : std::nullopt,
                                 *model,        o.roughness,
                                 o.keepLengths, o.bits,
                                 o.compress,    o.swizzle,
                                 plan};
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
                        {"model", o.model},
                        {"roughness", o.roughness},
                        {"levels", levels},
                        {"warnings", warnings}});
}

void declare(Arguments& a, MapMipsCommandOptions& o)
{
    addMemoryOption(a, o.memory);
    a.group(HelpGroup::input);
    a.option("FILE", o.file, "the map").required().reads();
    addSource(a, "--from", o.from, "how the map is stored");
    a.option("--to", o.to, "how to store the levels; as the map if not given")
        .in("WORDS")
        .offers(conventionWordList())
        .under(HelpGroup::output);
    a.option("--roughness", o.roughness, "perceptual roughness of the material, 0 to 1")
        .within(0.0, 1.0)
        .in("X")
        .main();
    a.option("--model", o.model, "how lost detail becomes roughness: toksvig, vmf or lean")
        .in("NAME")
        .offers({"toksvig", "vmf", "lean"})
        .main();
    a.flag("--keep-lengths", o.keepLengths, "with three channels: store mean vectors with their shortened lengths")
        .under(HelpGroup::output);
    addBits(a, o, " (as the map)");
    addCompress(a, o.compress, o.swizzle);
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
