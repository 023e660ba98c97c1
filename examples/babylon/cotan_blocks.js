// Block formats of GPU textures in Babylon.js on WebGL: KTX2 files of `cotan map convert --compress` with bc5, bc5-snorm,
// bc7, eac-rg11 or astc-4x4 to astc-8x8. Babylon's own reader of KTX2 takes every file for Basis Universal.
const kExtensions = { rgtc: 'EXT_texture_compression_rgtc', bptc: 'EXT_texture_compression_bptc', etc: 'WEBGL_compressed_texture_etc', astc: 'WEBGL_compressed_texture_astc' };

// Vulkan's number of a format without sRGB (VkFormat, in the header of KTX2): WebGL's number and extension.
const kFormats = new Map([[141, [0x8dbd, 'rgtc']], [142, [0x8dbe, 'rgtc']], [145, [0x8e8c, 'bptc']], [155, [0x9272, 'etc']], [156, [0x9273, 'etc']],
  ...Array.from({ length: 14 }, (_, k) => [157 + 2 * k, [0x93b0 + k, 'astc']])]); // 4x4 to 12x12

/** Makes textures with the ending .ktx2 read blocks. Basis Universal, and everything else, stays with Babylon's reader.
 * Load maps with `invertY: false`, as the glTF loader does: blocks cannot be flipped. */
export function readBlocks(BABYLON) {
  class BlockLoader extends BABYLON._KTXTextureLoader {
    loadData(bytes, texture, callback, options) {
      const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), signature = [0x58544bab, 0xbb303220];
      const isKtx2 = bytes.byteLength >= 80 && signature.every((word, k) => view.getUint32(4 * k, true) === word);
      const [vkFormat, , width, height, depth, layers, faces, levels, supercompression] = isKtx2 ? Array.from({ length: 9 }, (_, k) => view.getUint32(12 + 4 * k, true)) : [];
      const [format, blocks] = kFormats.get(vkFormat) ?? [];
      if (!format || depth || layers || faces !== 1 || supercompression) { super.loadData(bytes, texture, callback, options); return; }
      const engine = texture.getEngine(), count = Math.max(1, levels), read = k => Number(view.getBigUint64(k, true));
      const parts = bytes.byteLength < 80 + 24 * count ? [] : Array.from({ length: count }, (_, k) => [read(80 + 24 * k), read(88 + 24 * k)]);
      const complete = parts.length > 0 && parts.every(([offset, length]) => offset + length <= bytes.byteLength);
      if (!complete || !engine.getRenderingCanvas().getContext('webgl2')?.getExtension(kExtensions[blocks])) { // also: the device lacks the format
        callback(0, 0, false, false, () => {}, true);
        return;
      }
      texture.format = format;
      callback(width, height, count > 1, true, () => {
        parts.forEach(([offset, length], k) => engine._uploadCompressedDataToTextureDirectly(texture, format, Math.max(1, width >> k), Math.max(1, height >> k),
          new Uint8Array(bytes.buffer, bytes.byteOffset + offset, length), 0, k));
      }, false);
    }
  }
  for (const ending of ['.ktx2', '.ktx']) BABYLON.registerTextureLoader(ending, async () => new BlockLoader()); // .ktx: images of type image/ktx2
}

/** Makes a material rebuild z of a normal map whose x and y are in red and green (bc5, eac-rg11): Babylon reads blue, which
 * is 0 there. Call this before the first render. */
export function useTwoChannels(BABYLON, material) {
  class TwoChannels extends BABYLON.MaterialPluginBase {
    constructor() {
      super(material, 'CotanTwoChannels', 210, { COTAN_TWO_CHANNELS: true }, true, true);
      this.doNotSerialize = true;
    }
    getCustomCode(type) {
      return type !== 'fragment' ? null : {
        '!vec3 perturbNormal\\(mat3 cotangentFrame,vec3 textureSample,float scale\\)\\s*\\{[^}]*\\}': `
vec3 perturbNormal(mat3 cotangentFrame, vec3 textureSample, float scale) {
  vec2 xy = textureSample.xy * 2.0 - 1.0;
  return perturbNormalBase(cotangentFrame, vec3(xy, sqrt(max(0.0, 1.0 - dot(xy, xy)))), scale);
}
`,
      };
    }
  }
  new TwoChannels();
  return material;
}
