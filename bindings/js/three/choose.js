// Chooses the frame that reads a map without the tangents of its file, primitive by primitive, by measurement. The same rule
// as in the library (src/bake/lint/choose_frames.cpp).
import { ObjectSpaceNormalMap } from 'three';
import { degreesBetween, degreesOfGrooves, placesOf, Sample, summaryOf, texelsAt } from './candidates.js';
import { guessedFrame, isGrooved, mapOf, meansTangents, namedFrame, standsAlone } from './frames.js';
import { bitangentAreas, ofGltf } from './greens.js';
import { numbersOf, readingOf, turns, uvMatrixOf } from './mesh_data.js';
import { addStretch, pointsOfEach, surfaceOf } from './sampling.js';
import { texelsOf } from './texels.js';

const kCandidates = ['orthonormal', 'triangle', 'smooth', 'mikktspace']; // in the order of cost
const kFlattened = 1e-6; // factors on slopes below show nothing of a map
const kScales = { normalScale: 'normalMap', clearcoatNormalScale: 'clearcoatNormalMap' };

export const scalesOf = material => Object.entries(kScales).filter(([name]) => material[name]);

// The maps of a material that are read with the frame of mapOf(material), as [map, scale, name].
function mapsOf(material) {
  return scalesOf(material).filter(([name, map]) => material[map] && !standsAlone(material, material[map]) && (name !== 'normalScale' || material.normalMapType !== ObjectSpaceNormalMap))
    .map(([name, map]) => [material[map], material[name], name]);
}

// Meshes that draw the same triangles with the same material, and what is measured of them.
class Primitive {
  #samples = new Map(); // by the reading of a map
  meshes = [];
  stretches = [];

  constructor(mesh, material, group) {
    Object.assign(this, { geometry: mesh.geometry, material, group, stored: storedIn(mesh.geometry) });
  }

  add(mesh) {
    this.meshes.push(mesh);
    const { isInstancedMesh, isSkinnedMesh, matrixWorld, count } = mesh, one = matrixWorld.clone();
    if (isSkinnedMesh && mesh.skeleton && mesh.geometry.attributes.skinWeight) this.stretches[0] ??= mesh;
    else if (!isInstancedMesh || count < 1) addStretch(this.stretches, one);
    else for (let k = 0; k < count; ++k) {
      mesh.getMatrixAt(k, one);
      addStretch(this.stretches, one.premultiply(matrixWorld));
    }
  }

  // The points of the surface under a map. Null without uv. Tangents of a glTF belong to its uv before a transform.
  sampleFor(map, points) {
    const key = [readingOf(map), ofGltf(map)].join();
    if (!this.#samples.has(key)) {
      const { geometry, material, group, stored } = this, surface = surfaceOf(geometry, group, map, material.flatShading === true);
      this.#samples.set(key, surface && new Sample(surface, placesOf(surface, this.stretches, points), stored && numbersOf(stored, 4), ofGltf(map) && turns(map) && uvMatrixOf(map)));
    }
    return this.#samples.get(key);
  }
}

const generated = new WeakSet(); // geometries whose tangents were made here

// Says that the tangents of a geometry are no file's.
export const markGenerated = geometry => { generated.add(geometry); return geometry; };
// The tangents of the geometry that came with it.
export const storedIn = geometry => (generated.has(geometry) ? undefined : geometry.attributes.tangent);

// The primitives of all meshes, and what is decided about them.
export class Chooser {
  #primitives = new Map(); // by geometry, material and group
  #points;

