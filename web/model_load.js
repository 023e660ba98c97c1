// Loads a model into three.js from files in memory. three's own decoders handle Draco, meshopt and KTX2.
import * as three from 'three';
import { DRACOLoader } from 'three/addons/loaders/DRACOLoader.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { besideModel } from './files.js';
import { fileAddress } from './page_files.js';

const kPatience = 120000; // milliseconds
const kOfPage = 'cotan-page:'; // begins the addresses of the page's own files for three's decoders

// Rejects after kPatience or on a violation of the security policy, since three hides failures of its workers.
async function answered(loading) {
  let timer, forbidden;
  const failing = new Promise((_, failed) => {
    timer = setTimeout(() => failed(new Error(`the decoders did not respond within ${kPatience / 1000} seconds`)), kPatience);
    forbidden = event => failed(new Error(`${event.effectiveDirective} of the page's Content-Security-Policy forbids ${event.blockedURI}`));
    document.addEventListener('securitypolicyviolation', forbidden);
  });
  try {
    return await Promise.race([loading, failing]);
  } finally {
    clearTimeout(timer);
    document.removeEventListener('securitypolicyviolation', forbidden);
  }
}

let formats; // a renderer that detects the supported texture formats

export async function loadModel(files) {
  const manager = new three.LoadingManager(), addresses = [], missing = [];
  manager.setURLModifier(url => {
    if (/^(data|blob):/.test(url)) return url;
    if (url.startsWith(kOfPage)) return fileAddress(url.slice(kOfPage.length));
    const bytes = besideModel(files, url);
    if (!bytes) { missing.push(url); return 'data:,'; }
    addresses.push(URL.createObjectURL(new Blob([bytes])));
    return addresses.at(-1);
  });
  const draco = new DRACOLoader(manager).setDecoderPath(`${kOfPage}draco/`);
  formats ??= new three.WebGLRenderer({ canvas: new OffscreenCanvas(1, 1) });
  const ktx2 = new KTX2Loader(manager).setTranscoderPath(`${kOfPage}basis/`).detectSupport(formats);
  const loader = new GLTFLoader(manager).setDRACOLoader(draco).setKTX2Loader(ktx2).setMeshoptDecoder(MeshoptDecoder);
  try {
    const { bytes } = files.model;
    const gltf = await answered(loader.parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), ''));
    gltf.scene ??= gltf.scenes[0];
    if (!gltf.scene) throw new Error('no scene');
    return gltf;
  } catch (error) {
    const name = files.model.name;
    throw new Error(missing.length > 0 ? `${name}: expected ${missing.join(', ')} beside it, found nothing: drop all files together`
      : `${name}: expected a glTF model, found: ${error.message ?? error}`);
  } finally {
    draco.dispose();
    ktx2.dispose();
    setTimeout(() => addresses.forEach(address => URL.revokeObjectURL(address)), 60000);
  }
}
