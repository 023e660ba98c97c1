#include "page.hpp"

#include <fmt/format.h>

#include "html.hpp"

namespace cotan {

using namespace app;

namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --line: #8886; --soft: #8881; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 76rem; margin: 0 auto; padding: 1rem; }
h1, h2 { line-height: 1.2; }
section { border-top: 1px solid var(--line); margin-top: 2.5rem; }
p { max-width: 46rem; }
nav a { margin-right: 1em; }
code { background: var(--soft); padding: .1em .4em; border-radius: 4px; overflow-wrap: anywhere; }
.panels { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(21rem, 100%), 1fr)); gap: 1rem; }
figure { margin: 0; }
figcaption { font-size: .9em; }
img { max-width: 100%; height: auto; display: block; background: #8883; }
.panels img { width: 100%; }
table { border-collapse: collapse; margin: 1rem 0; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-size: .9em; padding-bottom: .3em; max-width: 46rem; }
th, td { border: 1px solid var(--line); padding: .2em .7em; text-align: left; }
td + td { text-align: right; }
.panels + .panels { margin-top: 1rem; }
.stack { position: relative; }
.stack img { width: 100%; }
.stack img + img { position: absolute; inset: 0; }
.slider input { width: 100%; margin: .3rem 0; }
.ends { display: flex; justify-content: space-between; gap: 1em; font-size: .9em; }
.ends span + span { text-align: right; }
)";

// Sliders are empty elements that this script fills with the two images they name.
constexpr std::string_view kScript = R"(
for (const slider of document.querySelectorAll('.slider')) {
  const pictures = [slider.dataset.before, slider.dataset.after].map(id => document.getElementById(id));
  const [before, after] = pictures.map(p => { const c = p.cloneNode(); c.removeAttribute('id'); return c; });
  const stack = document.createElement('div');
  stack.className = 'stack';
  stack.append(after, before);
  const range = document.createElement('input');
  range.type = 'range';
  range.value = 50;
  range.setAttribute('aria-label', before.alt + ' to the left, ' + after.alt + ' to the right');
  const show = () => { before.style.clipPath = 'inset(0 ' + (100 - range.value) + '% 0 0)'; };
  range.addEventListener('input', show);
  const ends = document.createElement('div');
  ends.className = 'ends';
  for (const picture of [before, after]) {
    const end = document.createElement('span');
    end.textContent = picture.alt;
    ends.append(end);
  }
  slider.append(stack, range, ends);
  show();
}
)";

std::string panelId(const PageFigure& figure, std::size_t panel)
{
    return escapeHtml(fmt::format("{}-{}", figure.name, panel));
}

std::string paragraphs(const std::vector<std::string>& text)
{
    std::string html;
    for (const std::string& paragraph : text)
        html += "<p>" + escapeHtml(paragraph) + "</p>\n";
    return html;
}

std::string panelHtml(const PageFigure& figure, std::size_t index)
{
    const PagePanel& p = figure.panels[index];
    return fmt::format(
        "<figure><img id=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\" src=\"data:image/png;base64,{}\">\n"
        "<figcaption><b>{}</b> {} <code>{}</code></figcaption></figure>\n",
        panelId(figure, index), p.width, p.height, escapeHtml(p.label), toBase64(p.png), escapeHtml(p.label),
        escapeHtml(p.caption), escapeHtml(p.file));
}

std::string rowHtml(const std::vector<std::string>& cells, std::string_view tag)
{
    std::string html = "<tr>";
    for (const std::string& cell : cells)
        html += fmt::format("<{}>{}</{}>", tag, escapeHtml(cell), tag);
    return html + "</tr>\n";
}

std::string tableHtml(const PageTable& table)
{
    std::string html = "<table><caption>" + escapeHtml(table.caption) + "</caption>\n";
    html += rowHtml(table.head, "th");
    for (const auto& row : table.rows)
        html += rowHtml(row, "td");
    return html + "</table>\n";
}

std::string figureHtml(const PageFigure& figure)
{
    std::string html =
        fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n", escapeHtml(figure.name), escapeHtml(figure.title));
    html += paragraphs(figure.text);
    html += "<div class=\"panels\">\n";
    for (const auto& [before, after] : figure.sliders)
        html += fmt::format("<div class=\"slider\" data-before=\"{}\" data-after=\"{}\"></div>\n",
                            panelId(figure, before), panelId(figure, after));
    html += "</div>\n<div class=\"panels\">\n";
    for (std::size_t i = 0; i < figure.panels.size(); ++i)
        html += panelHtml(figure, i);
    html += "</div>\n";
    for (const PageTable& table : figure.tables)
        html += tableHtml(table);
    return html + "<p>Made by <code>" + escapeHtml(figure.command) + "</code></p>\n</section>\n";
}

} // namespace

std::string toHtml(const Page& page)
{
    const std::string title = escapeHtml(page.title);
    std::string html = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
    html += "<title>" + title + "</title>\n<style>" + std::string(kStyle) + "</style>\n</head>\n<body>\n";
    html += "<h1>" + title + "</h1>\n" + paragraphs(page.text) + "<nav>";
    for (const PageFigure& figure : page.figures)
        html += fmt::format("<a href=\"#{0}\">{0}</a>\n", escapeHtml(figure.name));
    html += "</nav>\n";
    for (const PageFigure& figure : page.figures)
        html += figureHtml(figure);
    return html + "<footer><p>" + escapeHtml(page.footer) + "</p></footer>\n<script>" + std::string(kScript)
        + "</script>\n</body>\n</html>\n";
}

} // namespace cotan