  // meshes: with current world matrices. reasonAgainst(mesh, frame): why a mesh cannot have a frame; '' if it can.
  // warn: takes a line.
  constructor(meshes, limits, reasonAgainst, warn) {
    Object.assign(this, { limits, reasonAgainst, warn });
    for (const mesh of meshes)
      [mesh.material].flat().forEach((material, k) => {
        const key = keyOf(mesh, material, k);
        if (!this.#primitives.has(key)) this.#primitives.set(key, new Primitive(mesh, material, Array.isArray(mesh.material) ? k : undefined));
        this.#primitives.get(key).add(mesh);
      });
    this.#points = pointsOfEach(this.#primitives.size);
  }

  // { frame, keepsTangents, meaning, reason, candidates, why } for material k of a mesh; see Decision in index.d.ts.
  decide(mesh, material, k) {
    const primitive = this.#primitives.get(keyOf(mesh, material, k));
    return primitive.decision ??= this.#decided(primitive);
  }

  // The areas where stored bitangents run along and against increasing v of a map (bitangentAreas).
  areas(mesh, material, k, map) {
    const primitive = this.#primitives.get(keyOf(mesh, material, k)), found = primitive.stored && primitive.sampleFor(map, this.#points);
    return found?.usable ? found.areas ??= bitangentAreas(found) : { along: 0, against: 0, aligned: 0 };
  }

  #decided(primitive) {
    const { geometry, material, stored } = primitive, [first] = mapsOf(material), map = mapOf(material);
    const named = namedFrame(material, this.warn, geometry);
    const decision = (frame, meaning, reason, more) => ({ frame, keepsTangents: false, meaning, reason, candidates: [], ...more });
    if (!first && !isGrooved(material)) return decision(named ?? guessedFrame(geometry, map, stored), 'none', 'noMap');
    if (named && !meansTangents(material, geometry)) return decision(named, 'named', 'named');
    const guessed = first && guessedFrame(geometry, map, stored);
    if (first && guessed !== 'orthonormal') return decision(guessed, 'painted', 'painted');
    // Flat surfaces have no tangents in three, nor in glTF.
    const meaning = stored && material.flatShading !== true ? 'stored' : 'mikktspace';
    const kept = meaning === 'stored' ? { frame: 'mikktspace', keepsTangents: true } : {};
    const found = primitive.sampleFor(map, this.#points);
    const why = !found ? 'it has no texture coordinates' : !found.usable ? 'no triangle has an area both in space and in uv' : first && texelsOf(first[0]).why;
    if (why) return decision('orthonormal', meaning, 'notJudged', { ...kept, why });
    const few = this.#measureOf(primitive, found.few(), meaning), all = this.#measureOf(primitive, found, meaning), candidates = [], { limits } = this;
    // Some points tell if they are far from the limits.
    const measure = frame => {
      const first = few(frame);
      return 2 * first.mean <= limits.mean && first.maximum <= limits.percentile99 || first.mean > 4 * limits.mean ? first : all(frame);
    };
    for (const frame of kCandidates) {
      const against = primitive.meshes.map(mesh => this.reasonAgainst(mesh, frame)).find(Boolean);
      candidates.push({ frame, ...against ? { ...summaryOf([]), why: against } : measure(frame) });
      const { mean, percentile99 } = candidates.at(-1);
      if (mean <= limits.mean && percentile99 <= limits.percentile99) return decision(frame, meaning, 'fits', { candidates });
    }
    return decision('orthonormal', meaning, 'keeps', { ...kept, candidates });
  }

  // A function that compares a frame with what the maps mean: normals, and directions of anisotropy. The largest error counts
  // of those at each stretch and map.
  #measureOf(primitive, sample, meaning) {
    const { material } = primitive, map = mapOf(material);
    const shown = mapsOf(material).filter(([map, scale, name]) => Math.max(Math.abs(scale.x), Math.abs(scale.y)) > kFlattened
      && (name === 'normalScale' || material.clearcoat > 0) && !texelsOf(map).why);
    const areas = meaning === 'stored' && this.areas(primitive.meshes[0], material, primitive.group ?? 0, map), green = areas && shown.length ? greenAlongV(map, areas) : 1;
    const across = material.anisotropyRotation || material.anisotropyMap ? (areas.against > areas.along ? -1 : 1) : 0;
    let parts;
    return frame => {
      parts ??= sample.places.map(place => ({
        place, meant: sample.framesAt(place, meaning), texels: shown.map(([map, scale]) => texelsAt(place, map, texelsOf(map), scale.x, Math.abs(scale.y))),
      }));
      const found = parts.flatMap(({ place, meant, texels }) => {
        const frames = sample.framesAt(place, frame), errors = texels.map(one => degreesBetween(place, frames, meant, one, green));
        return [...errors, ...isGrooved(material) ? [degreesOfGrooves(place, frames, meant, across)] : []].map(summaryOf);
      });
      if (!found.length) return summaryOf([0]); // flattened
      return found.reduce((a, b) => ({ ...b.mean > a.mean ? b : a, percentile99: Math.max(a.percentile99, b.percentile99), maximum: Math.max(a.maximum, b.maximum) }));
    };
  }
}

const keyOf = ({ geometry, material: all }, material, k) => [geometry.uuid, material.uuid, Array.isArray(all) ? k : ''].join();

// 1 if green that stored bitangents show points along increasing v, else -1. Tangents of a glTF reverse what it declares if
// they contradict the uv on more than half of the area.
export function greenAlongV(map, { along, against, aligned }) {
  return ofGltf(map) ? (2 * aligned > along + against ? 1 : -1) : against > along ? -1 : 1;
}
