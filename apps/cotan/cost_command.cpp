#include "commands.hpp"

#include <filesystem>
#include <optional>

#include "cotan/cost/cards.hpp"
#include "cotan/cost/rows.hpp"
#include "cotan/files/bytes.hpp"
#include "cotan/files/output.hpp"
#include "cotan/report/cost_tables.hpp"
#include "loading.hpp"

namespace cotan::app {

namespace {

constexpr std::size_t kMaxCardBytes = 64 << 20;

struct CostCommandOptions : CommonOptions {
    std::vector<std::string> frames;
    std::vector<std::string> devices;
    std::vector<std::string> families;
    bool noTiming = false;
    bool timeCpuDevices = false;
    int repeats = 15;
    std::string csv;
    std::string name;
    std::string cards;
    std::string writeCards;
};

Status run(const CostCommandOptions& o)
{
    std::filesystem::path chart = o.output;
    if (!o.output.empty())
        chart.replace_extension(".svg");
    if (Status planned = beginOutputs(
            o,
            {{"-o", o.output}, {"-o, the chart", chart.string()}, {"--csv", o.csv}, {"--write-cards", o.writeCards}});
        !planned)
        return planned;
    std::string cards;
    if (!o.cards.empty()) {
        const auto bytes = readFileBytes(o.cards, kMaxCardBytes);
        if (!bytes)
            return bytes.error();
        cards.assign(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    }
    const auto report = withProgress(o, 1, "pricing", [&](Progress progress) {
        return cost::price({.frames = o.frames,
                            .devices = o.devices,
                            .families = o.families,
                            .cards = std::move(cards),
                            .name = o.name,
                            .timing = !o.noTiming,
                            .timeCpuDevices = o.timeCpuDevices,
                            .repeats = o.repeats,
                            .progress = std::move(progress)});
    });
    if (!report)
        return inWords(report.error());
    // Tables without machine code do not take the place of older ones that may have it.
    if (!report->codeSilence.empty())
        for (const std::filesystem::path& file : {std::filesystem::path(o.output), std::filesystem::path(o.csv),
                                                  std::filesystem::path(o.json), std::filesystem::path(o.writeCards)})
            if (std::filesystem::is_regular_file(file))
                return unavailableError(
                    fmt::format("{}; {} is there and stays as it is", report->codeSilence, file.string()));
    const auto picture = o.output.empty() ? std::nullopt : costChart(*report);
    const std::string tables = toMarkdown(*report, picture ? chart.filename().string() : "");
    if (picture)
        if (Status written = writeFileWhole(chart, *picture); !written)
            return written;
    if (!o.output.empty()) {
        if (Status written = writeTables(o.output, tables); !written)
            return written;
    } else if (o.json != "-") {
        print(tables);
    }
    if (!o.csv.empty())
        if (Status written = writeFileWhole(o.csv, toCsv(*report)); !written)
            return written;
    if (!o.writeCards.empty())
        if (Status written = writeFileWhole(o.writeCards, cost::cardsToCsv(report->code)); !written)
            return written;
    if (Status written = writeReport(o, toJson(*report)); !written)
        return written;
    return report->codeSilence.empty() ? Status(Done{}) : unavailableError(report->codeSilence);
}

std::vector<std::string> rowWords()
{
    std::vector<std::string> words;
    for (const cost::Row& row : cost::rows())
        words.emplace_back(row.name);
    return words;
}

void declare(Arguments& a, CostCommandOptions& o)
{
    a.find("--threads").unlisted(); // accepted by all commands, listed where it is used
    a.option("--frames", o.frames, "frames to measure besides floor and mikktspace; default: all")
        .separatedByCommas()
        .in("A,B")
        .offers(rowWords())
        .main();
    a.group(HelpGroup::input);
    a.option("--device", o.devices, "only devices with this in their name; default: all").in("NAME");
    a.option("--family", o.families,
             "graphics cards that Mesa's Radeon driver compiles for without the card; default, if no --device is "
             "given: POLARIS10, VEGA10, NAVI21, GFX1100")
        .in("NAME")
        .offers({"POLARIS10", "VEGA10", "NAVI21", "GFX1100"});
    a.group(HelpGroup::diagnostics);
    a.flag("--no-timing", o.noTiming, "measure no times");
    a.flag("--time-cpu-devices", o.timeCpuDevices, "measure times also where a driver draws on the processor");
    a.option("--repeats", o.repeats, "how often to draw; the time is the median").within(1, 1000).in("N");
    a.option("--csv", o.csv, "write every number, one per line").in("FILE").writes().under(HelpGroup::output);
    a.option("--write-cards", o.writeCards, "write a line for each card and stage, which --cards reads")
        .in("FILE.csv")
        .writes()
        .under(HelpGroup::output);
    a.option("--cards", o.cards, "make the tables of the cards in this file instead of asking drivers")
        .in("FILE.csv")
        .reads()
        .under(HelpGroup::input);
    a.option("--name", o.name, "what the tables call the device, where there is one; default: its own name").in("NAME");
}

} // namespace

void addCostCommand(Arguments& tool)
{
    addCommand<CostCommandOptions>(
        tool,
        {"cost",
         "Measure what each frame costs: operations, SPIR-V, machine code, time.",
         "file for the tables instead of standard output, and beside it a chart, .svg; where it has the marks of "
         "docs/explanation/cost.md, only what is between them is replaced",
         {"cotan cost --frames cotangent --no-timing", "cotan cost --family NAVI21 --csv cost.csv"}},
        declare, run);
}

} // namespace cotan::app
