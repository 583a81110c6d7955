// Closed Catmull-Rom curves and the frame that moves along them, as the service computes them (scene/animation.cpp).
import { cross, dot, length, scale, sub, add, type Vec3 } from './vec.ts';
import { identity, type Affine } from './matrix.ts';

/** The part of a period that has passed at `timeS`, 0 <= lap < 1. */
export function lapAt(timeS: number, seconds: number): number {
  const lap = (timeS % seconds) / seconds;
  return lap < 0 ? lap + 1 : lap;
}

/** `u` is the part of the lap; the tangent is by the lap. */
export function catmullRom(points: readonly Vec3[], u: number): { position: Vec3; tangent: Vec3 } {
  const n = points.length;
  if (n === 0) return { position: [0, 0, 0], tangent: [0, 0, 0] };
  const along = lapAt(u, 1) * n, at = Math.min(Math.floor(along), n - 1), t = along - at;
  const [a, b, c, d] = [n - 1, 0, 1, 2].map((k) => points[(at + k) % n]) as [Vec3, Vec3, Vec3, Vec3];
  const each = (combine: (a: number, b: number, c: number, d: number) => number): Vec3 =>
    [0, 1, 2].map((i) => combine(a[i] as number, b[i] as number, c[i] as number, d[i] as number)) as unknown as Vec3;
  const k1 = each((p, _, r) => 0.5 * (r - p)), k2 = each((p, q, r, s) => p - 2.5 * q + 2 * r - 0.5 * s), k3 = each((p, q, r, s) => 1.5 * (q - r) + 0.5 * (s - p));
  return {
    position: add(b, scale(add(k1, scale(add(k2, scale(k3, t)), t)), t)),
    tangent: scale(add(k1, scale(add(scale(k2, 2), scale(k3, 3 * t)), t)), n),
  };
}

/** The part of `v` across the unit vector `x`, of length 1; null where there is hardly any. */
function across(v: Vec3, x: Vec3): Vec3 | null {
  const rest = sub(v, scale(x, dot(v, x))), size = length(rest);
  return size > 1e-6 * length(v) ? scale(rest, 1 / size) : null;
}

interface Moving {
  x: Vec3;
  y: Vec3;
  isPlaced: boolean;
}

/** The frame turned to the next tangent; a tangent of zero leaves it as it is. */
function advance(frame: Moving, tangent: Vec3): Moving {
  const size = length(tangent);
  if (!(size > 0)) return frame;
  const next = scale(tangent, 1 / size), [w, h, d] = next.map(Math.abs) as unknown as Vec3;
  const least: Vec3 = d <= w && d <= h ? [0, 0, 1] : w <= h ? [1, 0, 0] : [0, 1, 0];
  const side = frame.isPlaced ? across(cross(cross(frame.x, frame.y), next), next) : null;
  return { x: next, y: across(frame.y, next) ?? side ?? across(least, next) ?? [0, 1, 0], isPlaced: true };
}

/** x the tangent, y the up carried along from +Y at 0, its turn over the lap spread evenly; the origin is 0. */
export function alignedFrame(points: readonly Vec3[], u: number): Affine {
  const steps = Math.min(8192, Math.max(256, 32 * Math.min(points.length, 256)));
  const tangentAt = (at: number): Vec3 => catmullRom(points, at).tangent;
  let moving = advance({ x: [0, 0, 0], y: [0, 1, 0], isPlaced: false }, tangentAt(0)), wanted: Moving = { x: [0, 0, 0], y: [0, 1, 0], isPlaced: false };
  const first = moving, before = Math.floor(u * steps);
  for (let i = 1; i <= steps; ++i) {
    if (i === before + 1) wanted = advance(moving, tangentAt(u));
    moving = advance(moving, tangentAt((i % steps) / steps));
  }
  if (!wanted.isPlaced) return identity;
  if (first.isPlaced) {
    const residual = Math.atan2(dot(cross(first.y, moving.y), first.x), dot(first.y, moving.y)), angle = -residual * u;
    wanted = { ...wanted, y: add(scale(wanted.y, Math.cos(angle)), scale(cross(wanted.x, wanted.y), Math.sin(angle))) };
  }
  return { x: wanted.x, y: wanted.y, z: cross(wanted.x, wanted.y), origin: [0, 0, 0] };
}
