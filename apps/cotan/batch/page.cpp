#include "batch/report.hpp"

#include <cmath>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "core/named_values.hpp"
#include "files/json.hpp"
#include "html.hpp"

namespace cotan::app {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --line: #8884; --soft: #8881; --bad: #c62828; --warn: #a15c00; --good: #2e7d32; }
@media (prefers-color-scheme: dark) { :root { --bad: #ff8a80; --warn: #ffc266; --good: #81c784; } }
* { box-sizing: border-box; }
html, body { height: 100%; margin: 0; }
body { font: 15px/1.35 system-ui, sans-serif; display: flex; flex-direction: column; }
header { padding: .8rem 1rem .5rem; }
h1 { font-size: 1.2rem; margin: 0 0 .5rem; overflow-wrap: anywhere; }
.tools { display: flex; flex-wrap: wrap; gap: .4rem; align-items: center; }
button, input { font: inherit; color: inherit; }
.tools button { border: 1px solid var(--line); border-radius: 1em; background: none; padding: .15em .8em;
  cursor: pointer; }
.tools button[aria-pressed=true] { background: #8884; }
.tools input { flex: 1 1 14rem; padding: .25em .6em; border: 1px solid var(--line); border-radius: 4px;
  background: none; }
.row { display: grid; grid-template-columns: 72px minmax(10rem, 1fr) 8rem 9rem 5rem 5rem; gap: .8rem;
  align-items: center; height: 64px; padding: 0 1rem; border-bottom: 1px solid var(--line); }
.head { height: auto; padding: .3rem 1rem; border-top: 1px solid var(--line); font-size: .85em;
  scrollbar-gutter: stable; overflow: hidden auto; }
.head button { border: 0; background: none; padding: 0; cursor: pointer; text-align: inherit; font-weight: 600; }
.number { text-align: right; font-variant-numeric: tabular-nums; }
#list { flex: 1; overflow-y: auto; scrollbar-gutter: stable; position: relative; }
#list .row { position: absolute; left: 0; right: 0; cursor: pointer; }
#list .row:hover, #list .row:focus { background: var(--soft); }
.row img { display: block; max-width: 64px; max-height: 60px; margin: auto; }
.name, .why { overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
.why { font-size: .85em; opacity: .8; }
.of { display: block; font-size: .7em; opacity: .75; line-height: 1.1; }
.bad { color: var(--bad); font-weight: 600; } .warn { color: var(--warn); font-weight: 600; }
.good { color: var(--good); }
.row.bad { color: inherit; font-weight: inherit; box-shadow: inset 4px 0 var(--bad); }
.row.good { color: inherit; }
.row.warn { color: inherit; font-weight: inherit; box-shadow: inset 4px 0 var(--warn); }
dialog { width: min(60rem, 94vw); max-height: 90vh; border: 1px solid var(--line); border-radius: 6px; }
pre { background: var(--soft); padding: .6em; white-space: pre-wrap; overflow-wrap: anywhere; }
dialog h2 { font-size: 1.1rem; margin: 0 0 .4rem; overflow-wrap: anywhere; }
dialog ul { padding-left: 1.2em; overflow-wrap: anywhere; }
footer { padding: .3rem 1rem; font-size: .8em; opacity: .75; }
@media (max-width: 46rem) { .row { grid-template-columns: 68px minmax(6rem, 1fr) 7rem 6rem; } .wide { display: none; } }
)";

// Each row is an array indexed by NAME to KEPT. All its contents are displayed as text, never as HTML.
constexpr std::string_view kScript = R"(
const { states, bad, warn, rows } = JSON.parse(document.getElementById('data').textContent);
const NAME = 0, STATE = 1, DEGREES = 2, OF = 3, SECONDS = 4, MEGABYTES = 5, COMMAND = 6, REASON = 7, SAID = 8,
  OUTPUTS = 9, INPUTS = 10, PICTURE = 11, KEPT = 12;
const [list, space, find] = ['list', 'space', 'find'].map(id => document.getElementById(id));
const height = 64;
let shown = rows.map((_, i) => i), state = -1, column = -1, down = true;
const texts = rows.map(r => (r[NAME] + '\n' + r[COMMAND] + '\n' + r[REASON]).toLowerCase());
const levelOf = r => bad.includes(r[STATE]) ? 'bad' : warn.includes(r[STATE]) ? 'warn' : 'good';
const make = (tag, className, text) => {
  const e = document.createElement(tag);
  if (className) e.className = className;
  if (text !== undefined) e.textContent = text;
  return e;
};
const degrees = d => d === null ? '' : d < 0.01 ? '< 0.01°' : (d < 10 ? d.toFixed(2) : d.toFixed(1)) + '°';
const seconds = s => s < 100 ? s.toFixed(s < 10 ? 2 : 1) : Math.round(s).toLocaleString('en');
function rowOf(i, place) {
  const r = rows[i], e = make('div', 'row ' + levelOf(r));
  e.style.top = place * height + 'px';
  e.tabIndex = 0;
  e.dataset.row = i;
  e.setAttribute('role', 'row');
  e.setAttribute('aria-rowindex', place + 2);
  const picture = make('div');
  picture.setAttribute('role', 'cell');
  if (r[PICTURE]) {
    const image = make('img');
    [image.width, image.height] = r[PICTURE];
    image.src = 'data:image/jpeg;base64,' + r[PICTURE][2];
    image.alt = '';
    picture.append(image);
  }
  const name = make('div', 'what');
  name.style.minWidth = 0;
  const why = r[REASON] || (r[COMMAND] === r[NAME] ? '' : r[COMMAND]);
  name.append(make('div', 'name', r[NAME]), make('div', 'why', why));
  const angle = make('div', 'number', degrees(r[DEGREES]));
  if (r[DEGREES] !== null) angle.append(make('span', 'of', r[OF]));
  const how = make('div', levelOf(r), states[r[STATE]]);
  if (r[KEPT]) how.append(make('span', 'of', 'from an earlier run'));
  const cells = [picture, name, how, angle,
    make('div', 'number wide', seconds(r[SECONDS])),
    make('div', 'number wide', Math.round(r[MEGABYTES]).toLocaleString('en'))];
  for (const cell of cells) cell.setAttribute('role', 'cell');
  e.append(...cells);
  return e;
}
let first = -1, last = -1;
function draw(force) {
  const from = Math.max(0, Math.floor(list.scrollTop / height) - 5),
    to = Math.min(shown.length, Math.ceil((list.scrollTop + list.clientHeight) / height) + 5);
  if (!force && from === first && to === last) return;
  [first, last] = [from, to];
  const focused = document.activeElement?.dataset?.row;
  space.replaceChildren(...shown.slice(from, to).map((row, i) => rowOf(row, from + i)));
  if (focused !== undefined) space.querySelector(`[data-row="${focused}"]`)?.focus({ preventScroll: true });
}
function choose() {
  const wanted = find.value.toLowerCase().split(/\s+/).filter(Boolean);
  shown = [];
  for (let i = 0; i < rows.length; ++i)
    if ((state < 0 || rows[i][STATE] === state) && wanted.every(w => texts[i].includes(w))) shown.push(i);
  if (column >= 0) {
    const sign = down ? -1 : 1, value = i => rows[i][column];
    shown.sort((a, b) => {
      const x = value(a), y = value(b);
      if (x === null || y === null) return (x === null) - (y === null);
      return sign * (typeof x === 'string' ? x.localeCompare(y, 'en', { numeric: true }) : x - y) || a - b;
    });
  }
  space.style.height = shown.length * height + 'px';
  list.setAttribute('aria-rowcount', shown.length + 1);
  document.getElementById('count').textContent = shown.length.toLocaleString('en') + ' shown';
  for (const b of document.querySelectorAll('[data-state]'))
    b.setAttribute('aria-pressed', Number(b.dataset.state) === state);
  for (const b of document.querySelectorAll('[data-column]')) {
    const by = Number(b.dataset.column) === column;
    b.parentElement.setAttribute('aria-sort', !by ? 'none' : down ? 'descending' : 'ascending');
    b.firstElementChild.textContent = !by ? '' : down ? ' ▾' : ' ▴';
  }
  list.scrollTop = 0;
  draw(true);
}
const dialog = document.querySelector('dialog');
function files(title, names, links) {
  const part = document.createDocumentFragment();
  if (!names.length) return part;
  const items = make('ul');
  for (const [text, link] of names) {
    const item = make('li');
    if (links) { const a = make('a', '', text); a.href = link; item.append(a); } else item.textContent = text;
    items.append(item);
  }
  part.append(make('h3', '', title), items);
  return part;
}
function open(i) {
  const r = rows[i], close = make('button', '', 'Close');
  close.onclick = () => dialog.close();
  const how = states[r[STATE]] + (r[REASON] ? ': ' + r[REASON] : '');
  dialog.replaceChildren(make('h2', '', r[NAME]), make('p', levelOf(r), how),
    make('pre', '', 'cotan ' + r[COMMAND]));
  if (r[SAID]) dialog.append(make('h3', '', 'Printed output'), make('pre', '', r[SAID]));
  dialog.append(files('Outputs', r[OUTPUTS], true), files('Inputs', r[INPUTS].map(n => [n]), false), close);
  dialog.showModal();
}
list.addEventListener('scroll', () => draw(false), { passive: true });
list.addEventListener('click', e => { const row = e.target.closest('.row'); if (row) open(row.dataset.row); });
list.addEventListener('keydown', e => {
  const row = e.target.closest('.row');
  if (!row) return;
  if (e.key === 'Enter' || e.key === ' ') { e.preventDefault(); open(row.dataset.row); }
  if (e.key === 'ArrowDown' && row.nextElementSibling) { e.preventDefault(); row.nextElementSibling.focus(); }
  if (e.key === 'ArrowUp' && row.previousElementSibling) { e.preventDefault(); row.previousElementSibling.focus(); }
});
find.addEventListener('input', choose);
document.querySelector('header').addEventListener('click', e => {
  const b = e.target.closest('[data-state]');
  if (b) { state = state === Number(b.dataset.state) ? -1 : Number(b.dataset.state); choose(); }
});
document.querySelector('.head').addEventListener('click', e => {
  const b = e.target.closest('[data-column]');
  if (!b) return;
  const c = Number(b.dataset.column);
  if (c !== column) { column = c; down = c !== NAME; }
  else if (down === (c !== NAME)) down = !down;
  else { column = -1; down = true; }
  choose();
});
new ResizeObserver(() => draw(true)).observe(list);
choose();
)";

constexpr std::size_t kMaxOutput = 1500; // bytes of output shown for a successful job; others show all that was kept

// A path as the URL of a link.
std::string link(const std::string& path)
{
    std::string text;
    for (const char c : path)
        if (isLetter(c) || isDigit(c) || std::string_view("-_./~").find(c) != std::string_view::npos)
            text += c;
        else
            text += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return text;
}

Json rowOf(const JobList& list, const JobResult& result, const fs::path& folder)
{
    const JobRecord& r = result.record;
    const Job& job = list.jobs[result.job];
    const Thumbnail& t = r.thumbnail;
    const bool bad = r.state > JobState::limit;
    auto outputs = Json::array(), inputs = Json::array();
    for (const FileState& output : r.outputs) {
        const fs::path path = (list.folder / output.file).lexically_normal();
        const fs::path relative = path.lexically_relative(folder);
        outputs.push_back({output.file, link((relative.empty() ? path : relative).string())});
    }
    for (const FileState& input : r.inputs)
        inputs.push_back(input.file);
    return {job.name,
            int(r.state),
            r.degrees ? Json(r.degrees->mean) : nullptr,
            r.degrees ? r.degrees->of : "",
            std::round(r.seconds * 1000) / 1000,
            std::round(r.megabytes),
            commandLine(job.words),
            r.reason,
            bad || r.output.size() <= kMaxOutput ? r.output : r.output.substr(0, kMaxOutput) + "...",
            outputs,
            inputs,
            t.jpeg.empty() ? nullptr : Json({t.width, t.height, t.jpeg}),
            result.kept ? 1 : 0};
}

// Escapes JSON for a script element: no text in it may end the element.
std::string scriptJson(const Json& data)
{
    const std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text)
        if (c == '<')
            safe += "\\u003c";
        else
            safe += c;
    return safe;
}

} // namespace

std::string batchPage(const JobList& list, const std::vector<JobResult>& results, const std::string& title,
                      const std::string& footer, const fs::path& folder, std::size_t maxRows)
{
    Json data;
    for (const char* member : {"states", "bad", "warn", "rows"})
        data[member] = Json::array();
    const StateCounts counts = countsOf(results);
    std::string buttons, heads, more;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        data["states"].push_back(name(JobState(i)));
        if (i > 0)
            data[JobState(i) > JobState::skipped ? "bad" : "warn"].push_back(i);
        if (counts[i] > 0) // worst first
            buttons =
                fmt::format("<button data-state=\"{}\">{} {}</button>", i, counts[i], name(JobState(i))) + buttons;
    }
    for (const auto& [column, text, className] : {std::tuple(0, "Job", ""),
                                                  {1, "State", ""},
                                                  {2, "Degrees", "number"},
                                                  {4, "Seconds", "number wide"},
                                                  {5, "MiB", "number wide"}})
        heads += fmt::format(
            "<div role=\"columnheader\" class=\"{}\"><button data-column=\"{}\">{}<span></span></button></div>",
            className, column, text);
    std::vector<std::size_t> order = worstFirst(results);
    if (order.size() > maxRows) {
        more = fmt::format("the worst {} of {}; ", maxRows, order.size());
        order.resize(maxRows);
    }
    for (const std::size_t i : order)
        data["rows"].push_back(rowOf(list, results[i], folder));
    const std::string safeTitle = escapeHtml(title);
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>"
        + safeTitle + "</title>\n<style>" + std::string(kStyle) + "</style>\n</head>\n<body>\n<header>\n<h1>"
        + safeTitle + "</h1>\n<div class=\"tools\">" + buttons
        + "<input id=\"find\" type=\"search\" placeholder=\"find in names, commands, reasons\" aria-label=\"find\">"
          "<span id=\"count\" aria-live=\"polite\"></span></div>\n</header>\n"
          "<noscript><p>This page needs JavaScript; <code>--json</code> writes the same data.</p></noscript>\n"
          "<div class=\"row head\" role=\"row\"><div></div>"
        + heads + "</div>\n<div id=\"list\" role=\"table\" aria-label=\"jobs, worst first\">"
        + "<div id=\"space\" role=\"rowgroup\"></div></div>\n<footer>" + escapeHtml(more + footer) + "</footer>\n"
        + "<dialog></dialog>\n<script type=\"application/json\" id=\"data\">" + scriptJson(data) + "</script>\n<script>"
        + std::string(kScript) + "</script>\n</body>\n</html>\n";
}

} // namespace cotan::app
