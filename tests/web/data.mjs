// Files that tests need and that the repository does not contain. The rule is that of dataFile in tests/test_data.hpp.
import crypto from 'node:crypto';
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const repository = fileURLToPath(new URL('../..', import.meta.url));

/** A file or folder: that of ../shared/data if it exists there, otherwise that of build/data, where scripts/test-data
 * puts it. COTAN_TEST_DATA=fetched in the environment leaves ../shared/data out. */
export function dataFile(name) {
  const shared = path.join(repository, '../shared/data', name);
  return process.env.COTAN_TEST_DATA !== 'fetched' && fs.existsSync(shared) ? shared : path.join(repository, 'build/data', name);
}

/** The folder that has the models. */
export const data = path.dirname(dataFile('models'));
/** Why tests that need data are skipped; '' if the data are there. */
export const missing = fs.existsSync(path.join(data, 'models')) ? '' : 'there are no models: run scripts/test-data';

/** Whether the first KTX2 of a file is packed with Zstandard. The published models have other packings than those made here. */
export function hasZstandard(file) {
  const bytes = fs.readFileSync(file), at = bytes.indexOf(Buffer.from('\xabKTX 20\xbb', 'latin1'));
  return at >= 0 && bytes.readUInt32LE(at + 44) === 2;
}

/** Whether a file is the published one of that name, and not a model with the same traits, as isOriginal in
 * tests/test_data.hpp. Numbers that were measured on published files hold for these only. */
export function isOriginal(name) {
  const listed = fs.readFileSync(path.join(repository, 'tests/test_data/originals.sha256'), 'utf8').split('\n').find((line) => line.endsWith(`  ${name}`));
  if (!listed) throw new Error(`tests/test_data/originals.sha256 does not list ${name}`);
  return listed.startsWith(crypto.createHash('sha256').update(fs.readFileSync(dataFile(name))).digest('hex'));
}
