// A bumpy ring with a matrix, drawn as an instance by stock three.js and by cotan/three, and as a mesh with transformed
// vertices, which is the truth. For three_defaults_test.mjs.
import * as THREE from 'three';
import { untangle } from '/package/three/index.js';
import { withTangents } from '/package/three/mikktspace.js';

const kSize = 256;

function bumps(side) {
  const data = new Uint8Array(side * side * 4);
  for (let y = 0; y < side; ++y)
    for (let x = 0; x < side; ++x) {
      const slopes = [0.5 * Math.sin(x / 6), 0.4 * Math.cos(y / 9), 1], length = Math.hypot(...slopes);
      data.set([...slopes.map(c => Math.round(127.5 + 127.5 * c / length)), 255], 4 * (y * side + x));
    }
  const map = new THREE.DataTexture(data, side, side);
  map.minFilter = map.magFilter = THREE.LinearFilter;
  map.needsUpdate = true;
  return map;
}

function ring() {
  const geometry = new THREE.TorusGeometry(0.8, 0.35, 48, 96), { uv } = geometry.attributes;
  for (let k = 0; k < uv.count; ++k) uv.setXY(k, uv.getX(k) * 3 + 0.4 * uv.getY(k), uv.getY(k));
  geometry.computeTangents();
  return geometry;
}

// The ring with the matrix applied to its vertices, tangents and winding.
function moved(matrix) {
  const geometry = ring(), { position, normal, tangent } = geometry.attributes, { index } = geometry, side = Math.sign(matrix.determinant()), t = new THREE.Vector3();
  position.applyMatrix4(matrix);
  normal.applyNormalMatrix(new THREE.Matrix3().getNormalMatrix(matrix));
  for (let k = 0; k < tangent.count; ++k) {
    t.fromBufferAttribute(tangent, k).transformDirection(matrix);
    tangent.setXYZW(k, ...t, tangent.getW(k) * side);
  }
  for (let k = 0; side < 0 && k < index.count; k += 3) {
    const second = index.getX(k + 1);
    index.setX(k + 1, index.getX(k + 2));
    index.setX(k + 2, second);
  }
  return geometry;
}

// Returns, for each frame, the mean angle in degrees to the truth, and to the truth turned inside out.
export function measure() {
  const renderer = new THREE.WebGLRenderer(), target = new THREE.WebGLRenderTarget(kSize, kSize, { type: THREE.FloatType }), map = bumps(128);
  const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 100);
  camera.position.set(0.6, 0.8, 3.2);
  camera.lookAt(0, 0, 0);
  const material = () => {
    const made = new THREE.MeshStandardMaterial({ normalMap: map, side: THREE.DoubleSide });
    made.onBeforeCompile = shader => { shader.fragmentShader = shader.fragmentShader.replace(/\}\s*$/, 'gl_FragColor = vec4( normalize( normal ), 1.0 );\n}'); };
    return made;
  };
  const draw = object => {
    renderer.setRenderTarget(target);
    renderer.setClearColor(0, 0);
    renderer.clear();
    renderer.render(new THREE.Scene().add(object), camera);
    const pixels = new Float32Array(kSize * kSize * 4);
    renderer.readRenderTargetPixels(target, 0, 0, kSize, kSize, pixels);
    return pixels;
  };
  const apart = (a, b) => {
    let sum = 0, count = 0;
    const p = new THREE.Vector3(), q = new THREE.Vector3();
    for (let k = 0; k < a.length; k += 4) {
      if (a[k + 3] < 0.5 || b[k + 3] < 0.5) continue;
      sum += THREE.MathUtils.radToDeg(p.fromArray(a, k).angleTo(q.fromArray(b, k)));
      ++count;
    }
    return count > 10000 ? sum / count : NaN;
  };
  const instance = (matrix, frame) => {
    const made = new THREE.InstancedMesh(ring(), material(), 1);
    made.setMatrixAt(0, matrix);
    if (frame) untangle(made, { frame });
    return made;
  };
  const turn = new THREE.Matrix4().makeRotationY(0.4), found = {};
  for (const [name, matrix] of [['upright', turn], ['mirrored', turn.clone().multiply(new THREE.Matrix4().makeScale(-1, 1, 1))]]) {
    const truth = draw(new THREE.Mesh(moved(matrix), material())), inside = truth.map((value, k) => (k % 4 === 3 ? value : -value));
    found[name] = Object.fromEntries(['stock', 'orthonormal', 'cotangent', 'smooth', 'triangle'].map(frame => {
      const drawn = draw(instance(matrix, frame === 'stock' ? undefined : frame));
      return [frame, { truth: apart(drawn, truth), inside: apart(drawn, inside) }];
    }));
  }
  return found;
}

