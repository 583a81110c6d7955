/** Vectors of three numbers, right-handed, +Y up. */
export type Vec3 = readonly [number, number, number];

export const degrees = 180 / Math.PI;

export const clamp = (x: number, low: number, high: number): number =>
  Math.min(high, Math.max(low, x));

export const add = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Vec3, s: number): Vec3 => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec3, b: Vec3): Vec3 =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a: Vec3): number => Math.hypot(a[0], a[1], a[2]);

export function parseVec(text: string | null): Vec3 | null {
  if (!text) return null;
  const numbers = text.split(',').map(Number);
  const [x, y, z] = numbers;
  if (numbers.length !== 3 || !numbers.every(Number.isFinite)) return null;
  return [x as number, y as number, z as number];
}

/** As short as `digits` significant digits allow: "1,2.5,0". */
export const formatVec = (v: Vec3, digits = 7): string =>
  v.map((x) => String(Number(x.toPrecision(digits)))).join(',');
