// What leaves the page: links, a frame for other pages, images; and what is honest about them.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import http from 'node:http';
import { after, before, test } from 'node:test';
import { axeFindings, canvasPixels, launch, openPage, settled, startServer, until } from './fixture.mjs';

let server, browser, other, framed;
before(async () => {
  // A page of another origin, with whatever frame it was given last.
  other = http.createServer((request, response) => response.setHeader('Content-Type', 'text/html').end(`<!doctype html><title>Course</title><p>Look:</p>${framed}`));
  await new Promise((done) => other.listen(0, '127.0.0.1', done));
  const origin = `http://127.0.0.1:${other.address().port}`;
  [server, browser] = await Promise.all([startServer({ args: ['--cors', origin] }), launch()]);
  other.url = `${origin}/course`; // no path of the service's page, which FAROL_PAGE replaces
});
after(async () => {
  await browser?.close();
  await server?.stop();
  other?.closeAllConnections();
  other?.close();
});

const open = async (options = {}) => {
  const view = await openPage(browser, `${server.url}/#/scene/torch`, { acceptDownloads: true, ...options });
  await settled(view);
  return view;
};
const openDialog = async (view) => {
  await view.page.getByRole('button', { name: 'Share', exact: true }).click();
  await view.page.locator('dialog.share').waitFor();
};
/** Until the frame shows the browser's error instead of the page: nothing in it can be asked. */
const refused = ({ page }) => until(() => page.frames()[1]?.url().startsWith('chrome-error:'), () => `the frame shows ${page.frames()[1]?.url()}`);
const line = (view, name) => view.page.locator('.share').getByRole('textbox', { name, exact: true }).inputValue();

test('the frame shows the view on a page of the origin that --cors names, can be orbited, and no other page is framed', async () => {
  const view = await open();
  await view.page.locator('.stage').focus();
  await view.page.keyboard.press('ArrowLeft');
  await settled(view);
  await openDialog(view);
  framed = await line(view, 'Frame');
  assert.match(framed, /^<iframe src="http:\/\/127\.0\.0\.1:\d+\/embed#\/scene\/torch\?az=/);
  await view.close();
  const page = await openPage(browser, other.url, { viewport: { width: 800, height: 700 } });
  const inside = page.page.frameLocator('iframe');
  await inside.locator('.stage[aria-busy=false]').waitFor({ timeout: 60000 });
  const frame = page.page.frames()[1], canvas = inside.locator('.stage canvas');
  const pixels = () => frame.evaluate(() => {
    const shown = document.querySelector('.stage canvas'), { data } = shown.getContext('2d').getImageData(0, 0, shown.width, shown.height);
    return { width: shown.width, height: shown.height, colours: new Set(Array.from({ length: data.length / 4 }, (_, i) => (data[4 * i] << 16) | (data[4 * i + 1] << 8) | data[4 * i + 2])).size };
  });
  await frame.waitForFunction(() => document.querySelector('.stage canvas').width === 640);
  assert.ok((await pixels()).colours > 50);
  assert.equal(page.full().at(-1).azimuth, /az=([^&]+)/.exec(framed)[1]);
  assert.equal(await inside.locator('.toolbar, .panel, header').count(), 0);
  const before = page.full().length, box = await canvas.boundingBox();
  await page.page.mouse.move(box.x + 300, box.y + 200);
  await page.page.mouse.down();
  for (let i = 1; i <= 8; ++i) await page.page.mouse.move(box.x + 300 + 10 * i, box.y + 200);
  await page.page.mouse.up();
  await until(() => page.full().length > before, 'a drag in the frame asks for no image');
  assert.notEqual(page.full().at(-1).azimuth, /az=([^&]+)/.exec(framed)[1]);
  // The whole page refuses to be framed.
  framed = framed.replace('/embed#', '/#');
  await page.page.reload();
  await refused(page);
  await page.context.close();
});

test('a page of an origin that is not named cannot frame the scene', async () => {
  const closed = await startServer();
  framed = `<iframe src="${closed.url}/embed#/scene/torch"></iframe>`;
  const page = await openPage(browser, other.url);
  await refused(page);
  assert.equal(page.pictures.length, 0);
  await page.context.close();
  await closed.stop();
});

test('the dialog says what a link does not hold; edits are stored first, and then are in it', async () => {
  const view = await open({ viewport: { width: 1200, height: 800 } });
  await openDialog(view);
  assert.equal(await view.page.locator('.share-warning').count(), 0);
  assert.equal(await view.page.locator('#share-title').innerText(), 'Share “Torch”');
  const [webp] = await Promise.all([view.page.waitForEvent('download'), view.page.getByRole('button', { name: 'WebP, small' }).click()]);
  assert.equal(readFileSync(await webp.path()).subarray(8, 12).toString(), 'WEBP');
  await view.page.keyboard.press('Escape');
  await view.page.locator('dialog.share').waitFor({ state: 'detached' });
  for (const key of ['l', 'x', 'a']) await view.page.locator('.stage').press(key);
  await settled(view);
  const shown = await canvasPixels(view.page);
  await openDialog(view);
  assert.match(await view.page.locator('.share').innerText(), /edits are in this browser only[\s\S]*Not in it: light mode, the open panel, your edits\./);
  await view.page.getByRole('button', { name: 'Store them and get a link' }).click();
  await view.page.waitForURL(/#\/scene\/(~|%7E)/);
  await settled(view);
  await view.page.locator('.share-warning').waitFor({ state: 'detached' }); // the dialog stays open, with the links
  assert.match(await view.page.locator('.share').innerText(), /It was uploaded and is kept until/);
  const link = await line(view, 'This view');
  const guest = await openPage(browser, link, { viewport: { width: 1200, height: 800 } });
  await settled(guest);
  assert.deepEqual(await canvasPixels(guest.page), shown);
  assert.equal(await guest.page.locator('h1').innerText(), 'Torch'); // an id only in the address
  await guest.close();
  await view.close();
});

test('no serious finding of axe in the dialog and in the frame', async () => {
  for (const look of [{ colorScheme: 'light' }, { colorScheme: 'dark', viewport: { width: 360, height: 740 } }]) {
    const view = await open({ ...look, bypassCSP: true });
    await openDialog(view);
    assert.deepEqual(await axeFindings(view.page), [], look.colorScheme);
    await view.page.goto(`${server.url}/embed#/scene/torch`);
    await view.page.waitForSelector('.embed .stage[aria-busy=false]', { timeout: 60000 });
    assert.deepEqual(await axeFindings(view.page), [], look.colorScheme);
    await view.close();
  }
});
