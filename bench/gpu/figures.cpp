#include "figures.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace cotan::bench {

namespace {

constexpr char kHow[] = R"(# On a real GPU

Instructions ([Cost](cost.md)) are not nanoseconds. This page says how to measure a frame on a machine with a Vulkan
GPU. The machine needs little else:

```sh
bench/on-gpu pack FOLDER    # on the machine that built Cotan: packs what the measurement needs, tens of MB
FOLDER/run                  # on the machine with the GPU, under ten minutes: writes FOLDER/gpu.md, which is this page
bench/on-gpu                # both, on one machine: writes docs/explanation/gpu.md
```

FOLDER contains programs, libraries and compiled shaders. The machine needs x86-64 Linux with glibc 2.35 or later
(Debian 12, Ubuntu 22.04) and a driver for Vulkan 1.3. It needs no display, compiler, network or Vulkan loader. If
`FOLDER/run` finds no driver, it prints one line and exits with code 3. If a test fails, it exits with code 5.

## What is measured

**Rows** are those of [Cost](cost.md). Whole pipelines fill a square of 2048 x 2048 pixels (1024 x 1024 for the smallest
triangles) with right-angled triangles of equal legs. The target has four half floats per pixel, and no depth or
blending. Meshes and target are in the device's memory. Two timestamps enclose one draw. All rows are drawn in turn, 15
times, after a warm-up that does not count.

"4 samples" is a multisampled target, not resolved. "4 layers" draws each pixel four times in one draw; no layer is
hidden, and all count. `triangle-read` reads vectors that were made at load. The other `triangle` rows make them at
provoking vertices. This needs almost twice as many vertices, and the times include that.

**A cell** has the median in nanoseconds per million pixels. Then it has the median of the ratio to `mikktspace` in the
same repetition, and half the distance between that ratio's quartiles.

**Passes** are those of [examples/deforming](../../examples/deforming), over a tube of a million triangles. Timestamps
enclose each dispatch alone.

**Tests** are the parity tests of the portable text and the tests of the examples, which `./run-tests` also runs, on
this device.

)";

std::string textOf(const cost::TimingCase& c)
{
    return fmt::format("legs of {} px, {} sample{}, {} layer{}", c.leg, c.samples, c.samples == 1 ? "" : "s", c.layers,
                       c.layers == 1 ? "" : "s");
}

std::string line(const std::vector<std::string>& cells)
{
    std::string text = "|";
    for (const std::string& cell : cells)
        text += " " + cell + " |";
    return text + "\n";
}

std::string rowTable(const Figures& figures, int samples, int layers)
{
    std::vector<std::size_t> cases;
    for (std::size_t i = 0; i < figures.rows.cases.size(); ++i)
        if (figures.rows.cases[i].samples == samples && figures.rows.cases[i].layers == layers)
            cases.push_back(i);
    if (cases.empty())
        return {};
    std::sort(cases.begin(), cases.end(),
              [&](std::size_t a, std::size_t b) { return figures.rows.cases[a].leg < figures.rows.cases[b].leg; });
    std::string text = fmt::format("### {} sample{} per pixel, {} layer{}\n\n", samples, samples == 1 ? "" : "s",
                                   layers, layers == 1 ? "" : "s");
    std::vector<std::string> head = {"legs of the triangles"}, rule = {"---"};
    for (const std::size_t i : cases) {
        head.push_back(fmt::format("{} px", figures.rows.cases[i].leg));
        rule.emplace_back("---:");
    }
    text += line(head) + line(rule);
    for (const cost::TimedRow& row : figures.rows.rows) {
        std::vector<std::string> cells = {fmt::format("`{}`", row.row)};
        for (const std::size_t i : cases) {
            const Middle ratio = ratioOf(figures, row, i);
            cells.push_back(
                fmt::format("{:.0f}; {:.2f} ± {:.2f}", row.nanosecondsPerMillionPixels[i], ratio.median, ratio.spread));
        }
        text += line(cells);
    }
    return text + "\n";
}

