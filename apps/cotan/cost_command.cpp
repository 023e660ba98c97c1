#include "commands.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <sys/utsname.h>

#include "cost_tables.hpp"
#include "progress.hpp"
#include "cotan/files/output.hpp"

namespace cotan::app {

namespace {

struct CostCommandOptions {
    CommonOptions common;
    std::vector<std::string> frames;
    std::vector<std::string> devices;
    std::vector<std::string> families;
    bool noTiming = false;
    bool timeCpuDevices = false;
    int repeats = 15;
    std::string csv;
};

constexpr const char* kBegin =
    "<!-- cotan cost: from here to the end mark written by the tool -->\n";
constexpr const char* kEnd = "<!-- cotan cost: end -->\n";

std::string machineText()
{
    std::string system;
    std::ifstream release("/etc/os-release");
    for (std::string line; std::getline(release, line);)
        if (line.rfind("PRETTY_NAME=", 0) == 0)
            system = line.substr(12);
    system.erase(std::remove(system.begin(), system.end(), '"'), system.end());
    utsname name{};
    ::uname(&name);
    return (system.empty() ? std::string(name.sysname) : system) + ", " + name.machine;
}

Result<std::vector<const cost::Row*>> chosenRows(const std::vector<std::string>& names)
{
    for (const std::string& name : names)
        if (!cost::rowFromName(name)) {
            std::string known;
            for (const cost::Row& row : cost::rows())
                known += (known.empty() ? "" : ", ") + std::string(row.name);
            return usageError(fmt::format("--frames: expected one of {}; found '{}'", known, name));
        }
    std::vector<const cost::Row*> rows;
    for (const cost::Row& row : cost::rows()) {
        const bool named = std::find(names.begin(), names.end(), row.name) != names.end();
        // What the others are compared with is always there.
        if (names.empty() || named || row.name == "floor" || row.name == "mikktspace")
            rows.push_back(&row);
    }
    return rows;
}

// Where the file has the two marks, what is between them is replaced; other files are written
// whole.
Status writeTables(const std::filesystem::path& file, const std::string& tables)
{
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream old;
    if (stream)
        old << stream.rdbuf();
    const std::string text = old.str();
    const std::size_t begin = text.find(kBegin), end = text.find(kEnd);
    if (begin == std::string::npos || end == std::string::npos || end < begin)
        return writeFileWhole(file, tables);
    return writeFileWhole(file,
                          text.substr(0, begin) + kBegin + '\n' + tables + '\n' + text.substr(end));
}

// Machine code and times; the error says why Vulkan cannot be used at all.
Status measure(const CostCommandOptions& o, CostReport& report)
{
    Status usable = Done{};
    const std::vector<std::string> families = !o.families.empty() ? o.families
        : o.devices.empty()                                      ? cost::usualFamilies()
                                                                 : std::vector<std::string>();
    Progress progress(o.common, families.size() + 2, "pricing"); // devices, families, times
    if (o.families.empty() || !o.devices.empty()) {
        auto code = cost::machineCodeOfDevices(report.rows, o.devices);
        if (code)
            report.code = std::move(*code);
        else
            usable = code.error();
        if (code && report.code.empty() && !o.devices.empty())
            return unavailableError(fmt::format("no Vulkan device has '{}' in its name",
                                                fmt::join(o.devices, "' or '")));
    }
    progress.step();
    for (const std::string& family : families) {
        report.code.push_back(cost::machineCodeOfFamily(report.rows, family));
        progress.step();
    }
    if (o.noTiming) {
        report.timingSilence = "--no-timing was given";
        return usable;
    }
    if (!o.families.empty() && o.devices.empty())
        return usable; // only cards that are not here were asked for
    auto timing = cost::timeRows(report.rows, {o.devices, o.timeCpuDevices, o.repeats});
    if (timing)
        report.timing = std::move(*timing);
    else
        report.timingSilence = timing.error().message;
    return usable;
}

Status run(const CostCommandOptions& o)
{
    auto rows = chosenRows(o.frames);
    if (!rows)
        return rows.error();
    if (Status planned = planOutputs(o.common, {{"-o", o.common.output}, {"--csv", o.csv}}); !planned)
        return planned;
    CostReport report;
    report.machine = machineText();
    report.rows = std::move(*rows);
    const Status measured = measure(o, report);
    const std::string tables = toMarkdown(report);
    if (o.common.output.empty()) {
        if (o.common.json != "-")
            print(tables);
    } else if (Status written = writeTables(o.common.output, tables); !written) {
        return written;
    }
    if (!o.csv.empty())
        if (Status written = writeFileWhole(o.csv, toCsv(report)); !written)
            return written;
    if (Status written = writeReport(o.common, toJson(report)); !written)
        return written;
    const bool any = std::any_of(report.code.begin(), report.code.end(),
                                 [](const cost::DeviceCode& d) { return d.silence.empty(); });
    if (any)
        return Done{};
    if (!measured)
        return unavailableError(measured.error().message + "; operations and SPIR-V were counted");
    return unavailableError(
        "no driver that was asked reports machine code; operations and SPIR-V were counted. "
        "Mesa's Radeon driver reports without a card (Debian: mesa-vulkan-drivers)");
}

} // namespace

Command addCostCommand(CLI::App& app)
{
    auto options = std::make_shared<CostCommandOptions>();
    CLI::App* command =
        app.add_subcommand("cost", "what each frame costs: operations, SPIR-V, machine code, time");
    addCommonOptions(
        *command, options->common,
        "file for the tables instead of standard output; where it has the marks of docs/cost.md, "
        "only what is between them is replaced");
    command->get_option("--threads")->group(""); // accepted by all commands, listed where it is used
    command
        ->add_option("--frames", options->frames,
                     "rows to price besides floor and mikktspace; default: all")
        ->delimiter(',')
        ->type_name("A,B");
    command
        ->add_option("--device", options->devices, "devices with this in their name; default: all")
        ->type_name("NAME");
    command
        ->add_option("--family", options->families,
                     "cards that Mesa's Radeon driver compiles for without having one; default, if "
                     "no --device is "
                     "given: POLARIS10, VEGA10, NAVI21, GFX1100")
        ->type_name("NAME");
    command->add_flag("--no-timing", options->noTiming, "do not draw to take times");
    command->add_flag("--time-cpu-devices", options->timeCpuDevices,
                      "take times also where a driver draws on the processor");
    command->add_option("--repeats", options->repeats, "draws of which the median is taken")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command->add_option("--csv", options->csv, "every number, one a line")->type_name("FILE");
    addExamples(*command, {"cotan cost --frames cotangent --no-timing",
                           "cotan cost --family NAVI21 --csv cost.csv"});
    return {command, [options] { return run(*options); }};
}

} // namespace cotan::app
