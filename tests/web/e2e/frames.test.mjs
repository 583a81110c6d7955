// What is shown when the server is slow, busy or gone.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { canvasPixels, launch, openPage, picturePixels, settled, startProxy, startServer, until } from './fixture.mjs';

let server, browser;
before(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

test('with a slow server that answers out of order no stale frame is ever shown', async () => {
  // Every third frame is held back for long: the ones after it overtake it.
  const proxy = await startProxy(server.url, (url) => {
    const seq = Number(url.searchParams.get('seq') ?? 0);
    return url.searchParams.has('scale') ? (seq % 3 === 0 ? 700 : 60) : 0;
  });
  const view = await openPage(browser, `${proxy.url}/#/scene/torch`);
  await settled(view);
  await view.page.evaluate(() => {
    window.seen = [];
    const canvas = document.querySelector('.stage canvas');
    new MutationObserver(() => window.seen.push(Number(canvas.dataset.seq))).observe(canvas, { attributes: true, attributeFilter: ['data-seq'] });
  });
  const area = await view.page.locator('.stage').boundingBox();
  await view.page.mouse.move(area.x + 200, area.y + 200);
  await view.page.mouse.down();
  for (let i = 1; i <= 60; ++i) {
    await view.page.mouse.move(area.x + 200 + 4 * i, area.y + 200);
    await view.page.waitForTimeout(20);
  }
  await view.page.mouse.up();
  await settled(view);
  await until(() => view.underWay.size === 0, 'frames that were held back did not come');
  const seen = await view.page.evaluate(() => window.seen);
  assert.ok(seen.length >= 4, `${seen.length} frames shown`);
  assert.deepEqual(seen, [...new Set(seen)].sort((a, b) => a - b), 'the numbers of the frames grow');
  const last = view.full().at(-1);
  assert.equal(seen.at(-1), Number(last.seq));
  const url = new URL(last.url);
  url.searchParams.delete('session');
  url.searchParams.delete('seq');
  assert.deepEqual(await canvasPixels(view.page), await picturePixels(view.page, url.href));
  await view.close();
  await proxy.stop();
});

test('when the server fails, a sentence says so and the last picture stays', async () => {
  const view = await openPage(browser, `${server.url}/#/scene/torch`);
  await settled(view);
  const before = await canvasPixels(view.page);
  await view.page.route(/\/image\?/, (route) => route.abort());
  await view.page.locator('.stage').focus();
  await view.page.keyboard.press('ArrowLeft');
  await view.page.locator('.state-note').getByText('The server does not answer').waitFor();
  assert.deepEqual(await canvasPixels(view.page), before);
  await view.page.unroute(/\/image\?/);
  await view.page.keyboard.press('ArrowLeft');
  await settled(view);
  assert.equal(await view.page.getByText('The server does not answer').count(), 0);
  await view.close();
});

test('a busy server is asked again', async () => {
  const view = await openPage(browser, `${server.url}/#/scene/torch`);
  await settled(view);
  let refused = 0;
  await view.page.route(/\/image\?/, (route) => (refused++ < 2
    ? route.fulfill({ status: 503, headers: { 'Retry-After': '1', 'Content-Type': 'application/problem+json' }, body: JSON.stringify({ code: 'busy.queue', detail: 'Busy.', errors: [{ code: 'busy.queue', severity: 'error', message: 'Busy.' }] }) })
    : route.continue()));
  await view.page.locator('.stage').focus();
  await view.page.keyboard.press('ArrowLeft');
  await view.page.getByText('The server is busy').waitFor();
  await settled(view);
  assert.equal(await view.page.getByText('The server is busy').count(), 0);
  assert.ok(refused > 2);
  await view.close();
});

test('the pages work under their policy, compressed and kept by browsers', async () => {
  const page = await fetch(`${server.url}/`);
  assert.match(page.headers.get('content-security-policy'), /script-src 'self'/);
  const text = await page.text(), script = /src="(assets\/app-[^"]+\.js)"/.exec(text)?.[1];
  const asset = await fetch(`${server.url}/${script}`, { headers: { 'Accept-Encoding': 'gzip' } });
  assert.equal(asset.headers.get('content-encoding'), 'gzip');
  assert.match(asset.headers.get('cache-control'), /immutable/);
  assert.ok(!/https?:\/\/(?!www\.w3\.org)/.test(text), 'no other host');
  const plain = await openPage(browser, `${server.url}/plain`);
  await plain.page.getByText('This is the plain page').waitFor();
  await plain.page.waitForFunction(() => document.querySelector('li img')?.naturalWidth === 320, null, { timeout: 60000 });
  await plain.page.getByRole('link', { name: 'Torch' }).first().click();
  await plain.page.waitForFunction(() => document.getElementById('picture').naturalWidth > 0, null, { timeout: 60000 });
  await plain.close();
});

test('frames that a newer one overtakes leave no error in the console', async () => {
  const busy = await startServer({ workers: 1 });
  const view = await openPage(browser, `${busy.url}/#/scene/torch`, { viewport: { width: 1200, height: 800 } });
  const errors = [], statuses = [];
  view.page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  view.page.on('response', (response) => /\/image\?/.test(response.url()) && statuses.push(response.status()));
  await settled(view);
  const area = await view.page.locator('.stage').boundingBox();
  await view.page.mouse.move(area.x + 200, area.y + 200);
  for (let round = 0; round < 8 && !statuses.includes(204); ++round) {
    // The only worker is kept busy meanwhile: frames wait, and newer ones overtake them.
    const other = fetch(`${busy.url}/v1/scenes/teapots/image?width=1024&height=1024&aa=16&azimuth=${round}`);
    await view.page.mouse.down();
    for (let i = 1; i <= 25; ++i) await view.page.mouse.move(area.x + 200 + 8 * i, area.y + 200);
    await view.page.mouse.up();
    assert.equal((await other).status, 200);
    await settled(view);
  }
  assert.ok(statuses.includes(204), `none was overtaken: ${statuses}`);
  assert.deepEqual(errors, []);
  await view.close();
  await busy.stop();
});
