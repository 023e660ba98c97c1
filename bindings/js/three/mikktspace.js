// Tangents as mikktspace.h makes them, generated when a model is loaded.
import { BufferAttribute } from 'three';
import { eachFan, fansOf } from './fans.js';
import { withVertices } from './gathered.js';
import { meshOf } from './mesh_data.js';
import { combine, cross, dot, flatten, normalise, readEdges, uvArea } from './vectors.js';

const kFew = 32; // corners of a vertex that are searched one by one

// Triangles as seen from the corners of fans.list. sides: 1 if uv run counterclockwise, -1 if clockwise, 0 if they have no
// area, NaN without area in space. vectors: dP/du in the plane of the normal, of length 1, and the corner's angle there.
function trianglesOf(mesh, { list }) {
  const sides = new Float32Array(list.length), vectors = new Float64Array(4 * list.length), e = new Float64Array(10), n = new Float64Array(3), work = new Float64Array(3);
  const zero = (a, b, p, q) => { combine(work, 0, e, a, p, e, b, q); return !dot(work, 0, work, 0); };
  for (let k = 0, t = 0; k < list.length; ++k, t += 4) {
    readEdges(e, mesh, list[k]);
    const area = uvArea(e), side = zero(0, 0, 1, 0) || zero(3, 3, 1, 0) || zero(0, 3, 1, -1) || !Number.isFinite(area) ? NaN : Math.sign(area);
    combine(vectors, t, e, 0, e[9] * side, e, 3, -e[7] * side);
    sides[k] = side && (!dot(vectors, t, vectors, t) || zero(3, 0, e[6], -e[8])) ? 0 : side;
    combine(n, 0, mesh.normal, 3 * mesh.corners[list[k]], 1, n, 0, 0);
    normalise(n, 0);
    flatten(vectors, t, n, 0);
    normalise(vectors, t);
    flatten(e, 0, n, 0);
    flatten(e, 3, n, 0);
    cross(work, 0, e, 0, e, 3);
    vectors[t + 3] = Math.atan2(Math.sqrt(dot(work, 0, work, 0)), dot(e, 0, e, 3));
  }
  return { sides, vectors };
}

// A function that gives, for index k of fans.list, the index of the corner at the same vertex whose triangle is across the
// edge to the next vertex (step 1) or to the previous one (step 2), or -1.
function neighboursOf({ corners }, { first, starts, list }, sides) {
  const ends = [1, 2].map(() => new Int32Array(list.length).fill(-1)), large = new Map();
  for (let k = 0; k < list.length; ++k) {
    const c = list[k], f = c - c % 3;
    for (let step = 0; step < 2 && !Number.isNaN(sides[k]); ++step) ends[step][k] = first[corners[f + (c + 1 + step) % 3]];
  }
  return (k, step) => {
    const vertex = first[corners[list[k]]], begin = starts[vertex], end = starts[vertex + 1], wanted = ends[step - 1][k], others = ends[2 - step];
    if (end - begin <= kFew) {
      for (let j = begin; j < end; ++j) if (j !== k && others[j] === wanted) return j;
      return -1;
    }
    const key = 2 * vertex + step;
    if (!large.has(key)) large.set(key, new Map(Array.from(others.subarray(begin, end), (other, i) => [other, begin + i]).reverse()));
    return large.get(key).get(wanted) ?? -1;
  };
}

// For each corner of fans.list: x y z w, with w * cross(normal, xyz) along increasing v. Corners at a vertex share a
// tangent if their triangles are connected over edges and turn their uv to the same side. Triangles without area in uv belong
// to the side that reaches them first; triangles without area in space get the tangent of the first other corner at the
// vertex. (1, 0, 0, -1) where there is none. Unlike in mikktspace.h, triangles with exactly opposite dP/du are averaged.
export function tangentsOf(mesh, fans) {
  const { list, at } = fans, { sides, vectors } = trianglesOf(mesh, fans), across = neighboursOf(mesh, fans, sides);
  const values = new Float64Array(4 * list.length), done = new Uint8Array(list.length), turned = new Int8Array(mesh.corners.length / 3), sum = new Float64Array(3), members = [];
  for (const c of fans.rising) {
    const start = at[c], side = sides[start];
    if (done[start] || !side) continue;
    members.length = 0;
    members.push(start);
    sum.fill(0);
    done[start] = 1;
    for (let m = 0; m < members.length; ++m) {
      const k = members[m];
      if (sides[k]) combine(sum, 0, sum, 0, 1, vectors, 4 * k, vectors[4 * k + 3]);
      for (let step = 1; step < 3; ++step) {
        const j = across(k, step);
        if (j < 0 || done[j]) continue;
        const triangle = (list[j] - list[j] % 3) / 3, own = sides[j] || (turned[triangle] ||= side);
        if (own !== side) continue;
        done[j] = 1;
        members.push(j);
      }
    }
    normalise(sum, 0);
    for (const k of members) {
      for (let i = 0; i < 3; ++i) values[4 * k + i] = sum[i];
      values[4 * k + 3] = side;
    }
  }
  eachFan(fans, (begin, end) => {
    for (let k = begin; k < end; ++k) {
      if (done[k]) continue;
      let other = begin;
      while (Number.isNaN(sides[k]) && other < end && Number.isNaN(sides[other])) ++other;
      values.set(Number.isNaN(sides[k]) && done[other] && other < end ? values.subarray(4 * other, 4 * other + 4) : [1, 0, 0, -1], 4 * k);
    }
  });
  return values;
}

// A copy of the geometry with packed tangents for the map's uv. Vertices whose corners have different tangents are split.
// against: whether w * cross(normal, xyz) runs against increasing v, as in glTF. The geometry must have positions, normals
// and this uv set.
export function withTangents(geometry, map, against) {
  const mesh = meshOf(geometry, map), { corners } = mesh, { position } = geometry.attributes;
  const fans = fansOf(mesh), values = packed(tangentsOf(mesh, fans)).array, more = new Map();
  const sources = Array.from({ length: position.count }, (_, k) => k), places = sources.map(() => -1); // by new vertex: the index into `values`
  const same = (a, b) => { for (let i = 0; i < 4; ++i) if (values[4 * a + i] !== values[4 * b + i]) return false; return true; };
  for (let c = 0; c < corners.length; ++c) {
    const old = corners[c], at = fans.at[c];
    if (places[old] < 0) places[old] = at;
    if (same(places[old], at)) continue;
    const key = `${old} ${values.subarray(4 * at, 4 * at + 4)}`;
    if (!more.has(key)) {
      more.set(key, sources.push(old) - 1);
      places.push(at);
    }
    corners[c] = more.get(key);
  }
  const tangents = new Int16Array(4 * sources.length);
  places.forEach((at, k) => {
    if (at < 0) return; // no triangle uses the vertex
    tangents.set(values.subarray(4 * at, 4 * at + 4), 4 * k);
    if (against) tangents[4 * k + 3] *= -1;
  });
  return withVertices(geometry, sources, sources.length > position.count && corners).setAttribute('tangent', new BufferAttribute(tangents, 4, true));
}

// Tangents in 8 bytes each instead of 16: within 0.003 degrees. values: x y z w, of any length.
export function packed(values) {
  for (let k = 0; k < values.length; k += 4) normalise(values, k);
  return new BufferAttribute(new Int16Array(values.map(x => Math.round(32767 * x))), 4, true);
}
