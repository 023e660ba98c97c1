// Which maps a bake makes, of which tiles and objects, and how their files are named.
#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "bake_options.hpp"
#include "core/parse_number.hpp"
#include "core/try.hpp"
#include "gltf_open.hpp"
#include "parse.hpp"

namespace cotan::app {

namespace {

// The name with a word in all places that are marked.
std::filesystem::path withWord(const std::filesystem::path& file, std::string_view mark, const std::string& word)
{
    std::string text = file.string();
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + word.size()))
        text.replace(at, mark.size(), word);
    return text;
}

// map.png with the part lid: map-lid.png. An empty file stays empty.
std::filesystem::path withPart(const std::filesystem::path& file, const std::string& part)
{
    return file.empty()
        ? file
        : std::filesystem::path(file).replace_filename(file.stem().string() + "-" + part + file.extension().string());
}

// The files of the maps. With <MAP> in the output, the name of each is in its place. Else several maps are NAME.png in
// a folder, which is an output that exists as one or has no ending, or map.png becomes map-NAME.png. base: folder in
// which the command runs.
void setFiles(const std::filesystem::path& base, const std::filesystem::path& output,
              const std::vector<std::string>& names, bool severalMaps, BakeFiles& files)
{
    constexpr std::string_view kPlace = "<MAP>";
    const bool isMarked = output.string().find(kPlace) != std::string::npos;
    std::error_code unknown;
    if (severalMaps && !isMarked && !output.empty()
        && (!output.has_extension() || std::filesystem::is_directory(base / output, unknown)))
        files.folder = output;
    for (const std::string& name : names)
        files.maps.push_back(isMarked                                  ? withWord(output, kPlace, name)
                                 : !severalMaps || namedAsGltf(output) ? output
                                 : files.folder.empty()                ? withPart(output, name)
                                                                       : output / (name + ".png"));
}

constexpr std::string_view kAllTiles = "all";

} // namespace

std::vector<std::string> namesOf(const BakeModelOptions& options)
{
    std::vector<std::string> names;
    for (const BakeKind kind : options.kinds)
        names.push_back(wordOf(kBakeKinds, kind));
    for (const PackedMap& map : options.packed)
        names.push_back(map.name);
    return names;
}

namespace {

// The maps of --maps and --pack, or that of --kind.
Status parseMaps(const BakeCommandOptions& o, BakeModelOptions& options)
{
    const BakeKind one = o.job.options.bake.kind;
    if (o.maps.empty() && o.packed.empty()) {
        options.kinds = {one};
        return Done{};
    }
    if (one != BakeKind::normal)
        return usageError(fmt::format("--kind {}: makes one map; expected no {} with it", wordOf(kBakeKinds, one),
                                      o.maps.empty() ? "--pack" : "--maps"));
    Words<BakeKind> known;
    for (const auto& [word, kind] : kBakeKinds)
        known.push_back({word, kind});
    known.push_back({kPackedOrm, {}});
    for (const std::string& word : o.maps.empty() ? std::vector<std::string>() : splitAtCommas(o.maps)) {
        COTAN_TRY(kind, oneOf("--maps", word, known));
        if (word == kPackedOrm)
            options.packed.push_back(*parsePackedMap(word));
        else
            options.kinds.push_back(*kind);
    }
    for (const std::string& text : o.packed) {
        auto map = parsePackedMap(text);
        if (!map)
            return usageError("--pack: " + map.error().message);
        options.packed.push_back(std::move(*map));
    }
    const std::vector<std::string> names = namesOf(options);
    for (const std::string& name : names)
        if (std::ranges::count(names, name) > 1)
            return usageError(fmt::format("{}: expected each map once; found {} twice",
                                          o.packed.empty() ? "--maps" : "--pack", name));
    return Done{};
}

Status parseTiles(const std::string& words, BakeJob& job)
{
    job.choosesTiles = !words.empty();
    job.allTiles = words == kAllTiles;
    std::vector<int>& tiles = job.options.tiles;
    if (job.allTiles || !job.choosesTiles) {
        tiles = {kFirstUdim};
        return Done{};
    }
    for (const std::string& word : splitAtCommas(words)) {
        int tile = 0;
        if (!parseNumber(word, tile) || tile < kFirstUdim || tile > kLastUdim)
            return usageError(
                fmt::format("--udim: expected numbers from {} to {}, separated by commas, or {}; found '{}'",
                            kFirstUdim, kLastUdim, kAllTiles, word));
        if (std::ranges::count(tiles, tile) > 0)
            return usageError(fmt::format("--udim: expected each tile once; found {} twice", tile));
        tiles.push_back(tile);
    }
    return Done{};
}

BakeFiles filesOfTile(const BakeJob& job, const BakeFiles& files, const std::string& number)
{
    const auto placed = [&](const std::filesystem::path& file) {
        return withWord(withWord(file, "<UDIM>", number), "%(UDIM)d", number);
    };
    const auto numbered = [&](const std::filesystem::path& file) {
        const std::filesystem::path of = placed(file);
        return of != file || !job.makesSeveralTiles() || file.empty()
            ? of
            : std::filesystem::path(file).replace_filename(file.stem().string() + "." + number
                                                           + file.extension().string());
    };
    BakeFiles of = files;
    for (std::filesystem::path& map : of.maps)
        map = numbered(map);
    of.folder = placed(files.folder);
    of.mask = numbered(files.mask);
    return of;
}

} // namespace

BakeFiles filesOfTile(const BakeJob& job, const BakeFiles& files, int tile)
{
    return filesOfTile(job, files, std::to_string(tile));
}

BakeFiles filesOfObject(const BakeFiles& files, const std::string& part)
{
    BakeFiles of{
        {}, files.folder, withPart(files.mask, part), files.verify.empty() ? files.verify : files.verify / part};
    for (const std::filesystem::path& map : files.maps)
        of.maps.push_back(withPart(map, part));
    return of;
}

Status nameMaps(const BakeCommandOptions& o, const std::filesystem::path& base, BakeJob& job)
{
    COTAN_CHECK(parseMaps(o, job.options));
    setFiles(base, o.output, namesOf(job.options), !o.maps.empty() || o.packed.size() > 1, job.files);
    return parseTiles(o.udim, job);
}

Result<std::vector<std::string>> bakeOutputsOf(const GivenCommand& given, const std::filesystem::path& base)
{
    BakeCommandOptions o;
    BakeJob& job = o.job;
    for (const GivenOption& option : given.options) {
        const std::string& last = option.values.back();
        if (option.name == "output")
            o.output = last;
        else if (option.name == "maps")
            o.maps = last;
        else if (option.name == "kind")
            job.options.bake.kind = valueOf(kBakeKinds, last).value_or(BakeKind::normal);
        else if (option.name == "pack")
            o.packed = option.values;
        else if (option.name == "udim")
            o.udim = last;
        else if (option.name == "mask")
            job.files.mask = last;
        else if (option.name == "per-object")
            job.perObject = true;
    }
    COTAN_CHECK(nameMaps(o, base, job));
    const BakeFiles files = job.perObject ? filesOfObject(job.files, "*") : job.files;
    std::vector<std::string> outputs;
    for (const int tile : job.options.tiles) {
        const BakeFiles of = filesOfTile(job, files, job.allTiles ? "*" : std::to_string(tile));
        for (const std::filesystem::path& map : of.maps)
            outputs.push_back(map.string());
        outputs.push_back(of.mask.string());
    }
    std::erase(outputs, "");
    return outputs;
}

} // namespace cotan::app
