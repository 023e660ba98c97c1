// Decompresses Draco and meshopt geometry by glTF-Transform.
import { WebIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { MeshoptDecoder } from 'meshoptimizer';
import createDecoder from 'draco3dgltf/draco_decoder_gltf_nodejs.js';
import { fileAddress } from './page_files.js';

// Returns the bytes of a GLB. json, beside: the JSON and the referenced files of a .gltf; json is null for a GLB.
export async function unpack({ name, bytes }, json, beside) {
  await MeshoptDecoder.ready;
  const decoder = await createDecoder({ locateFile: () => fileAddress('draco/gltf.wasm') });
  const io = new WebIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({ 'draco3d.decoder': decoder, 'meshopt.decoder': MeshoptDecoder });
  try {
    const document = await (json ? io.readJSON({ json, resources: beside }) : io.readBinary(bytes));
    for (const extension of document.getRoot().listExtensionsUsed()) if (/draco|meshopt/.test(extension.extensionName)) extension.dispose();
    return await io.writeBinary(document);
  } catch (error) {
    throw new Error(`${name}: expected geometry that can be decompressed, found: ${error.message}`);
  }
}
