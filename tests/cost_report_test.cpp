// Tables, lists and prices of made-up GPUs: every number is distinct and must be under its name.
#include <gtest/gtest.h>

#include <sys/utsname.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cost/cards.hpp"
#include "cost/price.hpp"
#include "cost/scalar_count.hpp"
#include "cost/spirv_count.hpp"
#include "report/cost_tables.hpp"
#include "statistics.hpp"

namespace cotan::cost {
namespace {

StageCode codeOf(double instructions)
{
    StageCode code;
    code.instructions = instructions;
    code.arithmetic = instructions - 10;
    code.registers = instructions / 2;
    code.bytes = 4 * instructions;
    code.inverseThroughput = instructions / 8;
    code.latency = 3 * instructions;
    return code;
}

// A GPU whose rows have these instruction counts: floor, mikktspace, smooth-fused, cotangent-fused.
DeviceCode gpuOf(const std::string& maker, const std::string& family, std::array<double, 4> rows)
{
    DeviceCode gpu;
    gpu.name = "device of " + family;
    gpu.maker = maker;
    gpu.driver = "driver of " + family;
    gpu.family = family;
    gpu.date = "2026-11-24";
    const std::string_view names[] = {"floor", "mikktspace", "smooth-fused", "cotangent-fused"};
    for (std::size_t i = 0; i < 4; ++i)
        gpu.rows.push_back({rowFromName(names[i])->name, codeOf(rows[i])});
    double next = 200;
    for (const VertexStage& stage : vertexStages())
        gpu.vertices.push_back({stage.stored, codeOf(next += 8)});
    next = 400;
    for (const Stage& stage : otherStages())
        gpu.others.push_back({&stage, codeOf(next += 16)});
    return gpu;
}

CostReport madeUp()
{
    CostReport report;
    report.machine = "a machine";
    for (const std::string_view name : {"floor", "mikktspace", "smooth-fused", "cotangent-fused"})
        report.rows.push_back(rowFromName(name));
    report.code = {gpuOf("M", "one", {40, 56, 52, 88}), gpuOf("M", "two", {40, 64, 64, 104}),
                   gpuOf("N", "three", {48, 64, 80, 72})};
    report.code[1].rows[3].fragment = {};
    report.code[1].rows[3].fragment.failure = "it is too new";
    DeviceCode silent;
    silent.name = "mute";
    silent.silence = "it says nothing";
    report.code.push_back(silent);
    report.timingSilence = "nobody asked";
    return report;
}

// The cells of the `nth` row that starts with `first` in the table below a heading; empty if there is none.
std::vector<std::string> cellsOfRow(const std::string& text, const std::string& heading, const std::string& first,
                                    std::size_t nth = 0)
{
    const std::size_t at = text.find(heading);
    std::istringstream lines(at == std::string::npos ? "" : text.substr(text.find('\n', at)));
    for (std::string line; std::getline(lines, line) && !line.starts_with("#");) {
        std::vector<std::string> cells;
        std::istringstream stream(line);
        for (std::string cell; std::getline(stream, cell, '|');) {
            const std::size_t from = cell.find_first_not_of(' ');
            cells.push_back(from == std::string::npos ? "" : cell.substr(from, cell.find_last_not_of(' ') + 1 - from));
        }
        if (cells.size() > 2 && cells[1] == first && nth-- == 0)
            return {cells.begin() + 1, cells.end()};
    }
    return {};
}

using Cells = std::vector<std::string>;

TEST(CostReportText, formsAreCountedAgainstStoredTangents)
{
    const std::string text = toMarkdown(madeUp());
    const std::string heading = "### Against stored tangents";
    // smooth-fused: -4, 0, +16; cotangent-fused: +32, not compiled, +8.
    EXPECT_EQ(cellsOfRow(text, heading, "forward, instructions", 0),
              (Cells{"forward, instructions", "smooth-fused", "-4 to +16", "3", "1", "1", "three"}));
    EXPECT_EQ(cellsOfRow(text, heading, "forward, instructions", 1),
              (Cells{"forward, instructions", "cotangent-fused", "+8 to +32", "2", "0", "0", "one, three"}));
    EXPECT_EQ(cellsOfRow(text, heading, "forward, bound in cycles", 0),
              (Cells{"forward, bound in cycles", "smooth-fused", "-0.5 to +2", "3", "1", "1", "three"}));
    // Each resolve costs the same on all three GPUs.
    EXPECT_EQ(
        cellsOfRow(text, heading, "visibility buffer, instructions", 0),
        (Cells{"visibility buffer, instructions", "triangle-read", "+32 to +32", "3", "0", "0", "one, two, three"}));
    CostReport many = madeUp();
    for (int i = 0; i < 5; ++i)
        many.code.push_back(gpuOf("O", fmt::format("more {}", i), {40, 50, 60, 70}));
    EXPECT_EQ(cellsOfRow(toMarkdown(many), heading, "forward, instructions", 0).at(6),
              "three, more 0, more 1, more 2, more 3, more 4");
    many.code.push_back(gpuOf("O", "last", {40, 50, 60, 70}));
    EXPECT_EQ(cellsOfRow(toMarkdown(many), heading, "forward, instructions", 0).at(6), "7 GPUs");
    CostReport cheap = madeUp();
    cheap.code = {gpuOf("M", "one", {40, 56, 52, 88})};
    EXPECT_EQ(cellsOfRow(toMarkdown(cheap), heading, "forward, instructions", 0).at(6), "none");
}

TEST(CostReportText, rowsAreShownOverTheFloorOrInTotal)
{
    const std::string text = toMarkdown(madeUp());
    const std::string added = "### What perturbing the normal adds, in instructions";
    const Operations floor = operationsOfRow("floor"), smooth = operationsOfRow("smooth-fused");
    const auto spirv = [](const char* row) { return spirvInstructions(rowFromName(row)->fragment); };
    EXPECT_EQ(cellsOfRow(text, added, "floor"),
              (Cells{"floor", fmt::format("{}", floor.total()), fmt::format("{}", floor.totalFused()),
                     fmt::format("{}", spirv("floor")), "40", "40", "48", ""}));
    EXPECT_EQ(cellsOfRow(text, added, "smooth-fused"),
              (Cells{"smooth-fused", fmt::format("{:+}", smooth.total() - floor.total()),
                     fmt::format("{:+}", smooth.totalFused() - floor.totalFused()),
                     fmt::format("{:+}", spirv("smooth-fused") - spirv("floor")), "+12", "+24", "+32", ""}));
    EXPECT_EQ(cellsOfRow(text, added, "cotangent-fused").at(5), "-"); // not compiled
    EXPECT_EQ(cellsOfRow(text, "### The same in instructions that compute", "floor"),
              (Cells{"floor", "30", "30", "38"}));
    EXPECT_EQ(cellsOfRow(text, "### The same in instructions that compute", "mikktspace"),
              (Cells{"mikktspace", "+16", "+24", "+16"}));
    EXPECT_EQ(cellsOfRow(text, "### The same in bytes of code", "smooth-fused"),
              (Cells{"smooth-fused", "+48", "+96", "+128"}));
    EXPECT_EQ(cellsOfRow(text, "bound in cycles (inverse throughput), each", "smooth-fused"),
              (Cells{"smooth-fused", "6.5", "8", "10"}));
    EXPECT_EQ(cellsOfRow(text, "latency in cycles", "smooth-fused"), (Cells{"smooth-fused", "156", "192", "240"}));
    EXPECT_EQ(cellsOfRow(text, "registers per thread", "smooth-fused"), (Cells{"smooth-fused", "26", "32", "40"}));
    EXPECT_EQ(cellsOfRow(text, "### What stored tangents add", "no tangent"),
              (Cells{"no tangent", "0", "208", "208", "208"}));
    EXPECT_EQ(cellsOfRow(text, "### What stored tangents add", "tangent"), (Cells{"tangent", "+16", "+8", "+8", "+8"}));
    EXPECT_EQ(cellsOfRow(text, added, "over the floor"),
              (Cells{"over the floor", "scalar", "with fma", "SPIR-V", "M", "M", "N", "2006"}));
    EXPECT_EQ(cellsOfRow(text, added, ""), (Cells{"", "", "", "", "one", "two", "three", ""}));
}

TEST(CostReportText, namesTheQueriedDevicesAndWhatIsMissing)
{
    CostReport report = madeUp();
    const std::string text = toMarkdown(report, "chart.svg");
    EXPECT_EQ(text.find("Machine: a machine. SPIR-V: "), 0u);
    for (const std::string line :
         {"- one: device of one, driver of one, queried on 2026-11-24.\n",
          "- two: device of two, driver of two, queried on 2026-11-24.\n"
          "  - fragment cotangent-fused: not compiled: it is too new.\n",
          "- mute: no machine code: it says nothing.\n", "](chart.svg)\n", "No timing: nobody asked.\n"})
        EXPECT_NE(text.find(line), std::string::npos) << line;
    report.gpusRead = true;
    EXPECT_EQ(toMarkdown(report).find("SPIR-V: "), 0u);
    EXPECT_EQ(toMarkdown(report).find("chart.svg"), std::string::npos);
    report.timingSilence.clear();
    DeviceTiming timing;
    timing.name = "a device", timing.driver = "its driver", timing.cpu = true;
    timing.cases = usualCases();
    timing.cases.resize(2);
    timing.rows.push_back({"mikktspace", {200, 400}, {}, {}});
    timing.rows.push_back({"smooth-fused", {100, 600}, {}, {}});
    report.timing = {timing};
    const std::string timed = toMarkdown(report);
    EXPECT_EQ(timed.find("No timing"), std::string::npos);
    EXPECT_NE(timed.find("### a device: nanoseconds per million pixels, medians (renders on the CPU)\n\nits driver\n"),
              std::string::npos);
    EXPECT_EQ(cellsOfRow(timed, "### a device", "smooth-fused"), (Cells{"smooth-fused", "100", "0.50", "600", "1.50"}));
    EXPECT_EQ(cellsOfRow(timed, "### a device", "mikktspace"), (Cells{"mikktspace", "200", "1.00", "400", "1.00"}));
    report.timing[0].silence = "it has no clock";
    EXPECT_NE(toMarkdown(report).find("No timing on a device: it has no clock.\n"), std::string::npos);
}

TEST(CostReportText, jsonHasEachDeviceWithItsStages)
{
    CostReport report = madeUp();
    report.code[0].rows[0].fragment.all = {{"Instructions", 40}, {"VGPRs", 9}};
    const auto json = nlohmann::json::parse(toText(toJson(report)));
    EXPECT_EQ(json["command"], "cost");
    EXPECT_EQ(json["machine"], "a machine");
    ASSERT_EQ(json["rows"].size(), 4u);
    EXPECT_EQ(json["rows"][2]["name"], "smooth-fused");
    EXPECT_EQ(json["rows"][2]["what"], rowFromName("smooth-fused")->what);
    const Operations o = operationsOfRow("smooth-fused");
    const auto& scalar = json["rows"][2]["scalar"];
    const std::vector<std::pair<const char*, int>> counts = {
        {"mul", int(o.multiply)},      {"add", int(o.add)},
        {"div", int(o.divide)},        {"sqrt", int(o.root)},
        {"rsqrt", int(o.inverseRoot)}, {"max", int(o.maximum)},
        {"compare", int(o.compare)},   {"bits", int(o.bits)},
        {"total", int(o.total())},     {"total_fma", int(o.totalFused())}};
    for (const auto& [name, count] : counts)
        EXPECT_EQ(scalar[name], count) << name;
    ASSERT_EQ(json["devices"].size(), 4u);
    const auto& one = json["devices"][0];
    EXPECT_EQ(one["name"], "device of one");
    EXPECT_EQ(one["maker"], "M");
    EXPECT_EQ(one["driver"], "driver of one");
    EXPECT_EQ(one["family"], "one");
    EXPECT_EQ(one["date"], "2026-11-24");
    EXPECT_EQ(one["fragment"]["floor"]["VGPRs"], 9);
    EXPECT_EQ(json["devices"][1]["fragment"]["cotangent-fused"]["failure"], "it is too new");
    EXPECT_EQ(json["devices"][3]["silence"], "it says nothing");
}

// ---- statistics and prices ---------------------------------------------------------------------------

TEST(CostStatisticNames, eachIsParsedIntoItsField)
{
    using Field = std::optional<double> StageCode::*;
    const Field all[] = {&StageCode::instructions, &StageCode::arithmetic,        &StageCode::registers,
                         &StageCode::bytes,        &StageCode::inverseThroughput, &StageCode::latency};
    const std::vector<std::pair<const char*, Field>> names = {{"Instructions", &StageCode::instructions},
                                                              {"Instruction Count", &StageCode::instructions},
                                                              {"VGPRs", &StageCode::registers},
                                                              {"Register Count", &StageCode::registers},
                                                              {"Max live registers", &StageCode::registers},
                                                              {"Number of GPRs", &StageCode::registers},
                                                              {"Registers used", &StageCode::registers},
                                                              {"GPRs", &StageCode::registers},
                                                              {"Code size", &StageCode::bytes},
                                                              {"Code Size", &StageCode::bytes},
                                                              {"Binary Size", &StageCode::bytes},
                                                              {"Inverse Throughput", &StageCode::inverseThroughput},
                                                              {"Latency", &StageCode::latency},
                                                              {"Cycle Count", &StageCode::latency},
                                                              {"Static cycle count", &StageCode::latency}};
    for (const auto& [name, field] : names) {
        StageCode code;
        code.all = {{name, 7}};
        nameStatistics(code);
        for (const Field f : all)
            EXPECT_EQ((code.*f).has_value(), f == field) << name;
        EXPECT_EQ(code.*field, 7) << name;
    }
    StageCode code;
    code.all = {{"VALU", 5}, {"VMEM", 2}};
    nameStatistics(code);
    EXPECT_EQ(code.arithmetic, 5);
    code.all = {{"VALU", 5}}; // without its counterpart it may belong to another driver
    nameStatistics(code);
    EXPECT_FALSE(code.arithmetic);
    code.all = {{"Cycles", 5}};
    nameStatistics(code);
    EXPECT_FALSE(code.inverseThroughput);
    code.all = {{"ALU", 3}, {"FSCIB", 1}, {"IC", 9}};
    nameStatistics(code);
    EXPECT_EQ(code.inverseThroughput, 9);
}

TEST(CostPrice, ofAFileQueriesNoDriverAndKeepsTheBaselines)
{
    PriceOptions options;
    options.cards = gpusToCsv({gpuOf("M", "one", {40, 56, 52, 88})});
    options.frames = {"smooth-fused"};
    const auto report = price(options);
    ASSERT_TRUE(report) << report.error().message;
    std::vector<std::string_view> names;
    for (const Row* row : report->rows)
        names.push_back(row->name);
    EXPECT_EQ(names, (std::vector<std::string_view>{"floor", "mikktspace", "smooth-fused"}));
    EXPECT_TRUE(report->gpusRead);
    EXPECT_EQ(report->codeSilence, "");
    EXPECT_EQ(report->timingSilence, "the figures of these GPUs were read from a file");
    EXPECT_EQ(fragmentCode(report->code.at(0), "smooth-fused").instructions, 52);
    utsname name{};
    ASSERT_EQ(::uname(&name), 0);
    EXPECT_TRUE(report->machine.ends_with(std::string(", ") + name.machine)) << report->machine;
    EXPECT_EQ(report->machine.find('"'), std::string::npos);
    options.frames = {"smooth-fused", "no-such"};
    const auto unknown = price(options);
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().kind, ErrorKind::usage);
    EXPECT_EQ(unknown.error().message.find("options.frames: expected one of floor, mikktspace, "), 0u);
    EXPECT_TRUE(unknown.error().message.ends_with("; found 'no-such'"));
    options.frames = {};
    options.cards = "nonsense";
    const auto broken = price(options);
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().kind, ErrorKind::input);
    EXPECT_EQ(broken.error().message.find("options.cards: line 1: "), 0u);
}

