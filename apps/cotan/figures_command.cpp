#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "cotan/figures/figures.hpp"
#include "loading.hpp"
#include "parse.hpp"

namespace cotan::app {

namespace {

constexpr const char* kSize = "480x360";

struct FiguresCommandOptions : CommonOptions {
    std::string size = kSize;
    std::string device = "auto";
    std::string only;
};

// What the page adds to the command line of a figure.
std::string commandOf(const FiguresCommandOptions& o)
{
    std::string command;
    if (o.size != kSize)
        command += " --size " + o.size;
    if (o.device != "auto")
        command += " --device \"" + o.device + "\"";
    return command;
}

Status run(const FiguresCommandOptions& o)
{
    if (o.output.empty())
        return usageError("figures needs -o FOLDER");
    const auto size = parseSize(o.size);
    if (!size)
        return size.error();
    const auto only = splitAtCommas(o.only);
    const auto names = figures::figureNames();
    for (const std::string& word : only)
        if (std::ranges::find(names, word) == names.end())
            return notOneOf("--only", names, word);
    if (Status planned = beginOutputs(o, plannedIn("-o", o.output, {"index.html", "overview.png"})); !planned)
        return planned;
    const auto painter = openDevice(o.device, o);
    if (!painter)
        return painter.error();
    if (Status made = makeFolder(o.output); !made)
        return made;
    const auto figures = withProgress(o, 1, "drawing figures", [&](Progress progress) {
        return figures::drawFigures(
            **painter, o.output,
            {.only = only,
             .width = size->first,
             .height = size->second,
             .threads = o.threads,
             .command = commandOf(o),
             .made = [&](std::string_view name, const std::string& title) { say(o, "{}: {}", name, title); },
             .progress = std::move(progress)});
    });
    if (!figures)
        return inWords(figures.error());
    say(o, "page: {}", (o.output / "index.html").string());
    return writeReport(o,
                       {{"command", "figures"},
                        {"device", (*painter)->device()},
                        {"size", {size->first, size->second}},
                        {"figures", *figures}});
}

void declare(Arguments& a, FiguresCommandOptions& o)
{
    a.group(HelpGroup::output);
    a.option("--size", o.size, "width and height of a panel in pixels, 512 is 512x512; square panels take the height")
        .in("WxH");
    const auto names = figures::figureNames();
    a.option("--only", o.only, fmt::format("figures to make, separated by commas: {}", fmt::join(names, ", ")))
        .in("NAMES")
        .offers({names.begin(), names.end()})
        .main();
    addDeviceOption(a, o.device);
}

} // namespace

void addFiguresCommand(Arguments& tool)
{
    addCommand<FiguresCommandOptions>(
        tool,
        {"figures",
         "Draw the figures of the papers, with errors in degrees, as one HTML page and PNGs.",
         "folder for index.html and the images",
         {"cotan figures --only mirrored -o figures", "cotan figures --only 2.6.4,decode --size 240x180 -o figures"},
         /*needsOutput=*/true},
        declare, run);
}

} // namespace cotan::app
