#include "lab.hpp"

#include <filesystem>
#include <optional>

#include "core/try.hpp"
#include "cost/cards.hpp"
#include "cost/rows.hpp"
#include "files/bytes.hpp"
#include "files/output.hpp"
#include "loading.hpp"
#include "report/cost_tables.hpp"

namespace cotan::app {

namespace {

constexpr std::size_t kMaxCardBytes = 64 << 20;

} // namespace

std::optional<int> runCostChild(const std::vector<std::string>& words) { return cost::runChild(words); }

Status runCost(const CostCommandOptions& o)
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
        COTAN_TRY(bytes, readFileBytes(o.cards, kMaxCardBytes));
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
        return withOptionNames(report.error());
    // Tables without machine code must not overwrite older ones that may have it.
    if (!report->codeSilence.empty())
        for (const std::filesystem::path& file : {std::filesystem::path(o.output), std::filesystem::path(o.csv),
                                                  std::filesystem::path(o.json), std::filesystem::path(o.writeCards)})
            if (std::filesystem::is_regular_file(file))
                return unavailableError(
                    fmt::format("{}; {} exists and is left unchanged", report->codeSilence, file.string()));
    const auto svg = o.output.empty() ? std::nullopt : costChart(*report);
    const std::string tables = toMarkdown(*report, svg ? chart.filename().string() : "");
    if (svg)
        COTAN_CHECK(writeFileWhole(chart, *svg));
    if (!o.output.empty()) {
        COTAN_CHECK(writeTables(o.output, tables));
    } else if (o.json != "-") {
        print(tables);
    }
    if (!o.csv.empty())
        COTAN_CHECK(writeFileWhole(o.csv, toCsv(*report)));
    if (!o.writeCards.empty())
        COTAN_CHECK(writeFileWhole(o.writeCards, cost::gpusToCsv(report->code)));
    COTAN_CHECK(writeReport(o, toJson(*report)));
    return report->codeSilence.empty() ? Status(Done{}) : unavailableError(report->codeSilence);
}

} // namespace cotan::app