TEST(CostPrice, queriesOnlyTheNamedGpusAndDevices)
{
    PriceOptions options;
    options.program = COTAN_LAB;
    options.frames = {"smooth-fused"};
    options.families = {"no such card"};
    const auto gpus = price(options); // excludes this machine's devices: they are neither queried nor timed
    ASSERT_TRUE(gpus) << gpus.error().message;
    ASSERT_EQ(gpus->code.size(), 1u);
    EXPECT_EQ(gpus->code[0].family, "no such card");
    EXPECT_NE(gpus->code[0].silence, "");
    EXPECT_TRUE(gpus->timing.empty());
    EXPECT_EQ(gpus->timingSilence, "");
    options.timing = false;
    options.families.push_back("nor this");
    const auto two = price(options);
    ASSERT_TRUE(two) << two.error().message;
    ASSERT_EQ(two->code.size(), 2u);
    EXPECT_EQ(two->code[1].family, "nor this");
    EXPECT_EQ(two->timingSilence, "--no-timing was given");
    options.name = "Card";
    const auto named = price(options);
    ASSERT_TRUE(named) << named.error().message;
    EXPECT_EQ(named->code.at(0).family, "no such card");
    if (!machineCodeOfDevices({}, {}, COTAN_LAB))
        GTEST_SKIP() << "Vulkan cannot be used here";
    for (const bool withGpus : {false, true}) {
        options = {};
        options.program = COTAN_LAB;
        options.frames = {"smooth-fused"};
        options.devices = {"no such device", "nor this"};
        if (withGpus)
            options.families = {"no such card"};
        const auto none = price(options);
        ASSERT_TRUE(none) << none.error().message; // operations are counted anyway
        EXPECT_EQ(none->rows.size(), 3u);
        EXPECT_TRUE(none->code.empty());
        EXPECT_EQ(none->codeSilence,
                  "no Vulkan device has 'no such device' or 'nor this' in its name; operations and "
                  "SPIR-V were counted");
    }
}

