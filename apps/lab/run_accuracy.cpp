#include "lab.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "core/try.hpp"
#include "figures/rendered_table.hpp"
#include "files/output.hpp"
#include "loading.hpp"
#include "parse.hpp"
#include "report/measurements.hpp"
#include "truth/measurement.hpp"

namespace cotan::app {

namespace {

constexpr std::string_view kRendered = "rendered";
constexpr std::string_view kRenderedSummary = "the curved surfaces drawn by the device, normals read back";

struct ChosenTables {
    std::vector<const AccuracyTable*> computed;
    bool rendered = false;
};

Result<ChosenTables> chooseTables(const std::string& text)
{
    ChosenTables chosen;
    std::string names;
    for (const AccuracyTable& table : accuracyTables())
        names += std::string(table.name) + ", ";
    names += kRendered;
    for (const std::string& word : splitAtCommas(text)) {
        if (word == kRendered) {
            chosen.rendered = true;
            continue;
        }
        const auto& all = accuracyTables();
        const auto found = std::find_if(all.begin(), all.end(), [&](const AccuracyTable& t) { return t.name == word; });
        if (found == all.end())
            return usageError(fmt::format("--tables: expected names from {}; found '{}'", names, word));
        chosen.computed.push_back(&*found);
    }
    if (text.empty()) {
        chosen.rendered = true;
        for (const AccuracyTable& table : accuracyTables())
            chosen.computed.push_back(&table);
    }
    return chosen;
}

Result<AccuracySelection> chooseRows(const AccuracyCommandOptions& o)
{
    AccuracySelection selection;
    selection.scene = o.scene;
    for (const std::string& word : splitAtCommas(o.frames)) {
        COTAN_TRY(frame, parseFrame(word, "--frames"));
        selection.frames.push_back(*frame);
    }
    return selection;
}

// Prints which results are worse than in the file given by --against.
Status compareWith(const AccuracyCommandOptions& o, const std::vector<Measurement>& rows)
{
    COTAN_TRY(before, readMeasurements(o.against));
    std::size_t compared = 0;
    const auto worse = worsenings(*before, rows, compared);
    for (const Worsening& w : worse)
        fmt::print(stderr, "worse: {}, {}, {}, {}, {}, {}: {}\n", w.now.table, w.now.scene, w.now.setting, w.now.frame,
                   w.now.truth, w.now.arithmetic, w.what);
    if (!worse.empty())
        return Error{ErrorKind::limit,
                     fmt::format("{} of {} figures are worse than in {}", worse.size(), compared, o.against.string())};
    if (compared == 0)
        return inputError(fmt::format("{}: holds none of the figures that were measured", o.against.string()));
    say(o, "{} figures compared with {}: none is worse", compared, o.against.string());
    return Done{};
}

Status listTables(const AccuracyCommandOptions& o)
{
    auto tables = Json::array();
    const auto add = [&](std::string_view name, std::string_view summary) {
        say(o, "{:<16}{}", name, summary);
        tables.push_back({{"name", name}, {"summary", summary}});
    };
    for (const AccuracyTable& table : accuracyTables())
        add(table.name, table.summary);
    add(kRendered, kRenderedSummary);
    return writeReport(o, {{"command", "accuracy"}, {"tables", tables}});
}

} // namespace

Status runAccuracy(const AccuracyCommandOptions& o)
{
    COTAN_CHECK(beginOutputs(o, {{"-o", o.output}, {"--csv", o.csv}}));
    if (o.list)
        return listTables(o);
    if (!o.against.empty()) // check it first: measuring may take hours
        COTAN_CHECK(readMeasurements(o.against));
    COTAN_TRY(tables, chooseTables(o.tables));
    COTAN_TRY(selection, chooseRows(o));
    std::unique_ptr<Renderer> renderer; // opened first: a missing device is reported before measuring
    if (tables->rendered && o.device != "none") {
        COTAN_TRY(opened, openDevice(o.device, o));
        renderer = *std::move(opened);
    }
    COTAN_TRY(measured, withProgress(o, 1, "measuring tables", [&](const Progress& progress) {
                  return measureTables(tables->computed, *selection, o.threads, progress);
              }));
    std::vector<Measurement> rows = *std::move(measured);
    if (renderer) {
        COTAN_TRY(rendered, withProgress(o, 1, "drawing surfaces", [&](const Progress& progress) {
                      return figures::measureRendered(*renderer, *selection, progress);
                  }));
        rows.insert(rows.end(), rendered->begin(), rendered->end());
    }
    if (rows.empty())
        return usageError("nothing was measured: no chosen table has that scene with those frames");
    if (o.output.empty() && o.against.empty())
        sayLines(o, toText(rows));
    if (!o.output.empty())
        COTAN_CHECK(writeFileWhole(o.output, toText(rows)));
    if (!o.csv.empty())
        COTAN_CHECK(writeFileWhole(o.csv, toCsv(rows)));
    if (Status written = writeReport(o, {{"command", "accuracy"}, {"unit", "degrees"}, {"figures", toJson(rows)}});
        !written)
        return written;
    return o.against.empty() ? Status(Done{}) : compareWith(o, rows);
}

} // namespace cotan::app
