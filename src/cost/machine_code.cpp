#include "cotan/cost/machine_code.hpp"

#include <cstdlib>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "pipeline.hpp"

namespace cotan::cost {

namespace {

// Sets an environment variable while it lives.
class Environment {
public:
    Environment(const char* name, const std::string& value) : name_(name)
    {
        if (const char* old = std::getenv(name))
            old_ = old;
        ::setenv(name, value.c_str(), 1);
    }
    ~Environment()
    {
        if (old_)
            ::setenv(name_, old_->c_str(), 1);
        else
            ::unsetenv(name_);
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    const char* name_;
    std::optional<std::string> old_;
};

double number(const vk::PipelineExecutableStatisticKHR& s)
{
    using F = vk::PipelineExecutableStatisticFormatKHR;
    switch (s.format) {
    case F::eBool32: return s.value.b32 ? 1 : 0;
    case F::eInt64: return double(s.value.i64);
    case F::eUint64: return double(s.value.u64);
    case F::eFloat64: return s.value.f64;
    }
    return 0;
}

StageCode readStage(const Device& device, const vk::raii::Pipeline& pipeline, vk::ShaderStageFlagBits stage)
{
    StageCode code;
    const auto executables = device.device.getPipelineExecutablePropertiesKHR(vk::PipelineInfoKHR(*pipeline));
    for (std::uint32_t i = 0; i < executables.size(); ++i) {
        if (!(executables[i].stages & stage))
            continue;
        for (const auto& s : device.device.getPipelineExecutableStatisticsKHR({*pipeline, i}))
            code.all.emplace_back(s.name.data(), number(s));
        break; // some drivers compile a stage for several widths; the first is named first
    }
    const auto find = [&](std::initializer_list<std::string_view> names) -> std::optional<double> {
        for (const std::string_view name : names)
            for (const auto& [reported, value] : code.all)
                if (reported == name)
                    return value;
        return std::nullopt;
    };
    // Mesa's Radeon; Mesa's Intel and others; NVIDIA.
    code.instructions = find({"Instructions", "Instruction Count"});
    code.registers = find({"VGPRs", "Register Count", "Max live registers"});
    code.bytes = find({"Code size", "Code Size", "Binary Size"});
    code.inverseThroughput = find({"Inverse Throughput"});
    code.latency = find({"Latency", "Cycle Count"});
    return code;
}

void compileAll(Device& device, const std::vector<const Row*>& rows, DeviceCode& result)
{
    if (!device.missing.empty()) {
        result.silence = device.missing;
        return;
    }
    if (!device.reports) {
        result.silence = "the driver does not offer VK_KHR_pipeline_executable_properties";
        return;
    }
    open(device);
    const Layout layout = makeLayout(device);
    for (const Row* row : rows) {
        const auto pipeline =
            makePipeline(device, layout, row->stored, vertexStage(row->stored).vertex, row->fragment, true);
        result.rows.push_back({row->name, readStage(device, pipeline, vk::ShaderStageFlagBits::eFragment)});
    }
    for (const VertexStage& v : vertexStages()) {
        const auto pipeline = makePipeline(device, layout, v.stored, v.vertex, v.consumer, true);
        result.vertices.push_back({v.stored, readStage(device, pipeline, vk::ShaderStageFlagBits::eVertex)});
    }
    for (const Stage& s : otherStages()) {
        using F = vk::ShaderStageFlagBits;
        result.others.push_back({&s, {}});
        if (s.kind != StageKind::mesh)
            result.others.back().code = readStage(device, makePassPipeline(device, layout, s.words), F::eCompute);
        else if (device.meshShaders)
            result.others.back().code =
                readStage(device, makeMeshPipeline(device, layout, s.words, s.consumer), F::eMeshEXT);
    }
    if (!result.rows.empty() && result.rows.front().fragment.all.empty())
        result.silence = "the driver offers the extension but reports nothing";
}

DeviceCode machineCode(Device& device, const std::vector<const Row*>& rows)
{
    DeviceCode result;
    result.name = device.name;
    result.driver = device.driver;
    try {
        compileAll(device, rows, result);
    } catch (const std::exception& e) {
        result.silence = reason(e);
    }
    return result;
}

// Whether Mesa's Radeon driver takes the family that is set in the environment. Asked in a child,
// because the driver aborts where it does not know it; what it then prints is dropped.
bool driverKnowsFamily()
{
    const pid_t child = ::fork();
    if (child < 0)
        return false;
    if (child == 0) {
        const int nowhere = ::open("/dev/null", O_WRONLY);
        ::dup2(nowhere, STDERR_FILENO);
        bool found = false;
        try {
            const Instance instance = openInstance();
            for (const Device& device : listDevices(instance))
                found = found || device.radv;
        } catch (...) {
        }
        ::_exit(found ? 0 : 1);
    }
    int status = 0;
    return ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

} // namespace

const std::vector<std::string>& usualFamilies()
{
    static const std::vector<std::string> list = {"POLARIS10", "VEGA10", "NAVI21", "GFX1100"};
    return list;
}

Result<std::vector<DeviceCode>> machineCodeOfDevices(const std::vector<const Row*>& rows,
                                                     const std::vector<std::string>& devices)
{
    // A shader from Mesa's cache would come without its statistics.
    const Environment noCache("MESA_SHADER_CACHE_DISABLE", "true");
    try {
        const Instance instance = openInstance();
        std::vector<DeviceCode> result;
        for (Device& device : listDevices(instance))
            if (wanted(device.name, devices))
                result.push_back(machineCode(device, rows));
        return result;
    } catch (const std::exception& e) {
        return unavailableError("Vulkan cannot be used: " + reason(e));
    }
}

DeviceCode machineCodeOfFamily(const std::vector<const Row*>& rows, const std::string& family)
{
    const Environment noCache("MESA_SHADER_CACHE_DISABLE", "true");
    const Environment forced("RADV_FORCE_FAMILY", family);
    DeviceCode result;
    result.family = family;
    result.silence = "Mesa's Radeon driver is not installed, or does not know this family";
    if (!driverKnowsFamily())
        return result;
    try {
        const Instance instance = openInstance();
        for (Device& device : listDevices(instance))
            if (device.radv) {
                result = machineCode(device, rows);
                break;
            }
    } catch (const std::exception& e) {
        result.silence = reason(e);
    }
    result.family = family;
    return result;
}

} // namespace cotan::cost
