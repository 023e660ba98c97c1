// The transforms on glTF-Transform's command line:
//   gltf-transform --config node_modules/cotan/gltf-transform/config.mjs untangent in.glb out.glb --to cotangent
import { lintNormals, provoking, tangents, untangent } from './index.js';

const both = (program, name, description) => program.command(name, description)
  .argument('<input>', 'Path to read glTF 2.0 (.glb, .gltf) model').argument('<output>', 'Path to write output');

/** Reads, transforms, writes, with what the command line has registered. */
const run = (io, makeTransform) => async ({ args, options, logger }) => {
  const document = (await io.read(String(args.input))).setLogger(logger);
  await document.transform(makeTransform(options));
  if (args.output) await io.write(String(args.output), document);
};

export default {
  extensions: [],
  onProgramReady: ({ program, io }) => {
    both(program, 'cotan-tangents', 'Give primitives tangents, indexed ones too')
      .option('--kind <kind>', 'mikktspace or vertex', { default: 'mikktspace' })
      .option('--overwrite <overwrite>', 'Replace tangents that are there', { validator: program.BOOLEAN, default: false })
      .action(run(io, ({ kind, overwrite }) => tangents({ kind, overwrite })));
    both(program, 'untangent', 'Make normal maps for another frame and drop tangents')
      .option('--from <frame>', 'Frame that the maps were made for', { default: 'mikktspace' })
      .option('--to <frame>', 'Frame that they shall be for', { default: 'cotangent' })
      .action(run(io, ({ from, to }) => untangent({ from, to })));
    both(program, 'provoking', 'Number vertices so that vertex k provokes triangle k')
      .option('--vertex <vertex>', 'first or last of the three', { default: 'first' })
      .action(run(io, ({ vertex }) => provoking({ vertex })));
    program.command('lint-normals', 'Say what to expect without stored tangents')
      .argument('<input>', 'Path to read glTF 2.0 (.glb, .gltf) model')
      .action(run(io, () => lintNormals()));
  },
};
