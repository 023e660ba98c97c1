// The page around the numbers, which page.cpp puts in place of DATA.
#pragma once

constexpr const char* kPageText = R"page(<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<title>Stored and derived frames on a mesh that deforms</title>
<style>
body { font: 15px/1.45 system-ui, sans-serif; margin: 1.5rem auto; max-width: 72rem; padding: 0 1rem; color: #1d2733; background: #fff }
h1 { font-size: 1.35rem } h2 { font-size: 1.05rem; margin: 1.4rem 0 0.2rem }
.bar { position: sticky; top: 0; background: #fff; padding: 0.6rem 0; border-bottom: 1px solid #cbd3dc; display: flex; gap: 1.2rem; align-items: center; flex-wrap: wrap }
.bar input[type=range] { width: 20rem }
.row { display: grid; grid-template-columns: 1fr 1fr 1.25fr; gap: 1rem }
figure { margin: 0 } figcaption { font-size: 0.85rem; min-height: 2.6em }
svg { width: 100%; background: #f4f6f8; border-radius: 4px } svg text { font: 12px system-ui, sans-serif; fill: #1d2733 }
table { border-collapse: collapse; font-size: 0.85rem; width: 100% } td { padding: 0.05rem 0.3rem } td:last-child, td:nth-child(3) { text-align: right; font-variant-numeric: tabular-nums }
.key { display: inline-block; width: 1.4rem; height: 0; border-top: 3px solid; vertical-align: middle }
@media (max-width: 800px) { .row { grid-template-columns: 1fr } }
</style>
<h1>Stored and derived frames on a mesh that deforms</h1>
<p>A tube moves away from its rest pose. Its deformed surface is known exactly, and so is what a normal map makes of it. Colours and curves say by
how many degrees the perturbed normals are off. Stored tangents are carried along as engines do it; the others are derived from the positions of each pose.</p>
<div class="bar">
<label>time <input id="time" type="range" min="0" max="20" value="20"></label><output id="now"></output>
<button id="play">play</button>
<label>normals <select id="normals"><option value="1">derived from the pose</option><option value="0">carried along by the engine</option></select></label>
<label>on the right <select id="way"></select></label>
<svg viewBox="0 0 260 34" style="width:260px;background:none" id="scale" aria-label="colours from 0 to 28 degrees"></svg>
</div>
<div id="motions"></div>
<script>
const data = DATA;
const colors = ["#8a939e", "#c8321e", "#e59a1c", "#7b5bb5", "#1769c2", "#13856b"];
const stops = [[0, 38, 69, 110], [4, 47, 158, 158], [10, 242, 209, 92], [20, 226, 87, 43], [28, 120, 16, 16]];
function color(degrees, light) {
  let k = 1;
  while (k < stops.length - 1 && degrees > stops[k][0]) ++k;
  const a = stops[k - 1], b = stops[k], x = Math.min(1, (degrees - a[0]) / (b[0] - a[0]));
  return "rgb(" + [1, 2, 3].map(i => Math.round((a[i] + (b[i] - a[i]) * x) * light)).join() + ")";
}
const make = (name, attributes, parent) => {
  const e = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const key in attributes) e.setAttribute(key, attributes[key]);
  return parent.appendChild(e);
};
const byId = id => document.getElementById(id);
const {around, along, steps, ways, motions} = data, columns = around + 1;
for (let x = 0; x < 56; ++x) make("rect", {x: 4 + x * 4.4, y: 2, width: 4.6, height: 12, fill: color(x / 2, 1)}, byId("scale"));
for (const d of [0, 10, 20, 28]) make("text", {x: 4 + d * 8.8, y: 29, "text-anchor": d ? d == 28 ? "end" : "middle" : "start"}, byId("scale")).textContent = d + "\u00b0";
ways.forEach((w, i) => { if (i > 1) byId("way").add(new Option(w.name, i)); });
byId("way").value = 4;
const most = Math.ceil(Math.max(...motions.flatMap(m => m.means.flat(3))));
const rows = motions.map(m => {
  const row = document.createElement("section");
  row.innerHTML = `<h2>${m.name}</h2><div>${m.text}</div><div class="row"><figure><svg viewBox="0 0 600 540"></svg><figcaption></figcaption></figure>` +
    `<figure><svg viewBox="0 0 600 540"></svg><figcaption></figcaption></figure><div><svg viewBox="0 0 420 210"></svg><table></table></div></div>`;
  byId("motions").append(row);
  const [left, right, chart] = row.querySelectorAll("svg"), cells = around * along;
  const fill = svg => Array.from({length: cells}, () => make("polygon", {"stroke-width": 0.6}, svg));
  return {m, left: fill(left), right: fill(right), chart, captions: row.querySelectorAll("figcaption"), table: row.querySelector("table")};
});
function drawTube(polygons, points, errors) {
  const order = [];
  for (let j = 0; j < along; ++j)
    for (let i = 0; i < around; ++i) {
      const at = [j * columns + i, (j + 1) * columns + i, (j + 1) * columns + i + 1, j * columns + i + 1].map(k => points.slice(3 * k, 3 * k + 3));
      const a = [0, 1, 2].map(k => at[2][k] - at[0][k]), b = [0, 1, 2].map(k => at[3][k] - at[1][k]);
      const n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
      order.push({depth: at.reduce((s, p) => s + p[2], 0), at, light: 0.62 + 0.38 * Math.abs(n[2]) / (Math.hypot(...n) || 1), cell: j * around + i});
    }
  order.sort((a, b) => a.depth - b.depth);
  order.forEach((c, k) => {
    const fill = color((errors.charCodeAt(c.cell) - 35) / 2, c.light);
    polygons[k].setAttribute("points", c.at.map(p => p[0] + "," + p[1]).join(" "));
    polygons[k].setAttribute("fill", fill);
    polygons[k].setAttribute("stroke", fill);
  });
}
function draw() {
  const t = +byId("time").value, normals = +byId("normals").value, way = +byId("way").value;
  byId("now").textContent = (t / steps).toFixed(2);
  for (const {m, left, right, chart, captions, table} of rows) {
    drawTube(left, m.points[t], m.cells[normals][0][t]);
    drawTube(right, m.points[t], m.cells[normals][way - 1][t]);
    [1, way].forEach((w, i) => captions[i].textContent = `${ways[w].name}: ${m.means[normals][w][t].toFixed(2)} degrees in the mean. ${ways[w].text}`);
    const x = k => 34 + 376 * k / steps, y = d => 186 - 176 * d / most;
    chart.replaceChildren();
    for (let d = 0; d <= most; d += 4) {
      make("line", {x1: 34, x2: 410, y1: y(d), y2: y(d), stroke: "#d4dae1"}, chart);
      make("text", {x: 28, y: y(d) + 4, "text-anchor": "end"}, chart).textContent = d + "\u00b0";
    }
    make("line", {x1: x(t), x2: x(t), y1: 10, y2: 186, stroke: "#1d2733"}, chart);
    make("text", {x: 34, y: 204}, chart).textContent = "rest";
    make("text", {x: 410, y: 204, "text-anchor": "end"}, chart).textContent = "time, mean degrees";
    ways.forEach((w, i) => make("polyline", {fill: "none", stroke: colors[i], "stroke-width": i == 1 ? 4.5 : 2, "stroke-dasharray": i ? "none" : "3 3",
      points: m.means[normals][i].map((d, k) => x(k) + "," + y(d)).join(" ")}, chart));
    table.innerHTML = "<tr><td><td>degrees<td>mean<td>95 %</tr>" + ways.map((w, i) => `<tr><td><span class="key" style="color:${colors[i]}"></span><td>${w.name}` +
      `<td>${m.means[normals][i][t].toFixed(2)}<td>${m.most95[normals][i][t].toFixed(2)}</tr>`).join("");
  }
}
for (const id of ["time", "normals", "way"]) byId(id).addEventListener("input", draw);
let playing = 0;
byId("play").onclick = () => {
  clearInterval(playing);
  byId("play").textContent = playing ? "play" : "stop";
  playing = playing ? 0 : setInterval(() => { byId("time").value = (+byId("time").value + 1) % (steps + 1); draw(); }, 120);
};
draw();
</script>
</html>
)page";
