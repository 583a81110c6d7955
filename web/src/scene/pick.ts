// Which model a pixel shows: a picture of model numbers, and the list of their lines.
import { getModels, type ModelPlaces } from '../api.ts';
import type { Viewer } from './viewer.ts';
import { fetchPicture, type Origin } from './frame.ts';
import { say } from '../views/ui.tsx';

/** Red, green and blue are the bytes of the number; 0 is nothing. */
export const numberOfPixel = (r: number, g: number, b: number): number => r * 65536 + g * 256 + b;

/** The places of the models of the document on show; kept until it changes. */
async function placesOf(viewer: Viewer, origin: Origin): Promise<ModelPlaces> {
  if (origin.text === null && viewer.id !== null) return (viewer.places ??= await getModels(viewer.id));
  const { models = [], copies = [] } = (await viewer.validated()) ?? {};
  return { models, copies };
}

/** The number at a place of the stage, in CSS pixels. */
async function numberAt(viewer: Viewer, origin: Origin, x: number, y: number): Promise<number> {
  const stage = viewer.canvas?.size();
  if (!stage) return 0;
  // Lines and cubes drawn over the models would hide them.
  const { axes: _a, curves: _c, focus: _f, debug: _d, shading: _s, ...options } = viewer.pictureOptions();
  Object.assign(options, { layer: 'id', aa: 1, format: 'png' });
  const response = await fetchPicture(origin, options);
  if (!response) return 0;
  const bitmap = await createImageBitmap(await response.blob(), { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
  const px = Math.min(bitmap.width - 1, Math.floor((x / stage.width) * bitmap.width));
  const py = Math.min(bitmap.height - 1, Math.floor((y / stage.height) * bitmap.height));
  const context = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true }) as OffscreenCanvasRenderingContext2D;
  context.drawImage(bitmap, px, py, 1, 1, 0, 0, 1, 1);
  const [r = 0, g = 0, b = 0] = context.getImageData(0, 0, 1, 1).data;
  bitmap.close();
  return numberOfPixel(r, g, b);
}

/** Selects the model under a place of the stage; its line is marked where the XML is on show. */
export async function pickModel(viewer: Viewer, x: number, y: number): Promise<void> {
  try {
    const origin = viewer.origin();
    const [number] = await Promise.all([numberAt(viewer, origin, x, y), viewer.loadText()]);
    const places = number > 0 ? await placesOf(viewer, origin) : null;
    const model = places?.models[places.copies[number - 1] ?? -1];
    if (number > 0 && !model) say(`Model ${number} of this scene has no place in the document.`);
    viewer.picked.value = model?.line ? { number, line: model.line } : null;
    if (model?.line) viewer.reveal.value = { line: model.line, column: model.column };
  } catch (fault) {
    viewer.report(fault);
  }
}

