// The crate of scripts/bevy-crate, compiled by naga, which Bevy uses, and by tint in headless Chromium, which browsers use.
//   node bevy_test.mjs NODE_MODULES COTAN [CASE]
// Without Bevy's shaders, stand-ins declare the names that the crate imports. COTAN_BEVY: a git repository of Bevy; with
// it the shaders of Bevy 0.19.1 take their place, and integrations/bevy/19069.patch is applied to its commit.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { degrees, drawn, expected, eye, kBevy, kSheets, kStandIns, vertexShader } from './bevy_draw.mjs';
import { kGpuArguments, launch } from './chromium.mjs';
import { composed, declared, preprocessed } from './naga_oil.mjs';
import { emptyFolder, here, runCases, skip } from './shared.mjs';
import { withoutBlocks } from './wesl_blocks.mjs';

const [modules, tool, only] = process.argv.slice(2), root = path.resolve(here, '../..'), bevy = process.env.COTAN_BEVY;
const naga = path.resolve(modules, 'naga-wasm/dist/node.js');
if (!fs.existsSync(naga)) skip('naga-wasm is not installed');
const { parseWgsl, validate, writeGlsl, writeHlsl, writeMsl, writeSpirv } = await import(pathToFileURL(naga));

const folder = emptyFolder();
execFileSync(path.join(root, 'scripts/bevy-crate'), [folder], { env: { ...process.env, TOOL: tool, SOURCE_DATE_EPOCH: '1700000000' } });
const crate = path.join(folder, 'bevy_cotan'), read = (name) => fs.readFileSync(path.join(crate, name), 'utf8');

