// Materials and lights in the XML, in whichever dialect the document writes them.
import { spellings } from './language.ts';
import { emptyElement, ownName } from './writing.ts';
import {
  appendChild, applyEdits, attributeOf, childOf, indentUnit, lineOf, parseXml, setAttribute, walkXml, type Edit, type XmlElement,
} from './xml.ts';

export type Rgb = readonly [number, number, number]; // 0 to 1
export type Component = 'diffuse' | 'ambient' | 'specular' | 'emissive';
export const components: readonly Component[] = ['diffuse', 'ambient', 'specular', 'emissive'];

/** How a document writes colours: children with 0..255, attributes with 0..1, or names. */
export type Manner = 'course' | 'engine2017' | 'engine2020';

export interface Part {
  kind: 'model' | 'light';
  index: number; // among its kind, in document order
  label: string;
  group: string;
  line: number;
  start: number; // of the element's "<" in the text
}

const isLight = (element: XmlElement): boolean => element.name.toLowerCase() === 'light';
const isModel = (element: XmlElement): boolean => element.name.toLowerCase() === 'model';
const prefix: Record<Component, string> = { diffuse: 'diff', ambient: 'ambt', specular: 'spec', emissive: 'emis' };
/** The attributes of one channel of a colour. */
const channelNames = (element: XmlElement, component: Component, c: string): readonly string[] =>
  spellings(isLight(element) && component !== 'emissive' ? 'light' : 'model', prefix[component] + c);
const words: Record<Component, readonly string[]> = {
  diffuse: spellings('model', 'diffuse'), ambient: spellings('model', 'ambient'), specular: spellings('model', 'specular'),
  emissive: spellings('model', 'emission'),
};
const children: Record<Component, readonly string[]> = {
  diffuse: spellings('diffuse'), ambient: spellings('ambient'), specular: spellings('specular'), emissive: spellings('emissive'),
};
const shininessNames = spellings('model', 'shininess'), exponentNames = spellings('shininess', 'value');
const textureNames = spellings('model', 'texture'), fileNames = spellings('texture', 'file');
const channel = ['R', 'G', 'B'] as const;

export function mannerOf(roots: readonly XmlElement[]): Manner {
  const root = roots[0];
  const stated = root && attributeOf(root, ['dialect'])?.value.toLowerCase();
  if (stated === 'engine2017' || stated === '2017') return 'engine2017';
  if (stated === 'engine2020' || stated === '2020') return 'engine2020';
  if (root?.name.toLowerCase() !== 'scene') return 'course';
  for (const element of walkXml(roots)) {
    const name = element.name.toLowerCase();
    if (name === 'colors' || name === 'skybox' || attributeOf(element, ['command', 'attenuation'])) return 'engine2020';
    if (name === 'transform' || (name === 'color' && element.parent && isModel(element.parent))) return 'course';
    if (attributeOf(element, ['diffR', 'axisX', 'rand'])) return 'engine2017';
  }
  return 'engine2017';
}

function groupName(element: XmlElement): string {
  for (let one = element.parent; one; one = one.parent) {
    const name = one.name.toLowerCase() === 'group' ? attributeOf(one, spellings('group', 'name'))?.value : undefined;
    if (name) return name;
  }
  return '';
}

export function partsOf(text: string, roots: readonly XmlElement[]): Part[] {
  const out: Part[] = [];
  let models = 0, lights = 0;
  for (const element of walkXml(roots)) {
    if (!isModel(element) && !isLight(element)) continue;
    const kind = isModel(element) ? 'model' : 'light';
    const named = attributeOf(element, ['name', 'id'])?.value;
    const what = kind === 'model' ? attributeOf(element, [...spellings('model', 'file'), 'command'])?.value : attributeOf(element, ['type'])?.value ?? 'point';
    out.push({
      kind, index: kind === 'model' ? models++ : lights++, label: named ?? what ?? kind, group: groupName(element), line: lineOf(text, element.start), start: element.start,
    });
  }
  return out;
}

