// Functions on normal maps: images { width, height, data } with four components per pixel, bytes, 16 bits or floats.
import { choice, options } from './arrays.js';
import { usage, wordsFor } from './instance.js';
import { kFunction } from './host.js';
import { checkedImage } from './image_checks.js';

const kTypes = { 8: Uint8Array, 16: Uint16Array, 32: Float32Array };

const number = (value, name) => {
  if (typeof value !== 'number' || !Number.isFinite(value)) throw usage(`${name}: expected a number, found ${wordsFor(value)}`);
  return value;
};

export function mapFunctions(library, host) {
  const input = (s, image, name) => {
    const p = checkedImage(image, name);
    return { ...p, at: s.struct(p.width, p.height, p.bits, s.put(p.data)) };
  };
  const output = (s, like, bits) => {
    choice(bits, 'options.bits', [8, 16, 32]);
    const count = 4 * like.width * like.height, pixels = s.allocate(count * bits / 8);
    return {
      at: s.struct(like.width, like.height, bits, pixels),
      take: () => ({ width: like.width, height: like.height, bits, data: s.take(kTypes[bits], pixels, count) }),
    };
  };
  const imageAt = (s, at) => {
    const [, width, height, bits, pixels] = s.view(Uint32Array, at, 5);
    return { width, height, bits, data: s.take(kTypes[bits], pixels, 4 * width * height) };
  };
  const zeroed = (s, bytes) => {
    const at = s.allocate(bytes);
    s.view(Uint8Array, at, bytes).fill(0);
    s.view(Uint32Array, at, 1)[0] = bytes;
    return at;
  };

  return {
    detect: (map) => library.run((s) => {
      const at = zeroed(s, 280);
      s.call('cotan_map_green', input(s, map, 'map').at, at);
      const [, direction, swapped, confidence] = s.view(Int32Array, at, 4);
      return {
        green: direction > 0 ? 'up' : direction < 0 ? 'down' : 'unknown',
        swapped: swapped < 0 ? null : swapped === 1,
        confidence: ['none', 'likely', 'certain'][confidence],
        agreement: s.view(Float64Array, at + 16, 1)[0],
        reason: s.textAt(at + 24, 256),
      };
    }),

    info: (map) => library.run((s) => {
      const at = zeroed(s, 144);
      s.call('cotan_map_describe', input(s, map, 'map').at, at);
      const [zero, srgb] = s.view(Int32Array, at + 68, 2);
      const [background, invalid, belowHorizon, meanLength, meanTilt, x, y, z] = s.view(Float64Array, at + 80, 8);
      return {
        content: s.textAt(at + 4, 64), zero: zero || null,
        transfer: srgb === 0 ? 'linear' : srgb > 0 ? 'srgb' : 'linearised',
        background, invalid, belowHorizon, meanLength, meanTilt, mean: [x, y, z],
      };
    }),

    convertMap: (map, given) => library.run((s) => {
      const o = options(given, { from: 'gltf,exact', to: 'gltf,exact', bits: undefined });
      const from = input(s, map, 'map'), to = output(s, from, o.bits ?? from.bits);
      s.call('cotan_map_convert', from.at, s.text(o.from, 'options.from'), s.text(o.to, 'options.to'), to.at);
      return to.take();
    }),

    blend: (base, detail, given) => library.run((s) => {
      const o = options(given, { convention: 'gltf,exact', mode: 'reoriented', strength: 1, bits: undefined });
      const under = input(s, base, 'base'), over = input(s, detail, 'detail'), to = output(s, under, o.bits ?? under.bits);
      s.call('cotan_map_blend', under.at, over.at, s.text(o.convention, 'options.convention'), s.text(o.mode, 'options.mode'),
        number(o.strength, 'options.strength'), to.at);
      return to.take();
    }),

    fromHeight: (height, given) => library.run((s) => {
      const o = options(given, { scale: 1, to: 'gltf,exact', bits: 8 });
      const from = input(s, height, 'height'), to = output(s, from, o.bits);
      if (Array.isArray(o.scale) && o.scale.length !== 2) throw usage(`options.scale: expected a number or two, found ${o.scale.length}`);
      const [x, y] = Array.isArray(o.scale) ? o.scale : [o.scale, o.scale];
      s.call('cotan_map_from_height', from.at, number(x, 'options.scale'), number(y, 'options.scale'), s.text(o.to, 'options.to'), to.at);
      return to.take();
    }),

    toHeight: (map, given) => library.run((s) => {
      const o = options(given, { from: 'gltf,exact' });
      const from = input(s, map, 'map'), count = from.width * from.height, heights = s.allocate(4 * count);
      s.call('cotan_map_to_height', from.at, s.text(o.from, 'options.from'), heights);
      return { width: from.width, height: from.height, data: s.take(Float32Array, heights, count) };
    }),

    mips: (map, given) => library.run((s) => {
      const o = options(given, { convention: 'gltf,exact', roughness: 0.3 });
      const levels = [], takeLevel = (level, normals, roughness) => {
        levels.push({ normals: imageAt(s, normals), roughness: imageAt(s, roughness) });
      };
      host.during({ scratch: s, takeLevel }, () =>
        s.call('cotan_map_mips', input(s, map, 'map').at, s.text(o.convention, 'options.convention'),
          number(o.roughness, 'options.roughness'), s.wasm.cotan_js_function(kFunction.takeLevel), 0));
      return levels;
    }),
  };
}