std::string passTable(const Figures& figures)
{
    std::string text = fmt::format("### Passes over {} triangles\n\n", figures.triangles)
        + line({"pass", "makes", "nanoseconds per million triangles"}) + line({"---", "---", "---:"});
    for (const PassTimes& pass : figures.passes) {
        const Middle m = middleOf(pass.nanoseconds);
        text += line({"`" + pass.name + "`", pass.makes, fmt::format("{:.0f} ± {:.0f}", m.median, m.spread)});
    }
    return text + "\n";
}

std::string testTable(const Figures& figures)
{
    std::string text = "### Tests\n\n";
    if (figures.tests.empty())
        return text + "None were run.\n";
    text += line({"test", "result", "cases", "worst, degrees"}) + line({"---", "---", "---:", "---"});
    for (const TestOutcome& t : figures.tests)
        text += line({"`" + t.name + "`", t.result, t.cases > 0 ? std::to_string(t.cases) : "",
                      t.cases > 0 ? fmt::format("{:.1e} ({})", t.worst, t.worstCase) : ""});
    return text;
}

} // namespace

Middle middleOf(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const auto at = [&](double fraction) { return values[std::size_t(fraction * double(values.size() - 1) + 0.5)]; };
    return {at(0.5), (at(0.75) - at(0.25)) / 2};
}

static const cost::TimedRow* baseOf(const Figures& figures)
{
    for (const cost::TimedRow& row : figures.rows.rows)
        if (row.row == "mikktspace")
            return &row;
    return nullptr;
}

Middle ratioOf(const Figures& figures, const cost::TimedRow& row, std::size_t atCase)
{
    const std::vector<double>&mine = row.repeats[atCase], &base = baseOf(figures)->repeats[atCase];
    std::vector<double> ratios;
    for (std::size_t i = 0; i < mine.size(); ++i)
        ratios.push_back(mine[i] / base[i]);
    return middleOf(std::move(ratios));
}

std::string whyInvalid(const Figures& figures)
{
    const auto took = [](const std::vector<double>& times) {
        return !times.empty()
            && std::all_of(times.begin(), times.end(), [](double t) { return std::isfinite(t) && t > 0; });
    };
    const std::vector<cost::TimingCase>& cases = figures.rows.cases;
    if (cases.empty() || !baseOf(figures))
        return "nothing was drawn";
    for (const cost::TimedRow& row : figures.rows.rows)
        for (std::size_t i = 0; i < cases.size(); ++i)
            if (row.repeats.size() != cases.size() || row.nanosecondsPerMillionPixels.size() != cases.size()
                || row.repeats[i].size() != baseOf(figures)->repeats[i].size() || !took(row.repeats[i]))
                return fmt::format("row {}, {}: expected times above zero in all repetitions; found others", row.row,
                                   textOf(cases[i]));
    if (figures.passes.empty())
        return "no pass was run";
    for (const PassTimes& pass : figures.passes)
        if (!took(pass.nanoseconds))
            return fmt::format("pass {}: expected times above zero in all repetitions; found others", pass.name);
    return {};
}

std::string page(const Figures& figures, bool tables)
{
    std::string text = kHow;
    if (!tables)
        return text
            + fmt::format(
                   "## No figures yet\n\n{} Small sizes were drawn on {} to check that the programs work. Their times "
                   "mean nothing.\n",
                   figures.rows.cpu ? "No GPU has been measured yet." : "Nothing was measured.", figures.rows.name);
    text += fmt::format("## {}\n\n{}. {}. Measured on {}.\n\n", figures.rows.name, figures.rows.driver, figures.machine,
                        figures.date);
    if (figures.rows.cpu)
        text += "This device renders on the CPU: the times say nothing about a GPU.\n\n";
    for (const int layers : {1, 4})
        for (const int samples : {1, 4})
            text += rowTable(figures, samples, layers);
    for (const cost::SkippedCase& s : figures.rows.skipped)
        text += fmt::format("Skipped: {}: {}.\n\n", textOf(s.what), s.why);
    return text + passTable(figures) + testTable(figures);
}

} // namespace cotan::bench
