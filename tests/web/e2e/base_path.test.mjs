// The page below a path of its own, as behind a proxy.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { drop, launch, openPage, settled, startServer } from './fixture.mjs';

let server, browser;
before(async () => {
  [server, browser] = await Promise.all([startServer({ args: ['--base-path', '/farol'] }), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

test('gallery, viewer, upload and plain page work below --base-path', async () => {
  const { origin } = new URL(server.url);
  const view = await openPage(browser, `${origin}/farol/`);
  const outside = [];
  view.page.on('request', (request) => {
    const { protocol, pathname } = new URL(request.url());
    if (protocol === 'http:' && !pathname.startsWith('/farol/')) outside.push(pathname);
  });
  await view.page.waitForSelector('.card:not(.ghost)');
  await drop(view.page, [{ name: 's.xml', bytes: Buffer.from('<world><group><models><model file="box_1.3d"/></models></group></world>') }]);
  await view.page.waitForURL(/#\/scene\/(~|%7E)/);
  await settled(view);
  await view.page.goto(`${origin}/farol/plain`);
  await view.page.waitForSelector('#scenes li img');
  assert.deepEqual(outside, []);
});