function filesOf(folder) {
  return fs.readdirSync(folder, { withFileTypes: true }).flatMap((e) => (e.isDirectory() ? filesOf(path.join(folder, e.name)) : [path.join(folder, e.name)]));
}
const standIns = () => fs.readFileSync(path.join(here, 'bevy_stand_ins.wgsl'), 'utf8').split(/^(?=#define_import_path)/m).slice(1);
/** The crates of Bevy that have the shaders of StandardMaterial, at a version. */
function cratesOfBevy(version) {
  const place = emptyFolder();
  execFileSync('sh', ['-c', 'git -C "$0" archive "$1" crates/bevy_pbr crates/bevy_render crates/bevy_core_pipeline | tar x -C "$2"', bevy, version, place], { stdio: ['ignore', 'ignore', 'ignore'] });
  return place;
}
const shadersOfBevy = () => filesOf(cratesOfBevy('v0.19.1')).filter((file) => file.endsWith('.wgsl')).map((file) => fs.readFileSync(file, 'utf8'));
/** The crate's modules and those of texts, by their paths. */
function modulesWith(texts) {
  const sources = new Map([['cotan', read('src/cotan.wgsl')], ['bevy_cotan', read('src/normal_map.wgsl')]]);
  for (const text of texts) {
    const found = text.match(/^\s*#define_import_path\s+(\S+)/m);
    // Bevy 0.19.1 forgets the attribute once, which naga 29 let pass; its next version has it.
    if (found) sources.set(found[1], text.replace('@location(7) instance_index: u32', '@location(7) @interpolate(flat) instance_index: u32'));
  }
  return sources;
}
const sources = modulesWith(bevy ? shadersOfBevy() : standIns());
console.log(bevy ? `with the ${sources.size - 2} modules of Bevy 0.19.1` : 'with stand-ins for the shaders of Bevy; COTAN_BEVY is not set');

// As MeshPipeline and StandardMaterial define them.
const kMesh = { MATERIAL_BIND_GROUP: 3, MAX_DIRECTIONAL_LIGHTS: 10, MAX_CASCADES_PER_LIGHT: 4, MAX_RECT_LIGHTS: 8, AVAILABLE_STORAGE_BUFFER_BINDINGS: 8,
  VERTEX_POSITIONS: true, VERTEX_NORMALS: true, VERTEX_UVS: true, VERTEX_UVS_A: true, VERTEX_OUTPUT_INSTANCE_INDEX: true };
const kMap = { STANDARD_MATERIAL_NORMAL_MAP: true };
const kDeferred = { PREPASS_PIPELINE: true, PREPASS_FRAGMENT: true, DEFERRED_PREPASS: true, NORMAL_PREPASS_OR_DEFERRED_PREPASS: true };
const kCoat = { STANDARD_MATERIAL_CLEARCOAT: true, PBR_MULTI_LAYER_MATERIAL_TEXTURES_SUPPORTED: true, STANDARD_MATERIAL_CLEARCOAT_NORMAL_MAP: true };
const kVariants = {
  'a normal map': kMap,
  'no normal map': {},
  'the second uv set': { ...kMap, VERTEX_UVS_B: true, STANDARD_MATERIAL_NORMAL_MAP_UV_B: true },
  'a mesh with tangents': { ...kMap, VERTEX_TANGENTS: true },
  'a coat with a map': { ...kMap, ...kCoat },
  'a coat with a map of the second uv set alone': { ...kCoat, VERTEX_UVS_B: true, STANDARD_MATERIAL_CLEARCOAT_NORMAL_UV_B: true },
  'a coat without a map': { ...kMap, STANDARD_MATERIAL_CLEARCOAT: true },
  deferred: { ...kMap, ...kDeferred },
  'deferred, with a coat': { ...kMap, ...kCoat, ...kDeferred },
  'normals of the prepass': { ...kMap, NORMAL_PREPASS: true, LOAD_PREPASS_NORMALS: true },
  'what discards': { ...kMap, MAY_DISCARD: true, VISIBILITY_RANGE_DITHER: true },
  'several samples': { ...kMap, MULTISAMPLED: true },
};
const wholes = Object.entries(kVariants).map(([name, chosen]) => [name, composed(read('src/material.wgsl'), sources, { ...kMesh, ...chosen })]);

function expectNaga(name, text) {
  try {
    const parsed = parseWgsl(text);
    validate(parsed).free();
    parsed.free();
  } catch (error) {
    assert.fail(`naga, ${name}: ${error.formatted ?? error}`);
  }
}

/** Bevy's pbr_functions, with the normal in the place of the lit colour. */
function showingNormals(text) {
  text = text.replace(/\/\/.*/g, '');
  for (const [name, value] of [['apply_pbr_lighting', 'vec4<f32>(in.N, 1.0)'], ['main_pass_post_lighting_processing', 'input_color']]) {
    const start = text.indexOf('{', text.indexOf(`fn ${name}(`)) + 1;
    let end = start;
    for (let open = 1; open > 0; ++end) open += { '{': 1, '}': -1 }[text[end]] ?? 0;
    text = `${text.slice(0, start)} return ${value}; ${text.slice(end - 1)}`;
  }
  return text;
}
const kFunctions = 'bevy_pbr::pbr_functions';
const withoutLight = (sources) => new Map(sources).set(kFunctions, showingNormals(sources.get(kFunctions)));
/** What a function returns for its argument in a page that has WebGPU. */
async function inPage(run, argument) {
  if (!fs.existsSync(path.join(modules, 'playwright-core'))) skip('playwright-core is not installed');
  const browser = await launch(modules, kGpuArguments);
  try {
    const page = await browser.newPage();
    await page.route('http://localhost/', (route) => route.fulfill({ contentType: 'text/html', body: '<!doctype html>' })); // WebGPU wants a safe origin
    await page.goto('http://localhost/');
    return await page.evaluate(run, argument);
  } finally {
    await browser.close();
  }
}
/** The errors of tint for each text, an empty text for none. */
async function tintErrors(texts) {
  const adapter = await navigator.gpu.requestAdapter(), device = await adapter.requestDevice(), found = [];
  for (const code of texts) {
    const { messages } = await device.createShaderModule({ code }).getCompilationInfo();
    found.push(messages.filter((m) => m.type === 'error').map((m) => `line ${m.lineNum}: ${m.message}`).join('\n'));
  }
  return found;
}
/** Fails if a drawn normal is farther from the expected one than `most` degrees. */
function expectNormals(pixels, wanted, most, name) {
  for (let i = 0; i < pixels.length; i += 4) {
    const off = degrees(pixels.slice(i, i + 3), wanted);
    assert.ok(off < most && pixels[i + 3] === 1, `${name}: ${off} degrees off in pixel ${i / 4}`);
  }
}

// The change for Bevy's main branch.
const kPatch = path.join(root, 'integrations/bevy/19069.patch');
const kCommit = fs.readFileSync(kPatch.replace('.patch', '.md'), 'utf8').match(/`([0-9a-f]{40})`/)[1];
const kPatched = {
  'render/pbr.wesl': [kMap, {}, { ...kMap, VERTEX_TANGENTS: true }, { ...kMap, VERTEX_UVS_B: true, STANDARD_MATERIAL_NORMAL_MAP_UV_B: true }, { ...kMap, ...kCoat }, kCoat,
    { ...kMap, ...kCoat, VERTEX_TANGENTS: true, STANDARD_MATERIAL_ANISOTROPY: true, PBR_ANISOTROPY_TEXTURE_SUPPORTED: true }, { ...kMap, ...kDeferred },
    { ...kMap, VERTEX_TANGENTS: true, MESHLET_MESH_MATERIAL_PASS: true }],
  'render/pbr_prepass.wesl': [{}, { VERTEX_TANGENTS: true }].map((more) => ({ ...kMap, ...more, PREPASS_PIPELINE: true, PREPASS_FRAGMENT: true, NORMAL_PREPASS: true,
    NORMAL_PREPASS_OR_DEFERRED_PREPASS: true })),
};
async function linked(place, main, conditions) {
  const { link } = await import(pathToFileURL(path.resolve(modules, 'wesl/dist/core.js')));
  const bundle = (name) => {
    const base = path.join(place, 'crates', name, 'src');
    // npm's linker does not know naga's r64uint, nor Bevy's constants.
    return { name, edition: 'unstable_2025_1', modules: Object.fromEntries(filesOf(base).filter((file) => file.endsWith('.wesl')).map((file) => [path.relative(base, file),
      withoutBlocks(fs.readFileSync(file, 'utf8').replaceAll('r64uint', 'r32uint'), conditions).replace(/constants::(\w+)/g, (_, word) => kMesh[word] ?? 1)])) };
  };
  return (await link({ weslSrc: bundle('bevy_pbr').modules, rootModuleName: main, libs: ['bevy_render', 'bevy_core_pipeline'].map(bundle), conditions, packageName: 'bevy_pbr' })).dest;
}

await runCases({
  nagaCompilesTheLibraryAndEachVariantOfTheMaterial() {
    expectNaga('cotan', preprocessed(sources.get('cotan'), {}).text);
    for (const [name, text] of wholes) expectNaga(name, text);
    assert.throws(() => expectNaga('wrong', wholes[0][1].replace('fn cotan_perturb_normal_in_cotan(', 'fn other(')), /cotan_perturb_normal_in_cotan/);
  },
  async tintCompilesTheLibraryAndEachVariantOfTheMaterial() {
    const all = [['cotan', preprocessed(sources.get('cotan'), {}).text], ...wholes, ['wrong', wholes[0][1].replace('fn cotan_perturb_normal_in_cotan(', 'fn other(')]];
    const found = await inPage(tintErrors, all.map(([, text]) => text));
    assert.match(found.pop(), /cotan_perturb_normal_in_cotan/);
    found.forEach((errors, i) => assert.equal(errors, '', all[i][0]));
  },
  // wgpu draws by these: WebGL 2, DirectX 12, Metal and Vulkan.
  async nagaTranslatesTheMaterialForEachDriver() {
    const parsed = parseWgsl(composed(read('src/material.wgsl'), modulesWith(standIns()), { ...kMesh, ...kMap })), info = validate(parsed);
    const glsl = writeGlsl(parsed, info, { version: '300 es', stage: 'fragment', entryPoint: 'fragment' });
    assert.match(writeHlsl(parsed, info, { shaderModel: '6_0' }), /ddx_fine/);
    assert.match(writeMsl(parsed, info), /dfdx/);
    assert.equal(writeSpirv(parsed, info)[0], 0x07230203);
    const compiled = (text) => {
      const gl = document.createElement('canvas').getContext('webgl2'), shader = gl.createShader(gl.FRAGMENT_SHADER);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      return gl.getShaderParameter(shader, gl.COMPILE_STATUS) ? '' : gl.getShaderInfoLog(shader);
    };
    assert.equal(await inPage(compiled, glsl), '');
    assert.notEqual(await inPage(compiled, glsl.replaceAll('dFdx(', 'dFd(')), '');
  },
  async theMaterialsNormalsAreThoseOfTheFormula() {
    const whole = composed(read('src/material.wgsl'), withoutLight(sources), { ...kMesh, ...kMap }), at = bevy ? kBevy : kStandIns;
    const texel = [200, 90, 220], m = texel.map((c) => (c - 128) / 127), z = Math.sqrt(1 - m[0] ** 2 - m[1] ** 2);
    const kinds = [ // flags as in pbr_types
      { name: 'a map', flags: 0, wanted: m },
      { name: 'two components', flags: 64, wanted: [m[0], m[1], z] },
      { name: 'green down', flags: 128, wanted: [m[0], -m[1], m[2]] },
      { name: 'the back of one side', flags: 0, back: true, wanted: m },
      { name: 'the back of two sides', flags: 16, back: true, wanted: m, side: -1 },
      { name: 'the front of two sides', flags: 16, wanted: m },
    ];
    const cases = Object.entries(kSheets).flatMap(([sheet, shape]) => kinds.map((kind) => ({ ...kind, name: `${sheet}, ${kind.name}`, shape })));
    const found = await inPage(drawn, cases.map(({ shape, back, flags }) => ({ vertex: vertexShader(shape, back), fragment: whole, texel, eye, flags, at })));
    cases.forEach(({ name, shape, wanted, side = 1 }, i) => expectNormals(found[i], expected(shape, wanted).map((x) => x * side), 0.01, name));
    assert.throws(() => expectNormals(found[0], expected(kSheets['mirrored uv'], m), 0.01, 'another sheet'));
  },
  // Bevy's own material reads 2c - 1, and the sheets' exact tangents.
  async bevysOwnMaterialWithTangentsAgrees() {
    if (!bevy) skip('COTAN_BEVY is not set');
    const pbr = fs.readFileSync(path.join(cratesOfBevy('v0.19.1'), 'crates/bevy_pbr/src/render/pbr.wgsl'), 'utf8'), texel = [200, 90, 220];
    const sheets = Object.entries(kSheets).filter(([name]) => name !== 'constant uv');
    const draw = async (text, more) => {
      const whole = composed(text, withoutLight(sources), { ...kMesh, ...kMap, ...more });
      return inPage(drawn, sheets.map(([, shape]) => ({ vertex: vertexShader(shape, false, 1), fragment: whole, texel, eye, flags: 0, at: kBevy })));
    };
    const own = await draw(pbr, { VERTEX_TANGENTS: true }), without = await draw(pbr, {}), ours = await draw(read('src/material.wgsl'), {});
    sheets.forEach(([name, shape], i) => {
      expectNormals(without[i], expected(shape, [0, 0, 1]), 0.01, `${name}, without tangents`); // what the patch is for
      expectNormals(own[i], expected(shape, texel.map((c) => (2 * c) / 255 - 1)), 0.01, `${name}, Bevy's tangents`);
      expectNormals(ours[i], own[i].slice(0, 3), 0.4, `${name}, against Bevy's tangents`); // 128 is zero, or 1 of 255
    });
  },
  async thePatchsTangentsAreThoseOfTheFormula() {
    const lines = fs.readFileSync(kPatch, 'utf8').split('\n').filter((line) => /^\+(?!\+)/.test(line)).map((line) => line.slice(1)).join('\n');
    const fragment = lines.match(/^fn screen_space_tangent[^]*?^}$/m)[0] + `
struct View { eye: vec3f, mip_bias: f32 }
struct Material { color: vec4f, uv_transform: mat3x3f, flags: u32 }
@group(0) @binding(0) var<uniform> view: View;
@group(3) @binding(0) var<uniform> material: Material;
@group(3) @binding(9) var map: texture_2d<f32>;
@group(3) @binding(10) var map_sampler: sampler;
@fragment fn fragment(@location(0) world_position: vec4f, @location(1) world_normal: vec3f, @location(2) uv: vec2f) -> @location(0) vec4f {
    let m = textureSample(map, map_sampler, uv).xyz * (255.0 / 127.0) - 128.0 / 127.0;
    let p = world_position.xyz - view.eye;
    let t = screen_space_tangent(world_normal, dpdx(p), dpdy(p), dpdx(uv), dpdy(uv));
    let n = normalize(world_normal);
    return vec4f(normalize(m.x * t.xyz + m.y * t.w * cross(n, t.xyz) + m.z * n), 1.0 + f32(material.flags));
}`;
    const texel = [200, 90, 220], sheets = Object.entries(kSheets).flatMap(([name, shape]) => [[name, shape, false], [`${name}, back`, shape, true]]);
    const found = await inPage(drawn, sheets.map(([, shape, back]) => ({ vertex: vertexShader(shape, back), fragment, texel, eye, flags: 0, at: kStandIns })));
    sheets.forEach(([name, shape], i) => expectNormals(found[i], expected(shape, texel.map((c) => (c - 128) / 127)), 0.01, name));
  },
  async thePatchAppliesToItsCommitAndDrawsNormalMapsWithoutTangents() {
    if (!bevy) skip('COTAN_BEVY is not set');
    const place = cratesOfBevy(kCommit), texts = [];
    execFileSync('git', ['apply', '--check', kPatch], { cwd: place, stdio: 'pipe' });
    execFileSync('git', ['apply', kPatch], { cwd: place, stdio: 'pipe' });
    const always = { ...kMesh, AVAILABLE_STORAGE_BUFFER_BINDINGS__GE_3: true, AVAILABLE_STORAGE_BUFFER_BINDINGS__GE_6: true };
    for (const [main, variants] of Object.entries(kPatched))
      for (const chosen of variants) texts.push([`${main} ${Object.keys(chosen).join(' ')}`, await linked(place, main, { ...always, ...chosen })]);
    for (const [name, text] of texts) {
      expectNaga(name, text);
      const wants = /NORMAL_MAP/.test(name) && !/TANGENTS/.test(name);
      assert.equal(/screen_space_tangent\(/.test(text), wants, name);
    }
    const byTint = texts.filter(([name]) => !/MESHLET/.test(name)), found = await inPage(tintErrors, byTint.map(([, text]) => text)); // 64-bit integers are naga's alone
    found.forEach((errors, i) => assert.equal(errors, '', byTint[i][0]));
    // Bevy's whole material, patched.
    const functions = path.join(place, 'crates/bevy_pbr/src/render/pbr_functions.wesl'), texel = [200, 90, 220], m = texel.map((c) => (2 * c) / 255 - 1);
    fs.writeFileSync(functions, showingNormals(fs.readFileSync(functions, 'utf8')));
    const fragment = await linked(place, 'render/pbr.wesl', { ...always, ...kMap });
    const cases = Object.entries(kSheets).flatMap(([name, shape]) => [[name, shape, 0, false, 1], [`${name}, back`, shape, 0, true, 1], [`${name}, back of two sides`, shape, 16, true, -1]]);
    const shown = await inPage(drawn, cases.map(([, shape, flags, back]) => ({ vertex: vertexShader(shape, back), fragment, texel, eye, flags, at: kBevy })));
    cases.forEach(([name, shape, , , side], i) => expectNormals(shown[i], expected(shape, m).map((x) => x * side), 0.01, `patched, ${name}`));
  },
  normalsOfMapsAreSetExactlyWhereThereAreMaps() {
    const has = (name, word) => wholes.find(([n]) => n === name)[1].split('@fragment')[1].includes(word);
    assert.ok(has('a normal map', '.N = side * base_normal') && has('deferred', '.N = side * base_normal'));
    assert.ok(!has('no normal map', 'base_normal') && !has('a coat with a map of the second uv set alone', 'base_normal'));
    assert.ok(has('a coat with a map of the second uv set alone', 'clearcoat_normal_in_bevy_cotan(in.world_normal, in.world_position.xyz, in.uv_b)'));
    assert.ok(!has('a coat without a map', 'clearcoat_normal_in'));
  },
  // naga_oil writes modules as WGSL, in which naga renames what ends in a digit or has two underscores; Bevy then refuses
  // the module (naga_oil's error InvalidIdentifier).
  noNameOfTheLibraryIsRenamedByNaga() {
    for (const name of ['cotan', 'bevy_cotan']) {
      const text = preprocessed(sources.get(name), { ...kMap, ...kCoat }).text, names = declared(text);
      assert.ok(names.length >= 4, names.join());
      for (const [, members] of text.matchAll(/struct\s+\w+\s*{([^}]*)}/g)) names.push(...[...members.matchAll(/(\w+)\s*:/g)].map((m) => m[1]));
      for (const word of names) assert.doesNotMatch(word, /\d$|__|_$/, word);
    }
    assert.doesNotMatch(read('src/cotan.wgsl').replace('#define_import_path cotan\n', ''), /#/, 'naga_oil reads # in comments, too');
  },
  theCrateNamesItsFiles() {
    const library = read('src/lib.rs');
    const named = [...library.matchAll(/"(?:embedded:\/\/bevy_cotan\/)?(\w+\.wgsl)"/g)].map((m) => m[1]);
    assert.deepEqual([...new Set(named)].sort(), filesOf(path.join(crate, 'src')).map((file) => path.basename(file)).filter((name) => name.endsWith('.wgsl')).sort());
    assert.match(read('Cargo.toml'), /^name = "bevy_cotan"\nversion = "\d+\.\d+\.\d+"$/m);
    assert.equal(read('LICENSE'), fs.readFileSync(path.join(root, 'LICENSE'), 'utf8'));
  },
}, only);
