// Creates an element with attributes and children: el('p', { class: 'small' }, 'text', otherElement).
export function el(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== undefined && value !== false) element.setAttribute(name, value);
  }
  element.append(...children.filter(child => child !== undefined && child !== null));
  return element;
}

// A drop-down list. names: the text to show for each value.
export function choice(label, names, chosen, changed) {
  const select = el('select', { onchange: () => changed(select.value) },
    ...Object.entries(names).map(([value, text]) => el('option', { value, selected: value === chosen }, text)));
  return { element: el('label', {}, label, select), select };
}

// A table of two columns, [['name', 'value'], ...]; rows whose value is undefined are left out.
export function table(caption, rows) {
  return el('div', { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': caption }, el('table', { 'aria-label': caption }, el('tbody', {},
    ...rows.filter(([, value]) => value !== undefined).map(([name, value]) => el('tr', {}, el('th', { scope: 'row' }, name), el('td', {}, value))))));
}

// A field for a number. value(): undefined if it is empty or out of range. changed: called without arguments.
export function numberField(label, unit, value, { min = 0, max }, changed) {
  const input = el('input', { type: 'number', min, max, step: 'any', value, onchange: changed });
  return { element: el('label', {}, label, el('span', { class: 'unit' }, input, unit)), value: () => (input.value === '' || !input.validity.valid ? undefined : Number(input.value)) };
}

// Offers the bytes as a file to save. The object URL is revoked after a minute.
export function download(bytes, name, type) {
  const link = el('a', { href: URL.createObjectURL(new Blob([bytes], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

export const degrees = value => `${value < 0.095 ? value.toFixed(2) : value.toFixed(1)}°`;

export const percent = fraction => `${fraction > 0 && fraction < 0.001 ? 'below 0.1' : (100 * fraction).toFixed(fraction < 0.1 ? 1 : 0)} %`;

// "12 bytes", "3.4 KB", "5.6 MB".
export const size = bytes => bytes < 1000 ? `${bytes} bytes` : bytes < 1e6 ? `${(bytes / 1e3).toFixed(1)} KB` : `${(bytes / 1e6).toFixed(1)} MB`;

/** Where the verdict leads to. */
export const smallFiles = () => el('p', { class: 'small' }, 'On phones and in browsers a map can take a quarter of the memory: ', el('a', { href: 'mobile.html' }, 'which file to write, and what it costs'), '.');
