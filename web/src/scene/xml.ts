// The scene's XML as text with places: enough of a parser to find elements and attributes in a
// document that may be broken, and to change single values without touching anything else.
export interface XmlAttribute {
  name: string;
  value: string; // entities resolved
  start: number; // of the name
  valueStart: number; // inside the quotes, where there are any
  valueEnd: number;
  quoted: boolean;
  end: number;
}

export interface XmlElement {
  name: string;
  start: number; // of "<"
  openEnd: number; // after ">" of the start tag
  selfClosing: boolean;
  attributes: XmlAttribute[];
  children: XmlElement[];
  parent: XmlElement | null;
  closeStart: number; // of "</", or where the element ends without it
  end: number;
}

export interface Edit {
  from: number;
  to: number;
  insert: string;
}

const entities: Record<string, string> = { amp: '&', lt: '<', gt: '>', quot: '"', apos: "'" };
const unescape = (text: string): string =>
  text.replace(/&(#x?[0-9a-f]+|\w+);/gi, (all, name: string) => {
    if (!name.startsWith('#')) return entities[name] ?? all;
    const code = name[1]?.toLowerCase() === 'x' ? parseInt(name.slice(2), 16) : parseInt(name.slice(1), 10);
    return code > 0 && code <= 0x10ffff ? String.fromCodePoint(code) : all;
  });
const escape = (text: string): string =>
  text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');

const nameAt = /[A-Za-z_:][\w:.-]*/y;
const blank = /\s/;

/** The elements of the text, outermost first. Never throws. */
export function parseXml(text: string): XmlElement[] {
  const roots: XmlElement[] = [];
  let open = null as XmlElement | null;
  let at = 0;
  const skipTo = (end: string, from: number): number => {
    const found = text.indexOf(end, from);
    return found < 0 ? text.length : found + end.length;
  };
  while (at < text.length) {
    const start = text.indexOf('<', at);
    if (start < 0) break;
    if (text.startsWith('<!--', start)) at = skipTo('-->', start + 4);
    else if (text.startsWith('<![CDATA[', start)) at = skipTo(']]>', start);
    else if (text[start + 1] === '?' || text[start + 1] === '!') at = skipTo('>', start);
    else if (text[start + 1] === '/') {
      at = skipTo('>', start);
      const name = text.slice(start + 2, at).replace(/>$/, '').trim().toLowerCase();
      // Closes the innermost element of that name; what is open within it ends here too.
      let closed = open;
      while (closed && closed.name.toLowerCase() !== name) closed = closed.parent;
      if (!closed) continue;
      for (let one = open; one && one !== closed; one = one.parent) one.closeStart = one.end = start;
      closed.closeStart = start;
      closed.end = at;
      open = closed.parent;
    } else {
      const element = readTag(text, start, open);
      if (!element) {
        at = start + 1;
        continue;
      }
      (open ? open.children : roots).push(element);
      if (!element.selfClosing) open = element;
      at = element.openEnd;
    }
  }
  for (let one = open; one; one = one.parent) one.closeStart = one.end = text.length;
  return roots;
}

function readTag(text: string, start: number, parent: XmlElement | null): XmlElement | null {
  nameAt.lastIndex = start + 1;
  const name = nameAt.exec(text)?.[0];
  if (!name) return null;
  let at = nameAt.lastIndex, selfClosing = false;
  const attributes: XmlAttribute[] = [];
  const skipBlanks = (): void => {
    while (at < text.length && blank.test(text[at] as string)) at += 1;
  };
  for (;;) {
    skipBlanks();
    if (at >= text.length || text[at] === '<') break;
    if (text[at] === '>') {
      at += 1;
      break;
    }
    if (text[at] === '/') {
      at += 1;
      skipBlanks();
      if (text[at] === '>') {
        selfClosing = true;
        at += 1;
        break;
      }
      continue;
    }
    nameAt.lastIndex = at;
    const key = nameAt.exec(text)?.[0];
    if (!key) {
      at += 1;
      continue;
    }
    const nameStart = at;
    at += key.length;
    const afterName = at;
    skipBlanks();
    if (text[at] !== '=') {
      at = afterName;
      continue; // a name without a value
    }
    at += 1;
    skipBlanks();
    const quote = text[at];
    const quoted = quote === '"' || quote === "'";
    let valueStart = at, valueEnd: number;
    if (quoted) {
      valueStart += 1;
      const close = text.indexOf(quote as string, valueStart);
      // A quote that is never closed ends with the line.
      const line = text.indexOf('\n', valueStart);
      valueEnd = close >= 0 ? close : line >= 0 ? line : text.length;
      at = close >= 0 ? close + 1 : valueEnd;
    } else {
      while (at < text.length && !/[\s>]/.test(text[at] as string) && !(text[at] === '/' && text[at + 1] === '>')) at += 1;
      valueEnd = at;
    }
    attributes.push({ name: key, value: unescape(text.slice(valueStart, valueEnd)), start: nameStart, valueStart, valueEnd, quoted, end: at });
  }
  return { name, start, openEnd: at, selfClosing, attributes, children: [], parent, closeStart: at, end: at };
}

