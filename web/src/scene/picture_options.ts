// What a picture is asked with: size, quality and camera as the service's picture options.
import { orbitOptions, type Options, type SceneFacts } from '../api.ts';
import { fitFov, walkTarget, type LookAt, type Orbit, type Walk } from '../maths/camera.ts';
import { clamp, formatVec } from '../maths/vec.ts';

export type Quality = 'fast' | 'standard' | 'reference';

export const qualityOptions: Record<Quality, Options> = {
  fast: { aa: 1, error: 1, filter: 'linear' },
  standard: {},
  reference: { aa: 16, error: 0.05, filter: 'anisotropic' },
};

/** The stage, in CSS pixels, and how many of the screen's make one. */
export interface StageSize {
  width: number;
  height: number;
  ratio: number;
}

/** A picture of the stage's size; where that is narrower than the scene's window, the view is wider. */
export function sizeOptions({ width, height, ratio }: StageSize, home: LookAt | null, facts: SceneFacts | null): Options {
  const factor = Math.min(ratio, 2, 2048 / Math.max(width, height, 1));
  const out: Options = {
    width: clamp(Math.round(width * factor), 16, 4096), height: clamp(Math.round(height * factor), 16, 4096),
  };
  if (home && facts?.width && facts.height) {
    const fov = fitFov(home.fov, facts.width / facts.height, width / height);
    if (fov > home.fov + 1e-6) out['fov'] = Number(fov.toFixed(4));
  }
  return out;
}

/** None where the scene's own camera is meant. */
export function cameraOptions(walk: Walk | null, orbit: Orbit | null, home: LookAt | null): Options {
  if (walk) return { eye: formatVec(walk.eye), target: formatVec(walkTarget(walk), 9) };
  if (!orbit) return {};
  return { ...orbitOptions(orbit), ...(home && home.up[1] < 0.999 ? { up: formatVec(home.up) } : {}) };
}
