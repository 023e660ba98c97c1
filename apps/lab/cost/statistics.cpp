#include "statistics.hpp"

#include <algorithm>

namespace cotan::cost {

namespace {

using Names = std::initializer_list<std::string_view>;

std::optional<double> find(const StageCode& code, Names names)
{
    for (const std::string_view name : names)
        for (const auto& [reported, value] : code.all)
            if (reported == name)
                return value;
    return std::nullopt;
}

// Returns nothing if a value is missing, because a partial sum would look like a cheap shader.
std::optional<double> sum(const StageCode& code, Names names)
{
    double total = 0;
    for (const std::string_view name : names) {
        const auto value = find(code, {name});
        if (!value)
            return std::nullopt;
        total += *value;
    }
    return total;
}

// Returns the maximum: the units work in parallel, so the slowest determines the time.
std::optional<double> slowest(const StageCode& code, Names names)
{
    std::optional<double> maximum;
    for (const std::string_view name : names)
        if (const auto value = find(code, {name}))
            maximum = std::max(maximum.value_or(*value), *value);
    return maximum;
}

} // namespace

void nameStatistics(StageCode& code)
{
    // RADV, Honeykrisp, PanVK; ANV, Turnip, V3DV, NVIDIA's own; NVK.
    code.instructions = find(code, {"Instructions", "Instruction Count", "Instruction count"});
    // Turnip pads waiting times with instructions that do nothing. Its categories 2, 3 and 4 compute.
    code.arithmetic = sum(code, {"cat2 instructions", "cat3 instructions", "cat4 instructions"});
    if (!code.arithmetic && find(code, {"VMEM"})) // RADV; Honeykrisp's "ALU" counts cycles
        code.arithmetic = find(code, {"VALU"});
    code.registers =
        find(code, {"VGPRs", "Register Count", "Max live registers", "Number of GPRs", "Registers used", "GPRs"});
    code.bytes = find(code, {"Code size", "Code Size", "Binary Size"});
    code.inverseThroughput = find(code, {"Inverse Throughput"}); // RADV
    if (!code.inverseThroughput && find(code, {"Varying"}))      // PanVK reports the slowest of its pipes
        code.inverseThroughput = find(code, {"Cycles"});
    if (!code.inverseThroughput && find(code, {"FSCIB"})) // Honeykrisp
        code.inverseThroughput = slowest(code, {"ALU", "FSCIB", "IC"});
    // RADV; ANV; NVK, whose cycles are a sum of latencies.
    code.latency = find(code, {"Latency", "Cycle Count", "Static cycle count"});
}

} // namespace cotan::cost
