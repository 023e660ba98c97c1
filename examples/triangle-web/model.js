// The models that both pages draw. Vertex k is the provoking vertex of triangle k: its first corner in WebGPU, its last
// in WebGL. Positions are relative to the eye, which looks along -z; v runs down.

// Two sheets with sheared texture coordinates, mirrored on their left halves; the right sheet is seen from behind.
// `number` orders the six vertices that the four triangles of a sheet share so that the four provoking ones come first.
function sheets(provoking) {
  const positions = new Float32Array(36), normals = new Float32Array(36), texcoords = new Float32Array(24), indices = [];
  const number = (sheet, i) => (i < 4 ? 4 * sheet + i : 4 + 2 * sheet + i);
  [[-1.2, 0.4], [1.2, Math.PI - 0.4]].forEach(([middle, angle], sheet) => {
    const c = Math.cos(angle), s = Math.sin(angle);
    for (let i = 0; i < 6; ++i) {
      const x = (i >> 1) - 1, y = i % 2 ? -1 : 1, k = number(sheet, i);
      positions.set([middle + c * x, y, -4 - s * x], 3 * k);
      normals.set([s, 0, c], 3 * k);
      texcoords.set([Math.abs(x) + (1 - y) / 2, 1 - y], 2 * k);
    }
  });
  for (const sheet of [0, 1])
    for (const [a, b, c] of [[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 5, 4]])
      indices.push(...(provoking === 'last' ? [b, c, a] : [a, b, c]).map(i => number(sheet, i)));
  return { positions, normals, texcoords, indices: new Uint32Array(indices) };
}

// The first primitive of a .glb, moved and scaled into view, without its nodes and materials. provoking: 'first' or
// 'last' if the file must have been written by `cotan convert --provoking`.
function readGlb(buffer, provoking) {
  const view = new DataView(buffer);
  if (buffer.byteLength < 20 || view.getUint32(0, true) !== 0x46546C67) throw new Error('expected a .glb file');
  const length = view.getUint32(12, true);
  const root = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 20, length)));
  const read = index => {
    const a = root.accessors[index], v = root.bufferViews[a.bufferView];
    const width = { SCALAR: 1, VEC2: 2, VEC3: 3 }[a.type];
    const [size, get] = { 5121: [1, 'getUint8'], 5123: [2, 'getUint16'], 5125: [4, 'getUint32'], 5126: [4, 'getFloat32'] }[a.componentType];
    const from = 28 + length + (v.byteOffset || 0) + (a.byteOffset || 0), stride = v.byteStride || size * width;
    const values = a.componentType === 5126 ? new Float32Array(a.count * width) : new Uint32Array(a.count * width);
    for (let i = 0; i < values.length; ++i)
      values[i] = view[get](from + Math.floor(i / width) * stride + i % width * size, true);
    return values;
  };
  const { attributes, indices } = root.meshes[0].primitives[0];
  for (const needed of ['POSITION', 'NORMAL', 'TEXCOORD_0'])
    if (attributes[needed] === undefined) throw new Error('the model has no ' + needed);
  const mesh = { positions: read(attributes.POSITION), normals: read(attributes.NORMAL),
                 texcoords: read(attributes.TEXCOORD_0), indices: read(indices) };
  for (let k = 0; provoking && k < mesh.indices.length / 3; ++k)
    if (mesh.indices[3 * k + (provoking === 'last' ? 2 : 0)] !== k)
      throw new Error(`triangle ${k} does not own its ${provoking} vertex: write the model with cotan convert --provoking ${provoking}`);
  const p = mesh.positions, low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  p.forEach((x, i) => { low[i % 3] = Math.min(low[i % 3], x); high[i % 3] = Math.max(high[i % 3], x); });
  const scale = Math.min(5 / (high[0] - low[0]), 3 / (high[1] - low[1]));
  mesh.positions = p.map((x, i) => (x - (low[i % 3] + high[i % 3]) / 2) * scale - (i % 3 === 2 ? 4 : 0));
  return mesh;
}

// Draws the chosen model or shows the error. provoking: a function that returns the provoking argument of readGlb.
function drawChosen(provoking, show) {
  document.getElementById('model').onchange = async e => {
    const said = document.getElementById('said');
    said.textContent = '';
    try {
      load(readGlb(await e.target.files[0].arrayBuffer(), provoking()));
      show();
    } catch (problem) {
      said.textContent = problem.message;
    }
  };
}

// A normal map of four domes as in glTF: red along +u, green up the image, flat is (128, 128, 255).
const mapSize = 256;
const map = new Uint8Array(mapSize * mapSize * 4);
for (let row = 0; row < mapSize; ++row)
  for (let column = 0; column < mapSize; ++column) {
    const x = (column + 0.5) / mapSize * 4 % 2 - 1, down = (row + 0.5) / mapSize * 4 % 2 - 1;
    const inside = Math.hypot(x, down) < 0.8;
    const n = inside ? [x, -down, Math.sqrt(1 - x * x - down * down)] : [0, 0, 1];
    map.set([...n.map(c => Math.round(127 * c + 128)), 255], (row * mapSize + column) * 4);
  }

const zoom = 2.2; // the height of the view at distance 1 is 2/zoom
