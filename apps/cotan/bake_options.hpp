// The options of `cotan bake`, and the job that they describe.
#pragma once

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bake/bake_kinds.hpp"
#include "bake/bake_surfaces.hpp"
#include "common.hpp"
#include "core/named_values.hpp"
#include "loading.hpp"
#include "terminal/arguments.hpp"

namespace cotan::app {

inline constexpr Named<PixelType> kBitCounts[] = {
    {"8", PixelType::unorm8}, {"16", PixelType::unorm16}, {"32", PixelType::float32}};

// Where the normals of the high mesh come from.
enum class HighSource { smooth, curved, face, map };
inline constexpr Named<HighSource> kHighSources[] = {{"smooth", HighSource::smooth},
                                                     {"curved", HighSource::curved},
                                                     {"face", HighSource::face},
                                                     {"map", HighSource::map}};

// The outputs of one bake; empty: not wanted.
struct BakeFiles {
    std::vector<std::filesystem::path> maps; // of each kind
    std::filesystem::path folder;            // that is made for them
    std::filesystem::path mask;
    std::filesystem::path verify; // a folder
};

// What to bake.
struct BakeJob {
    CommonOptions common;
    std::vector<std::string> high, highMaps;
    std::string low, cage, raysMask;
    Up up = Up::y, highUp = Up::y;
    int memory = kDefaultMemory;
    HighSource highNormals = HighSource::smooth;
    bool namesHighFrame = false; // options.highFrame was given
    std::string convention;      // as it was given
    BakeModelOptions options;    // without cage and others
    bool choosesTiles = false;   // options.tiles were given
    bool allTiles = false;       // those on which the low mesh has triangles, instead of options.tiles
    std::string object;          // of the low mesh; empty: all
    bool perObject = false;      // a map for each object, with its name in all of `files`
    BakeFiles files;
    std::string device = "auto";
    std::string compress = "none"; // blocks for the normal maps of a model, or for a map in a texture file

    bool makesSeveralTiles() const { return allTiles || options.tiles.size() > 1; }
    bool makes(BakeKind kind) const { return std::ranges::count(options.kinds, kind) > 0; }
    bool readsMaterials() const { return std::ranges::any_of(kindsOf(options), cotan::readsMaterials); }
    bool readsHighMaps() const { return options.ownMaps && std::ranges::any_of(options.kinds, showsNormals); }
};

// The options, as the command line sets them: most members of the job, and words that are yet to be parsed.
struct BakeCommandOptions : CommonOptions {
    BakeJob job;
    std::string frame = "mikktspace", size = "1024x1024", convention = "opengl", highFrame, highConvention;
    std::optional<Expansion> expansion; // none: depends on -o
    std::optional<Up> highUp;           // none: as of the low mesh
    std::string udim;                   // empty: 1001
    std::string maps;                   // names of kinds
    std::vector<std::string> packed;    // channels of maps
};

// The names of the maps: of their kinds, then of the packed ones.
std::vector<std::string> namesOf(const BakeModelOptions& options);

// Parses which maps and tiles are made, and names the files of the maps. base: the folder in which the command runs.
// Errors: ErrorKind::usage.
Status nameMaps(const BakeCommandOptions& o, const std::filesystem::path& base, BakeJob& job);

// The outputs for one tile: with its number in the place of <UDIM> or %(UDIM)d in their names; if there are several
// tiles, map.png without such a place becomes map.1002.png.
BakeFiles filesOfTile(const BakeJob& job, const BakeFiles& files, int tile);

// The same for one object: map.png with the part lid is map-lid.png.
BakeFiles filesOfObject(const BakeFiles& files, const std::string& part);

// The maps and masks that a command line writes, with * for what only the low mesh says: tiles and objects. base: as
// above. Errors: ErrorKind::usage.
Result<std::vector<std::string>> bakeOutputsOf(const GivenCommand& given, const std::filesystem::path& base);

void declareBakeOptions(Arguments& a, BakeCommandOptions& o);

// Parses and checks the options. Reads and writes no file. Errors: ErrorKind::usage.
Result<BakeJob> bakeJobOf(const BakeCommandOptions& o);

// ---- the open models ------------------------------------------------------------------------

// The models of a job, each read once.
struct OpenBake {
    BakeModelOptions options; // those of the job, with the frame that the high mesh's maps name
    Scene low;
    std::optional<Scene> cage;
    std::optional<GltfDocument> document;            // of the low mesh, if the map is put into a glTF model
    HighModel high;                                  // for one map
    std::shared_ptr<const DetailedSurface> detailed; // for several
    std::vector<std::string> warnings;
};

// Reads the models. Errors: those of the files; ErrorKind::input if the low mesh lacks the object, or has none.
Result<OpenBake> openBake(const BakeJob& job);

// One map, ready to be baked.
struct PreparedMap {
    Scene low; // what is baked
    BakeSetup setup;
    std::vector<std::string> warnings; // of preparing it
};

// object: of the low mesh; empty: all. Takes open.high if there is no open.detailed. Errors: those of prepareBake, with
// the names of options.
Result<PreparedMap> prepareMap(const BakeJob& job, OpenBake& open, const std::string& object);

// Replaces the name of a library option in an error by that of the command's option.
Error withBakeOptionNames(const BakeJob& job, const Error& error);

} // namespace cotan::app
