// Shared by the subcommands of `cotan map`.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common.hpp"
#include "cotan/convention.hpp"
#include "cotan/maps.hpp"
#include "loading.hpp"
#include "map_files/map_file.hpp"

namespace cotan::app {

struct MapOptions : CommonOptions {
    int memory = kDefaultMemory; // for an image that is decoded whole
    std::string bits = "auto";
};

// Options shared by subcommands, besides those of all commands.
void addBits(Arguments& command, MapOptions& options, const std::string& help);
void addCompress(Arguments& command, std::string& compress, std::string& swizzle);
void addDither(Arguments& command, bool& dither);

// parseStatedConvention with the option's name in its error.
Result<StatedConvention> parseConvention(const std::string& text, const std::string& option);

// The value of such options for a map whose convention is found, as `map detect` finds it.
inline constexpr const char* kFound = "auto";

// parseStatedConvention, or for kFound maps::findMap, which says what it sees; then `to` may keep the zero of the map,
// and repairs are asked for. Errors: as these and greenOfFile.
Result<maps::FoundMap> sourceOf(const MapOptions& options, const std::string& text, const std::string& option,
                                const std::string& file, const StatedConvention& to = {});

// The words of such options, for completion.
std::vector<std::string> sourceWords();

// Declares such an option. about: what it tells, as in "how the map is stored".
Argument addSource(Arguments& command, const std::string& option, std::string& text, const std::string& about);

// parseConvention for a map that is written: its words must not describe a broken map.
Result<StatedConvention> parseWrittenConvention(const std::string& text, const std::string& option);

// For commands that write a map: requires -o, and plans the output `file`, or that of -o if `file` is empty.
Status needOutput(const MapOptions& options, const std::string& command, const std::filesystem::path& file = {});

// Runs a function of map_files with a progress line. Errors have option names.
template<class Work> auto onFiles(const MapOptions& o, const std::string& what, const Work& work)
{
    auto result = withProgress(o, 1, what, [&](Progress progress) {
        return work(FileOptions{limitsFor(o.memory), o.threads, std::move(progress)});
    });
    return result ? std::move(result) : decltype(result)(withOptionNames(result.error()));
}

// The same for work that writes a normal map: once the work has started, warns if the format of -o is lossy.
template<class Work> auto onFilesToMap(const MapOptions& o, const std::string& what, const Work& work)
{
    bool warned = false;
    return onFiles(o, what, [&](FileOptions files) {
        files.progress = [&, line = std::move(files.progress)](double fraction) {
            if (!std::exchange(warned, true))
                warnIfLossy(o, o.output);
            return line(fraction);
        };
        return work(files);
    });
}

// Warns of notes of map_files, and returns them with option names, for the report.
std::vector<std::string> warned(const MapOptions& options, std::vector<std::string> notes);

// Each adds one command.
void addMapInfo(Arguments& map);
void addMapDetect(Arguments& map);
void addMapConvert(Arguments& map);
void addMapDiff(Arguments& map);
void addMapFromHeight(Arguments& map);
void addMapToHeight(Arguments& map);
void addMapBlend(Arguments& map);
void addMapMips(Arguments& map);

} // namespace cotan::app
