// The distance between two places of the image, found by the layer of depths.
import { signal } from '@preact/signals';
import { Lens } from '../gizmo/lens.ts';
import { findDepth } from '../maths/depth.ts';
import { add, dot, length, scale, sub, type Vec3 } from '../maths/vec.ts';
import { t } from '../words.ts';
import { say } from '../views/ui.tsx';
import { fetchPicture } from './frame.ts';
import { layerOptions, pixelsOf } from './id_image.ts';
import type { Viewer } from './viewer.ts';

export interface Place {
  point: Vec3; // world space
  uncertain: number; // most error along the ray, world units
}

/** The surface's place under a point of the stage, CSS pixels; null where there is none, or no camera. */
export async function placeAt(viewer: Viewer, x: number, y: number): Promise<Place | null> {
  const camera = viewer.frame.value?.camera, stage = viewer.canvas?.size();
  if (!camera || !stage) return null;
  let at = { x, y };
  const depth = await findDepth(camera.near, camera.far, async (near) => {
    const response = await fetchPicture(viewer.origin(), { ...layerOptions(viewer, 'depth'), near, far: camera.far });
    if (!response) return 0;
    const { data, width, height } = await pixelsOf(await response.blob());
    const px = Math.min(width - 1, Math.floor((x / stage.width) * width)), py = Math.min(height - 1, Math.floor((y / stage.height) * height));
    at = { x: ((px + 0.5) * stage.width) / width, y: ((py + 0.5) * stage.height) / height };
    return data[4 * (py * width + px)] ?? 0;
  });
  if (!depth) return null;
  const lens = new Lens(camera, stage.width, stage.height), ray = lens.rayAt(at), along = dot(ray.direction, lens.view.forward);
  return {
    point: add(ray.origin, scale(ray.direction, Math.sqrt(depth.least * depth.most) / along)),
    uncertain: (depth.most - depth.least) / 2 / along,
  };
}

/** The places of the measurement on show: none, one or two. */
export const measured = signal<readonly Place[]>([]);

export const distanceOf = ([from, to]: readonly Place[]): { distance: number; uncertain: number } | null =>
  from && to ? { distance: length(sub(to.point, from.point)), uncertain: from.uncertain + to.uncertain } : null;

/** The first place, the second, and again the first of a new measurement. */
export async function measureAt(viewer: Viewer, x: number, y: number): Promise<void> {
  try {
    const place = await placeAt(viewer, x, y);
    if (!place) return say(t('There is nothing to measure to at this place.'));
    measured.value = measured.value.length === 1 ? [...measured.value, place] : [place];
  } catch (fault) {
    viewer.report(fault);
  }
}
