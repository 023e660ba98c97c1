// `cotan map mips`: the chain as one DDS or a file for each level.
#include "map_command.hpp"

#include <array>
#include <cstring>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "cotan/files/account.hpp"
#include "cotan/files/output.hpp"
#include "cotan/maps/mips.hpp"
#include "map_options.hpp"
#include "progress.hpp"

namespace cotan::app {

namespace {

struct MapMipsCommandOptions {
    MapOptions map;
    std::string file, from = "gltf", to, model = "lean", bits = "auto";
    double roughness = 0.3;
    bool keepLengths = false;
};

// An uncompressed DDS of RGBA, 8 bits, little-endian: header of 124 bytes (Microsoft's DDS_HEADER),
// then the levels. Roughness goes to alpha.
std::string ddsBytes(const std::vector<maps::MipLevel>& chain)
{
    const Image& first = chain[0].normals;
    std::array<std::uint32_t, 32> header{};
    header[0] = 0x20534444; // "DDS "
    header[1] = 124;
    header[2] = 0x1 | 0x2 | 0x4 | 0x8 | 0x1000 | 0x20000; // caps, height, width, pitch, format, mip count
    header[3] = std::uint32_t(first.height);
    header[4] = std::uint32_t(first.width);
    header[5] = std::uint32_t(first.width) * 4;
    header[7] = std::uint32_t(chain.size());
    header[19] = 32;         // the pixel format's own size
    header[20] = 0x1 | 0x40; // alpha and RGB
    header[22] = 32;
    header[23] = 0x000000ff, header[24] = 0x0000ff00, header[25] = 0x00ff0000, header[26] = 0xff000000;
    header[27] = 0x8 | 0x1000 | 0x400000; // complex, texture, mip map
    std::string bytes(reinterpret_cast<const char*>(header.data()), sizeof header);
    for (const maps::MipLevel& level : chain) {
        std::string texels(reinterpret_cast<const char*>(level.normals.bytes8()), level.normals.data.size());
        for (std::size_t i = 0; i < level.normals.pixelCount(); ++i)
            texels[4 * i + 3] = char(level.roughness.bytes8()[4 * i]);
        bytes += texels;
    }
    return bytes;
}

std::filesystem::path numbered(const std::filesystem::path& file, const std::string& mark, std::size_t level)
{
    return file.parent_path() / fmt::format("{}{}_{}{}", file.stem().string(), mark, level, file.extension().string());
}

bool isDds(const MapMipsCommandOptions& o) { return o.map.common.output.extension() == ".dds"; }

Status writeChain(const MapMipsCommandOptions& o, const std::vector<maps::MipLevel>& chain, const Bits& bits)
{
    if (isDds(o))
        return writeFileWhole(o.map.common.output, ddsBytes(chain));
    for (std::size_t i = 0; i < chain.size(); ++i) // before anything is written; the first is planned
        for (const char* mark : {"", "_roughness"})
            if (const auto file = numbered(o.map.common.output, mark, i); i > 0 || *mark != '\0')
                if (Status planned = planOutput("-o", file); !planned)
                    return planned;
    for (std::size_t i = 0; i < chain.size(); ++i) {
        if (Status w = writeMap(numbered(o.map.common.output, "", i), chain[i].normals, bits); !w)
            return w;
        if (Status w = writeMap(numbered(o.map.common.output, "_roughness", i), chain[i].roughness, bits); !w)
            return w;
    }
    return Done{};
}

Result<maps::SpreadModel> parseModel(const std::string& name)
{
    if (name == "toksvig")
        return maps::SpreadModel::toksvig;
    if (name == "vmf")
        return maps::SpreadModel::vmf;
    if (name == "lean")
        return maps::SpreadModel::lean;
    return usageError(fmt::format("--model: expected toksvig, vmf or lean; found '{}'", name));
}

Result<Bits> typeOf(const MapMipsCommandOptions& o, PixelType input)
{
    if (!isDds(o))
        return parseBits(o.bits, input, o.map.common.output);
    if (o.bits != "auto" && o.bits != "8")
        return usageError(fmt::format("--bits: .dds files are written with 8 bits; found '{}'", o.bits));
    return Bits{};
}

Status run(const MapMipsCommandOptions& o)
{
    if (Status given = needOutput(o.map, "mips", isDds(o) ? o.map.common.output : numbered(o.map.common.output, "", 0)); !given)
        return given;
    const auto from = parseConvention(o.from, "--from");
    if (!from)
        return from.error();
    const auto to = parseConvention(o.to.empty() ? o.from : o.to, "--to");
    if (!to)
        return to.error();
    const auto model = parseModel(o.model);
    if (!model)
        return model.error();
    const auto image = openMap(o.file, o.map, *from);
    if (!image)
        return image.error();
    const auto type = typeOf(o, image->type);
    if (!type)
        return type.error();
    if (Status fits = checkSigned(*to, *type, o.map.common.output); !fits)
        return fits;
    // 32 bytes of moments for a quarter of the texels, and both pictures of all levels.
    const std::size_t work = image->pixelCount() * (8 + 11 * bytesPerComponent(type->type));
    if (work > 4 * (std::size_t(o.map.memory) << 20))
        return inputError(fmt::format("{}: the chain takes {} MiB, the limit is four times {} (--memory raises it)",
                                      o.file, work >> 20, o.map.memory));
    const Progress filtering(o.map.common, 0, "filtering levels");
    const auto chain = maps::mipChain(*image, {.from = *from, .to = *to, .keepLengths = o.keepLengths, .model = *model,
                                               .roughness = o.roughness, .type = type->type});
    if (Status written = writeChain(o, chain, *type); !written)
        return written;
    auto levels = nlohmann::ordered_json::array();
    for (const maps::MipLevel& level : chain) {
        levels.push_back({{"width", level.normals.width}, {"height", level.normals.height},
                          {"mean_length", level.meanLength}, {"mean_roughness", level.meanRoughness}});
        say(o.map.common, fmt::format("{} x {}: mean length {:.4f}, roughness {:.3f}", level.normals.width,
                                      level.normals.height, level.meanLength, level.meanRoughness));
    }
    return writeReport(o.map.common, {{"command", "map mips"}, {"file", o.file},
                                      {"output", o.map.common.output.string()}, {"from", describe(*from)},
                                      {"to", describe(*to)}, {"model", o.model}, {"roughness", o.roughness},
                                      {"levels", levels}});
}

} // namespace

Command addMapMips(CLI::App& map)
{
    auto options = std::make_shared<MapMipsCommandOptions>();
    CLI::App* command = map.add_subcommand("mips", "smaller levels, filtered as vectors, and the roughness they need");
    addMapOptions(*command, options->map,
                  "OUT.dds (all levels, roughness in alpha), or OUT.png and others: OUT_0.png, OUT_roughness_0.png, ...");
    command->add_option("FILE", options->file, "the map")->required();
    command->add_option("--from", options->from, "how it is stored: " + conventionWords())->type_name("WORDS")->capture_default_str();
    command->add_option("--to", options->to, "how to store the levels; as the map if not given")->type_name("WORDS");
    command->add_option("--roughness", options->roughness, "of the material, perceptual, 0 to 1")
        ->check(CLI::Range(0.0, 1.0))->capture_default_str();
    command->add_option("--model", options->model, "toksvig, vmf or lean")->capture_default_str();
    command->add_flag("--keep-lengths", options->keepLengths, "three channels: store the shortened mean vectors");
    command->add_option("--bits", options->bits, "auto (as the map), 8, 16, half (.exr) or float")->capture_default_str();
    addExamples(*command, {"cotan map mips rocks.png -o rocks.dds",
                           "cotan map mips rocks.png --roughness 0.4 -o level.png"});
    return {command, [options] {
                return withThreads(options->map.common.threads, [&] { return run(*options); });
            }};
}

} // namespace cotan::app
