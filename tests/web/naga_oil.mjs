// Joins shaders as naga_oil does, which Bevy 0.19 uses: #define_import_path, #import, #ifdef and #{NAME}. Unlike
// naga_oil it works on text: names of a module get a suffix, in the module and where they are imported.

/** Keeps the lines that the definitions choose. Returns { name, imports: Map(name -> path), text }. */
export function preprocessed(source, definitions) {
  const lines = [], imports = new Map(), open = [];
  let name = null, importing = null;
  const value = (word) => (Object.hasOwn(definitions, word) ? definitions[word] : undefined);
  const holds = (line) => {
    let m;
    if ((m = line.match(/^#\s*(?:else\s+)?ifdef\s+(\w+)/))) return value(m[1]) !== undefined;
    if ((m = line.match(/^#\s*(?:else\s+)?ifndef\s+(\w+)/))) return value(m[1]) === undefined;
    m = line.match(/^#\s*(?:else\s+)?if\s+(\w+)\s*(==|!=|>=|<=|>|<)\s*(-?\w+)/);
    if (!m) throw new Error(`cannot read ${line}`);
    const a = String(value(m[1])), b = m[3];
    return { '==': a === b, '!=': a !== b, '>=': +a >= +b, '<=': +a <= +b, '>': +a > +b, '<': +a < +b }[m[2]];
  };
  for (const raw of source.replace(/\/\*[^]*?\*\//g, '').split('\n')) {
    const line = raw.replace(/\/\/.*/, '').trim(), active = open.every((o) => o.now);
    if (importing !== null) {
      importing += line;
    } else if (/^#\s*(ifdef|ifndef|if)\b/.test(line)) {
      const now = active && holds(line);
      open.push({ now, done: now || !active });
    } else if (/^#\s*else/.test(line)) {
      const top = open.at(-1);
      top.now = !top.done && (/^#\s*else\s*$/.test(line) || holds(line));
      top.done ||= top.now;
    } else if (/^#\s*endif/.test(line)) {
      open.pop();
    } else if (active) {
      if (/^#\s*define_import_path/.test(line)) name = line.split(/\s+/)[1];
      else if (/^#\s*import\s/.test(line)) importing = line.replace(/^#\s*import\s+/, '');
      else if (/^#\s*define\s/.test(line)) definitions[line.split(/\s+/)[1]] = line.split(/\s+/)[2] ?? true;
      else lines.push(raw.replace(/\/\/.*/, '').replace(/#\{?(\w+)\}?/g, (all, word) => value(word) ?? fail(all)));
    }
    if (importing !== null && (importing.match(/{/g) ?? []).length === (importing.match(/}/g) ?? []).length) {
      addImports(importing.replace(/;\s*$/, ''), '', imports);
      importing = null;
    }
  }
  if (open.length > 0) throw new Error('#endif is missing');
  return { name, imports, text: lines.join('\n') };
}
function fail(word) { throw new Error(`${word} is not defined`); }

function addImports(list, prefix, imports) {
  let depth = 0, start = 0;
  const parts = [];
  for (let i = 0; i <= list.length; ++i) {
    if (list[i] === '{') ++depth;
    else if (list[i] === '}') --depth;
    else if (i === list.length || (list[i] === ',' && depth === 0)) { parts.push(list.slice(start, i).trim()); start = i + 1; }
  }
  for (const part of parts.filter((p) => p !== '')) {
    const group = part.match(/^([\w:]+)::{(.*)}$/s);
    if (group) { addImports(group[2], `${prefix}${group[1]}::`, imports); continue; }
    const [path, as] = part.split(/\s+as\s+/);
    imports.set(as ?? path.split('::').at(-1), prefix + path);
  }
}

/** The names that a module declares. */
export const declared = (text) => [...text.matchAll(/^\s*(?:@[^\n{]*?\s)?(?:fn|struct|const|alias|override|var(?:<[^>]*>)?)\s+(\w+)/gm)]
  .filter((m) => (text.slice(0, m.index).match(/{/g) ?? []).length === (text.slice(0, m.index).match(/}/g) ?? []).length).map((m) => m[1]);

/** The whole shader of `entry`. sources: the text of each module by its path. */
export function composed(entry, sources, definitions) {
  const done = new Map(), order = [];
  const suffixed = (module, item) => `${item}_in_${module.replaceAll('::', '_')}`;
  const add = (source, path) => {
    const module = preprocessed(source, definitions);
    if (module.name !== path) throw new Error(`expected ${path}, found ${module.name}`);
    module.own = new Set(declared(module.text));
    if (path !== null) done.set(path, module);
    const find = (full) => { // the module and item of a path
      if (sources.has(full)) return [full, null];
      const at = full.lastIndexOf('::'), owner = at < 0 ? '' : full.slice(0, at);
      if (!sources.has(owner)) return null;
      return [owner, full.slice(at + 2)];
    };
    const use = (owner, item) => {
      if (!done.has(owner)) add(sources.get(owner), owner);
      if (!done.get(owner).own.has(item)) throw new Error(`${path ?? 'the entry'}: ${owner} has no ${item}`);
      return suffixed(owner, item);
    };
    const renamed = (all, before, word) => {
      if (before === '.') return all;
      const parts = word.split('::'), first = module.imports.get(parts[0]);
      if (parts.length === 1 && module.own.has(word)) return before + (path === null ? word : suffixed(path, word));
      if (parts.length === 1 && !first) return all;
      const found = find([first ?? parts[0], ...parts.slice(1)].join('::'));
      if (!found || found[1] === null) { if (parts.length === 1) return all; throw new Error(`${path ?? 'the entry'}: there is no ${word}`); }
      return before + use(...found);
    };
    const identifiers = /(\.?)(\b[A-Za-z_]\w*(?:::\w+)*)/g;
    for (const full of module.imports.values()) // naga_oil does not mind an unused item that is not there
      if (!find(full)) throw new Error(`${path ?? 'the entry'}: there is no ${full}`);
    // Names of members are not those of the module.
    const text = module.text.split(/(struct\s+\w+\s*{[^}]*})/).map((piece) => (piece.startsWith('struct')
      ? piece.replace(/(\.?)(\b[A-Za-z_]\w*(?:::\w+)*)(\s*:(?!:))?/g, (all, before, word, member) => (member ? all : renamed(all, before, word)))
      : piece.replace(identifiers, renamed))).join('');
    order.push(text);
  };
  add(entry, null);
  return order.join('\n');
}
