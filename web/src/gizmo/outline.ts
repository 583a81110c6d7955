// The outline of what is selected, from the numbers of the models that the pixels show.

export interface Pixels {
  width: number;
  height: number;
  data: Uint8ClampedArray<ArrayBuffer>; // red, green, blue, alpha
}

type Rgba = readonly [number, number, number, number];
const bright: Rgba = [255, 176, 32, 255], dark: Rgba = [10, 16, 22, 200];

/** Where `inside` is 1 within `radius` pixels, across and along: a square grows by two passes. */
function grown(inside: Uint8Array, width: number, height: number, radius: number): Uint8Array {
  const across = new Uint8Array(inside.length), out = new Uint8Array(inside.length);
  for (let y = 0; y < height; ++y)
    for (let x = 0, reach = -1; x < width + radius; ++x) {
      if (x < width && inside[y * width + x]) reach = x + radius;
      const at = x - radius;
      if (at >= 0 && reach >= at) across[y * width + at] = 1;
    }
  for (let x = 0; x < width; ++x)
    for (let y = 0, reach = -1; y < height + radius; ++y) {
      if (y < height && across[y * width + x]) reach = y + radius;
      const at = y - radius;
      if (at >= 0 && reach >= at) out[at * width + x] = 1;
    }
  return out;
}

/**
 * A bright line with a dark one around it, outside of the pixels whose number is among `chosen`; null where there is
 * none. `radius` is the bright line's width in pixels; the dark one is half of it.
 */
export function outlineOf(numbers: Uint32Array, width: number, height: number, chosen: ReadonlySet<number>, radius: number): Pixels | null {
  const inside = new Uint8Array(numbers.length);
  let any = false;
  for (let i = 0; i < numbers.length; ++i)
    if (numbers[i] !== 0 && chosen.has(numbers[i] as number)) {
      inside[i] = 1;
      any = true;
    }
  if (!any) return null;
  const near = grown(inside, width, height, radius), far = grown(near, width, height, Math.ceil(radius / 2));
  const data = new Uint8ClampedArray(4 * numbers.length);
  for (let i = 0; i < inside.length; ++i) {
    if (inside[i] || !far[i]) continue;
    data.set(near[i] ? bright : dark, 4 * i);
  }
  return { width, height, data };
}
