// Tangents as mikktspace.h makes them, generated when a model is loaded.
import { BufferAttribute, BufferGeometry } from 'three';
import { eachFan, fansOf } from './fans.js';
import { gathered } from './gathered.js';
import { cornersOf, numbersOf, transformedUv, uvNameOf } from './mesh_data.js';

const kEmpty = -1; // group of a corner: none yet
const kFew = 32;   // corners of a vertex that are searched one by one

// A triangle as seen from one of its corners: the uv's side, dP/du and the corner's angle in the plane of the normal.
// side: 1 if uv run counterclockwise, -1 if clockwise, 0 if they have no area; NaN without area in space.
const kTriangle = { side: 0, x: 0, y: 0, z: 0, angle: 0 };

function triangleAt({ corners, position, uv }, c, nx, ny, nz, out) {
  const f = c - c % 3, a = corners[c], b = corners[f + (c + 1) % 3], d = corners[f + (c + 2) % 3];
  let px = position[3 * b] - position[3 * a], py = position[3 * b + 1] - position[3 * a + 1], pz = position[3 * b + 2] - position[3 * a + 2];
  let qx = position[3 * d] - position[3 * a], qy = position[3 * d + 1] - position[3 * a + 1], qz = position[3 * d + 2] - position[3 * a + 2];
  const u1 = uv[2 * b] - uv[2 * a], v1 = uv[2 * b + 1] - uv[2 * a + 1], u2 = uv[2 * d] - uv[2 * a], v2 = uv[2 * d + 1] - uv[2 * a + 1];
  const area = u1 * v2 - v1 * u2, meets = (x, y, z) => x === 0 && y === 0 && z === 0;
  out.side = meets(px, py, pz) || meets(qx, qy, qz) || meets(px - qx, py - qy, pz - qz) || !Number.isFinite(area) ? NaN : Math.sign(area);
  let x = (v2 * px - v1 * qx) * out.side, y = (v2 * py - v1 * qy) * out.side, z = (v2 * pz - v1 * qz) * out.side;
  if (out.side && !(Math.abs(x) + Math.abs(y) + Math.abs(z) > 0)) out.side = 0;
  if (out.side && meets(u1 * qx - u2 * px, u1 * qy - u2 * py, u1 * qz - u2 * pz)) out.side = 0;
  const along = nx * x + ny * y + nz * z, scale = 1 / (Math.sqrt((x -= nx * along) * x + (y -= ny * along) * y + (z -= nz * along) * z) || 1);
  out.x = x * scale;
  out.y = y * scale;
  out.z = z * scale;
  const pn = nx * px + ny * py + nz * pz, qn = nx * qx + ny * qy + nz * qz;
  px -= nx * pn, py -= ny * pn, pz -= nz * pn, qx -= nx * qn, qy -= ny * qn, qz -= nz * qn;
  out.angle = Math.atan2(Math.hypot(py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx), px * qx + py * qy + pz * qz);
}

