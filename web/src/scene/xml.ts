// The scene's XML as text with places: the elements and attributes of a document that may be broken,
// and changes of single values that touch nothing else.
import { parser } from '@lezer/xml';
import type { Change } from '../editor/places.ts';

export interface XmlAttribute {
  name: string;
  value: string; // entities resolved
  start: number; // of the name
  valueStart: number; // inside the quotes, where there are any
  valueEnd: number;
  quote: '"' | "'" | ''; // '': it has none
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

export type Edit = Change;

const entities: Record<string, string> = { amp: '&', lt: '<', gt: '>', quot: '"', apos: "'" };
const unescape = (text: string): string =>
  text.replace(/&(#x?[0-9a-f]+|\w+);/gi, (all, name: string) => {
    if (!name.startsWith('#')) return entities[name] ?? all;
    const code = name[1]?.toLowerCase() === 'x' ? parseInt(name.slice(2), 16) : parseInt(name.slice(1), 10);
    return code > 0 && code <= 0x10ffff ? String.fromCodePoint(code) : all;
  });
export const escapeXml = (text: string): string =>
  text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');

/**
 * What an attribute may seem to stand in, then everything that looks like one: its name, and its value in double
 * quotes, in single ones, after a quote that is never closed (it ends with the line), or without quotes.
 */
const attributeText =
  /<!--[\s\S]*?-->|<!\[CDATA\[[\s\S]*?\]\]>|(<[?!][^>]*>)|<[\w:.-]+|([A-Za-z_:][\w:.-]*)\s*=\s*(?:"([^"]*)"|'([^']*)'|["']([^\n]*)|((?:(?!\/>)[^\s>])*))/g;
const blanks = (text: string): string => text.replace(/\S/g, ' ');
const tagName = /<(\/\s*)?([A-Za-z_:][\w:.-]*)/y;
/** The rest of a tag that holds something else. */
const tagRest = /[^<>]*>?/y;

/**
 * Everything that looks like an attribute, and the text for the parser, which refuses what the service
 * repairs: attributes without closed quotes and declarations are blanks in it.
 */
function takeAttributes(text: string): { found: XmlAttribute[]; rest: string } {
  const found: XmlAttribute[] = [];
  const rest = text.replace(attributeText, (all: string, ...groups: unknown[]) => {
    const [declaration, name, double, single, unclosed, bare, start] = groups as [...(string | undefined)[], number] as [string, string, string, string, string, string, number];
    if (name === undefined) return declaration === undefined ? all : blanks(all);
    const closed = double ?? single, raw = closed ?? unclosed ?? bare, end = start + all.length;
    const valueEnd = closed === undefined ? end : end - 1;
    const quote = closed === undefined && unclosed === undefined ? '' : (text[valueEnd - raw.length - 1] as '"' | "'");
    found.push({ name, value: unescape(raw), start, valueStart: valueEnd - raw.length, valueEnd, quote, end });
    return closed === undefined ? blanks(all) : all;
  });
  return { found, rest };
}

let last: { text: string; roots: readonly XmlElement[] } = { text: '', roots: [] };

/** The elements of the text, outermost first. Never throws. The text read last is not parsed again. */
export function parseXml(text: string): readonly XmlElement[] {
  if (text !== last.text) last = { text, roots: parse(text) };
  return last.roots;
}

