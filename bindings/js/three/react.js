// Cotan for react-three-fiber: untangle() of cotan/three when a model is mounted. See react.d.ts.
import { invalidate } from '@react-three/fiber';
import { createElement, useEffect, useLayoutEffect, useState } from 'react';
import { checkTypes } from '../src/arrays.js';
import { usage, wordsFor } from '../src/errors.js';
import { untangle as untangleForWebGL } from './index.js';

export function useUntangled(object, given) {
  const { untangle = untangleForWebGL, ...options } = given ?? {};
  checkTypes({ untangle }, 'function', 'untangle');
  const [decisions, setDecisions] = useState([]);
  // Before the next frame is drawn, and after the object has its parents, which may mirror it.
  useLayoutEffect(() => {
    const target = typeof object?.current === 'object' ? object.current : object; // a ref, or the object
    if (target === null || target === undefined) return;
    setDecisions(untangle(target, options));
    invalidate();
  }, [object, untangle, options.frame, options.maxDegrees, options.convention]);
  return decisions;
}

export function Untangled({ object, frame, maxDegrees, convention, note, untangle, onDecided, dispose, ...props }) {
  const root = object?.isObject3D ? object : object?.scene;
  if (!root?.isObject3D) throw usage(`object: expected an Object3D or the result of GLTFLoader, found ${wordsFor(object)}`);
  checkTypes({ onDecided }, 'function', 'onDecided');
  const decisions = useUntangled(object, { frame, maxDegrees, convention, note, untangle });
  useEffect(() => { if (decisions.length > 0) onDecided?.(decisions); }, [decisions]);
  useEffect(() => (dispose === null ? undefined : () => free(root)), [root, dispose]);
  return createElement('primitive', { ...props, object: root, dispose: null });
}

// Frees what the renderer holds of a model. A model that is drawn again is uploaded again.
function free(root) {
  root.traverse(({ geometry, material, skeleton }) => {
    geometry?.dispose();
    skeleton?.dispose();
    for (const one of [material].flat()) {
      for (const value of Object.values(one ?? {})) if (value?.isTexture) value.dispose();
      one?.dispose();
    }
  });
}
