#include <algorithm>

#include "core/try.hpp"
#include "figures/figures.hpp"
#include "lab.hpp"
#include "loading.hpp"
#include "parse.hpp"

namespace cotan::app {

namespace {

// Options that the page shows in the command line of each figure.
std::string commandOf(const FiguresCommandOptions& o)
{
    std::string command;
    if (o.size != kFigureSize)
        command += " --size " + o.size;
    if (o.device != "auto")
        command += " --device \"" + o.device + "\"";
    return command;
}

} // namespace

Status runFigures(const FiguresCommandOptions& o)
{
    if (o.output.empty())
        return usageError("figures needs -o FOLDER");
    COTAN_TRY(size, parseSize(o.size));
    const auto only = splitAtCommas(o.only);
    const auto names = figures::figureNames();
    for (const std::string& word : only)
        if (std::ranges::find(names, word) == names.end())
            return notOneOf("--only", names, word);
    COTAN_CHECK(beginOutputs(o, plannedIn("-o", o.output, {"index.html", "overview.png"})));
    COTAN_TRY(renderer, openDevice(o.device, o));
    COTAN_CHECK(makeFolder(o.output));
    const auto figures = withProgress(o, 1, "drawing figures", [&](Progress progress) {
        return figures::drawFigures(
            **renderer, o.output,
            {.only = only,
             .width = size->width,
             .height = size->height,
             .threads = o.threads,
             .command = commandOf(o),
             .made = [&](std::string_view name, const std::string& title) { say(o, "{}: {}", name, title); },
             .progress = std::move(progress)});
    });
    if (!figures)
        return withOptionNames(figures.error());
    say(o, "page: {}", (o.output / "index.html").string());
    return writeReport(o,
                       {{"command", "figures"},
                        {"device", (*renderer)->device()},
                        {"size", {size->width, size->height}},
                        {"figures", *figures}});
}

} // namespace cotan::app