// Numbers of geometries that the renderer holds: with tangents, after untangle(), and after the caller's geometry is
// disposed of.
export function heldGeometries(frame) {
  const renderer = new THREE.WebGLRenderer(), camera = new THREE.PerspectiveCamera(40, 1, 0.1, 100), geometry = ring();
  const mesh = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ normalMap: bumps(16) })), scene = new THREE.Scene().add(mesh), held = [];
  camera.position.z = 3;
  const count = () => { renderer.render(scene, camera); held.push(renderer.info.memory.geometries); };
  count();
  untangle(mesh, { frame });
  count();
  geometry.dispose();
  held.push(renderer.info.memory.geometries);
  renderer.dispose();
  return held;
}

// A coarse sphere of a glTF, upright and with a mirrored matrix: what untangle() decides, and degrees from the same sphere
// whose vertices are transformed and which came with MikkTSpace tangents. stored: the sphere comes with tangents in floats,
// which `kept` spoils, so that they stay: one vertex has the other w. Both spheres have one geometry if `shared`, else each its own; in either
// case they are decided about in one call.
export function coarseSpheres({ stored = false, shared = false, kept = false } = {}) {
  const renderer = new THREE.WebGLRenderer(), target = new THREE.WebGLRenderTarget(kSize, kSize, { type: THREE.FloatType }), camera = new THREE.PerspectiveCamera(40, 1, 0.1, 100);
  camera.position.set(0.8, 1, 3.2);
  camera.lookAt(0, 0, 0);
  const map = bumps(128), sphere = () => new THREE.BufferGeometry().copy(new THREE.SphereGeometry(1, 10, 6)), found = [];
  const withFloats = geometry => {
    const made = withTangents(geometry, map, true).clone(), { tangent } = made.attributes;
    const array = Float32Array.from({ length: 4 * tangent.count }, (_, k) => tangent.getComponent(k >> 2, k % 4));
    for (let k = 3; kept && k < array.length; k += 8) array[k] *= -1;
    return made.setAttribute('tangent', new THREE.BufferAttribute(array, 4));
  };
  const loaded = () => (stored ? withFloats(sphere()) : sphere());
  map.userData.mimeType = 'image/png';
  const material = green => new THREE.MeshStandardMaterial({ normalMap: map, normalScale: new THREE.Vector2(1, green) });
  const draw = mesh => {
    const { onBeforeCompile: before } = mesh.material;
    mesh.material.onBeforeCompile = (shader, given) => {
      before.call(mesh.material, shader, given);
      shader.fragmentShader = shader.fragmentShader.replace(/\}\s*$/, 'gl_FragColor = vec4( normalize( normal ), 1.0 );\n}');
    };
    renderer.setRenderTarget(target);
    renderer.setClearColor(0, 0);
    renderer.clear();
    renderer.render(new THREE.Scene().add(mesh), camera);
    const pixels = new Float32Array(kSize * kSize * 4);
    renderer.readRenderTargetPixels(target, 0, 0, kSize, kSize, pixels);
    return pixels;
  };
  for (const frame of [undefined, 'orthonormal']) {
    const one = loaded(), sides = [1, -1];
    const meshes = sides.map(side => {
      const mesh = new THREE.Mesh(shared ? one : loaded(), material(stored ? 1 : -1)); // green as the loader leaves it
      mesh.scale.x = side;
      return mesh;
    });
    const decisions = untangle(new THREE.Group().add(...meshes), { frame, note() {} });
    meshes.forEach((mesh, which) => {
      const truth = sphere(), { attributes: { position, normal }, index } = truth, side = sides[which];
      for (let k = 0; k < position.count; ++k) {
        position.setX(k, position.getX(k) * side);
        normal.setX(k, normal.getX(k) * side);
      }
      if (side < 0) index.array.reverse(); // winding
      const reference = withFloats(truth), given = withFloats(sphere());
      // What the file means where its tangents are wrong: its w, of a mirrored tangent.
      if (kept) for (let k = 0; k < position.count; ++k) reference.attributes.tangent.setXYZW(k, ...[side, 1, 1, side].map((s, i) => s * given.attributes.tangent.getComponent(k, i)));
      const expected = draw(new THREE.Mesh(reference, material(1))), drawn = draw(mesh), degrees = [];
      for (let k = 0; k < drawn.length; k += 4)
        if (drawn[k + 3] > 0.5 && expected[k + 3] > 0.5) degrees.push(THREE.MathUtils.radToDeg(new THREE.Vector3().fromArray(drawn, k).angleTo(new THREE.Vector3().fromArray(expected, k))));
      found.push({ side, frame: decisions[which].keepsTangents ? 'tangents' : decisions[which].frame, count: degrees.length, mean: degrees.reduce((sum, x) => sum + x, 0) / degrees.length });
    });
  }
  return found;
}
