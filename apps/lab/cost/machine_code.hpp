// What drivers say about the machine code they make (VK_KHR_pipeline_executable_properties).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cost/rows.hpp"
#include "cost/stages.hpp"
#include "cotan/result.hpp"

namespace cotan::cost {

// One compiled stage. Names differ between drivers; what a driver does not report is empty.
struct StageCode {
    std::optional<double> instructions;
    std::optional<double> arithmetic;                // instructions that compute, where the driver tells them apart
    std::optional<double> registers;                 // per thread (vector registers where there are two kinds)
    std::optional<double> bytes;                     // of code
    std::optional<double> inverseThroughput;         // the driver's bound in cycles, its unit
    std::optional<double> latency;                   // the driver's estimate, its unit
    std::vector<std::pair<std::string, double>> all; // every number, by the driver's name; empty where it was read
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
    StageCode code; // empty for mesh stages where the device has none
};

struct DeviceCode {
    std::string name;
    std::string maker;   // AMD, NVIDIA, ...; empty where it is not known
    std::string driver;  // name and version
    std::string family;  // what tables call it instead of its name, such as a family that was asked for
    std::string silence; // why there are no numbers; empty where there are
    std::string date;    // when it was asked, YYYY-MM-DD
    std::vector<RowCode> rows;
    std::vector<VertexCode> vertices; // each with a fragment stage that uses all it hands on
    std::vector<OtherCode> others;    // all of otherStages()
};

// The families that are asked for when nothing else is said.
const std::vector<std::string>& usualFamilies();

// Compiles the rows on every Vulkan device of this machine whose name contains one of `devices` (any case; empty: all
// of them). Drivers run in child processes: one that crashes loses the stage that it compiled, or its device, and no
// more. Not for programs with other threads. Errors: ErrorKind::unavailable where Vulkan cannot be used at all.
Result<std::vector<DeviceCode>> machineCodeOfDevices(const std::vector<const Row*>& rows,
                                                     const std::vector<std::string>& devices);

// The same by Mesa's Radeon driver for a family of cards (RADV_FORCE_FAMILY), none of which is needed. Mesa 26 no
// longer takes it. Sets the environment variable for the duration.
DeviceCode machineCodeOfFamily(const std::vector<const Row*>& rows, const std::string& family);

// The stage of a device, or an empty one.
const StageCode& fragmentCode(const DeviceCode& device, std::string_view row);
const StageCode& vertexCode(const DeviceCode& device, Stored stored);
const StageCode& otherCode(const DeviceCode& device, const Stage& stage);
// Of otherStages(), the resolve of that name, which there has to be.
const StageCode& resolveCode(const DeviceCode& device, std::string_view name);

// Calls use(kind, name, code) for each of a device's stages, which it may change where the device is no constant:
// "fragment" by the row, "vertex" by what vertices have, then otherStages() by their kinds.
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
