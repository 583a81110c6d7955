// Steps of the history, and the view, in words for a screen reader.
import { orbitOf } from '../maths/camera.ts';
import type { Viewer } from '../scene/viewer.ts';
import { number, t } from '../words.ts';
import { announce } from './focus.ts';

export function undo(viewer: Viewer): void {
  if (!viewer.canUndo.peek()) return;
  viewer.undo();
  announce(t('Undone.'));
}

export function redo(viewer: Viewer): void {
  if (!viewer.canRedo.peek()) return;
  viewer.redo();
  announce(t('Done again.'));
}

/** From where the scene is seen, and at which time. */
export function viewWords(viewer: Viewer): string {
  const short = (value: number): string => number(value, { maximumFractionDigits: 1 });
  const walk = viewer.walk.value, orbit = viewer.orbit.value ?? (viewer.home && orbitOf(viewer.home));
  const place = walk ? t('At {x}, {y}, {z}', { x: short(walk.eye[0]), y: short(walk.eye[1]), z: short(walk.eye[2]) })
    : orbit ? t('Azimuth {azimuth}°, elevation {elevation}°, distance {distance}', { azimuth: short(orbit.azimuth), elevation: short(orbit.elevation), distance: short(orbit.distance) }) : '';
  const time = viewer.clock.animated.value ? t('{time} s', { time: short(viewer.clock.time.value) }) : '';
  return [place, time].filter(Boolean).join(', ');
}
