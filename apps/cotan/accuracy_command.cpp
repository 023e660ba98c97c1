#include "commands.hpp"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <sstream>
#include <thread>

#include <fmt/format.h>

#include "cotan/files/account.hpp"
#include "cotan/files/output.hpp"
#include "cotan/report/measurements.hpp"
#include "cotan/truth/measurement.hpp"
#include "parse.hpp"
#include "progress.hpp"
#include "rendered_table.hpp"

namespace cotan::app {

namespace {

struct AccuracyCommandOptions {
    CommonOptions common;
    std::string tables, frames, scene, csv;
    std::string device = "auto";
    std::filesystem::path against;
    bool list = false;
};

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
    std::stringstream words(text);
    for (std::string word; std::getline(words, word, ',');) {
        if (word == kRendered) {
            chosen.rendered = true;
            continue;
        }
        const auto& all = accuracyTables();
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const AccuracyTable& t) { return t.name == word; });
        if (found == all.end())
            return usageError(fmt::format("--tables: expected names out of {}; found '{}'", names, word));
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
    std::stringstream words(o.frames);
    for (std::string word; std::getline(words, word, ',');) {
        const auto frame = parseFrame(word);
        if (!frame)
            return frame.error();
        selection.frames.push_back(*frame);
    }
    return selection;
}

// The tables side by side on some threads; their rows in the order of the tables.
std::vector<Measurement> measure(const AccuracyCommandOptions& o, const std::vector<const AccuracyTable*>& tables,
                                 const AccuracySelection& selection)
{
    std::vector<std::vector<Measurement>> results(tables.size());
    std::atomic<std::size_t> next = 0;
    Progress progress(o.common, tables.size(), "measuring tables");
    auto work = [&] {
        for (std::size_t i; (i = next++) < tables.size();) {
            results[i] = tables[i]->measure(selection);
            progress.step();
        }
    };
    const std::size_t wanted = o.common.threads > 0 ? std::size_t(o.common.threads)
                                                    : std::size_t(std::max(1u, std::thread::hardware_concurrency()));
    std::vector<std::thread> threads;
    for (std::size_t i = 1; i < std::min(wanted, tables.size()); ++i)
        threads.emplace_back(work);
    work();
    for (std::thread& t : threads)
        t.join();
    std::vector<Measurement> rows;
    for (auto& part : results)
        rows.insert(rows.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
    return rows;
}

Result<std::vector<Measurement>> readCsv(const std::filesystem::path& file)
{
    if (Status free = noteInput(file); !free)
        return free.error();
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    constexpr std::uintmax_t kLimit = 64u << 20;
    if (error)
        return inputError(fmt::format("{}: cannot read: {}", file.string(), error.message()));
    if (size > kLimit)
        return inputError(fmt::format("{}: {} bytes; expected at most {}", file.string(), size, kLimit));
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return measurementsFromCsv(text.str(), file.string());
}

// Says what has become worse than in the file --against names.
Status compareWith(const AccuracyCommandOptions& o, const std::vector<Measurement>& rows)
{
    const auto before = readCsv(o.against);
    if (!before)
        return before.error();
    std::size_t compared = 0;
    const auto worse = worsenings(*before, rows, compared);
    for (const Worsening& w : worse)
        fmt::print(stderr, "worse: {}, {}, {}, {}, {}, {}: {}\n", w.now.table, w.now.scene, w.now.setting,
                   w.now.frame, w.now.truth, w.now.arithmetic, w.what);
    if (!worse.empty())
        return Error{ErrorKind::limit, fmt::format("{} of {} figures are worse than in {}", worse.size(), compared,
                                                   o.against.string())};
    if (compared == 0)
        return inputError(fmt::format("{}: holds none of the figures that were measured", o.against.string()));
    say(o.common, fmt::format("{} figures compared with {}: none is worse", compared, o.against.string()));
    return Done{};
}

Status listTables(const AccuracyCommandOptions& o)
{
    auto tables = nlohmann::ordered_json::array();
    const auto add = [&](std::string_view name, std::string_view summary) {
        say(o.common, fmt::format("{:<16}{}", name, summary));
        tables.push_back({{"name", name}, {"summary", summary}});
    };
    for (const AccuracyTable& table : accuracyTables())
        add(table.name, table.summary);
    add(kRendered, kRenderedSummary);
    return writeReport(o.common, {{"command", "accuracy"}, {"tables", tables}});
}

Status run(const AccuracyCommandOptions& o)
{
    if (Status planned = planOutputs(o.common, {{"-o", o.common.output}, {"--csv", o.csv}}); !planned)
        return planned;
    if (o.list)
        return listTables(o);
    if (!o.against.empty()) // read first: hours may pass before it is compared
        if (const auto before = readCsv(o.against); !before)
            return before.error();
    const auto tables = chooseTables(o.tables);
    if (!tables)
        return tables.error();
    const auto selection = chooseRows(o);
    if (!selection)
        return selection.error();
    auto rows = measure(o, tables->computed, *selection);
    if (tables->rendered && o.device != "none") {
        auto rendered = measureRendered(o.device, o.common, *selection);
        if (!rendered)
            return rendered.error();
        rows.insert(rows.end(), rendered->begin(), rendered->end());
    }
    if (rows.empty())
        return usageError("nothing was measured: no chosen table has that scene with those frames");
    if (o.common.output.empty() && o.against.empty())
        say(o.common, toText(rows));
    if (!o.common.output.empty())
        if (Status written = writeFileWhole(o.common.output, toText(rows)); !written)
            return written;
    if (!o.csv.empty())
        if (Status written = writeFileWhole(o.csv, toCsv(rows)); !written)
            return written;
    if (Status written = writeReport(o.common, {{"command", "accuracy"}, {"unit", "degrees"}, {"figures", toJson(rows)}});
        !written)
        return written;
    return o.against.empty() ? Status(Done{}) : compareWith(o, rows);
}

} // namespace

Command addAccuracyCommand(CLI::App& app)
{
    auto options = std::make_shared<AccuracyCommandOptions>();
    CLI::App* command = app.add_subcommand("accuracy", "every frame against analytic truth, in degrees");
    addCommonOptions(*command, options->common, "write the tables (Markdown) there instead of printing them");
    command->add_option("--tables", options->tables, "names, separated by commas (default: all; see --list)")
        ->type_name("A,B");
    command->add_option("--frames", options->frames, "frames, separated by commas (default: all): " + frameNames())
        ->type_name("A,B");
    command->add_option("--device", options->device,
                        "draws the table rendered: auto, reference, a part of a Vulkan device's name, or none")
        ->type_name("DEVICE")->capture_default_str();
    command->add_option("--scene", options->scene, "only this scene of the tables, such as sphere")->type_name("NAME");
    command->add_option("--csv", options->csv, "write all figures as CSV")->type_name("FILE");
    command->add_option("--against", options->against,
                        "compare with figures that --csv wrote; exit code 5 if one is worse")->type_name("FILE");
    command->add_flag("--list", options->list, "name the tables and stop");
    addExamples(*command, {"cotan accuracy --list",
                           "cotan accuracy --tables flat --frames cotangent,orthonormal --csv flat.csv"});
    return {command, [options] { return run(*options); }};
}

} // namespace cotan::app
