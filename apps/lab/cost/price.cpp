#include "cost/price.hpp"

#include <algorithm>

#include "core/try.hpp"
#include "cost/cards.hpp"
#include "files/system/system.hpp"

namespace cotan::cost {

namespace {

std::string joined(const std::vector<std::string>& words, const char* between)
{
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : between) + word;
    return text;
}

Result<std::vector<const Row*>> chosenRows(const std::vector<std::string>& names)
{
    for (const std::string& name : names)
        if (!rowFromName(name)) {
            std::vector<std::string> known;
            for (const Row& row : rows())
                known.emplace_back(row.name);
            return about("options.frames",
                         usageError("expected one of " + joined(known, ", ") + "; found '" + name + "'"));
        }
    std::vector<const Row*> chosen;
    for (const Row& row : rows()) {
        const bool named = std::find(names.begin(), names.end(), row.name) != names.end();
        // The rows that the others are compared with are always included.
        if (names.empty() || named || row.name == "floor" || row.name == "mikktspace")
            chosen.push_back(&row);
    }
    return chosen;
}

// Fills in machine code and times. Errors: why Vulkan cannot be used at all, or stopped; earlier results are kept.
Status measure(const PriceOptions& o, CostReport& report)
{
    Status usable = Done{};
    const std::vector<std::string> families = !o.families.empty() ? o.families
        : o.devices.empty() && o.name.empty()                     ? usualFamilies()
                                                                  : std::vector<std::string>();
    CountedSteps steps(o.progress, families.size() + 2); // devices, families, times
    if (o.families.empty() || !o.devices.empty()) {
        auto code = machineCodeOfDevices(report.rows, o.devices, o.program);
        if (code)
            report.code = std::move(*code);
        else
            usable = code.error();
        if (code && report.code.empty() && !o.devices.empty())
            return unavailableError("no Vulkan device has '" + joined(o.devices, "' or '") + "' in its name");
    }
    if (!o.name.empty() && report.code.size() > 1)
        return about("options.name",
                     usageError("names one device; found " + std::to_string(report.code.size())
                                + ": select one with options.devices"));
    if (!o.name.empty() && !report.code.empty())
        report.code.front().family = o.name;
    if (!steps.step())
        return stoppedError();
    for (const std::string& family : families) {
        report.code.push_back(machineCodeOfFamily(report.rows, family, o.program));
        if (!steps.step())
            return stoppedError();
    }
    if (!o.timing) {
        report.timingSilence = "--no-timing was given";
        return usable;
    }
    if (!o.families.empty() && o.devices.empty())
        return usable; // only GPUs that are not in this machine were requested
    auto timing = timeRows(report.rows, {o.devices, o.timeCpuDevices, o.repeats, usualCases()});
    if (timing)
        report.timing = std::move(*timing);
    else
        report.timingSilence = timing.error().message;
    return usable;
}

} // namespace

Result<CostReport> price(const PriceOptions& options)
{
    COTAN_TRY(rows, chosenRows(options.frames));
    CostReport report;
    report.machine = systemName();
    report.rows = std::move(*rows);
    Status measured = Done{};
    if (options.cards.empty()) {
        measured = measure(options, report);
    } else {
        auto gpus = gpusFromCsv(options.cards);
        if (!gpus)
            return about("options.cards", inputError(gpus.error().message));
        report.code = std::move(*gpus);
        report.gpusRead = true;
        report.timingSilence = "the figures of these GPUs were read from a file";
    }
    if (!measured && measured.error().kind != ErrorKind::unavailable)
        return measured.error();
    if (std::ranges::none_of(report.code, [](const DeviceCode& d) { return d.silence.empty(); }))
        report.codeSilence = measured ? "no queried driver reports machine code; operations and SPIR-V were counted. "
                                        "Mesa's Radeon driver reports it without a GPU (Debian: mesa-vulkan-drivers)"
                                      : measured.error().message + "; operations and SPIR-V were counted";
    return report;
}

} // namespace cotan::cost