export function elementOf(roots: readonly XmlElement[], kind: Part['kind'], index: number): XmlElement | undefined {
  let seen = 0;
  for (const element of walkXml(roots))
    if ((kind === 'model' ? isModel(element) : isLight(element)) && seen++ === index) return element;
  return undefined;
}

const numberIn = (element: XmlElement | undefined, names: readonly string[]): number | undefined => {
  const found = element && attributeOf(element, names);
  const value = Number.parseFloat(found?.value ?? '');
  return Number.isFinite(value) ? value : undefined;
};
export const numberOf = (element: XmlElement, names: readonly string[], otherwise: number): number => numberIn(element, names) ?? otherwise;

const hex = (text: string): Rgb | undefined => {
  const digits = /^#([0-9a-f]{6})$/i.exec(text.trim())?.[1];
  return digits ? [0, 2, 4].map((i) => parseInt(digits.slice(i, i + 2), 16) / 255) as unknown as Rgb : undefined;
};
export const toHex = (color: Rgb): string =>
  `#${color.map((x) => Math.round(Math.min(1, Math.max(0, x)) * 255).toString(16).padStart(2, '0')).join('')}`;
export const fromHex = (text: string): Rgb => hex(text) ?? [0, 0, 0];

function namedColor(roots: readonly XmlElement[], name: string): Rgb | undefined {
  for (const element of walkXml(roots)) {
    if (element.parent?.name.toLowerCase() !== 'colors' || attributeOf(element, ['name'])?.value !== name) continue;
    return channel.map((c) => numberOf(element, spellings('namedColor', c.toLowerCase()), 0)) as unknown as Rgb;
  }
  return undefined;
}

const materialDefaults = (manner: Manner): Record<Component, Rgb> => {
  const [d, a] = manner === 'course' ? [200 / 255, 50 / 255] : [0.8, 0.2];
  return { diffuse: [d, d, d], ambient: [a, a, a], specular: [0, 0, 0], emissive: [0, 0, 0] };
};
const lightDefaults: Record<Component, Rgb> = { diffuse: [1, 1, 1], ambient: [0, 0, 0], specular: [1, 1, 1], emissive: [0, 0, 0] };

const colorElement = (model: XmlElement): XmlElement | undefined => childOf(model, ...spellings('color'));

/** A colour of a model or light; components are 0 to 1. */
export function colorOf(roots: readonly XmlElement[], element: XmlElement, component: Component): Rgb {
  const defaults = isLight(element) ? lightDefaults[component] : materialDefaults(mannerOf(roots))[component];
  const holder = colorElement(element);
  const child = holder && childOf(holder, ...children[component]);
  if (child) {
    const max = numberOf(child, ['max'], 255);
    return channel.map((c, i) => (numberIn(child, spellings('diffuse', c)) ?? (defaults[i] as number) * max) / max) as unknown as Rgb;
  }
  const word = attributeOf(element, words[component])?.value;
  if (word) return hex(word) ?? namedColor(roots, word) ?? defaults;
  const values = channel.map((c) => numberIn(element, channelNames(element, component, c)));
  if (values.every((value) => value === undefined)) return defaults;
  const most = Math.max(...values.map((value) => value ?? 0));
  return values.map((value, i) => (value === undefined ? (defaults[i] as number) : most > 1 ? value / 255 : value)) as unknown as Rgb;
}

const trim = (value: number, digits = 4): string => String(Number(value.toPrecision(digits)));

