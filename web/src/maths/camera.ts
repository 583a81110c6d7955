// Cameras one moves: an orbit about a target, and a walker. Angles are degrees.
import { add, clamp, degrees, length, scale, sub, type Vec3 } from './vec.ts';

export interface LookAt {
  eye: Vec3;
  target: Vec3;
  up: Vec3;
  fov: number; // vertical, degrees
  near: number;
  far: number;
}

/** Longitude 0 is +Z and grows towards +X; latitude 90 is above. The service uses the same. */
export interface Orbit {
  azimuth: number;
  elevation: number;
  distance: number;
  target: Vec3;
}

/** Yaw 0 looks along +Z, 90 along +X; a positive pitch looks up. */
export interface Walk {
  eye: Vec3;
  yaw: number;
  pitch: number;
}

/** At the poles the azimuth would have no meaning. */
export const maxElevation = 89;

export const wrapDegrees = (angle: number): number => ((((angle + 180) % 360) + 360) % 360) - 180;

function direction(azimuth: number, elevation: number): Vec3 {
  const a = azimuth / degrees, e = elevation / degrees;
  return [Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e)];
}

function angles(d: Vec3): { azimuth: number; elevation: number } {
  const r = length(d) || 1;
  return {
    azimuth: Math.atan2(d[0], d[2]) * degrees,
    elevation: Math.asin(clamp(d[1] / r, -1, 1)) * degrees,
  };
}

export function orbitOf({ eye, target }: Pick<LookAt, 'eye' | 'target'>): Orbit {
  const d = sub(eye, target);
  const { azimuth, elevation } = angles(d);
  return { azimuth, elevation: clamp(elevation, -maxElevation, maxElevation), distance: length(d) || 1, target };
}

export const orbitEye = (orbit: Orbit): Vec3 =>
  add(orbit.target, scale(direction(orbit.azimuth, orbit.elevation), orbit.distance));

export function turnOrbit(orbit: Orbit, azimuth: number, elevation: number): Orbit {
  return {
    ...orbit,
    azimuth: wrapDegrees(orbit.azimuth + azimuth),
    elevation: clamp(orbit.elevation + elevation, -maxElevation, maxElevation),
  };
}

export const zoomOrbit = (orbit: Orbit, factor: number): Orbit => ({
  ...orbit,
  distance: clamp(orbit.distance * factor, 1e-4, 1e9),
});

/** Moves the target with the picture: by pixels, x to the right and y down, of a stage so high. */
export function panOrbit(orbit: Orbit, dx: number, dy: number, fov: number, stageHeight: number): Orbit {
  const perPixel = (2 * orbit.distance * Math.tan(fov / 2 / degrees)) / Math.max(1, stageHeight);
  const a = orbit.azimuth / degrees, e = orbit.elevation / degrees;
  const right: Vec3 = [Math.cos(a), 0, -Math.sin(a)];
  const up: Vec3 = [-Math.sin(a) * Math.sin(e), Math.cos(e), -Math.cos(a) * Math.sin(e)];
  const move = add(scale(right, -dx * perPixel), scale(up, dy * perPixel));
  return { ...orbit, target: add(orbit.target, move) };
}

/** Moves the target on the ground plane, in shares of the distance. */
export function slideOrbit(orbit: Orbit, forward: number, right: number): Orbit {
  const a = orbit.azimuth / degrees;
  const move: Vec3 = [
    -Math.sin(a) * forward + Math.cos(a) * right, 0, -Math.cos(a) * forward - Math.sin(a) * right,
  ];
  return { ...orbit, target: add(orbit.target, scale(move, orbit.distance)) };
}

export function walkOf({ eye, target }: Pick<LookAt, 'eye' | 'target'>): Walk {
  const { azimuth, elevation } = angles(sub(target, eye));
  return { eye, yaw: azimuth, pitch: elevation };
}

export const walkTarget = (walk: Walk): Vec3 => add(walk.eye, direction(walk.yaw, clamp(walk.pitch, -maxElevation, maxElevation)));

/** To the left and up are positive; the pitch stays within 90 degrees. */
export const turnWalk = (walk: Walk, left: number, up: number): Walk => ({
  ...walk,
  yaw: wrapDegrees(walk.yaw + left),
  pitch: clamp(walk.pitch + up, -maxElevation, maxElevation),
});

/** Steps along the view and to the right of it, in world units. */
export function stepWalk(walk: Walk, forward: number, right: number): Walk {
  const y = walk.yaw / degrees;
  const aside: Vec3 = [-Math.cos(y), 0, Math.sin(y)];
  const ahead = direction(walk.yaw, walk.pitch);
  return { ...walk, eye: add(walk.eye, add(scale(ahead, forward), scale(aside, right))) };
}

/** The vertical field of view that keeps the whole of the scene's window in a narrower stage. */
export function fitFov(fov: number, windowAspect: number, stageAspect: number): number {
  if (stageAspect >= windowAspect) return fov;
  const half = Math.tan(fov / 2 / degrees) * (windowAspect / stageAspect);
  return clamp(2 * Math.atan(half) * degrees, 0.01, 170);
}
