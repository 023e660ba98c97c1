// `cotan map convert`: converts a map to another convention.
#include <fmt/format.h>

#include "core/try.hpp"
#include "image/format_table.hpp"
#include "map_files/convert.hpp"
#include "map_options.hpp"
#include "parse.hpp"

namespace cotan::app {

namespace {

struct MapConvertCommandOptions : MapOptions {
    ConvertFileOptions convert; // without the mesh
    MeshOfMap mesh;             // without a file: none
};

Status run(const MapConvertCommandOptions& o)
{
    COTAN_CHECK(needOutput(o, "convert"));
    ConvertFileOptions options = o.convert;
    const Convention& to = options.to;
    const std::string mesh = o.mesh.file.string();
    if (!mesh.empty())
        options.mesh = o.mesh;
    const auto done =
        onFilesToMap(o, mesh.empty() ? o.file : "converting with the mesh",
                     [&](const FileOptions& files) { return convertFile(o.file, o.output, options, files); });
    if (!done)
        return done.error();
    if (!mesh.empty())
        say(o, "{}: the mesh uses {:.1f} % of the map; the rest is padding", mesh,
            100 * double(done->covered) / (double(done->width) * double(done->height)));
    if (done->counts.invalid > 0)
        warn(o, "{}: {} texels have no direction; written as flat", o.file, done->counts.invalid);
    if (done->counts.clamped > 0)
        warn(o, "{}: {} texels are steeper than {} can hold; clamped", o.file, done->counts.clamped, describe(to));
    const std::vector<std::string> warnings = warned(o, done->notes);
    Convention stored = to;
    if (options.compress == "bc5" && to.channels == Channels::xyz)
        stored.channels = Channels::orthographic;
    const std::string bits = options.compress != "none" ? options.compress : bitsName(done->bits);
    say(o, "{}: {} x {}, {}: {}", o.output.string(), done->width, done->height, bits, describe(stored));
    return writeReport(o,
                       {{"command", "map convert"},
                        {"file", o.file},
                        {"output", o.output.string()},
                        {"from", describe(done->from)},
                        {"to", describe(stored)},
                        {"width", done->width},
                        {"height", done->height},
                        {"bits", bits},
                        {"invalid", done->counts.invalid},
                        {"clamped", done->counts.clamped},
                        {"warnings", warnings}});
}

void declare(Arguments& a, MapConvertCommandOptions& o)
{
    addFile(a, o, "FILE", "the map");
    std::vector<std::string> words = conventionWordList();
    std::string damages;
    for (const std::string& word : damageWords()) {
        words.push_back(word);
        damages += ' ' + word;
    }
    addConvention(a, "--from", o.convert.from, "",
                  "how the map is stored: " + conventionWords()
                      + "; and for broken maps, which are repaired:" + damages)
        .offers(words)
        .required()
        .main();
    addConvention(a, "--to", o.convert.to, "", "how to store the result; the same words").required().main();
    addBits(a, o.convert.bits, "");
    a.option("--strength", o.convert.strength, "factor on the slopes; negative turns bumps into dents").in("X").main();
    a.flag("--normalise", o.convert.normalise,
           "normalise every vector; without this, vectors of three channels keep their lengths")
        .under(HelpGroup::output);
    addCompress(a, o.convert.compress);
    addDither(a, o.convert.dither);
    a.option("--mesh", o.mesh.file, "mesh that uses the map; required to or from object space").in("FILE").reads();
    addFrameName(a, "--frame", o.mesh.frame, "with --mesh: the frame that reads the tangent-space map")
        .under(HelpGroup::frame);
    addListOfFrames(a);
    a.group(HelpGroup::input);
    addUpOption(a, o.mesh.up, "--mesh");
    a.option("--material", o.mesh.material, "with --mesh: only triangles of this material; -1: all")
        .within(-1, 1 << 20)
        .in("N");
    addTangentsOption(a, o.mesh.tangents, "with --mesh, for the frames vertex and mikktspace: stored or generated");
}

} // namespace

void addMapConvert(Arguments& map)
{
    addCommand<MapConvertCommandOptions>(
        map,
        {"convert",
         "Convert a normal map between conventions, or repair it: green, channels, sRGB, space, bits.",
         "the new map: " + imageEndings([](const ImageFormat& f) { return f.writes || f.texture; }),
         {"cotan map convert rocks.png --from directx --to gltf -o out.png",
          "cotan map convert rocks.png --from gltf --to unity,orthographic --bits 16 -o out.tif"},
         /*needsOutput=*/true},
        declare, run);
}

} // namespace cotan::app