/** Writes a colour where the document has it, or in the manner of its dialect. */
export function setColor(text: string, kind: Part['kind'], index: number, component: Component, color: Rgb): string {
  const roots = parseXml(text), element = elementOf(roots, kind, index);
  if (!element) return text;
  const channels = (target: XmlElement, names: (c: string) => readonly string[], scale: number): Edit[] =>
    channel.map((c, i) => setAttribute(target, names(c), scale === 1 ? trim(color[i] as number, 3) : String(Math.round((color[i] as number) * scale))));
  const holder = colorElement(element), unit = indentUnit(text, roots);
  const child = holder && childOf(holder, ...children[component]);
  if (child) {
    const max = numberOf(child, ['max'], 255);
    return applyEdits(text, channels(child, (c) => spellings('diffuse', c), max));
  }
  const wide = (): string => emptyElement(text, component, channel.map((c, i) => [c, String(Math.round((color[i] as number) * 255))]));
  if (holder) return applyEdits(text, [appendChild(text, holder, wide(), unit)]);
  if (attributeOf(element, words[component])) return applyEdits(text, [setAttribute(element, words[component], toHex(color))]);
  const present = channel.map((c) => numberIn(element, channelNames(element, component, c))).filter((value) => value !== undefined);
  const manner = mannerOf(roots);
  if (present.length > 0 || manner === 'engine2017' || kind === 'light') {
    const scale = present.some((value) => value > 1) ? 255 : 1;
    return applyEdits(text, channels(element, (c) => channelNames(element, component, c), scale));
  }
  if (manner === 'engine2020') return applyEdits(text, [setAttribute(element, words[component], toHex(color))]);
  return applyEdits(text, [appendChild(text, element, `<color> ${wide()} </color>`, unit)]);
}

export function shininessOf(element: XmlElement): number {
  const holder = colorElement(element), child = holder && childOf(holder, 'shininess');
  return child ? numberOf(child, exponentNames, 0) : numberOf(element, shininessNames, 0);
}

export function setShininess(text: string, index: number, value: number): string {
  const roots = parseXml(text), element = elementOf(roots, 'model', index);
  if (!element) return text;
  const holder = colorElement(element), child = holder && childOf(holder, 'shininess');
  if (child) return applyEdits(text, [setAttribute(child, exponentNames, trim(value))]);
  const shininess = emptyElement(text, 'shininess', [['value', trim(value)]]);
  if (holder) return applyEdits(text, [appendChild(text, holder, shininess, indentUnit(text, roots))]);
  if (mannerOf(roots) !== 'course' || attributeOf(element, shininessNames))
    return applyEdits(text, [setAttribute(element, shininessNames, trim(value))]);
  return applyEdits(text, [appendChild(text, element, `<color> ${shininess} </color>`, indentUnit(text, roots))]);
}

/** Sets an attribute of a model or light. */
export function setNumber(text: string, kind: Part['kind'], index: number, names: readonly string[], value: number): string {
  const element = elementOf(parseXml(text), kind, index);
  return element ? applyEdits(text, [setAttribute(element, names, trim(value, 5))]) : text;
}

export const textureOf = (model: XmlElement): string => {
  const child = childOf(model, 'texture');
  return (child ? attributeOf(child, fileNames) : attributeOf(model, textureNames))?.value ?? '';
};

export function setTexture(text: string, index: number, file: string): string {
  const roots = parseXml(text), model = elementOf(roots, 'model', index);
  if (!model) return text;
  const child = childOf(model, 'texture');
  if (child) return applyEdits(text, [setAttribute(child, fileNames, file)]);
  if (attributeOf(model, textureNames) || mannerOf(roots) !== 'course')
    return applyEdits(text, [setAttribute(model, textureNames, file)]);
  return applyEdits(text, [appendChild(text, model, emptyElement(text, ownName(roots, 'texture'), [['file', file]]), indentUnit(text, roots))]);
}

/** The textures that the document names, for a choice among them. */
export function texturesOf(roots: readonly XmlElement[]): string[] {
  const out = new Set<string>();
  for (const element of walkXml(roots)) if (isModel(element) && textureOf(element)) out.add(textureOf(element));
  return [...out].sort();
}
