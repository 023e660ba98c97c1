#include <fmt/format.h>

#include "commands.hpp"
#include "core/try.hpp"
#include "image/format_table.hpp"
#include "map_files/inspect.hpp"
#include "map_options.hpp"
#include "maps/textures/texel_code.hpp"

namespace cotan::app {

void addBits(Arguments& command, MapOptions& options, const std::string& help)
{
    command
        .option("--bits", options.bits,
                "bits per component: auto" + help + ", 8, 16, half (" + imageEndings(&ImageFormat::halfs, ", ")
                    + ") or float")
        .in("N")
        .offers({"auto", "8", "16", "half", "float"})
        .under(HelpGroup::output);
}

void addCompress(Arguments& command, std::string& compress, std::string& swizzle)
{
    command
        .option(
            "--compress", compress,
            "for " + imageEndings(&ImageFormat::texture, ", ", " and ")
                + ": none; blocks of one byte per texel, bc5 (x and y only, more exact), bc5-snorm (the same for "
                  "signed textures), bc7 (x, y, z and alpha) or "
                  "bc3 (x in alpha, y in green, for old engines); in .ktx2, for browsers, which turn it into the "
                  "format of their device, uastc (x, y and z, one byte); and for phones eac-rg11 (x and y, one byte) "
                  "or "
                  "astc-4x4 to astc-8x8 (16 bytes for as many texels; x, y and z, or two channels if --to has them)")
        .in("NAME")
        .offers(maps::compressionWords())
        .under(HelpGroup::output);
    command
        .option("--swizzle", swizzle,
                "where a map of two channels has x and y: red and green (rg), red and alpha (ra or rrrg) or alpha and "
                "green (ag); auto: ra for astc, ag for bc3, else rg")
        .in("NAME")
        .offers(maps::swizzleWords())
        .under(HelpGroup::output);
}

void addDither(Arguments& command, bool& dither)
{
    command.flag("--dither", dither, "add noise of half a step before rounding; it is the same on every run")
        .under(HelpGroup::output);
}

Result<StatedConvention> parseConvention(const std::string& text, const std::string& option)
{
    auto convention = parseStatedConvention(text);
    return convention ? convention : usageError(option + ": " + convention.error().message);
}

Result<maps::FoundMap> sourceOf(const MapOptions& o, const std::string& text, const std::string& option,
                                const std::string& file, const StatedConvention& to)
{
    if (text != kFound) {
        const auto stated = parseConvention(text, option);
        if (stated)
            return maps::FoundMap{.from = *stated, .to = to.convention};
        std::string why = stated.error().message; // "--from: expected gltf ..."
        why.insert(why.find("expected ") + 9, fmt::format("{}, or ", kFound));
        return usageError(why);
    }
    GreenOfFile seen;
    const auto look = [&](const Damage& damage) -> Result<maps::GreenVerdict> {
        COTAN_TRY(green, onFiles(o, "looking at " + file, [&](const FileOptions& files) {
                      return greenOfFile(file, files, damage);
                  }));
        seen = *green;
        return seen.verdict;
    };
    COTAN_TRY(found, maps::findMap(file + ": " + option, to, look));
    say(o, "{}: {}", file, linesOf(seen, file).front());
    return *found;
}

std::vector<std::string> sourceWords()
{
    std::vector<std::string> words = conventionWordList(), damages = damageWords();
    words.insert(words.begin(), kFound);
    words.insert(words.end(), damages.begin(), damages.end());
    return words;
}

Argument addSource(Arguments& command, const std::string& option, std::string& text, const std::string& about)
{
    std::string damages;
    for (const std::string& word : damageWords())
        damages += ' ' + word;
    return command
        .option(option, text,
                about + ": auto, which finds it as map detect does; or " + conventionWords()
                    + "; and for broken maps, which are repaired:" + damages)
        .in("WORDS")
        .offers(sourceWords());
}

Result<StatedConvention> parseWrittenConvention(const std::string& text, const std::string& option)
{
    auto convention = cotan::parseWrittenConvention(text);
    return convention ? convention : usageError(option + ": " + convention.error().message);
}

std::vector<std::string> warned(const MapOptions& options, std::vector<std::string> notes)
{
    for (std::string& note : notes) {
        note = withOptionNames({.message = note, .field = note.substr(0, note.find(':'))}).message;
        warn(options, "{} (cotan map detect)", note);
    }
    return notes;
}

Status needOutput(const MapOptions& options, const std::string& command, const std::filesystem::path& file)
{
    if (options.output.empty())
        return usageError(fmt::format("map {} needs -o FILE", command));
    return beginOutputs(options, {{"-o", file.empty() ? options.output : file}});
}

void addMapCommand(Arguments& tool)
{
    Arguments map = tool.command("map", "Inspect, repair and convert normal-map files.");
    addExamples(map,
                {"cotan map detect rocks.png", "cotan map convert rocks.png --from directx --to opengl -o out.png"});
    for (const auto add : {addMapInfo, addMapDetect, addMapConvert, addMapDiff, addMapFromHeight, addMapToHeight,
                           addMapBlend, addMapMips})
        add(map);
}

} // namespace cotan::app