function parse(text: string): XmlElement[] {
  const { found, rest } = takeAttributes(text);
  const roots: XmlElement[] = [];
  let open = null as XmlElement | null, next = 0;
  const attributesIn = (from: number, to: number): XmlAttribute[] => {
    while ((found[next]?.start ?? from) < from) next += 1;
    const first = next;
    while ((found[next]?.start ?? to) < to) next += 1;
    return found.slice(first, next);
  };
  const begin = (name: string, start: number, nameEnd: number, tagEnd: number): void => {
    let openEnd = tagEnd;
    if (rest[tagEnd - 1] !== '>') {
      tagRest.lastIndex = tagEnd;
      openEnd += tagRest.exec(rest)?.[0].length ?? 0;
    }
    const selfClosing = /\/\s*>$/.test(rest.slice(nameEnd, openEnd));
    const element: XmlElement = {
      name, start, openEnd, selfClosing, attributes: attributesIn(nameEnd, openEnd), children: [], parent: open, closeStart: openEnd, end: openEnd,
    };
    (open ? open.children : roots).push(element);
    if (!selfClosing) open = element;
  };
  /** Closes the innermost element of that name, in any case; what is open within it ends here too. */
  const close = (name: string, start: number, end: number): void => {
    let closed = open;
    while (closed && closed.name.toLowerCase() !== name.toLowerCase()) closed = closed.parent;
    if (!closed) return;
    for (let one = open; one && one !== closed; one = one.parent) one.closeStart = one.end = start;
    closed.closeStart = start;
    closed.end = end;
    open = closed.parent;
  };
  parser.parse(rest).iterate({
    enter({ name: kind, from, to }) {
      if (kind === 'Document' || kind === 'Element') return true;
      tagName.lastIndex = from;
      const [, slash, name = ''] = (to > from && kind.endsWith('Tag') && tagName.exec(rest)) || [];
      if (name && slash) close(name, from, to);
      else if (name) begin(name, from, tagName.lastIndex, to);
      return false;
    },
  });
  for (let one = open; one; one = one.parent) one.closeStart = one.end = text.length;
  return roots;
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

/** A value between quotes of that kind. */
export const escapeFor = (quote: string, value: string): string => (quote === "'" ? escapeXml(value).replaceAll("'", '&apos;') : escapeXml(value));

/** The edit that replaces an attribute's value. */
export const setValue = ({ valueStart, valueEnd, quote }: XmlAttribute, value: string): Edit =>
  ({ from: valueStart, to: valueEnd, insert: quote ? escapeFor(quote, value) : `"${escapeXml(value)}"` });

/** Sets the attribute under the name it has, or adds it under the first of the names, quoted like the one before. */
export function setAttribute(element: XmlElement, names: readonly string[], value: string): Edit {
  const found = attributeOf(element, names);
  if (found) return setValue(found, value);
  const last = element.attributes[element.attributes.length - 1];
  const at = last ? last.end : element.start + 1 + element.name.length;
  const quote = last?.quote || '"';
  return { from: at, to: at, insert: ` ${names[0]}=${quote}${escapeFor(quote, value)}${quote}` };
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

const startsLine = (text: string, at: number): boolean => /(^|\n)[ \t]*$/.test(text.slice(Math.max(0, at - 200), at));

/** Adds an element right before another one, on a line of its own where that has one. */
export const insertBefore = (text: string, next: XmlElement, piece: string): Edit =>
  ({ from: next.start, to: next.start, insert: startsLine(text, next.start) ? `${piece}\n${indentAt(text, next.start)}` : `${piece} ` });

/** Adds an element right after another one, on a line of its own where that has one. */
export const insertAfter = (text: string, previous: XmlElement, piece: string): Edit =>
  ({ from: previous.end, to: previous.end, insert: startsLine(text, previous.start) ? `\n${indentAt(text, previous.start)}${piece}` : ` ${piece}` });

/** Adds an element as the first of another one. */
export function prependChild(text: string, element: XmlElement, piece: string, unit: string): Edit {
  const first = element.children[0];
  return first ? insertBefore(text, first, piece) : appendChild(text, element, piece, unit);
}

/** Removes an element, with its line where it has one for itself. */
export function removeElement(text: string, { start, end }: XmlElement): Edit {
  const after = /^[ \t]*(\r?\n|$)/.exec(text.slice(end, end + 200));
  if (!startsLine(text, start) || !after) return { from: start, to: end, insert: '' };
  return { from: start - indentAt(text, start).length, to: end + after[0].length, insert: '' };
}

/** Applies edits that do not overlap; insertions at one place come in the order given. */
export function applyEdits(text: string, edits: readonly Edit[]): string {
  return edits.map((edit, order) => ({ ...edit, order })).sort((a, b) => b.from - a.from || b.order - a.order)
    .reduce((out, { from, to, insert }) => out.slice(0, from) + insert + out.slice(to), text);
}
