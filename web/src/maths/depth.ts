// The distance of a surface by images of eight bits.

/** Bounds of the distance along the view. */
export interface Depth {
  least: number;
  most: number;
}

/** Of a pixel, 0..255, in a layer of depths with that near plane; 0 where it shows nothing. */
export type DepthAt = (near: number) => Promise<number>;

/**
 * Where a pixel's surface is between the planes. A pixel is 255 near / distance, to the nearest whole number: a near plane just
 * before the surface leaves 0.6 % of the distance, and planes on either side of it halve that, to one part in ten thousand.
 */
export async function findDepth(near: number, far: number, at: DepthAt): Promise<Depth | null> {
  let least = near, most = far;
  for (let step = 0; step < 12; ++step) {
    const value = await at(least);
    if (value === 0) {
      least *= 500; // a pixel of 0 is farther than 510 near planes
      if (least >= far) return null;
      continue;
    }
    most = Math.min(most, (least * 255) / (value - 0.5));
    least = Math.max(least, (least * 255) / (value + 0.5));
    if (value < 254) continue;
    for (let halving = 0; halving < 6; ++halving) {
      const middle = Math.sqrt(least * most);
      // A surface before the plane is cut away: farther ones, or none, are seen.
      if ((await at(middle)) >= 253) least = middle;
      else most = middle;
    }
    return { least, most };
  }
  return { least, most };
}
