#include "lab_options.hpp"

#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/not_built.hpp"
#include "picture_options.hpp"

namespace cotan::app {

namespace {

// Copies of the tables in apps/lab; a test compares them.
constexpr const char* kTables[] = {"flat",   "foreshortening", "perspective", "views",      "signs",      "curved",
                                   "facets", "precision",      "half",        "degenerate", "procedural", "rendered"};
constexpr const char* kFigures[] = {"2.6.3",   "2.6.4",    "2.6.5", "mirrored",  "faceting", "sparkle",
                                    "flicker", "parallax", "decal", "triplanar", "grooves",  "isolines"};
// Rows other than the frames and their fused forms.
constexpr const char* kRows[] = {"triangle-halfs",   "triangle-read",        "triangle-scaled",
                                 "cotangent-seen",   "cotangent-area-fused", "cotangent-plain",
                                 "cotangent-facing", "gradient-plain",       "orthonormal-plain"};

} // namespace

std::vector<std::string> accuracyTableNames() { return {std::begin(kTables), std::end(kTables)}; }
std::vector<std::string> figureOptionNames() { return {std::begin(kFigures), std::end(kFigures)}; }

std::vector<std::string> costRowNames()
{
    std::vector<std::string> names = {"floor"};
    for (const FrameInfo& f : frames()) {
        if (f.frame == Frame::areaWeighted) // the code of mikktspace
            continue;
        names.emplace_back(f.name);
        if (f.fused)
            names.push_back(std::string(f.name) + "-fused");
    }
    names.insert(names.end(), std::begin(kRows), std::end(kRows));
    return names;
}

namespace {

void declare(Arguments& a, AccuracyCommandOptions& o)
{
    a.option("--tables", o.tables, "tables, separated by commas (default: all; see --list)")
        .in("A,B")
        .offers(accuracyTableNames())
        .main();
    a.option("--frames", o.frames,
             "frames, separated by commas (default: all): " + usefulFrameNames()
                 + ", and historical ones of --list-frames")
        .in("A,B")
        .offers(frameWords())
        .main();
    addListOfFrames(a);
    a.group(HelpGroup::input);
    a.option("--device", o.device,
             "device for the table `rendered`: auto, reference, a part of a Vulkan device's name, or none")
        .in("DEVICE")
        .offers({"auto", "reference", "none"})
        .under(HelpGroup::general);
    a.option("--scene", o.scene, "only this scene of the tables, such as sphere").in("NAME").main();
    a.group(HelpGroup::output);
    a.option("--csv", o.csv, "write all figures as CSV").in("FILE").writes();
    a.option("--against", o.against, "compare with figures that --csv wrote; exit code 5 if any is worse")
        .in("FILE")
        .reads()
        .under(HelpGroup::diagnostics);
    a.flag("--list", o.list, "print the names of the tables and stop").main();
}

void declare(Arguments& a, FiguresCommandOptions& o)
{
    a.group(HelpGroup::output);
    a.option("--size", o.size, "width and height of a panel in pixels, 512 is 512x512; square panels take the height")
        .in("WxH");
    const std::vector<std::string> names = figureOptionNames();
    a.option("--only", o.only, fmt::format("figures to make, separated by commas: {}", fmt::join(names, ", ")))
        .in("NAMES")
        .offers(names)
        .main();
    addDeviceOption(a, o.device);
}

#ifdef COTAN_WITH_COST
void declare(Arguments& a, CostCommandOptions& o)
{
    a.find("--threads").unlisted(); // accepted by all commands, but listed only where used
    a.option("--frames", o.frames, "frames to measure besides floor and mikktspace; default: all")
        .separatedByCommas()
        .in("A,B")
        .offers(costRowNames())
        .main();
    a.group(HelpGroup::input);
    a.option("--device", o.devices, "only devices with this in their name; default: all").in("NAME");
    a.option("--family", o.families,
             "GPUs that Mesa's Radeon driver compiles for without having them; default, if no --device is given: "
             "POLARIS10, VEGA10, NAVI21, GFX1100")
        .in("NAME")
        .offers({"POLARIS10", "VEGA10", "NAVI21", "GFX1100"});
    a.group(HelpGroup::diagnostics);
    a.flag("--no-timing", o.noTiming, "measure no times");
    a.flag("--time-cpu-devices", o.timeCpuDevices, "measure times also on devices that render on the CPU");
    a.option("--repeats", o.repeats, "how often to draw; the time is the median").within(1, 1000).in("N");
    a.option("--csv", o.csv, "write every number, one per line").in("FILE").writes().under(HelpGroup::output);
    a.option("--write-cards", o.writeCards, "write a line for each GPU and stage, which --cards reads")
        .in("FILE.csv")
        .writes()
        .under(HelpGroup::output);
    a.option("--cards", o.cards, "make the tables of the GPUs in this file instead of querying drivers")
        .in("FILE.csv")
        .reads()
        .under(HelpGroup::input);
    a.option("--name", o.name, "name in the tables of the device, if only one; default: its own name").in("NAME");
}
#endif

} // namespace

void addAccuracyCommand(Arguments& tool, Status (*run)(const AccuracyCommandOptions&))
{
    addCommand<AccuracyCommandOptions>(
        tool,
        {"accuracy",
         "Measure the error of every frame, in degrees, on surfaces whose normals are known exactly.",
         "file for the tables (Markdown) instead of standard output",
         {"cotan accuracy --list", "cotan accuracy --tables flat --frames cotangent,orthonormal --csv flat.csv"}},
        declare, run);
}

void addFiguresCommand(Arguments& tool, Status (*run)(const FiguresCommandOptions&))
{
    addCommand<FiguresCommandOptions>(
        tool,
        {"figures",
         "Draw the figures of the papers, with errors in degrees, as one HTML page and PNGs.",
         "folder for index.html and the images",
         {"cotan figures --only mirrored -o figures", "cotan figures --only 2.6.4,mirrored --size 240x180 -o figures"},
         /*needsOutput=*/true},
        declare, run);
}

#ifdef COTAN_WITH_COST
void addCostCommand(Arguments& tool, Status (*run)(const CostCommandOptions&))
{
    addCommand<CostCommandOptions>(
        tool,
        {"cost",
         "Measure what each frame costs: operations, SPIR-V, machine code, time.",
         "file for the tables instead of standard output, with a chart (.svg) beside it; if it has the marks of "
         "docs/explanation/cost.md, only the text between them is replaced",
         {"cotan cost --frames cotangent --no-timing", "cotan cost --family NAVI21 --csv cost.csv"}},
        declare, run);
}
#else
// Accepts any words and reports what is missing.
void addCostCommand(Arguments& tool, Status (*)(const CostCommandOptions&))
{
    Arguments command =
        tool.command("cost", "Measure what each frame costs. Not in this build: needs Linux and Vulkan.");
    command.takesAnything();
    command.does(
        []() -> Status { return notBuiltWith("the measurement of costs", "libvulkan-dev and glslang-tools"); });
}
#endif

} // namespace cotan::app