// For each corner of fans.list: x y z w, with w * cross(normal, xyz) along increasing v. Corners at a vertex share a
// tangent if their triangles are connected over edges and turn their uv to the same side. Triangles without area in uv join
// the first group that reaches them, for each vertex on its own; triangles without area in space get the tangent of another
// corner at the vertex. (1, 0, 0, 1) where there is none.
export function tangentsOf(mesh, fans) {
  const { corners, normal } = mesh, { first, list } = fans, values = new Float32Array(4 * list.length), group = [], sides = [], x = [], y = [], z = [], angles = [];
  const ends = [[], [], []];
  // Of a vertex: the function that gives the corner whose triangle is across corner i's edge to its next vertex (step 1) or
  // to its previous one (step 2), or -1.
  const neighbours = (begin, count) => {
    for (let i = 0; i < count; ++i) {
      const c = list[begin + i], f = c - c % 3;
      for (let step = 1; step < 3; ++step) ends[step][i] = Number.isNaN(sides[i]) ? -1 : first[corners[f + (c + step) % 3]];
    }
    if (count <= kFew) return (i, step) => {
      for (let j = 0; j < count; ++j) if (j !== i && ends[3 - step][j] === ends[step][i]) return j;
      return -1;
    };
    const found = [0, 1, 2].map(step => new Map(ends[step].slice(0, count).map((end, i) => [end, i]).reverse()));
    return (i, step) => found[3 - step].get(ends[step][i]) ?? -1;
  };
  eachFan(fans, (begin, end) => {
    const count = end - begin, vertex = 3 * corners[list[begin]];
    let nx = normal[vertex], ny = normal[vertex + 1], nz = normal[vertex + 2];
    const length = Math.hypot(nx, ny, nz) || 1;
    nx /= length, ny /= length, nz /= length;
    for (let i = 0; i < count; ++i) {
      triangleAt(mesh, list[begin + i], nx, ny, nz, kTriangle);
      sides[i] = kTriangle.side;
      x[i] = kTriangle.x;
      y[i] = kTriangle.y;
      z[i] = kTriangle.z;
      angles[i] = kTriangle.angle;
      group[i] = kEmpty;
    }
    const across = neighbours(begin, count);
    let valued = -1;
    for (let i = 0; i < count; ++i) {
      if (group[i] !== kEmpty || !sides[i]) continue;
      let sx = 0, sy = 0, sz = 0;
      const members = [i];
      group[i] = i;
      for (let m = 0; m < members.length; ++m) {
        const k = members[m];
        if (sides[k]) {
          sx += angles[k] * x[k];
          sy += angles[k] * y[k];
          sz += angles[k] * z[k];
        }
        for (let step = 1; step < 3; ++step) {
          const j = across(k, step);
          if (j < 0 || group[j] !== kEmpty || sides[j] && sides[j] !== sides[i]) continue;
          group[j] = i;
          members.push(j);
        }
      }
      const scale = 1 / (Math.hypot(sx, sy, sz) || 1);
      for (const k of members) {
        const at = 4 * (begin + k);
        values[at] = sx * scale;
        values[at + 1] = sy * scale;
        values[at + 2] = sz * scale;
        values[at + 3] = sides[i];
      }
      if (valued < 0) valued = i;
    }
    for (let k = 0; k < count; ++k)
      if (group[k] === kEmpty) values.set(valued < 0 ? [1, 0, 0, 1] : values.subarray(4 * (begin + valued), 4 * (begin + valued) + 4), 4 * (begin + k));
  });
  return values;
}

// A copy of the geometry with tangents for the map's uv. Vertices whose corners have different tangents are split.
// Attributes are copied if vertices were split, else shared. against: whether w * cross(normal, xyz) runs against
// increasing v, as in glTF. The geometry must have positions, normals and this uv set.
export function withTangents(geometry, map, against) {
  const { position, normal, [uvNameOf(map)]: uv } = geometry.attributes, corners = cornersOf(geometry);
  const mesh = { corners, position: numbersOf(position, 3), normal: numbersOf(normal, 3), uv: transformedUv(uv, map) };
  const fans = fansOf(mesh), values = tangentsOf(mesh, fans), bits = new Uint32Array(values.buffer);
  const sources = Array.from({ length: position.count }, (_, k) => k), from = new Int32Array(position.count).fill(-1), more = new Map();
  const same = (a, b) => { for (let i = 0; i < 4; ++i) if (bits[4 * a + i] !== bits[4 * b + i]) return false; return true; };
  const places = Array.from(from); // by new vertex: the index into `values`
  for (let c = 0; c < corners.length; ++c) {
    const old = corners[c], at = fans.at[c];
    if (places[old] < 0) places[old] = at;
    if (same(places[old], at)) continue;
    const key = `${old} ${bits.subarray(4 * at, 4 * at + 4)}`;
    if (!more.has(key)) {
      more.set(key, sources.push(old) - 1);
      places.push(at);
    }
    corners[c] = more.get(key);
  }
  const made = new BufferGeometry().copy(geometry);
  if (sources.length > position.count) {
    for (const name of Object.keys(made.attributes)) made.setAttribute(name, gathered(geometry.attributes[name], sources));
    for (const [name, targets] of Object.entries(geometry.morphAttributes)) made.morphAttributes[name] = targets.map(target => gathered(target, sources));
    made.setIndex(new BufferAttribute(sources.length > 65535 ? corners : Uint16Array.from(corners), 1));
  }
  const tangents = new Float32Array(4 * sources.length);
  places.forEach((at, k) => {
    if (at < 0) return; // no triangle uses the vertex
    tangents.set(values.subarray(4 * at, 4 * at + 4), 4 * k);
    if (against) tangents[4 * k + 3] *= -1;
  });
  return made.setAttribute('tangent', new BufferAttribute(tangents, 4));
}
