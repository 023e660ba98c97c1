#include "commands.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>

#include <fmt/format.h>

#include "cotan/image/file.hpp"
#include "cotan/files/output.hpp"
#include "device.hpp"
#include "figures/figure.hpp"
#include "figures/stage.hpp"
#include "figures/studio.hpp"
#include "parse.hpp"
#include "progress.hpp"

namespace cotan::app {

namespace {

constexpr const char* kSize = "480x360";

struct FiguresCommandOptions {
    CommonOptions common;
    std::string size = kSize;
    std::string device = "auto";
    std::string only;
};

std::string figureNames()
{
    std::string names;
    for (const FigureInfo& info : figureTable())
        names += (names.empty() ? "" : ", ") + std::string(info.name);
    return names;
}

// The figures that --only names, in the order of the table; all if it is empty.
Result<std::vector<FigureInfo>> chosen(const std::string& only)
{
    const auto table = figureTable();
    if (only.empty())
        return std::vector<FigureInfo>(table.begin(), table.end());
    std::vector<bool> wanted(table.size());
    for (std::size_t at = 0; at <= only.size();) {
        const std::size_t end = std::min(only.find(',', at), only.size());
        const std::string word = only.substr(at, end - at);
        const auto found = std::find_if(table.begin(), table.end(), [&](const FigureInfo& f) { return f.name == word; });
        if (found == table.end())
            return usageError(fmt::format("--only: expected names from {}; found '{}'", figureNames(), word));
        wanted[std::size_t(found - table.begin())] = true;
        at = end + 1;
    }
    std::vector<FigureInfo> figures;
    for (std::size_t i = 0; i < table.size(); ++i)
        if (wanted[i])
            figures.push_back(table[i]);
    return figures;
}

std::string commandOf(const FiguresCommandOptions& o, std::string_view name)
{
    std::string command = fmt::format("cotan figures --only {} -o figures", name);
    if (o.size != kSize)
        command += " --size " + o.size;
    if (o.device != "auto")
        command += " --device \"" + o.device + "\"";
    return command;
}

std::string readBytes(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
}

PageTable tableOf(const Figure& figure)
{
    PageTable table{figure.measured, {"degrees", "mean", "95 %", "largest"}, {}};
    for (const Measure& m : figure.measures)
        table.rows.push_back({m.name, fmt::format("{:.2f}", m.degrees.mean), fmt::format("{:.2f}", m.degrees.percentile95),
                              fmt::format("{:.1f}", m.degrees.maximum)});
    return table;
}

nlohmann::ordered_json reportOf(std::string_view name, const Figure& figure)
{
    nlohmann::ordered_json json = {{"name", name}, {"title", figure.title}};
    json["pictures"] = nlohmann::ordered_json::array();
    for (const Panel& panel : figure.panels)
        json["pictures"].push_back(fmt::format("{}-{}.png", name, panel.file));
    json["measured"] = figure.measured;
    json["angles"] = nlohmann::ordered_json::object();
    for (const Measure& m : figure.measures)
        json["angles"][m.name] = toJson(m.degrees);
    for (const Number& n : figure.numbers)
        json["numbers"][n.name] = n.value;
    return json;
}

// Writes a figure's pictures and describes it for the page.
Result<PageFigure> written(const FiguresCommandOptions& o, std::string_view name, const Figure& figure)
{
    PageFigure page;
    page.name = name;
    page.title = figure.title;
    page.text = figure.text;
    page.command = commandOf(o, name);
    page.sliders = figure.sliders;
    if (!figure.measures.empty())
        page.tables.push_back(tableOf(figure));
    for (const Panel& panel : figure.panels) {
        const std::string file = fmt::format("{}-{}.png", name, panel.file);
        if (Status done = writeImage(o.common.output / file, panel.image); !done)
            return done.error();
        page.panels.push_back({file, panel.label, panel.caption, readBytes(o.common.output / file),
                               panel.image.width, panel.image.height});
    }
    return page;
}

Page emptyPage(const std::string& device)
{
    Page page;
    page.title = "Normal mapping without precomputed tangents: the figures";
    page.text = {"Figures 2.6.3 to 2.6.5 of C. Schueler's chapter of 2006 and others that its follow-up of 2013 and common "
                 "tutorials ask for, drawn anew and measured: every picture has beside it, in degrees, how far its normals are from "
                 "what is right. Drag a slider to compare."};
    page.footer = fmt::format("Drawn on {}.", device);
    return page;
}

Status run(const FiguresCommandOptions& o)
{
    if (o.common.output.empty())
        return usageError("figures: expected -o FOLDER; found none");
    const auto size = parseSize(o.size);
    if (!size)
        return size.error();
    const auto figures = chosen(o.only);
    if (!figures)
        return figures.error();
    if (Status planned = planOutputs(o.common, plannedIn("-o", o.common.output, {"index.html", "overview.png"})); !planned)
        return planned;
    auto painter = openDevice(o.device, o.common);
    if (!painter)
        return painter.error();
    if (Status made = makeFolder(o.common.output); !made)
        return made;

    Studio studio(**painter, o.common.threads, size->first, size->second);
    Page page = emptyPage((*painter)->device());
    nlohmann::ordered_json report = {{"command", "figures"}, {"device", (*painter)->device()},
                                     {"size", {size->first, size->second}},
                                     {"figures", nlohmann::ordered_json::array()}};
    std::vector<Figure> made;
    Progress progress(o.common, figures->size(), "drawing figures");
    for (const FigureInfo& info : *figures) {
        made.push_back(info.make(studio));
        if (studio.error())
            return *studio.error();
        auto onPage = written(o, info.name, made.back());
        if (!onPage)
            return onPage.error();
        page.figures.push_back(std::move(*onPage));
        report["figures"].push_back(reportOf(info.name, made.back()));
        progress.step();
        say(o.common, fmt::format("{}: {}", info.name, made.back().title));
    }
    std::vector<const Image*> overview;
    for (const Figure& figure : made)
        for (std::size_t panel : {figure.overview.first, figure.overview.second})
            overview.push_back(&figure.panels[panel].image);
    const int columns = overview.size() > 8 ? 6 : std::min(4, int(overview.size()));
    const Image sheet = contactSheet(overview, columns, std::min(size->first, 240), std::min(size->second, 180));
    if (Status done = writeImage(o.common.output / "overview.png", sheet); !done)
        return done;
    if (Status done = writeFileWhole(o.common.output / "index.html", toHtml(page)); !done)
        return done;
    say(o.common, fmt::format("page: {}", (o.common.output / "index.html").string()));
    return writeReport(o.common, report);
}

constexpr FigureInfo kFigures[] = {
    {"2.6.3", makeTeapotFigure},        {"2.6.4", makePatchFigure},
    {"2.6.5", makePlaneFigure},         {"tutorial", makeTutorialFigure},
    {"normal-matrices", makeNormalMatrixFigure},
    {"mirrored", makeMirroredFigure},   {"targets", makeTargetsFigure},
    {"decode", makeDecodeFigure},       {"faceting", makeFacetingFigure},
};

} // namespace

std::span<const FigureInfo> figureTable() { return kFigures; }

Command addFiguresCommand(CLI::App& app)
{
    auto options = std::make_shared<FiguresCommandOptions>();
    CLI::App* command = app.add_subcommand("figures", "draw the figures, with their errors in degrees, as one HTML page and PNGs");
    addCommonOptions(*command, options->common, "folder for index.html and the pictures");
    command->add_option("--size", options->size, "width and height of a panel in pixels; square panels take the height")
        ->type_name("WxH")->capture_default_str();
    command->add_option("--only", options->only, "figures to make, separated by commas: " + figureNames())->type_name("NAMES");
    command->add_option("--device", options->device, "auto, reference, or a part of a Vulkan device's name")
        ->type_name("DEVICE")->capture_default_str();
    addExamples(*command, {"cotan figures --only mirrored -o figures",
                           "cotan figures --only 2.6.4,decode --size 240x180 -o figures"});
    return {command, [options] { return run(*options); }};
}

} // namespace cotan::app
