// Fixes PlayCanvas's frame without tangents for all materials of a graphics device. Takes the sign of the frame from
// the visible triangle instead of the uniform tbnBasis. Correct for mirroring cameras, projections with y down, and back
// faces without two-sided lighting. Call before the first frame: useCotanFrame(pc, app.graphicsDevice).
export function useCotanFrame(pc, device) {
  const fixes = {
    [pc.SHADERLANGUAGE_GLSL]: [
      [/tbnBasis\s*\/\s*sqrt\(\s*denom\s*\)/, 'cotanSide / sqrt( denom )'],
      [/(float denom\s*=)/, 'float cotanSide = dot( normal, cross( dp1, dp2 ) ) < 0.0 ? -1.0 : 1.0;\n\t\t$1'],
    ],
    [pc.SHADERLANGUAGE_WGSL]: [
      [/uniform\.tbnBasis\s*\/\s*sqrt\(\s*denom\s*\)/, 'cotanSide / sqrt( denom )'],
      [/(let denom\s*:)/, 'let cotanSide: f32 = select( 1.0, -1.0, dot( normal, cross( dp1, dp2 ) ) < 0.0 );\n\t\t$1'],
    ],
  };
  for (const language of [pc.SHADERLANGUAGE_GLSL, pc.SHADERLANGUAGE_WGSL]) {
    const chunks = pc.ShaderChunks.get(device, language);
    const fix = (name, changes) => {
      let text = chunks.get(name);
      if (text === undefined) throw new Error(`PlayCanvas has no shader chunk ${name}`);
      for (const [pattern, replacement] of changes) {
        if (!text.match(pattern)) throw new Error(`PlayCanvas's shader chunk ${name} has no ${pattern}; 2.23 has it`);
        text = text.replace(pattern, replacement);
      }
      chunks.set(name, text);
    };
    fix('TBNPS', fixes[language]);
    // Before this fix t and b were already reversed on back faces, so that two-sided lighting negated only n.
    fix('twoSidedLightingPS', [[/dTBN\[2\]\s*=\s*-dTBN\[2\]/, language === pc.SHADERLANGUAGE_GLSL ? 'dTBN = -dTBN' : 'dTBN = dTBN * -1.0']]);
  }
}
