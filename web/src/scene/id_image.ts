// Which model each pixel of the image shows: the layer of model numbers, and the elements that they stand for.
import { getModels, type ModelPlaces } from '../api.ts';
import { indexOfColumn } from '../editor/places.ts';
import { fetchPicture } from './frame.ts';
import { isWithin } from './hide.ts';
import { spellings } from './language.ts';
import { baseName } from './scene_files.ts';
import { kindOf } from './tree.ts';
import type { Viewer } from './viewer.ts';
import { attributeOf, parseXml, walkXml, type XmlElement } from './xml.ts';

/** Red, green and blue are the bytes of the number; 0 is nothing. */
export const numberOfPixel = (r: number, g: number, b: number): number => r * 65536 + g * 256 + b;

export interface IdImage {
  width: number;
  height: number;
  numbers: Uint32Array; // by rows from the top
}

/** How a layer of the view on show is asked for: lines and cubes drawn over the models would hide them. */
export function layerOptions(viewer: Viewer, layer: 'id' | 'depth'): Record<string, string | number> {
  const { axes: _a, curves: _c, focus: _f, debug: _d, shading: _s, ...options } = viewer.pictureOptions();
  return { ...options, layer, aa: 1, format: 'png' };
}

export async function pixelsOf(blob: Blob): Promise<ImageData> {
  const bitmap = await createImageBitmap(blob, { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
  const { width, height } = bitmap;
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true }) as OffscreenCanvasRenderingContext2D;
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  return context.getImageData(0, 0, width, height);
}

async function readIds(viewer: Viewer): Promise<IdImage | null> {
  const response = await fetchPicture(viewer.origin(), layerOptions(viewer, 'id'));
  if (!response) return null;
  const { data, width, height } = await pixelsOf(await response.blob());
  const numbers = new Uint32Array(width * height);
  for (let i = 0; i < numbers.length; ++i) numbers[i] = numberOfPixel(data[4 * i] as number, data[4 * i + 1] as number, data[4 * i + 2] as number);
  return { width, height, numbers };
}

let last: { viewer: Viewer; key: string; image: Promise<IdImage | null> } | null = null;

/** The numbers of the view on show; the last view is not asked for again. */
export function idImage(viewer: Viewer): Promise<IdImage | null> {
  const { text, files } = viewer.origin(), key = JSON.stringify([layerOptions(viewer, 'id'), text, files.added.map(({ path, file }) => [path, file.size]), files.removed]);
  if (last?.viewer === viewer && last.key === key) return last.image;
  const image = readIds(viewer), mine = { viewer, key, image };
  last = mine;
  image.catch(() => {
    if (last === mine) last = null;
  });
  return image;
}

const startsOf = (lines: readonly string[]): number[] => {
  let at = 0;
  return lines.map((line) => (at += line.length + 1) - line.length - 1);
};

/** The elements of the drawn copies: that of number n is the entry n - 1; null where it is of no document here. */
export async function elementsDrawn(viewer: Viewer): Promise<(XmlElement | null)[]> {
  await viewer.loadText();
  const { models, copies } = await placesOf(viewer), text = viewer.text.value ?? '', all = [...walkXml(parseXml(text))];
  const byStart = new Map(all.map((one) => [one.start, one])), includes = all.filter((one) => kindOf(one) === 'include');
  const lines = text.split('\n'), starts = startsOf(lines);
  const elements = models.map(({ file, line, column }): XmlElement | null => {
    if (viewer.isOfDocument({ file })) return byStart.get((starts[line - 1] ?? -1) + indexOfColumn(lines[line - 1] ?? '', column)) ?? null;
    return includes.find((one) => baseName(attributeOf(one, spellings('xml', 'file'))?.value ?? '') === baseName(file)) ?? null;
  });
  const { hidden } = viewer.marks.value;
  return copies.map((model) => elements[model] ?? null).filter((element) => !element || !isWithin(element, hidden));
}

/** The places of the models of the whole document; kept until it changes. */
async function placesOf(viewer: Viewer): Promise<ModelPlaces> {
  if (viewer.document().text === null && viewer.id !== null) return (viewer.places ??= await getModels(viewer.id));
  const { models = [], copies = [] } = (await viewer.validated()) ?? {};
  return { models, copies };
}
