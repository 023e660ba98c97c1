// Every export of the package once, as its typings have it: compiled in strict mode by types_test.mjs, not run.
import * as cotan from 'cotan';
import * as beside from 'cotan/beside';
import * as small from 'cotan/tangents';
import * as smallBeside from 'cotan/tangents/beside';
import * as textures from 'cotan/textures';
import * as texturesBeside from 'cotan/textures/beside';
import { frames, lintNormals, provoking, tangents, untangent } from 'cotan/gltf-transform';
import { CotanError as ThreeError, replaceFrame, untangle, untangled, type Candidate, type Decision, type Frame, type LoadedModel, type UntangleOptions } from 'cotan/three';
import { addRelief, type ReliefOptions, type WithRelief } from 'cotan/three/relief';
import * as tsl from 'cotan/three/tsl';
import { addRelief as addReliefToNodes } from 'cotan/three/tsl/relief';
import { Untangled, useUntangled, type UntangledProps, type UseUntangledOptions } from 'cotan/react';
import { Document, type Transform } from '@gltf-transform/core';
import { Material, MeshStandardMaterial, Object3D, Texture } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

await Promise.all([cotan.ready, beside.ready, small.ready, smallBeside.ready]);
const version: string = cotan.version();

// Tangents
const mesh: small.Mesh = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], normals: new Float32Array(9), uvs: [0, 0, 1, 0, 0, 1], indices: [0, 1, 2] };
const corners: Float32Array = small.tangents(mesh, { kind: 'vertex' });
const { u, v }: { u: Float32Array; v: Float32Array } = smallBeside.smooth(mesh);
const onTriangles = cotan.triangles(mesh);
const { sources, indices }: cotan.Split = cotan.split(3, [0, 1, 2], corners);
const mirrored: Uint32Array = beside.splitMirrored(mesh).indices;
const words: Uint32Array = cotan.packTriangles(onTriangles.u, onTriangles.v);
const eight: Int16Array = cotan.packSmooth(mesh.normals, u, v);
const four: Uint32Array = cotan.packSmooth(mesh.normals, u, v, { bytes: 4 });
const two: Uint16Array = cotan.packTangents(mesh.normals, corners);
const provoked: Uint32Array = cotan.provoking(3, indices, { vertex: 'last' }).corners;

// Maps
const picture: cotan.Image = await cotan.decodePng(new Uint8Array());
const read: cotan.Image & { bits: number } = await cotan.decodeImage(new Uint8Array(), 'map.jpg');
const file: Uint8Array = await cotan.encodePng(read);
const green: 'up' | 'down' | 'unknown' = cotan.detect(picture).green;
const zero: 127 | 128 | null = cotan.info(picture).zero;
const blocks: { bytes: Uint8Array; levels: number } = textures.texture(picture, { from: 'gltf', to: 'gltf,xy', compress: 'eac-rg11', mips: false });
const lost: number | undefined = texturesBeside.texture(picture, { compress: 'uastc', container: 'ktx2', swizzle: 'auto' }).degrees?.mean;
const bits: cotan.Bits = 16, convention: cotan.Convention = 'unity,xyz';
const other: cotan.Image = cotan.convertMap(picture, { from: convention, to: 'gltf', bits });
const blended: cotan.Image = cotan.blend(picture, other, { mode: 'whiteout', strength: 0.5 });
const made: cotan.Image = cotan.fromHeight(blended, { scale: [1, 2] });
const heights: Float32Array = cotan.toHeight(made, { from: 'directx' }).data;
const roughness: cotan.Image | undefined = cotan.mips(made, { roughness: 0.2 })[0]?.roughness;

// The names of version 0.2, in this version only
const old: cotan.Picture = await cotan.decodePicture(new Uint8Array()), oldPlaces: cotan.Places = { normals: [], dpdx: [], dpdy: [], duvdx: [], duvdy: [] };
const oldVertexPlaces: cotan.VertexPlaces = { normals: [], tangents: [] }, stillRead: cotan.Image[] = [old];

