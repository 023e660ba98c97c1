#include "figures/figures.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/try.hpp"
#include "cotan/image.hpp"
#include "figure.hpp"
#include "figure_renderer.hpp"
#include "files/output.hpp"
#include "page.hpp"
#include "stage.hpp"

namespace cotan::figures {

namespace {

struct FigureInfo {
    std::string_view name; // as in FiguresOptions::only; also the prefix of its file names
    Figure (*make)(FigureRenderer& studio);
};

constexpr FigureInfo kFigures[] = {
    {"2.6.3", makeTeapotFigure},        {"2.6.4", makePatchFigure},       {"2.6.5", makePlaneFigure},
    {"mirrored", makeMirroredFigure},   {"faceting", makeFacetingFigure}, {"sparkle", makeSparkleFigure},
    {"flicker", makeFlickerFigure},     {"parallax", makeParallaxFigure}, {"decal", makeDecalFigure},
    {"triplanar", makeTriplanarFigure}, {"grooves", makeGroovesFigure},   {"isolines", makeIsolinesFigure},
};

// Returns the figures with these names in the order of the table; all of them if `only` is empty.
Result<std::vector<FigureInfo>> chosenFigures(const std::vector<std::string>& only)
{
    std::vector<FigureInfo> figures;
    for (const std::string& word : only)
        if (std::ranges::find(kFigures, word, &FigureInfo::name) == std::end(kFigures))
            return about(
                "options.only",
                usageError(fmt::format("expected names from {}; found '{}'", fmt::join(figureNames(), ", "), word)));
    for (const FigureInfo& info : kFigures)
        if (only.empty() || std::ranges::find(only, info.name) != only.end())
            figures.push_back(info);
    return figures;
}

PageTable tableOf(const Figure& figure)
{
    PageTable table{figure.measured, {"degrees", "mean", "95 %", "largest"}, {}};
    for (const Measure& m : figure.measures)
        table.rows.push_back({m.name, fmt::format("{:.2f}", m.degrees.mean),
                              fmt::format("{:.2f}", m.degrees.percentile95), fmt::format("{:.1f}", m.degrees.maximum)});
    return table;
}

Json reportOf(std::string_view name, const Figure& figure)
{
    Json json = {{"name", name}, {"title", figure.title}};
    json["image_files"] = Json::array();
    for (const Panel& panel : figure.panels)
        json["image_files"].push_back(fmt::format("{}-{}.png", name, panel.file));
    json["measured"] = figure.measured;
    json["angles"] = Json::object();
    for (const Measure& m : figure.measures)
        json["angles"][m.name] = toJson(m.degrees);
    for (const Number& n : figure.numbers)
        json["numbers"][n.name] = n.value;
    return json;
}

// Writes a figure's images and describes the figure for the page.
Result<PageFigure> writeFigure(const std::filesystem::path& folder, const FiguresOptions& o, std::string_view name,
                               const Figure& figure)
{
    PageFigure page;
    page.name = name;
    page.title = figure.title;
    page.text = figure.text;
    page.command = fmt::format("cotan figures --only {} -o figures{}", name, o.command);
    page.sliders = figure.sliders;
    if (!figure.measures.empty())
        page.tables.push_back(tableOf(figure));
    for (const Panel& panel : figure.panels) {
        const std::string file = fmt::format("{}-{}.png", name, panel.file);
        COTAN_CHECK(writeImage(folder / file, panel.image));
        COTAN_TRY(png, readText(folder / file, /*isInput*/ false));
        page.panels.push_back(
            {file, panel.label, panel.caption, *std::move(png), panel.image.width, panel.image.height});
    }
    return page;
}

Page emptyPage(const std::string& device)
{
    Page page;
    page.title = "Normal mapping without precomputed tangents: the figures";
    page.text = {
        "Figures 2.6.3 to 2.6.5 of C. Schueler's chapter of 2006 and others that its follow-up of 2013 and common "
        "tutorials suggest, redrawn and measured: every image is captioned with the error of its normals, in degrees. "
        "Drag a slider to compare."};
    page.footer = fmt::format("Drawn on {}.", device);
    return page;
}

// A contact sheet with two panels of each figure.
Image overviewOf(const std::vector<Figure>& figures, const FiguresOptions& o)
{
    std::vector<const Image*> panels;
    for (const Figure& figure : figures)
        for (const std::size_t panel : {figure.overview.first, figure.overview.second})
            panels.push_back(&figure.panels[panel].image);
    const int columns = panels.size() > 8 ? 6 : std::min(4, int(panels.size()));
    return contactSheet(panels, columns, std::min(o.width, 240), std::min(o.height, 180));
}

} // namespace

std::vector<std::string_view> figureNames()
{
    std::vector<std::string_view> names;
    for (const FigureInfo& info : kFigures)
        names.push_back(info.name);
    return names;
}

Result<Json> drawFigures(Renderer& renderer, const std::filesystem::path& folder, const FiguresOptions& o)
{
    COTAN_TRY(figures, chosenFigures(o.only));
    FigureRenderer studio(renderer, o.threads, o.width, o.height);
    Page page = emptyPage(renderer.device());
    Json report = Json::array();
    std::vector<Figure> made;
    CountedSteps steps(o.progress, figures->size());
    for (const FigureInfo& info : *figures) {
        made.push_back(info.make(studio));
        if (studio.error())
            return *studio.error();
        COTAN_TRY(onPage, writeFigure(folder, o, info.name, made.back()));
        page.figures.push_back(std::move(*onPage));
        report.push_back(reportOf(info.name, made.back()));
        if (!steps.step())
            return stoppedError();
        if (o.made)
            o.made(info.name, made.back().title);
    }
    COTAN_CHECK(writeImage(folder / "overview.png", overviewOf(made, o)));
    COTAN_CHECK(writeFileWhole(folder / "index.html", toHtml(page)));
    return report;
}

} // namespace cotan::figures
