#include "commands.hpp"

#include "cotan/files/output.hpp"
#include "cotan/report/cost_tables.hpp"
#include "loading.hpp"

namespace cotan::app {

namespace {

struct CostCommandOptions : CommonOptions {
    std::vector<std::string> frames;
    std::vector<std::string> devices;
    std::vector<std::string> families;
    bool noTiming = false;
    bool timeCpuDevices = false;
    int repeats = 15;
    std::string csv;
};

Status run(const CostCommandOptions& o)
{
    if (Status planned = planOutputs(o, {{"-o", o.output}, {"--csv", o.csv}}); !planned)
        return planned;
    const auto report = withProgress(o, 1, "pricing", [&](Progress progress) {
        return cost::price({.frames = o.frames,
                            .devices = o.devices,
                            .families = o.families,
                            .timing = !o.noTiming,
                            .timeCpuDevices = o.timeCpuDevices,
                            .repeats = o.repeats,
                            .progress = std::move(progress)});
    });
    if (!report)
        return inWords(report.error());
    const std::string tables = toMarkdown(*report);
    if (!o.output.empty()) {
        if (Status written = writeTables(o.output, tables); !written)
            return written;
    } else if (o.json != "-") {
        print(tables);
    }
    if (!o.csv.empty())
        if (Status written = writeFileWhole(o.csv, toCsv(*report)); !written)
            return written;
    if (Status written = writeReport(o, toJson(*report)); !written)
        return written;
    return report->codeSilence.empty() ? Status(Done{}) : unavailableError(report->codeSilence);
}

void declare(Arguments& a, CostCommandOptions& o)
{
    a.find("--threads").unlisted(); // accepted by all commands, listed where it is used
    a.option("--frames", o.frames, "rows to price besides floor and mikktspace; default: all")
        .separatedByCommas()
        .in("A,B");
    a.option("--device", o.devices, "devices with this in their name; default: all").in("NAME");
    a.option("--family", o.families,
             "cards that Mesa's Radeon driver compiles for without having one; default, if "
             "no --device is "
             "given: POLARIS10, VEGA10, NAVI21, GFX1100")
        .in("NAME");
    a.flag("--no-timing", o.noTiming, "do not draw to take times");
    a.flag("--time-cpu-devices", o.timeCpuDevices, "take times also where a driver draws on the processor");
    a.option("--repeats", o.repeats, "draws of which the median is taken").within(1, 1000);
    a.option("--csv", o.csv, "every number, one a line").in("FILE");
}

} // namespace

void addCostCommand(Arguments& tool)
{
    addCommand<CostCommandOptions>(
        tool,
        {"cost",
         "what each frame costs: operations, SPIR-V, machine code, time",
         "file for the tables instead of standard output; where it has the marks of docs/cost.md, "
         "only what is between them is replaced",
         {"cotan cost --frames cotangent --no-timing", "cotan cost --family NAVI21 --csv cost.csv"}},
        declare, run);
}

} // namespace cotan::app
