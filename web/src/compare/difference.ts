// Where two images differ: the absolute difference of each channel, made visible.

export interface Rgba {
  width: number;
  height: number;
  data: Uint8ClampedArray;
}

/** Writes |a - b| times `gain` into `out`; all three have one size. Returns the share of pixels that differ at all. */
export function difference(a: Uint8ClampedArray, b: Uint8ClampedArray, out: Uint8ClampedArray, gain: number): number {
  let differ = 0;
  for (let i = 0; i < out.length; i += 4) {
    let any = 0;
    for (let k = i; k < i + 3; ++k) {
      const away = Math.abs((a[k] as number) - (b[k] as number));
      any |= away;
      out[k] = away * gain;
    }
    out[i + 3] = 255;
    if (any !== 0) differ += 1;
  }
  return differ / (out.length / 4 || 1);
}
