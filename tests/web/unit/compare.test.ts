import assert from 'node:assert/strict';
import { test } from 'node:test';
import { fileSource, openSource } from '../../../web/src/compare/source.ts';
import { difference } from '../../../web/src/compare/difference.ts';

test('the difference of two images is each channel’s distance, made brighter, and opaque', () => {
  const a = new Uint8ClampedArray([10, 20, 30, 255, 0, 0, 0, 255, 255, 0, 128, 255, 7, 7, 7, 255]);
  const b = new Uint8ClampedArray([10, 20, 30, 255, 1, 0, 2, 255, 0, 0, 120, 255, 7, 7, 7, 0]);
  const out = new Uint8ClampedArray(16);
  assert.equal(difference(a, b, out, 4), 0.5); // opacity does not count
  assert.deepEqual([...out], [0, 0, 0, 255, 4, 0, 8, 255, 255, 0, 32, 255, 0, 0, 0, 255]);
  assert.equal(difference(new Uint8ClampedArray(), new Uint8ClampedArray(), new Uint8ClampedArray(), 1), 0);
});

test('files of the same name on both sides stay apart', async () => {
  const [first, second] = ['<a/>', '<b/>'].map((text) => fileSource([{ path: 'scene.xml', file: new Blob([text]) as never }]));
  assert.notEqual(first, second);
  assert.match(second ?? '', /^file:scene\.xml/);
  assert.equal(await openSource('file:another.xml'), null);
});
