// Adds the transforms to glTF-Transform's command line:
//   gltf-transform untangent in.glb out.glb --to cotangent --config node_modules/cotan/gltf-transform/config.mjs
import fs from 'node:fs';
import { lintNormals, provoking, tangents, untangent } from './index.js';

const addCommand = (program, name, description) => program.command(name, description)
  .argument('<input>', 'Path to read glTF 2.0 (.glb, .gltf) model').argument('<output>', 'Path to write output');

/** The action of a command that reads the input, applies the transform and writes the output. */
const run = (io, makeTransform) => async ({ args, options, logger }) => {
  const document = (await io.read(String(args.input))).setLogger(logger);
  await document.transform(makeTransform(options));
  if (!args.output) return;
  await io.write(String(args.output), document);
  const [before, after] = [args.input, args.output].map((file) => (String(file).endsWith('.glb') ? fs.statSync(String(file)).size : undefined));
  if (before !== undefined && after !== undefined) logger.info(`${args.input}: ${before} bytes; ${args.output}: ${after} bytes`);
};

// Exit codes, the same as those of the cotan command.
const kExit = { usage: 1, input: 2, unavailable: 3, output: 4, limit: 5 };

/** The action of lint-normals: writes the report to a file or standard output and sets the exit code by the verdict. */
const check = (io) => async ({ args, options: { json, distance, limit, limitArea, frame }, logger }) => {
  let found;
  try {
    const document = (await io.read(String(args.input))).setLogger(logger);
    await document.transform(lintNormals({ distance, limit, limitArea, frame, report: (report) => { found = report; } }));
  } catch (error) {
    if (!(error.code in kExit)) throw error;
    process.exitCode = kExit[error.code];
    process.stderr.write(`lint-normals: ${error.message}\n`);
  }
  const text = `${JSON.stringify({ command: 'lint-normals', model: String(args.input), ...found }, null, 2)}\n`;
  if (found && json === '-') process.stdout.write(text);
  else if (found && json) fs.writeFileSync(String(json), text);
};

export default {
  onProgramReady: ({ program, io }) => {
    addCommand(program, 'cotan-tangents', 'Add tangents to primitives, also to indexed ones')
      .option('--kind <kind>', 'mikktspace, area-weighted or vertex', { default: 'mikktspace' })
      .option('--overwrite <overwrite>', 'Replace existing tangents', { validator: program.BOOLEAN, default: false })
      .action(run(io, ({ kind, overwrite }) => tangents({ kind, overwrite })));
    addCommand(program, 'untangent', 'Drop tangents where nobody can see it, or remake normal maps for another frame')
      .option('--mode <mode>', 'auto: keep the maps, choose a frame for each primitive by measurement, and keep tangents where none is near enough; '
        + 'drop: drop tangents without reading maps; convert: remake the maps. Default: auto, or convert with --to')
      .option('--max-degrees <degrees>', 'Mean error of normals that a chosen frame may have, and ten times as much on 1 % of the area. '
        + 'Default: 0.3', { validator: program.NUMBER })
      .option('--from <frame>', 'Frame that the maps were made for. Default: the one that the materials name, else mikktspace')
      .option('--to <frame>', 'Frame of the new maps. Default with --mode convert: cotangent')
      .option('--unsigned <how>', 'How engines decode the new maps: biased, 2c - 1 (default), or exact, where 128 is zero')
      .action(run(io, ({ mode, maxDegrees, from, to, unsigned }) => untangent({ mode, maxDegrees, from, to, unsigned })));
    addCommand(program, 'provoking', 'Renumber vertices so that vertex k is the provoking vertex of triangle k')
      .option('--vertex <vertex>', 'Provoking vertex: first or last of the three', { default: 'first' })
      .action(run(io, ({ vertex }) => provoking({ vertex })));
    program.command('lint-normals', 'Report what to expect without stored tangents; with a limit, check it')
      .argument('<input>', 'Path to read glTF 2.0 (.glb, .gltf) model')
      .option('--limit <degrees>', 'Exit code 5 if the error with --frame exceeds this on more than 5 % of the area, or if green '
        + 'contradicts the file', { validator: program.NUMBER })
      .option('--limit-area <percent>', 'Exit code 5 if degenerate uv, overlapping mirrored uv, or stored tangents that contradict the uv exceed '
        + "this percentage of a primitive's area, or if green contradicts the file", { validator: program.NUMBER })
      .option('--frame <frame>', 'Frame that --limit applies to: cotangent, orthonormal, smooth, exact, triangle or stored', { default: 'orthonormal' })
      .option('--distance <distance>', 'Distance from eye to surface; 0: where the whole model fills the image', { validator: program.NUMBER, default: 0 })
      .option('--json <file>', 'File for the report; -: standard output')
      .action(check(io));
  },
};
