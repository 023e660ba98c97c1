// Every line after the imports is wrong, and the compiler has to say so of each: see types_test.mjs.
import * as cotan from 'cotan';
import { tangents } from 'cotan/tangents';
import { untangent } from 'cotan/gltf-transform';
import { untangle } from 'cotan/three';
import { perturbedNormal } from 'cotan/three/tsl';

tangents({ positions: [0, 0, 0], normals: [0, 0, 1] });
tangents({ positions: [0, 0, 0], normals: [0, 0, 1], uvs: [0, 0] }, { kind: 'smooth' });
const words: Int16Array = cotan.packSmooth([0, 0, 1], [1, 0, 0], [0, 1, 0], { bytes: 4 });
cotan.shader({ language: 'basic' });
cotan.shader({ frame: 'triangle', stage: 'pixel' });
cotan.shader({ lang: 'wgsl' });
cotan.detect({ width: 1, height: 1, data: [128, 128, 255, 255] });
const green: 'left' = cotan.detect({ width: 1, height: 1, data: new Uint8Array(4) }).green;
const report: string = await cotan.convert(new Uint8Array());
cotan.lint('model.glb');
untangent({ report: (report) => report.unread_maps.length.toUpperCase() });
untangle({});
untangle({ scenes: [] }, { frame: 'mikktspace' });
untangle({ scenes: [] }, { convention: 'unity' });
untangle({ scenes: [] }, { fraem: 'smooth' });
untangle({ scenes: [] }, { maxDegrees: '1' });
untangle({ scenes: [] })[0]!.reason === 'fit';
cotan.lint(new Uint8Array(), { limit: '2' });
perturbedNormal('map.png');
perturbedNormal(undefined!, undefined, 'auto');
