/** WESL without conditional blocks of declarations, `@if(A) { ... } @else { ... }`, which Bevy's linker takes and npm's
 * does not. Chosen blocks lose their braces; conditions inside of functions and on single declarations stay. */
export function withoutBlocks(text, conditions) {
  const holds = (words) => new Function(...new Set(words.match(/[A-Za-z_]\w*/g) ?? []), `return ${words};`)
    (...[...new Set(words.match(/[A-Za-z_]\w*/g) ?? [])].map((word) => conditions[word] ?? false));
  const plain = text.replace(/\/\/[^\n]*/g, ''), block = /@(?:(if|elif)\s*\(([^()]*(?:\([^()]*\)[^()]*)*)\)|(else))\s*{/y;
  let out = '', depth = 0, done = false;
  for (let i = 0; i < plain.length;) {
    block.lastIndex = i;
    const found = depth === 0 ? block.exec(plain) : null;
    if (!found) {
      if (plain[i] === '{') ++depth;
      else if (plain[i] === '}') --depth;
      out += plain[i++];
      continue;
    }
    const start = block.lastIndex;
    let end = start, open = 1;
    while (open > 0) {
      if (end >= plain.length) throw new Error('a block has no end');
      open += plain[end] === '{' ? 1 : plain[end] === '}' ? -1 : 0;
      ++end;
    }
    if (found[1] === 'if') done = false;
    const now = !done && (found[3] === 'else' || holds(found[2]));
    done ||= now;
    if (now) out += withoutBlocks(plain.slice(start, end - 1), conditions);
    i = end;
  }
  return out;
}
