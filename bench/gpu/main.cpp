// Times every row of `cotan cost` and the passes of examples/deforming on a GPU, and writes docs/explanation/gpu.md.
// bench/on-gpu copies this program to a machine with a GPU.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>

#include <CLI/CLI.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include "devices.hpp"
#include "figures.hpp"

namespace cotan::bench {
namespace {

struct Options {
    std::string output = "gpu.md", log;
    double seconds = 400;
    bool quick = false, tables = false, probe = false;
};

int failed(int code, const std::string& why)
{
    fmt::print(stderr, "on_gpu: {}\n", why);
    return code;
}

struct Found {
    std::string name, missing;
    bool cpu = true;
};
// Returns the first device that draws; GPUs come first. Throws if Vulkan cannot be used.
Found findDevice()
{
    Found found{{}, "no Vulkan device", true};
    const cost::Instance instance = cost::openInstance();
    for (const cost::Device& d : cost::listDevices(instance)) {
        if (d.missing.empty())
            return {d.name, {}, d.cpu};
        found.missing = d.name + " " + d.missing;
    }
    return found;
}

// The most informative sizes come first, because the last ones may exceed the time limit.
std::vector<cost::TimingCase> casesOf(bool quick)
{
    std::vector<cost::TimingCase> cases;
    for (const int leg : quick ? std::vector{1, 16} : std::vector{16, 4, 64, 1, 256, 8, 2, 32, 128})
        for (const int layers : {1, 4})
            for (const int samples : {1, 4})
                cases.push_back({leg, samples, layers, quick ? 64 : leg < 4 ? 1024 : 2048});
    return cases;
}

std::string systemName()
{
    std::ifstream release("/etc/os-release");
    for (std::string line; std::getline(release, line);)
        if (line.starts_with("PRETTY_NAME=\"") && line.ends_with('"'))
            return line.substr(13, line.size() - 14);
    return "unknown system";
}

int measure(const Options& options)
{
    const Found device = findDevice();
    if (!device.missing.empty())
        return failed(3, device.missing);
    if (options.probe) {
        fmt::print("{} {}\n", device.cpu ? "cpu" : "gpu", device.name);
        return 0;
    }
    Figures figures;
    figures.machine = systemName();
    figures.date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
    const bool quick = options.quick || device.cpu; // a check that everything runs, not a measurement
    const int repeats = quick ? 3 : 15;
    if (!options.log.empty()) {
        std::ifstream log(options.log);
        if (!log)
            return failed(2, options.log + ": cannot be read");
        figures.tests = readTestLog(log);
    }

    std::string passDevice;
    const std::uint32_t around = quick ? 24 : 500, along = quick ? 32 : 1000;
    figures.triangles = 2 * std::size_t(around) * along;
    figures.passes = timePasses(around, along, repeats, passDevice);
    if (passDevice != device.name)
        return failed(
            3, fmt::format("rows would be timed on {}, passes on {}: keep only one driver", device.name, passDevice));

    std::vector<const cost::Row*> rows;
    for (const cost::Row& row : cost::rows())
        rows.push_back(&row);
    auto timed = cost::timeRows(rows, {{device.name}, device.cpu, repeats, casesOf(quick), options.seconds, 1});
    if (!timed)
        return failed(3, timed.error().message);
    figures.rows = std::move(timed->front());
    if (!figures.rows.silence.empty())
        return failed(3, device.name + ": " + figures.rows.silence);
    if (const std::string why = whyInvalid(figures); !why.empty())
        return failed(3, device.name + ": " + why);

    std::ofstream file(options.output, std::ios::binary);
    file << page(figures, !quick || options.tables);
    if (!file.flush())
        return failed(4, options.output + ": cannot be written");
    const std::ptrdiff_t bad = std::count_if(figures.tests.begin(), figures.tests.end(),
                                             [](const TestOutcome& t) { return t.result == "failed"; });
    fmt::print("{}: {} of {} cases drawn, {} of {} tests failed; {}\n", device.name, figures.rows.cases.size(),
               figures.rows.cases.size() + figures.rows.skipped.size(), bad, figures.tests.size(), options.output);
    return bad > 0 ? failed(5, "a test failed on " + device.name) : 0;
}

} // namespace
} // namespace cotan::bench

int main(int count, char** words)
{
    cotan::bench::Options options;
    CLI::App app("times every row of cotan cost and the passes of examples/deforming on a GPU");
    app.add_option("-o,--output", options.output, "file for the page");
    app.add_option("--tests", options.log, "output of the test programs");
    app.add_option("--seconds", options.seconds, "triangle sizes that would end later are skipped and listed");
    app.add_flag("--quick", options.quick, "small sizes, as on a device that renders on the CPU");
    app.add_flag("--tables", options.tables, "also write tables of small sizes; they say nothing about a GPU");
    app.add_flag("--probe", options.probe, "print `gpu` or `cpu` and the name of the device, and stop");
    try {
        app.parse(count, words);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 1;
    }
    try {
        return cotan::bench::measure(options);
    } catch (const std::exception& e) {
        return cotan::bench::failed(3, cotan::reason(e));
    }
}
