// Writes modules of this package as one ES module, for pages without a bundler.
import fs from 'node:fs';
import path from 'node:path';

const kImport = /^import (?:\{([^}]*)\}|\* as (\w+)) from '([^']+)';$/gm, kExport = /^export (?=(?:async )?(?:function\*?|class|const) (\w+))|^export \{([^}]*)\};$/gm;
const names = (list) => list.split(',').map((word) => word.trim()).filter(Boolean);

// The text of one module that exports what `entries` (paths) export. Modules of other packages stay imported. Each module
// becomes a function that is called once, after those that it imports. slim: shortens the text of a module.
export function oneFile(entries, slim) {
  const outside = new Map(), made = new Map(), parts = []; // by name of a package: its variable; by path: { variable, exported }
  const variableOf = (from, file) => {
    if (from.startsWith('.')) return add(path.resolve(path.dirname(file), from)).variable;
    if (!outside.has(from)) outside.set(from, `outside${outside.size}`);
    return outside.get(from);
  };
  function add(file) {
    if (made.has(file)) {
      if (!made.get(file)) throw new Error(`${file}: expected no circle of imports`);
      return made.get(file);
    }
    made.set(file, null);
    const exported = [];
    const body = slim(fs.readFileSync(file, 'utf8'))
      .replace(kImport, (_, list, all, from) => (all ? `const ${all} = ${variableOf(from, file)};` : `const { ${names(list).map((name) => name.replace(' as ', ': ')).join(', ')} } = ${variableOf(from, file)};`))
      .replace(kExport, (_, name, list) => { exported.push(...name ? [name] : names(list)); return ''; });
    const left = /^(import|export)\b.*|\bimport\(.*/m.exec(body);
    if (left) throw new Error(`${file}: expected imports and exports as one_file.mjs knows them, found ${left[0]}`);
    const variable = `module${parts.length}`;
    parts.push(`const ${variable} = (() => {\n${body}return { ${exported.join(', ')} };\n})();\n`);
    made.set(file, { variable, exported });
    return made.get(file);
  }
  const found = new Map(); // of all entries: variable by name; the first one's counts
  for (const { variable, exported } of entries.map((file) => add(path.resolve(file)))) for (const name of exported) if (!found.has(name)) found.set(name, variable);
  const imports = [...outside].map(([from, variable]) => `import * as ${variable} from '${from}';\n`);
  return `${imports.join('')}${parts.join('')}${[...found].map(([name, variable]) => `export const ${name} = ${variable}.${name};\n`).join('')}`;
}
