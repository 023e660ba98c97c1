// Validates glTF files with Khronos' validator: node validate.mjs NODE_MODULES FILE...
// Prints one line per message; exit code 1 if any file has an error, 0 otherwise.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';

const [modules, ...files] = process.argv.slice(2);
const validator = createRequire(path.resolve(modules, 'x.js'))(path.resolve(modules, 'gltf-validator'));
let errors = 0;
for (const file of files) {
  const folder = path.dirname(path.resolve(file));
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
    uri: path.basename(file),
    maxIssues: 1000,
    externalResourceFunction: async (uri) =>
      new Uint8Array(fs.readFileSync(path.join(folder, decodeURIComponent(uri)))),
  });
  errors += report.issues.numErrors;
  for (const m of report.issues.messages)
    console.log(`${['error', 'warning', 'info', 'hint'][m.severity]} ${path.basename(file)} ${m.code} ${m.pointer ?? ''} ${m.message}`);
  console.log(`${path.basename(file)}: ${report.issues.numErrors} errors, ${report.issues.numWarnings} warnings`);
}
process.exit(errors > 0 ? 1 : 0);