/** All elements in document order. */
export function* walkXml(elements: readonly XmlElement[]): Generator<XmlElement> {
  for (const element of elements) {
    yield element;
    yield* walkXml(element.children);
  }
}

/** The attribute by the first of these names that is there, in any case. */
export function attributeOf(element: XmlElement, names: readonly string[]): XmlAttribute | undefined {
  for (const name of names) {
    const found = element.attributes.find((one) => one.name.toLowerCase() === name.toLowerCase());
    if (found) return found;
  }
  return undefined;
}

export const childOf = (element: XmlElement, ...names: string[]): XmlElement | undefined =>
  element.children.find((child) => names.includes(child.name.toLowerCase()));

/** Sets the attribute under the name it has, or adds it under the first of the names. */
export function setAttribute(element: XmlElement, names: readonly string[], value: string): Edit {
  const found = attributeOf(element, names);
  if (found) return { from: found.valueStart, to: found.valueEnd, insert: found.quoted ? escape(value) : `"${escape(value)}"` };
  const last = element.attributes[element.attributes.length - 1];
  const at = last ? last.end : element.start + 1 + element.name.length;
  return { from: at, to: at, insert: ` ${names[0]}="${escape(value)}"` };
}

export const lineOf = (text: string, at: number): number => text.slice(0, at).split('\n').length;

/** The blanks a line begins with. */
function indentAt(text: string, at: number): string {
  const line = text.lastIndexOf('\n', at - 1) + 1;
  return /^[ \t]*/.exec(text.slice(line, at))?.[0] ?? '';
}

/** One level of the document's indentation: what a child has more than its parent. */
export function indentUnit(text: string, elements: readonly XmlElement[]): string {
  for (const element of walkXml(elements)) {
    const child = element.children[0];
    if (!child) continue;
    const outer = indentAt(text, element.start), inner = indentAt(text, child.start);
    if (inner.length > outer.length && inner.startsWith(outer)) return inner.slice(outer.length);
  }
  return '    ';
}

/** Adds a child as the last of the element, on a line of its own where the others have one. */
export function appendChild(text: string, element: XmlElement, child: string, unit: string): Edit {
  const outer = indentAt(text, element.start);
  const last = element.children[element.children.length - 1];
  if (element.selfClosing) {
    const slash = text.lastIndexOf('/', element.openEnd);
    const from = text.slice(0, slash).trimEnd().length;
    return { from, to: element.openEnd, insert: `>\n${outer}${unit}${child}\n${outer}</${element.name}>` };
  }
  if (last) {
    const ownLine = text.slice(element.openEnd, last.start).includes('\n');
    return { from: last.end, to: last.end, insert: ownLine ? `\n${indentAt(text, last.start)}${child}` : ` ${child}` };
  }
  return { from: element.openEnd, to: element.closeStart, insert: `\n${outer}${unit}${child}\n${outer}` };
}

/** Applies edits that do not overlap; insertions at one place come in the order given. */
export function applyEdits(text: string, edits: readonly Edit[]): string {
  return edits.map((edit, order) => ({ ...edit, order })).sort((a, b) => b.from - a.from || b.order - a.order)
    .reduce((out, { from, to, insert }) => out.slice(0, from) + insert + out.slice(to), text);
}