// Bytes follow from what is stored: floats and indices of 4 bytes.
TEST(CostStages, bytesAreThoseReadAndStored)
{
    EXPECT_EQ(vertexStage(Stored::tangent).bytes, 4 * 4);
    EXPECT_EQ(vertexStage(Stored::cotangents).bytes, 2 * 3 * 4);
    for (const auto stored : {Stored::nothing, Stored::triangle, Stored::triangleHalfs})
        EXPECT_EQ(vertexStage(stored).bytes, 0);
    for (const VertexStage& stage : vertexStages())
        EXPECT_EQ(&vertexStage(stage.stored), &stage);
    EXPECT_EQ(rowFromName("exact")->bytesPerPixel, 3 * (4 + 3 * 4 + 2 * 4));
    EXPECT_EQ(rowFromName("triangle-read")->bytesPerPixel, 6 * 2);
    EXPECT_EQ(rowFromName("no-such"), nullptr);
    const auto stageOf = [](StageKind kind, std::string_view name) {
        for (const Stage& stage : otherStages())
            if (stage.kind == kind && stage.name == name)
                return stage;
        ADD_FAILURE() << name;
        return otherStages()[0];
    };
    const int vertex = 3 * 4 + 3 * 4 + 2 * 4, floor = 4 + 3 * 4 + 3 * vertex; // triangle, indices, vertices
    EXPECT_EQ(stageOf(StageKind::resolve, "floor").perPixel, floor);
    EXPECT_EQ(stageOf(StageKind::resolve, "mikktspace").perPixel, floor + 3 * 4 * 4);
    EXPECT_EQ(stageOf(StageKind::resolve, "smooth-fused").perPixel, floor + 3 * 6 * 4);
    EXPECT_EQ(stageOf(StageKind::resolve, "triangle-read").perPixel, floor + 6 * 2);
    EXPECT_EQ(stageOf(StageKind::mesh, "triangle, six floats").perTriangle, 6 * 4);
    EXPECT_EQ(stageOf(StageKind::mesh, "triangle, six halfs").perTriangle, 6 * 2);
    EXPECT_EQ(stageOf(StageKind::pass, "triangle, six halfs").perTriangle, 3 * 4 + vertex / 2 + 6 * 2);
}

TEST(CostCsv, hasPlainAndFusedOperationsOfEachRow)
{
    const std::string csv = toCsv(madeUp());
    for (const Row* row : madeUp().rows) {
        const Operations counted = operationsOfRow(row->name);
        const std::string lines = fmt::format("\n{0},scalar,,,total,{1}\n{0},scalar,,,total with fma,{2}\n", row->name,
                                              counted.total(), counted.totalFused());
        EXPECT_NE(csv.find(lines), std::string::npos) << lines;
        EXPECT_LT(counted.totalFused(), counted.total()) << row->name;
    }
}

} // namespace
} // namespace cotan::cost
