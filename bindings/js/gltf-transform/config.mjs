// The transforms on glTF-Transform's command line:
//   gltf-transform untangent in.glb out.glb --to cotangent --config node_modules/cotan/gltf-transform/config.mjs
import fs from 'node:fs';
import { lintNormals, provoking, tangents, untangent } from './index.js';

const both = (program, name, description) => program.command(name, description)
  .argument('<input>', 'Path to read glTF 2.0 (.glb, .gltf) model').argument('<output>', 'Path to write output');

/** Reads, transforms, writes, with what the command line has registered. */
const run = (io, makeTransform) => async ({ args, options, logger }) => {
  const document = (await io.read(String(args.input))).setLogger(logger);
  await document.transform(makeTransform(options));
  if (!args.output) return;
  await io.write(String(args.output), document);
  const [before, after] = [args.input, args.output].map((file) => (String(file).endsWith('.glb') ? fs.statSync(String(file)).size : undefined));
  if (before !== undefined && after !== undefined) logger.info(`${args.input}: ${before} bytes; ${args.output}: ${after} bytes`);
};

// As of the tool.
const kExit = { usage: 1, input: 2, unavailable: 3, output: 4, limit: 5 };

/** A check: its report goes to a file or to standard output, its verdict into the exit code. */
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
    both(program, 'cotan-tangents', 'Give primitives tangents, indexed ones too')
      .option('--kind <kind>', 'mikktspace or vertex', { default: 'mikktspace' })
      .option('--overwrite <overwrite>', 'Replace tangents that are there', { validator: program.BOOLEAN, default: false })
      .action(run(io, ({ kind, overwrite }) => tangents({ kind, overwrite })));
    both(program, 'untangent', 'Drop tangents; make normal maps for another frame where that is asked for or needed')
      .option('--mode <mode>', 'auto: drop tangents with the maps as they are, new maps only where they are needed and cost little; drop: maps as they are; '
        + 'convert: new maps. Default: auto, convert with one of the next options')
      .option('--from <frame>', 'Frame that the maps were made for; left out: the one that the materials name, else mikktspace')
      .option('--to <frame>', 'Frame that they shall be for; left out with --mode convert: cotangent')
      .option('--unsigned <how>', 'How engines take the numbers of the new maps: biased, 2c - 1 (the default), or exact, where 128 is zero')
      .action(run(io, ({ mode, from, to, unsigned }) => untangent({ mode, from, to, unsigned })));
    both(program, 'provoking', 'Number vertices so that vertex k provokes triangle k')
      .option('--vertex <vertex>', 'first or last of the three', { default: 'first' })
      .action(run(io, ({ vertex }) => provoking({ vertex })));
    program.command('lint-normals', 'Say what to expect without stored tangents; a check where a limit is set')
      .argument('<input>', 'Path to read glTF 2.0 (.glb, .gltf) model')
      .option('--limit <degrees>', 'Exit code 5 where the error with --frame exceeds it on more than 5 % of the area, and where green '
        + 'points the other way than the file says', { validator: program.NUMBER })
      .option('--limit-area <percent>', 'Exit code 5 where degenerate uv, mirrored uv that overlap, or stored tangents against the uv '
        + "exceed it of a primitive's area, and where green points the other way", { validator: program.NUMBER })
      .option('--frame <frame>', 'Frame that --limit judges: cotangent, orthonormal, smooth, exact, triangle or stored', { default: 'orthonormal' })
      .option('--distance <distance>', 'From eye to surface; 0: where the whole model fills the picture', { validator: program.NUMBER, default: 0 })
      .option('--json <file>', 'Where the report goes; -: standard output')
      .action(check(io));
  },
};
