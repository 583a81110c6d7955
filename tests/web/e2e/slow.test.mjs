// On a slow line: small things first, and no more than the line carries.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { canvasPixels, launch, openPage, picturePixels, settled, startLine, startServer } from './fixture.mjs';

let server, browser, line;
before(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
  line = await startLine(server.url);
});
after(async () => {
  await browser?.close();
  await line?.stop();
  await server?.stop();
});

/** The answers with images: their order, kind and bytes. */
function answers(view) {
  const out = [];
  view.page.on('response', async (response) => {
    const url = new URL(response.url());
    if (!/\/(image|render|thumbnail)$/.test(url.pathname)) return;
    const one = { kind: url.pathname.split('/').pop(), seq: Number(url.searchParams.get('seq')), small: url.searchParams.has('scale'), format: url.searchParams.get('format'), bytes: 0 };
    out.push(one);
    one.bytes = (await response.body().catch(() => Buffer.alloc(0))).length;
  });
  return out;
}

test('thumbnail, small frame, sharp image: in this order, the first of 30 kB at most, the sharp one as WebP', async () => {
  const view = await openPage(browser, `${line.url}/#/new`, { viewport: { width: 1280, height: 800 } });
  await settled(view);
  const sent = answers(view);
  await view.page.evaluate(() => (location.hash = '#/scene/torch'));
  await view.page.waitForFunction(() => document.querySelector('.stage .preview')?.naturalWidth === 320, null, { timeout: 60000 });
  await view.page.waitForFunction(() => Number(document.querySelector('.stage canvas').dataset.seq) > 0, null, { timeout: 60000 });
  await view.page.waitForFunction(() => !document.querySelector('.stage .preview'));
  await settled(view);
  assert.equal(sent[0].kind, 'thumbnail');
  assert.ok(sent[0].bytes > 1000 && sent[0].bytes <= 30000, `the thumbnail has ${sent[0].bytes} bytes`);
  assert.ok(sent[1].small && sent[1].bytes < 60000, JSON.stringify(sent[1]));
  const sharp = sent.at(-1);
  assert.deepEqual([sharp.small, sharp.format], [false, 'webp']);
  assert.equal(sent.filter((one) => !one.small && one.kind !== 'thumbnail').length, 1, 'one sharp image, no PNG before it');
  const exact = new URL(view.full().at(-1).url);
  for (const name of ['session', 'seq']) exact.searchParams.delete(name);
  exact.searchParams.set('format', 'png');
  const png = (await (await fetch(exact)).arrayBuffer()).byteLength;
  assert.ok(sharp.bytes < png / 3, `${sharp.bytes} bytes as WebP, ${png} as PNG`);
  const area = await view.page.locator('.stage').boundingBox(), shown = await canvasPixels(view.page);
  assert.deepEqual([shown.width, shown.height], [Math.round(area.width), Math.round(area.height)], 'at full size');
  // PNG on request: the file is the exact image.
  const [download] = await Promise.all([view.page.waitForEvent('download'), view.page.getByRole('button', { name: 'PNG', exact: true }).click()]);
  const { readFileSync } = await import('node:fs');
  assert.equal(readFileSync(await download.path()).length, png);
  // Reference quality is exact at any price.
  await view.page.getByRole('button', { name: 'reference', exact: true }).click();
  await settled(view);
  assert.equal(view.full().at(-1).format, 'png');
  await view.close();
});

test('a drag on a slow line: frames get smaller, few are under way, and it ends sharp', async () => {
  const view = await openPage(browser, `${line.url}/#/new`, { viewport: { width: 1280, height: 800 } });
  await settled(view);
  await view.page.evaluate(() => (location.hash = '#/scene/torch'));
  await settled(view);
  line.most = 0;
  const area = await view.page.locator('.stage').boundingBox();
  const [x, y] = [area.x + area.width / 2, area.y + area.height / 2];
  await view.page.mouse.move(x, y);
  await view.page.mouse.down();
  for (let i = 1; i <= 60; ++i) {
    await view.page.mouse.move(x + 3 * i, y);
    await view.page.waitForTimeout(40);
  }
  await view.page.mouse.up();
  await settled(view);
  assert.ok(line.most >= 1 && line.most <= 5, `${line.most} small frames under way`);
  const scales = view.moving().map((one) => Number(one.scale));
  assert.ok(scales.at(-1) <= 0.5, scales.join());
  assert.equal(view.moving().at(-1).format, 'webp');
  const last = view.full().at(-1);
  assert.equal(last.format, 'webp');
  const url = new URL(last.url);
  for (const name of ['session', 'seq']) url.searchParams.delete(name);
  assert.deepEqual(await canvasPixels(view.page), await picturePixels(view.page, url.href));
  await view.close();
});

test('when the line gets better the image at rest is exact again', async () => {
  const view = await openPage(browser, `${line.url}/#/new`, { viewport: { width: 900, height: 600 } });
  await settled(view);
  await view.page.evaluate(() => (location.hash = '#/scene/torch'));
  await settled(view);
  assert.equal(view.full().at(-1).format, 'webp');
  Object.assign(line, { latencyMs: 0, bytesPerMs: 100000 });
  await view.page.locator('.stage').focus();
  for (let i = 0; i < 30 && view.full().at(-1).format !== 'png'; ++i) {
    await view.page.keyboard.press('ArrowLeft');
    await settled(view);
  }
  assert.equal(view.full().at(-1).format, 'png');
  await view.close();
});
