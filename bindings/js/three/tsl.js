// cotan/three/tsl for Node.js and import maps. The modules three/tsl and three/webgpu are imported only where three has
// them. Bundlers load tsl_nodes.js (see package.json), because older ones do not bundle top-level await.
import { REVISION } from 'three';
import { CotanError } from '../src/errors.js';

if (parseInt(REVISION) < 185) throw new CotanError('unavailable', `three: expected version 0.185 or later for cotan/three/tsl, found ${REVISION}`);
export const { perturbedNormal, replaceFrame, untangle, untangled } = await import('./tsl_nodes.js');
export { CotanError };
