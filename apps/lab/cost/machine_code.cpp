#include "cost/machine_code.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>

#include "compile.hpp"
#include "core/parse_number.hpp"
#include "files/sandbox/confine.hpp"
#include "files/system/program.hpp"
#include "files/system/system.hpp"
#include "in_child.hpp"
#include "statistics.hpp"

namespace cotan::cost {

namespace {

constexpr int kSeconds = 300;  // timeout for one stage; emulated drivers are slow
constexpr int kMaxCrashes = 5; // maximum crashes before a device is given up

// Splits a line of the child-to-parent protocol: a keyword and its values, separated by tabs.
std::vector<std::string> cells(std::string_view line)
{
    std::vector<std::string> list(1);
    for (const char c : line)
        if (c == '\t')
            list.emplace_back();
        else
            list.back() += c;
    return list;
}

std::string joined(std::initializer_list<std::string_view> words)
{
    std::string line;
    for (const std::string_view word : words)
        (line += line.empty() ? "" : "\t") += word;
    return line;
}

std::string digits(double value)
{
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

double value(const std::string& text)
{
    double number = 0;
    fromChars(text.data(), text.data() + text.size(), number);
    return number;
}

std::string today()
{
    const std::time_t now = std::time(nullptr);
    char text[16];
    return {text, std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now))};
}

// ---- in the child ---------------------------------------------------------------------------

using LineWriter = std::function<void(const std::string&)>;

void writeDevices(const LineWriter& write)
{
    try {
        const Instance instance = openInstance();
        for (const Device& d : listDevices(instance)) {
            const char* silence = !d.compiles ? "has no graphics queue"
                : !d.reports                  ? "the driver does not offer VK_KHR_pipeline_executable_properties"
                                              : "";
            write(joined({"device", d.name, d.maker, d.driver, d.radv ? "radv" : "", silence}));
        }
    } catch (const std::exception& e) {
        write(joined({"silence", reason(e)}));
    }
}

void writeStages(std::size_t device, const std::vector<const Row*>& rows, std::size_t from, const LineWriter& write)
{
    try {
        const Instance instance = openInstance();
        Device d = std::move(listDevices(instance).at(device));
        open(d);
        const Layout layout = makeLayout(d);
        for (std::size_t k = from; k < stageCount(rows); ++k) {
            write(joined({"stage", std::to_string(k)}));
            try {
                for (const auto& [name, number] : compileStage(d, layout, rows, k).all)
                    write(joined({"value", name, digits(number)}));
            } catch (const std::exception& e) {
                write(joined({"failure", reason(e)}));
            }
        }
    } catch (const std::exception& e) {
        write(joined({"silence", reason(e)}));
    }
}

// ---- in the parent --------------------------------------------------------------------------

struct Listed {
    DeviceCode code; // not compiled yet
    bool radv = false;
};

// The program that becomes a child, and the variables that its drivers read.
ChildProgram childProgram(const std::filesystem::path& program)
{
    return {program.empty() ? sameProgram() : program,
            {std::string(kChildWord), std::to_string(thisProcess())},
            // Mesa reports no statistics for a shader that comes from its cache.
            {{"MESA_SHADER_CACHE_DISABLE", "true"}},
            /*confined*/ false};
}

// Errors: why Vulkan cannot be used; "crashed" if a driver crashes while devices are listed.
Result<std::vector<Listed>> listInChild(const ChildProgram& program)
{
    std::vector<Listed> list;
    std::string silence;
    const std::string end = inChild(kSeconds, program, [&](std::string_view line) {
        std::vector<std::string> c = cells(line);
        c.resize(6);
        if (c[0] == "silence")
            silence = c[1];
        else
            list.push_back({{c[1], c[2], c[3], "", c[5], today(), {}, {}, {}}, c[4] == "radv"});
    });
    if (!end.empty())
        return unavailableError("a driver " + end + " while listing its devices");
    if (!silence.empty())
        return unavailableError(silence);
    return list;
}

// Compiles all stages of the device, starting a new child after each crash.
void compileAll(DeviceCode& code, std::size_t device, const std::vector<const Row*>& rows, const ChildProgram& program)
{
    prepareStages(code, rows);
    std::size_t next = 0; // the first stage that was not started
    for (int crashes = 0; next < stageCount(rows);) {
        const std::size_t from = next;
        ChildProgram child = program;
        child.arguments.insert(child.arguments.end(), {std::to_string(device), std::to_string(from)});
        for (const Row* row : rows)
            child.arguments.emplace_back(row->name);
        const std::string end = inChild(kSeconds, child, [&](std::string_view line) {
            std::vector<std::string> c = cells(line);
            c.resize(3);
            if (c[0] == "stage")
                ++next;
            else if (c[0] == "silence")
                code.silence = c[1];
            else if (next > 0 && c[0] == "failure")
                stageAt(code, next - 1).failure = c[1];
            else if (next > 0 && c[0] == "value")
                stageAt(code, next - 1).all.emplace_back(c[1], value(c[2]));
        });
        if (end.empty())
            break;
        if (next == from) {
            code.silence = "the driver " + end + " before compiling";
            break;
        }
        StageCode& lost = stageAt(code, next - 1);
        lost.all.clear();
        lost.failure = "the driver " + end;
        if (++crashes == kMaxCrashes)
            for (; next < stageCount(rows); ++next)
                stageAt(code, next).failure = "skipped, the driver crashed too often";
    }
    bool any = false;
    for (std::size_t k = 0; k < stageCount(rows); ++k) {
        nameStatistics(stageAt(code, k));
        any = any || !stageAt(code, k).all.empty();
    }
    if (code.silence.empty() && !any)
        code.silence = code.rows.front().fragment.failure.empty()
            ? "the driver offers the extension but reports nothing"
            : "nothing could be compiled: " + code.rows.front().fragment.failure;
}

} // namespace

