// The search of a distance by images of eight bits.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { findDepth } from '../../../web/src/maths/depth.ts';

/** A pixel of the layer of depths: the nearest of the surfaces that the near plane leaves. */
const pixel = (...distances: number[]) => {
  let asked = 0;
  const at = async (near: number): Promise<number> => {
    ++asked;
    const seen = Math.min(...distances.filter((distance) => distance >= near));
    return Number.isFinite(seen) ? Math.round((255 * near) / seen) : 0;
  };
  return { at, asked: () => asked };
};

test('a distance is found to one part in ten thousand, near and far', async () => {
  let seed = 7;
  for (let i = 0; i < 300; ++i) {
    seed = (seed * 48271) % 2147483647;
    const distance = 0.1 * 10 ** (4 * (seed / 2147483647)) * 1.01; // 0.101 to 1010
    const { at, asked } = pixel(distance);
    const found = await findDepth(0.1, 2000, at);
    assert.ok(found && found.least <= distance * 1.000001 && found.most >= distance * 0.999999, `${distance}: ${JSON.stringify(found)}`);
    assert.ok((found.most - found.least) / distance < 2e-4, `${distance}: ${found.most - found.least}`);
    assert.ok(asked() <= 12, `${asked()} images`);
  }
});

test('a surface behind is not found instead of the near one', async () => {
  const found = await findDepth(0.1, 100, pixel(5, 5.5, 60).at);
  assert.ok(found && found.least <= 5 && found.most >= 5 && found.most < 5.01);
});

test('where nothing is there is no distance', async () => {
  assert.equal(await findDepth(0.1, 1000, async () => 0), null);
});
