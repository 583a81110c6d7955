// Affine matrices of 3 rows and 4 columns: the columns are the images of x, y and z, and the origin.
import { add, cross, degrees, dot, length, scale, sub, type Vec3 } from './vec.ts';

export interface Affine {
  x: Vec3;
  y: Vec3;
  z: Vec3;
  origin: Vec3;
}

export const identity: Affine = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1], origin: [0, 0, 0] };

/** Turns and scales a direction; the origin does not count. */
export const applyLinear = (m: Affine, v: Vec3): Vec3 => add(add(scale(m.x, v[0]), scale(m.y, v[1])), scale(m.z, v[2]));
export const applyAffine = (m: Affine, p: Vec3): Vec3 => add(m.origin, applyLinear(m, p));
export const multiply = (a: Affine, b: Affine): Affine =>
  ({ x: applyLinear(a, b.x), y: applyLinear(a, b.y), z: applyLinear(a, b.z), origin: applyAffine(a, b.origin) });

export const translation = (origin: Vec3): Affine => ({ ...identity, origin });
export const scaling = ([x, y, z]: Vec3): Affine => ({ x: [x, 0, 0], y: [0, y, 0], z: [0, 0, z], origin: [0, 0, 0] });

/** Returns the inverse, or null where the matrix flattens something. */
export function inverse(m: Affine): Affine | null {
  const yz = cross(m.y, m.z), zx = cross(m.z, m.x), xy = cross(m.x, m.y), determinant = dot(m.x, yz);
  if (!(Math.abs(determinant) > 1e-12 * length(m.x) * length(m.y) * length(m.z))) return null;
  const [r, s, t] = [yz, zx, xy].map((row) => scale(row, 1 / determinant)) as unknown as [Vec3, Vec3, Vec3];
  const linear: Affine = { x: [r[0], s[0], t[0]], y: [r[1], s[1], t[1]], z: [r[2], s[2], t[2]], origin: [0, 0, 0] };
  return { ...linear, origin: scale(applyLinear(linear, m.origin), -1) };
}

/** A turn by degrees about an axis of any length; a zero axis turns nothing. Quarter turns are exact. */
export function rotation(axis: Vec3, angle: number): Affine {
  const size = length(axis);
  if (!(size > 0)) return identity;
  const [x, y, z] = scale(axis, 1 / size), quarter = angle / 90;
  const exact = Number.isInteger(quarter) ? ([[1, 0], [0, 1], [-1, 0], [0, -1]] as const)[((quarter % 4) + 4) % 4] : undefined;
  const [c, s] = exact ?? [Math.cos(angle / degrees), Math.sin(angle / degrees)], k = 1 - c;
  return {
    x: [x * x * k + c, x * y * k + z * s, x * z * k - y * s],
    y: [x * y * k - z * s, y * y * k + c, y * z * k + x * s],
    z: [x * z * k + y * s, y * z * k - x * s, z * z * k + c],
    origin: [0, 0, 0],
  };
}

/** The turn of a rotation: its axis, of length 1, and degrees from 0 to 180. */
export function axisAngle({ x, y, z }: Affine): { axis: Vec3; angle: number } {
  const twice: Vec3 = [y[2] - z[1], z[0] - x[2], x[1] - y[0]], sine = length(twice), cosine = x[0] + y[1] + z[2] - 1;
  const angle = Math.atan2(sine, cosine) * degrees;
  if (sine > 1e-6) return { axis: scale(twice, 1 / sine), angle };
  if (cosine > 0) return { axis: [0, 1, 0], angle: 0 };
  // Half a turn: the matrix is 2 a a^T - 1, of which the longest column is along the axis.
  const columns: Vec3[] = [add(x, [1, 0, 0]), add(y, [0, 1, 0]), add(z, [0, 0, 1])];
  const longest = columns.reduce((a, b) => (length(b) > length(a) ? b : a));
  return { axis: scale(longest, 1 / length(longest)), angle: 180 };
}

/** The vector with length 1; zero stays zero. */
export const unit = (v: Vec3): Vec3 => scale(v, 1 / (length(v) || 1));
export const distance = (a: Vec3, b: Vec3): number => length(sub(a, b));
