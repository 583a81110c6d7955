// How a document writes elements: the spelling of names, quotes and ends of those that it has, or of its dialect.
import { spellings } from './language.ts';
import { mannerOf } from './materials.ts';
import { axes, numberAt, type Axis } from './transforms.ts';
import { parseNumber, plainStyle, styleOf, writeNumber } from './number_text.ts';
import { attributeOf, escapeFor, parseXml, setAttribute, walkXml, type Edit, type XmlElement } from './xml.ts';
import type { Vec3 } from '../maths/vec.ts';

const inCaseOf = (axis: Axis, example: string): string => (/[XYZ]$/.test(example) ? axis.toUpperCase() : axis);

/** The attribute's name for an axis, like those that the element has: posX beside posY, Z beside X. */
export function axisName(element: XmlElement, names: Record<Axis, readonly string[]>, axis: Axis): string {
  const own = attributeOf(element, names[axis]);
  if (own) return own.name;
  for (const other of axes) {
    const found = attributeOf(element, names[other]);
    if (found) return found.name.slice(0, -1) + inCaseOf(axis, found.name);
  }
  return names[axis][0] as string;
}

/** Every spelling of the three attributes: x, y, z of a transform, pos or dir of a light. */
export const vectorNames = (element: string, prefix = ''): Record<Axis, readonly string[]> =>
  Object.fromEntries(axes.map((axis) => [axis, spellings(element, prefix === '' ? axis : `${prefix}${axis.toUpperCase()}`)])) as unknown as Record<Axis, readonly string[]>;

/** Sets the numbers that changed, each as it is written there; a number that is missing is written like its neighbours. */
export function setVector(element: XmlElement, names: Record<Axis, readonly string[]>, before: Vec3, after: Vec3, decimals: number): Edit[] {
  const texts = axes.map((axis) => attributeOf(element, names[axis])?.value), least = Math.max(0, ...texts.map((text) => styleOf(text ?? '').decimals));
  let added = ''; // all in one place, in their order
  const edits: Edit[] = [], quote = element.attributes[element.attributes.length - 1]?.quote || '"';
  axes.forEach((axis, i) => {
    if (after[i] === before[i]) return;
    const text = texts[i], value = after[i] as number;
    if (text !== undefined) edits.push(setAttribute(element, names[axis], writeNumber(value, styleOf(text), decimals)));
    else added += ` ${axisName(element, names, axis)}=${quote}${writeNumber(value, { ...plainStyle, decimals: Math.min(least, 3) }, decimals)}${quote}`;
  });
  if (added !== '') {
    const last = element.attributes[element.attributes.length - 1], at = last ? last.end : element.start + 1 + element.name.length;
    edits.push({ from: at, to: at, insert: added });
  }
  return edits;
}

export function setNumberAt(element: XmlElement, names: readonly string[], value: number, decimals: number): Edit[] {
  const text = attributeOf(element, names)?.value;
  if (text !== undefined && parseNumber(text) === value) return [];
  return [setAttribute(element, names, writeNumber(value, text === undefined ? plainStyle : styleOf(text), decimals))];
}

const exampleOf = (roots: readonly XmlElement[], names: readonly string[]): XmlElement | undefined =>
  [...walkXml(roots)].find((one) => names.some((name) => name.toLowerCase() === one.name.toLowerCase()) && one.attributes.length > 0);

/** Whether the document has its transforms in <transform>; of a document without any, what its dialect does. */
export function wrapsTransforms(roots: readonly XmlElement[]): boolean {
  const wrappers = spellings('transform').map((name) => name.toLowerCase()), direct = ['translate', 'rotate', 'scale'].flatMap((name) => spellings(name));
  for (const element of walkXml(roots)) {
    if (wrappers.includes(element.name.toLowerCase())) return true;
    if (direct.some((name) => name.toLowerCase() === element.name.toLowerCase())) return false;
  }
  return mannerOf(roots) === 'course';
}

/** What comes most often; of as many the first. */
function commonest<T>(all: Iterable<T>, otherwise: T): T {
  const counts = new Map<T, number>();
  for (const one of all) counts.set(one, (counts.get(one) ?? 0) + 1);
  return [...counts].reduce(([best, most], [one, count]) => (count > most ? [one, count] : [best, most]), [otherwise, 0] as [T, number])[0];
}

/** The end and the quote of the document's empty elements. */
function habitsOf(text: string): { end: string; quote: string } {
  const ends: string[] = [], quotes: string[] = [];
  for (const { selfClosing, start, openEnd, attributes } of walkXml(parseXml(text))) {
    for (const { quote } of attributes) if (quote) quotes.push(quote);
    // After a value without quotes a blank is no habit.
    if (selfClosing && attributes[attributes.length - 1]?.quote !== '') ends.push(/\s\/\s*>$/.test(text.slice(start, openEnd)) ? ' />' : '/>');
  }
  return { end: commonest(ends, ' />'), quote: commonest(quotes, '"') };
}

/** The document's own name for a kind of element. */
export const ownName = (roots: readonly XmlElement[], kind: 'group' | 'models' | 'model' | 'light' | 'lights' | 'texture' | 'color' | 'shininess'): string =>
  [...walkXml(roots)].find((one) => spellings(kind).some((name) => name.toLowerCase() === one.name.toLowerCase()))?.name ?? (spellings(kind)[0] as string);

/** An empty element with attributes [name, value], as the document writes them. */
export function emptyElement(text: string, name: string, attributes: readonly (readonly [string, string])[]): string {
  const { end, quote } = habitsOf(text);
  return `<${name}${attributes.map(([key, value]) => ` ${key}=${quote}${escapeFor(quote, value)}${quote}`).join('')}${end}`;
}

/** A new transform with these numbers, spelled like the document's own of that kind. */
export function newTransform(text: string, roots: readonly XmlElement[], kind: 'translate' | 'rotate' | 'scale', vector: Vec3, angle: number | null, decimals: number): string {
  const example = exampleOf(roots, spellings(kind)), names = vectorNames(kind);
  const anyVector = example ?? exampleOf(roots, (['translate', 'scale'] as const).flatMap((name) => spellings(name)));
  const isUpper = anyVector?.attributes.some(({ name }) => /^[XYZ]$/.test(name)) ?? false;
  const nameOf = (axis: Axis): string => {
    if (example && axes.some((one) => attributeOf(example, names[one]))) return axisName(example, names, axis);
    if (kind === 'rotate' && mannerOf(roots) === 'engine2017') return `axis${axis.toUpperCase()}`;
    return isUpper ? axis.toUpperCase() : axis;
  };
  const numbers = axes.map((axis, i) => [nameOf(axis), writeNumber(vector[i] as number, plainStyle, decimals)] as const);
  const turn = angle === null ? [] : [[(example && attributeOf(example, spellings('rotate', 'angle'))?.name) ?? 'angle', writeNumber(angle, plainStyle, decimals)] as const];
  return emptyElement(text, example?.name ?? kind, [...turn, ...numbers]);
}

export const vectorAt = (element: XmlElement, names: Record<Axis, readonly string[]>, otherwise = 0): Vec3 =>
  axes.map((axis) => numberAt(element, names[axis]) ?? otherwise) as unknown as Vec3;
