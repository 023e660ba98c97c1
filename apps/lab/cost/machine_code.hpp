// What drivers report about their machine code (VK_KHR_pipeline_executable_properties).
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cost/rows.hpp"
#include "cost/stages.hpp"
#include "cotan/result.hpp"

namespace cotan::cost {

// Statistics of one compiled stage. Drivers name them differently; a value that a driver does not report is empty.
struct StageCode {
    std::optional<double> instructions;
    std::optional<double> arithmetic;                // instructions that compute, if the driver reports them separately
    std::optional<double> registers;                 // per thread (vector registers if there are two kinds)
    std::optional<double> bytes;                     // code size
    std::optional<double> inverseThroughput;         // the driver's bound in cycles, in its unit
    std::optional<double> latency;                   // the driver's estimate, in its unit
    std::vector<std::pair<std::string, double>> all; // every number, by the driver's name; empty if read from a file
    std::string failure;                             // why the driver did not compile it
};

struct RowCode {
    std::string_view row;
    StageCode fragment;
};

struct VertexCode {
    Stored stored = Stored::nothing;
    StageCode vertex;
};

struct OtherCode {
    const Stage* stage;
    StageCode code; // empty for mesh stages if the device does not support them
};

struct DeviceCode {
    std::string name;
    std::string maker;   // AMD, NVIDIA, ...; empty if unknown
    std::string driver;  // name and version
    std::string family;  // shown in tables instead of the name, such as a requested GPU family
    std::string silence; // why there are no numbers; empty if there are
    std::string date;    // date of the query, YYYY-MM-DD
    std::vector<RowCode> rows;
    std::vector<VertexCode> vertices; // each with a fragment stage that uses all of its outputs
    std::vector<OtherCode> others;    // all of otherStages()
};

// The GPU families that are compiled for by default.
const std::vector<std::string>& usualFamilies();

// Compiles the rows on every Vulkan device of this machine whose name contains one of `devices` (ignoring case; all
// devices if empty). Drivers run in child processes: a crash loses only the stage being compiled, or the device.
// `program` is what is started as a child: one whose main() begins with runChild; empty: this one. Errors:
// ErrorKind::unavailable if Vulkan cannot be used at all.
Result<std::vector<DeviceCode>> machineCodeOfDevices(const std::vector<const Row*>& rows,
                                                     const std::vector<std::string>& devices,
                                                     const std::filesystem::path& program = {});

// Compiles the rows with Mesa's Radeon driver for a GPU family (RADV_FORCE_FAMILY); no such GPU is needed. Mesa 26 no
// longer supports this.
DeviceCode machineCodeOfFamily(const std::vector<const Row*>& rows, const std::string& family,
                               const std::filesystem::path& program = {});

// If the words of a command line, without the program's name, are those of a child of these functions: does its work
// and returns the exit code.
inline constexpr std::string_view kChildWord = "price-for-parent";
std::optional<int> runChild(std::span<const std::string> words);

// Return the code of a stage, or an empty one if the device has none.
const StageCode& fragmentCode(const DeviceCode& device, std::string_view row);
const StageCode& vertexCode(const DeviceCode& device, Stored stored);
const StageCode& otherCode(const DeviceCode& device, const Stage& stage);
// Returns the code of the stage in otherStages() that resolves `name`, which must exist.
const StageCode& resolveCode(const DeviceCode& device, std::string_view name);

// Calls use(kind, name, code) for each stage of a device; `code` is mutable unless the device is const. The kind is
// "fragment" (named by row), "vertex" (named by what is stored), or the kind of the entry of otherStages().
template<class Device, class Use> void eachStage(Device& device, const Use& use)
{
    for (auto& r : device.rows)
        use(std::string_view("fragment"), r.row, r.fragment);
    for (auto& v : device.vertices)
        use(std::string_view("vertex"), vertexStage(v.stored).name, v.vertex);
    for (auto& o : device.others)
        use(kindName(o.stage->kind), o.stage->name, o.code);
}

} // namespace cotan::cost