// Frames, shaders
const points: cotan.SurfacePoints = { normals: [0, 0, 1], dpdx: [1, 0, 0], dpdy: [0, 1, 0], duvdx: [1, 0], duvdy: [0, 1] };
const atVertices: cotan.InterpolatedPoints = { normals: [0, 0, 1], tangents: [1, 0, 0, 1] };
const normals: Float32Array = cotan.apply('cotangent', points, [0, 0, 1]), texels: Float32Array = cotan.encode('mikktspace', atVertices, normals);
const names: string[] = cotan.frames();
const text: string = cotan.shader({ language: 'wgsl', frame: 'triangle', convention: 'gltf', stage: 'vertex' });

// Models
const options: cotan.ModelOptions = { files: { 'scene.bin': new ArrayBuffer(4) }, decode: async () => read, progress: (done) => done < 0.5 };
const judged: cotan.LintReport = await cotan.lint(file, { ...options, distance: 2, limit: 2, limitArea: 10, frame: 'smooth' });
const over: cotan.OverLimit[] = [...judged.over_limit, ...cotan.overLimits(judged, { limit: 1 } satisfies cotan.Limits)];
const { glb, report } = await cotan.convert(file, { ...options, to: 'smooth', bits: 8, keepTangents: true, encode: async () => file });
const unread: cotan.UnreadMap[] = report.unread_maps, advice: string | undefined = unread[0]?.advice, notes: string[] = (report satisfies cotan.ConvertReport).notes;
try {
  cotan.shader();
} catch (error) {
  if (error instanceof cotan.CotanError && error.code === 'input') console.log(error.file, error.field, error.expected, error.found);
}

// glTF-Transform
const all: Transform[] = [tangents({ kind: 'mikktspace', overwrite: true }), untangent({ to: 'cotangent', unsigned: 'exact', report: (r) => r.unread_maps.map((map) => map.name) }),
  lintNormals({ limit: 2, frame: 'stored', report: (r) => r.over_limit.map(({ mesh, degrees, limit }) => [mesh, degrees, limit]).join() }), provoking({ vertex: 'first' })];
await new Document().transform(...all);
const known: string[] = frames();

// three.js
const frame: Frame = 'smooth', wanted: UntangleOptions = { frame, maxDegrees: 0.5, convention: 'directx', note: (line) => console.log(line.length) };
if (wanted instanceof ThreeError || wanted instanceof tsl.CotanError) throw wanted;
const model: LoadedModel = await new GLTFLoader().register(untangled(wanted)).loadAsync('model.glb');
const object = new Object3D(), decided: Decision[] = untangle(model, wanted), stay: string[] = untangle(object).filter((one) => one.keepsTangents).map(({ mesh, why }) => mesh.name + (why ?? ''));
const measured: Candidate | undefined = decided[0]?.candidates[0], kept: Decision[] = model.userData?.cotan ?? [];
const material: MeshStandardMaterial = replaceFrame(new MeshStandardMaterial(), { frame: 'orthonormal', against: true, from: new Material() });
tsl.untangle(object, { frame: 'cotangent', maxDegrees: 1 } satisfies tsl.UntangleNodesOptions).map(({ reason }) => reason);
tsl.replaceFrame(material, { against: false });
new GLTFLoader().register(tsl.untangled());
const node = tsl.perturbedNormal(new Texture());
const deep: ReliefOptions = { heightMap: new Texture(), heightDepth: 0.05, heightSteps: 32, selfShadow: false }, raised: WithRelief<MeshStandardMaterial> = addRelief(material, deep);
addReliefToNodes(raised, { heightMap: new Texture(), heightDepth: 1 }).heightMap = null;

// react-three-fiber
const inReact: UseUntangledOptions = { maxDegrees: 1, untangle: tsl.untangle }, properties: UntangledProps = { object, frame: 'smooth', onDecided: (all) => console.log(all.length), dispose: null, scale: 2 };
const shown = Untangled(properties), inHook: Decision[] = useUntangled(model, inReact), ofRef: Decision[] = useUntangled({ current: object }), ofNothing: Decision[] = useUntangled(null);

export { shown, inHook, ofRef, ofNothing, version, sources, mirrored, words, eight, four, two, provoked, green, zero, heights, roughness, texels, names, text, judged, over, glb, advice, notes, known, stay, measured, kept, node };
