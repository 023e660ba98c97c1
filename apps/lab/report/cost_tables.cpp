#include "report/cost_tables.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cost/scalar_count.hpp"
#include "cost/spirv_count.hpp"
#include "cost_markdown.hpp"
#include "files/bytes.hpp"
#include "files/output.hpp"

namespace cotan {

using namespace cost;

std::string aligned(const Table& table)
{
    std::vector<std::size_t> widths(table.front().size(), 3);
    for (const auto& line : table)
        for (std::size_t i = 0; i < line.size(); ++i)
            widths[i] = std::max(widths[i], line[i].size());
    std::string text;
    for (std::size_t n = 0; n < table.size(); ++n) {
        for (std::size_t i = 0; i < widths.size(); ++i)
            text += i == 0 ? fmt::format("| {:<{}} |", table[n][i], widths[i])
                           : fmt::format(" {:>{}} |", table[n][i], widths[i]);
        text += '\n';
        for (std::size_t i = 0; n == 0 && i < widths.size(); ++i)
            text += i == 0 ? "| " + std::string(widths[i], '-') + " |" : " " + std::string(widths[i] - 1, '-') + ": |";
        if (n == 0)
            text += '\n';
    }
    return text + '\n';
}

std::string title(const DeviceCode& d) { return d.family.empty() ? d.name : d.family; }

std::vector<const DeviceCode*> devicesWith(const CostReport& report, Measure measure)
{
    std::vector<const DeviceCode*> list;
    for (const DeviceCode& d : report.code)
        if (d.silence.empty() && fragmentCode(d, "floor").*measure)
            list.push_back(&d);
    return list;
}

Table tableOf(std::vector<std::string> header, const std::vector<const DeviceCode*>& devices)
{
    std::vector<std::string> cards(header.size());
    for (const DeviceCode* d : devices) {
        header.push_back(d->maker);
        cards.push_back(title(*d));
    }
    return {std::move(header), std::move(cards)};
}

namespace {

// Some drivers report less than one cycle per pixel.
std::string plain(std::optional<double> value)
{
    return !value ? "-" : *value < 100 ? fmt::format("{:.4g}", *value) : fmt::format("{:.0f}", *value);
}

// Formats the floor as it is, and other rows as the difference to the floor.
std::string over(std::optional<double> value, std::optional<double> floor, bool isFloor)
{
    if (!value || !floor)
        return "-";
    return isFloor ? plain(value) : fmt::format("{:+.0f}", *value - *floor);
}

std::string overview(const CostReport& report)
{
    const auto devices = devicesWith(report, &StageCode::instructions);
    Table table = tableOf({"over the floor", "scalar", "with fma", "SPIR-V"}, devices);
    table[0].emplace_back("2006");
    table[1].emplace_back();
    const Row& floor = *report.rows.front();
    const Operations floorOps = operationsOfRow(floor.name);
    for (std::size_t i = 0; i < report.rows.size(); ++i) {
        const Row& row = *report.rows[i];
        const Operations ops = operationsOfRow(row.name);
        std::vector<std::string> line = {
            std::string(row.name), over(ops.total(), floorOps.total(), i == 0),
            over(ops.totalFused(), floorOps.totalFused(), i == 0),
            over(spirvInstructions(row.fragment), spirvInstructions(floor.fragment), i == 0)};
        for (const DeviceCode* d : devices)
            line.push_back(
                over(fragmentCode(*d, row.name).instructions, fragmentCode(*d, floor.name).instructions, i == 0));
        line.push_back(row.instructionsOf2006 ? std::to_string(row.instructionsOf2006) : "");
        table.push_back(std::move(line));
    }
    return "### What perturbing the normal adds, in instructions\n\n" + aligned(table);
}

// A table of one measure by device, for whole shaders or relative to the floor. Empty if no driver reports it.
std::string fragmentsBy(const CostReport& report, const std::string& heading, Measure measure, bool overFloor)
{
    const auto devices = devicesWith(report, measure);
    if (devices.empty())
        return "";
    Table table = tableOf({overFloor ? "over the floor" : "fragment shader"}, devices);
    for (const Row* row : report.rows) {
        std::vector<std::string> line = {std::string(row->name)};
        for (const DeviceCode* d : devices)
            line.push_back(over(fragmentCode(*d, row->name).*measure, fragmentCode(*d, "floor").*measure,
                                !overFloor || row == report.rows.front()));
        table.push_back(std::move(line));
    }
    return "### " + heading + "\n\n" + aligned(table);
}

std::string otherBounds(const CostReport& report)
{
    const auto devices = devicesWith(report, &StageCode::inverseThroughput);
    if (devices.empty())
        return "";
    Table table = tableOf({"stage"}, devices);
    const auto add = [&](const std::string& name, const auto& codeOf) {
        table.push_back({name});
        for (const DeviceCode* d : devices)
            table.back().push_back(plain(codeOf(*d).inverseThroughput));
    };
    for (const VertexStage& v : cost::vertexStages())
        add(fmt::format("vertex: {}", v.name), [&](const DeviceCode& d) { return vertexCode(d, v.stored); });
    for (const Stage& s : otherStages())
        add(fmt::format("{}: {}", kindName(s.kind), s.name), [&](const DeviceCode& d) { return otherCode(d, s); });
    return "### Whole other stages, bound in cycles (inverse throughput)\n\n" + aligned(table);
}

std::string vertexStages(const CostReport& report)
{
    const auto devices = devicesWith(report, &StageCode::instructions);
    Table table = tableOf({"vertex stage", "bytes per vertex"}, devices);
    for (const VertexStage& v : cost::vertexStages()) {
        std::vector<std::string> line = {std::string(v.name), v.bytes ? fmt::format("{:+}", v.bytes) : "0"};
        for (const DeviceCode* d : devices)
            line.push_back(over(vertexCode(*d, v.stored).instructions, vertexCode(*d, Stored::nothing).instructions,
                                v.stored == Stored::nothing));
        table.push_back(std::move(line));
    }
    return "### What stored tangents add at every vertex, in instructions\n\n" + aligned(table);
}

// Stages are shown relative to the first of their kind, passes as a whole.
std::string otherStagesOf(StageKind kind, const CostReport& report)
{
    auto devices = devicesWith(report, &StageCode::instructions);
    const bool mesh = kind == StageKind::mesh, pass = kind == StageKind::pass;
    const Stage& first = *std::ranges::find(otherStages(), kind, &Stage::kind);
    if (mesh) // few devices have this stage
        std::erase_if(devices, [&](const DeviceCode* d) { return !otherCode(*d, first).instructions; });
    Table table = tableOf(
        mesh || pass
            ? std::vector<std::string>{std::string(kindName(kind)), "bytes per vertex", "per triangle", "SPIR-V"}
            : std::vector<std::string>{std::string(kindName(kind)),
                                       kind == StageKind::beyond ? "texels" : "bytes read per pixel", "SPIR-V"},
        devices);
    for (const Stage& s : otherStages()) {
        if (s.kind != kind)
            continue;
        const bool whole = pass || &s == &first;
        std::vector<std::string> line = {std::string(s.name)};
        for (const int bytes : mesh || pass ? std::vector{s.perVertex, s.perTriangle} : std::vector{s.perPixel})
            line.push_back(std::to_string(bytes));
        line.push_back(over(spirvInstructions(s.words), spirvInstructions(first.words), whole));
        for (const DeviceCode* d : devices)
            line.push_back(over(otherCode(*d, s).instructions, otherCode(*d, first).instructions, whole));
        table.push_back(std::move(line));
    }
    return aligned(table);
}

std::string stagesBesides(const CostReport& report)
{
    return "### What the mesh stage adds, in instructions\n\n" + otherStagesOf(StageKind::mesh, report)
        + "### Passes that derive frames from positions, in instructions; loops counted once\n\n"
        + otherStagesOf(StageKind::pass, report)
        + "### What a frame adds where a visibility buffer is resolved, in instructions\n\n"
        + otherStagesOf(StageKind::resolve, report)
        + "### What antialiasing and parallax add to the frame `gradient`, in instructions; loops counted once\n\n"
        + otherStagesOf(StageKind::beyond, report);
}

std::string frameOperations()
{
    Table table = {
        {"frame alone, n unit", "mul", "add", "div", "sqrt", "rsqrt", "max", "compare", "bits", "total", "with fma"}};
    const auto line = [&](std::string_view name, const Operations& o) {
        table.push_back({std::string(name), std::to_string(o.multiply), std::to_string(o.add), std::to_string(o.divide),
                         std::to_string(o.root), std::to_string(o.inverseRoot), std::to_string(o.maximum),
                         std::to_string(o.compare), std::to_string(o.bits), std::to_string(o.total()),
                         std::to_string(o.totalFused())});
    };
    for (const FrameInfo& f : frames())
        if (!readsVertices(f.frame) && !readsTriangleVectors(f.frame))
            line(f.name, operationsOfFrame(f.name));
    line("(their safe normal)", operationsOfSafeNormal());
    line("(U and V, sound edges)", operationsOfTriangleVectors(false));
    line("(U and V, any edges)", operationsOfTriangleVectors(true));
    return "### Scalar operations of building a frame\n\n" + aligned(table);
}

std::string timings(const DeviceTiming& d)
{
    std::string text = fmt::format("### {}: nanoseconds per million pixels, medians{}\n\n{}\n\n", d.name,
                                   d.cpu ? " (renders on the CPU)" : "", d.driver);
    Table table = {{"legs of the triangles"}};
    for (const TimingCase& c : d.cases) {
        table[0].push_back(fmt::format("{} px", c.leg));
        table[0].push_back("ratio");
    }
    const auto base =
        std::find_if(d.rows.begin(), d.rows.end(), [](const TimedRow& r) { return r.row == "mikktspace"; });
    for (const TimedRow& r : d.rows) {
        std::vector<std::string> line = {std::string(r.row)};
        for (std::size_t i = 0; i < d.cases.size(); ++i) {
            const double t = r.nanosecondsPerMillionPixels[i];
            line.push_back(fmt::format("{:.0f}", t));
            line.push_back(base == d.rows.end() ? "-"
                                                : fmt::format("{:.2f}", t / base->nanosecondsPerMillionPixels[i]));
        }
        table.push_back(std::move(line));
    }
    for (const SkippedCase& s : d.skipped)
        text += fmt::format("Left out, legs of {} px: {}.\n\n", s.what.leg, s.why);
    return text + "Ratio: to `mikktspace` in the same run.\n\n" + aligned(table);
}

Json stageJson(const StageCode& code)
{
    Json all = Json::object();
    if (!code.failure.empty())
        all["failure"] = code.failure;
    for (const auto& [name, value] : code.all)
        all[name] = value;
    return all;
}

Json operationsJson(const Operations& o)
{
    return {{"mul", o.multiply}, {"add", o.add},           {"merged", o.merged},         {"div", o.divide},
            {"sqrt", o.root},    {"rsqrt", o.inverseRoot}, {"max", o.maximum},           {"compare", o.compare},
            {"bits", o.bits},    {"total", o.total()},     {"total_fma", o.totalFused()}};
}

} // namespace

namespace {

// Describes the device and the stages it did not compile.
std::string askedOf(const DeviceCode& d)
{
    const std::string date = d.date.empty() ? "" : ", queried on " + d.date;
    std::string text = d.silence.empty() ? fmt::format("- {}: {}, {}{}.\n", title(d), d.name, d.driver, date)
                                         : fmt::format("- {}: no machine code: {}.\n", title(d), d.silence);
    eachStage(d, [&](std::string_view kind, std::string_view name, const StageCode& code) {
        if (d.silence.empty() && !code.failure.empty())
            text += fmt::format("  - {} {}: not compiled: {}.\n", kind, name, code.failure);
    });
    return text;
}

} // namespace

std::string toMarkdown(const CostReport& report, const std::string& chart)
{
    std::string text = report.gpusRead ? "" : fmt::format("Machine: {}. ", report.machine);
    text += fmt::format("SPIR-V: {}.\n\n", spirvCompiler());
    for (const DeviceCode& d : report.code)
        text += askedOf(d);
    text += '\n' + againstStored(report) + overview(report);
    const auto devices = devicesWith(report, &StageCode::instructions);
    text += fragmentsBy(report, "The same in instructions that compute, where drivers distinguish them",
                        &StageCode::arithmetic, true);
    text += fragmentsBy(report, "Whole fragment shaders, bound in cycles (inverse throughput), each driver's unit",
                        &StageCode::inverseThroughput, false);
    text += fragmentsBy(report, "Whole fragment shaders, latency in cycles, each driver's estimate",
                        &StageCode::latency, false);
    text += fragmentsBy(report, "The same in bytes of code", &StageCode::bytes, true);
    text += fragmentsBy(report, "Whole fragment shaders, registers per thread", &StageCode::registers, false);
    if (!devices.empty())
        text += vertexStages(report) + breakEven(report);
    if (!chart.empty())
        text += fmt::format("![Cost of a triangle against `mikktspace`, by the pixels it covers]({})\n\n", chart);
    text += stagesBesides(report) + otherBounds(report) + frameOperations();
    if (!report.timingSilence.empty())
        text += "No timing: " + report.timingSilence + ".\n\n";
    for (const DeviceTiming& d : report.timing)
        text += d.silence.empty() ? timings(d) : fmt::format("No timing on {}: {}.\n\n", d.name, d.silence);
    text.pop_back();
    return text;
}

Json toJson(const CostReport& report)
{
    Json json = {{"command", "cost"}, {"machine", report.machine}, {"spirv_compiler", spirvCompiler()}};
    for (const Row* row : report.rows) {
        Json r = {{"name", row->name},
                  {"what", row->what},
                  {"scalar", operationsJson(operationsOfRow(row->name))},
                  {"spirv", spirvInstructions(row->fragment)}};
        if (row->instructionsOf2006)
            r["instructions_2006"] = row->instructionsOf2006;
        json["rows"].push_back(std::move(r));
    }
    json["devices"] = Json::array();
    for (const DeviceCode& d : report.code) {
        Json device = {{"name", d.name},     {"maker", d.maker},     {"driver", d.driver},
                       {"family", d.family}, {"silence", d.silence}, {"date", d.date}};
        eachStage(d, [&](std::string_view kind, std::string_view name, const StageCode& code) {
            device[std::string(kind)][std::string(name)] = stageJson(code);
        });
        json["devices"].push_back(std::move(device));
    }
    json["timing"] = Json::array();
    for (const DeviceTiming& d : report.timing) {
        Json device = {{"name", d.name}, {"driver", d.driver}, {"cpu", d.cpu}, {"silence", d.silence}};
        device["legs"] = Json::array();
        for (const TimingCase& c : d.cases)
            device["legs"].push_back(c.leg);
        for (const TimedRow& r : d.rows) {
            device["nanoseconds_per_million_pixels"][std::string(r.row)] = r.nanosecondsPerMillionPixels;
            device["vertices"][std::string(r.row)] = r.vertices;
        }
        json["timing"].push_back(std::move(device));
    }
    return json;
}

std::string toCsv(const CostReport& report)
{
    const auto quoted = [](std::string_view s) { return '"' + std::string(s) + '"'; };
    std::string text = "row,source,device,driver,measure,value\n";
    for (const Row* row : report.rows) {
        const Operations o = operationsOfRow(row->name);
        text += fmt::format("{},scalar,,,total,{}\n{},scalar,,,total with fma,{}\n", row->name, o.total(), row->name,
                            o.totalFused());
        text += fmt::format("{},SPIR-V,,{},instructions,{}\n", row->name, quoted(spirvCompiler()),
                            spirvInstructions(row->fragment));
    }
    for (const Stage& s : otherStages())
        text += fmt::format("{},SPIR-V {},,{},instructions,{}\n", quoted(s.name), kindName(s.kind),
                            quoted(spirvCompiler()), spirvInstructions(s.words));
    for (const DeviceCode& d : report.code) {
        eachStage(d, [&](std::string_view kind, std::string_view name, const StageCode& code) {
            const std::string cell = kind == "fragment" ? std::string(name) : quoted(name);
            for (const auto& [measure, value] : code.all)
                text += fmt::format("{},{},{},{},{},{:.0f}\n", cell, kind, quoted(title(d)), quoted(d.driver),
                                    quoted(measure), value);
        });
    }
    for (const DeviceTiming& d : report.timing)
        for (const TimedRow& r : d.rows)
            for (std::size_t i = 0; i < r.nanosecondsPerMillionPixels.size(); ++i)
                text += fmt::format("{},timing,{},{},ns per million pixels with legs of {} px,{:.0f}\n", r.row,
                                    quoted(d.name), quoted(d.driver), d.cases[i].leg, r.nanosecondsPerMillionPixels[i]);
    return text;
}

Status writeTables(const std::filesystem::path& file, const std::string& tables)
{
    const auto old = readText(file, /*isInput*/ false);
    const std::string text = old ? *old : "";
    const std::string first = "<!-- cotan cost: from here to the end mark written by the tool -->\n",
                      last = "<!-- cotan cost: end -->\n";
    const std::size_t begin = text.find(first), end = text.find(last);
    if (begin == std::string::npos || end == std::string::npos || end < begin)
        return writeFileWhole(file, tables);
    return writeFileWhole(file, text.substr(0, begin) + first + '\n' + tables + '\n' + text.substr(end));
}

} // namespace cotan
