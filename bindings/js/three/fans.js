// The corners of triangles around each vertex, across copies of the vertex.

// For each vertex: the first vertex that has the same position, normal and uv.
export function welded({ position, normal, uv }) {
  const count = position.length / 3, size = 2 ** Math.ceil(Math.log2(2 * count + 2)), table = new Int32Array(size).fill(-1);
  const first = new Uint32Array(count), keys = new Float32Array(8 * count), bits = new Uint32Array(keys.buffer);
  for (let k = 0; k < count; ++k) {
    const key = 8 * k;
    for (let i = 0; i < 3; ++i) {
      keys[key + i] = position[3 * k + i] + 0; // -0 becomes 0
      if (normal) keys[key + 3 + i] = normal[3 * k + i] + 0;
      if (i < 2) keys[key + 6 + i] = uv[2 * k + i] + 0;
    }
    let hash = 0, slot;
    for (let i = 0; i < 8; ++i) hash = Math.imul(hash ^ bits[key + i], 0x9e3779b1) ^ hash >>> 15;
    for (slot = hash & size - 1; table[slot] >= 0; slot = slot + 1 & size - 1) {
      const other = 8 * table[slot];
      let i = 0;
      while (i < 8 && keys[other + i] === keys[key + i]) ++i;
      if (i === 8) break;
    }
    if (table[slot] < 0) table[slot] = k;
    first[k] = table[slot];
  }
  return first;
}

// { first, starts, list, at, rising } for the vertices of the corners in `wanted`, or for all. first: as from welded(). The
// corners at vertex v = first[corners[c]] are list[starts[v]] to list[starts[v + 1] - 1], in rising order; list[at[c]] is c.
// rising: all these corners, in rising order.
export function fansOf(mesh, wanted) {
  const { corners } = mesh, first = mesh.first ??= welded(mesh), count = first.length, flags = new Uint8Array(count);
  for (const c of wanted ?? corners.keys()) flags[first[corners[c]]] = 1;
  const starts = new Uint32Array(count + 1), at = new Int32Array(corners.length), rising = [];
  for (let c = 0; c < corners.length; ++c) {
    const v = first[corners[c]];
    if (!flags[v]) continue;
    ++starts[v + 1];
    rising.push(c);
  }
  for (let v = 0; v < count; ++v) starts[v + 1] += starts[v];
  const list = new Uint32Array(starts[count]), next = starts.slice(0, count);
  for (const c of rising) list[at[c] = next[first[corners[c]]]++] = c;
  return { first, starts, list, at, rising };
}

// Calls work(begin, end) for each vertex that has corners.
export function eachFan({ starts }, work) {
  for (let v = 0; v + 1 < starts.length; ++v) if (starts[v + 1] > starts[v]) work(starts[v], starts[v + 1]);
}
