// Normal maps as textures of blocks.
import { checkTypes, options } from './arrays.js';
import { checkedImage } from './image_checks.js';

const kDefaults = { from: 'gltf,exact', to: undefined, compress: 'none', swizzle: 'auto', container: 'ktx2', frame: undefined, mips: true };

export function textureFunction(library) {
  return (map, given) => library.run((s) => {
    const o = options(given, kDefaults), p = checkedImage(map, 'map');
    checkTypes(o, 'boolean', 'mips');
    const image = s.struct(p.width, p.height, p.bits, s.put(p.data)), slot = s.struct();
    const words = ['from', 'to', 'compress', 'swizzle', 'container', 'frame'].map((name) => s.text(o[name], `options.${name}`));
    const result = s.struct(0, 0, 0, 0, 0); // levels, and two doubles
    s.call('cotan_map_texture', image, s.struct(...words, Number(o.mips)), result, slot);
    const at = s.view(Uint32Array, slot, 1)[0];
    const bytes = s.take(Uint8Array, s.wasm.cotan_bytes_data(at) >>> 0, s.wasm.cotan_bytes_size(at) >>> 0);
    s.wasm.cotan_bytes_free(at);
    const [mean, percentile99] = s.view(Float64Array, result + 8, 2);
    return { bytes, levels: s.view(Int32Array, result + 4, 1)[0], degrees: mean < 0 ? null : { mean, percentile99 } };
  });
}