const std::vector<std::string>& usualFamilies()
{
    static const std::vector<std::string> list = {"POLARIS10", "VEGA10", "NAVI21", "GFX1100"};
    return list;
}

Result<std::vector<DeviceCode>> machineCodeOfDevices(const std::vector<const Row*>& rows,
                                                     const std::vector<std::string>& devices,
                                                     const std::filesystem::path& program)
{
    const ChildProgram child = childProgram(program);
    auto listed = listInChild(child);
    if (!listed)
        return unavailableError("Vulkan cannot be used: " + listed.error().message);
    std::vector<DeviceCode> result;
    for (std::size_t i = 0; i < listed->size(); ++i) {
        DeviceCode& code = (*listed)[i].code;
        if (!wanted(code.name, devices))
            continue;
        if (code.silence.empty())
            compileAll(code, i, rows, child);
        result.push_back(std::move(code));
    }
    return result;
}

DeviceCode machineCodeOfFamily(const std::vector<const Row*>& rows, const std::string& family,
                               const std::filesystem::path& program)
{
    ChildProgram child = childProgram(program);
    child.environment["RADV_FORCE_FAMILY"] = family;
    DeviceCode result;
    auto listed = listInChild(child);
    if (!listed) {
        // Before Mesa 26 the driver aborts if it does not know the family.
        result.silence = listed.error().message + ": does Mesa's Radeon driver know this family?";
    } else if (const auto radv = std::ranges::find_if(*listed, &Listed::radv); radv == listed->end()) {
        result.silence =
            "Mesa's Radeon driver is not available: it is not installed, or it is of Mesa 26 or later, which needs the "
            "GPU for a family; Mesa's null devices do not (bench/cards uses them)";
    } else {
        result = std::move(radv->code);
        if (result.silence.empty())
            compileAll(result, std::size_t(radv - listed->begin()), rows, child);
    }
    result.family = family;
    return result;
}

std::optional<int> runChild(std::span<const std::string> words)
{
    if (words.empty() || words[0] != kChildWord)
        return std::nullopt;
    const auto parent = ParentConnection::take();
    if (!parent || words.size() < 2) {
        std::fputs((words[0] + " is internal: another process starts it\n").c_str(), stderr);
        return 1;
    }
    leaveNoCore();
    dieWith(std::atoll(words[1].c_str()));
    const LineWriter write = [&](std::string line) {
        std::ranges::replace(line, '\n', ' ');
        line += '\n';
        if (!parent->send(std::as_bytes(std::span(line))))
            std::_Exit(1);
    };
    if (words.size() < 4) {
        writeDevices(write);
        return 0;
    }
    std::vector<const Row*> rows;
    for (const std::string& name : words.subspan(4))
        if (const Row* row = rowFromName(name))
            rows.push_back(row);
    writeStages(std::size_t(std::atoll(words[2].c_str())), rows, std::size_t(std::atoll(words[3].c_str())), write);
    return 0;
}

const StageCode& fragmentCode(const DeviceCode& device, std::string_view row)
{
    static const StageCode none;
    const auto found = std::ranges::find(device.rows, row, &RowCode::row);
    return found == device.rows.end() ? none : found->fragment;
}

const StageCode& vertexCode(const DeviceCode& device, Stored stored)
{
    static const StageCode none;
    const auto found = std::ranges::find(device.vertices, stored, &VertexCode::stored);
    return found == device.vertices.end() ? none : found->vertex;
}

const StageCode& otherCode(const DeviceCode& device, const Stage& stage)
{
    static const StageCode none;
    const auto found = std::ranges::find(device.others, &stage, &OtherCode::stage);
    return found == device.others.end() ? none : found->code;
}

const StageCode& resolveCode(const DeviceCode& device, std::string_view name)
{
    const auto is = [&](const Stage& s) { return s.kind == StageKind::resolve && s.name == name; };
    return otherCode(device, *std::ranges::find_if(otherStages(), is));
}

} // namespace cotan::cost
