// `cotan map info` and `detect`: nothing is changed.
#include <string>
#include <vector>

#include "cotan/map_files/inspect.hpp"
#include "map_options.hpp"

namespace cotan::app {

namespace {

struct InspectOptions : MapOptions {
    std::string file;
};

// Says the lines, and writes the figures.
Status tell(const InspectOptions& o, const std::vector<std::string>& lines, const char* command, const Json& figures)
{
    for (const std::string& line : lines)
        say(o, line);
    Json report = {{"command", command}, {"file", o.file}};
    report.update(figures);
    return writeReport(o, report);
}

Status runInfo(const InspectOptions& o)
{
    if (Status planned = planOutputs(o, {}); !planned)
        return planned;
    const auto found =
        onFiles(o, o.file, [&](const maps::FileOptions& files) { return maps::surveyFile(o.file, files); });
    return found ? tell(o, maps::linesOf(*found, o.file), "map info", maps::toJson(*found)) : found.error();
}

Status runDetect(const InspectOptions& o)
{
    if (Status planned = planOutputs(o, {}); !planned)
        return planned;
    const auto found =
        onFiles(o, o.file, [&](const maps::FileOptions& files) { return maps::greenOfFile(o.file, files); });
    return found ? tell(o, maps::linesOf(*found, o.file), "map detect", maps::toJson(*found)) : found.error();
}

void declare(Arguments& a, InspectOptions& o)
{
    addMemoryOption(a, o.memory);
    a.option("FILE", o.file, "the map").required().reads();
}

} // namespace

void addMapInfo(Arguments& map)
{
    addCommand<InspectOptions>(map,
                               {"info",
                                "properties of a map: lengths, tilt, centre, channels, and what is wrong",
                                "",
                                {"cotan map info rocks.png", "cotan map info rocks.png --json rocks.json"}},
                               declare, runInfo);
}

void addMapDetect(Arguments& map)
{
    addCommand<InspectOptions>(map,
                               {"detect",
                                "which way green points, and how sure that is",
                                "",
                                {"cotan map detect rocks.png", "cotan map detect rocks.png --json rocks.json"}},
                               declare, runDetect);
}

} // namespace cotan::app
