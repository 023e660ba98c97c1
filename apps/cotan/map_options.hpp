// What the subcommands of `cotan map` share.
#pragma once

#include <string>
#include <utility>

#include "common.hpp"
#include "cotan/convention.hpp"
#include "loading.hpp"
#include "map_files/map_file.hpp"

namespace cotan::app {

struct MapOptions : CommonOptions {
    int memory = kDefaultMemory; // of one picture that is decoded whole
    std::string bits = "auto";
};

// The options that they share besides those of all commands.
void addBits(Arguments& command, MapOptions& options, const std::string& help);
void addCompress(Arguments& command, std::string& compress);
void addDither(Arguments& command, bool& dither);

// parseStatedConvention with the option in front of its message.
Result<StatedConvention> parseConvention(const std::string& text, const std::string& option);

// The two of --from and --to.
Result<std::pair<StatedConvention, StatedConvention>> parseFromTo(const std::string& from, const std::string& to);

// For the commands that write a map: -o has to be given, and what is written is planned: `file`, the one that -o names
// if empty.
Status needOutput(const MapOptions& options, const std::string& command, const std::filesystem::path& file = {});

// Runs a call of cotan/map_files under a line of progress; errors are in words of the command line.
template<class Work> auto onFiles(const MapOptions& o, const std::string& what, const Work& work)
{
    auto result = withProgress(o, 1, what, [&](Progress progress) {
        return work(maps::FileOptions{limitsFor(o.memory), o.threads, std::move(progress)});
    });
    return result ? std::move(result) : decltype(result)(withOptionNames(result.error()));
}

// The same for work that writes a normal map: once the work has begun, warns where the format of -o does not keep it.
template<class Work> auto onFilesToMap(const MapOptions& o, const std::string& what, const Work& work)
{
    bool told = false;
    return onFiles(o, what, [&](maps::FileOptions files) {
        files.progress = [&, line = std::move(files.progress)](double share) {
            if (!std::exchange(told, true))
                warnIfLossy(o, o.output);
            return line(share);
        };
        return work(files);
    });
}

// Each adds its command.
void addMapInfo(Arguments& map);
void addMapDetect(Arguments& map);
void addMapConvert(Arguments& map);
void addMapDiff(Arguments& map);
void addMapFromHeight(Arguments& map);
void addMapToHeight(Arguments& map);
void addMapBlend(Arguments& map);
void addMapMips(Arguments& map);

} // namespace cotan::app
