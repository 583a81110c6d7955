// The page in Firefox by WebDriver BiDi: opens, is drawn, follows the mouse, is edited, and speaks another language.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import http from 'node:http';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { requirePackage, startServer } from './fixture.mjs';

const firefox = [process.env.FAROL_FIREFOX, '/usr/bin/firefox-esr', '/usr/bin/firefox'].find((path) => path && existsSync(path));
const skip = firefox || process.env.CI === 'true' ? false : 'there is no Firefox (package firefox-esr)';
if (skip) console.log(`SKIPPED: ${skip}`);

/** FAROL_PAGE: the page comes from that folder, all else from the server. */
function withPage(target, folder) {
  const types = { html: 'text/html', js: 'text/javascript', css: 'text/css', svg: 'image/svg+xml' };
  const proxy = http.createServer(async (request, response) => {
    const path = new URL(request.url, target).pathname, file = join(folder, path === '/' ? 'index.html' : path);
    if (request.method === 'GET' && /^\/(assets\/[\w.-]+)?$/.test(path) && existsSync(file)) {
      const policy = (await fetch(target)).headers.get('content-security-policy');
      return response.writeHead(200, { 'Content-Type': types[file.split('.').pop()], 'Content-Security-Policy': policy }).end(readFileSync(file));
    }
    const ahead = http.request(target + request.url, { method: request.method, headers: request.headers }, (answer) => {
      response.writeHead(answer.statusCode, answer.headers);
      answer.pipe(response);
    });
    ahead.on('error', () => response.destroy());
    request.pipe(ahead);
  });
  return new Promise((done) => proxy.listen(0, '127.0.0.1', () => done(proxy)));
}

let server, proxy, browser, url;
before(async () => {
  if (skip) return;
  server = await startServer();
  if (process.env.FAROL_PAGE) proxy = await withPage(server.url, process.env.FAROL_PAGE);
  url = proxy ? `http://127.0.0.1:${proxy.address().port}` : server.url;
  const { default: puppeteer } = requirePackage('puppeteer-core');
  browser = await puppeteer.launch({
    browser: 'firefox', protocol: 'webDriverBiDi', executablePath: firefox, headless: true,
    // The window's own size: older releases have no command for a viewport.
    defaultViewport: null, args: ['--width=1280', '--height=900'],
    extraPrefsFirefox: { 'intl.accept_languages': 'en-US, en', 'app.update.auto': false, 'toolkit.telemetry.enabled': false },
  });
});
after(async () => {
  await browser?.close();
  proxy?.closeAllConnections();
  proxy?.close();
  await server?.stop();
});

async function open(hash) {
  const page = await browser.newPage(), faults = [], images = [];
  page.on('request', (request) => {
    const asked = new URL(request.url());
    if (asked.searchParams.has('seq')) images.push({ seq: Number(asked.searchParams.get('seq')), moving: asked.searchParams.has('scale') });
  });
  page.on('pageerror', (error) => faults.push(String(error.message ?? error)));
  page.on('console', (message) => {
    if (message.type() === 'error') faults.push(message.text());
  });
  await page.goto(`${url}/${hash}`);
  return { page, images, faults, close: async () => (await page.close(), assert.deepEqual(faults, [])) };
}

/** Until the image at rest is on show: the last that was asked for, and nothing newer for a while. */
async function settled({ page, images }) {
  await page.waitForSelector('.stage[aria-busy=false]', { timeout: 60000 });
  const until = Date.now() + 60000;
  for (let calm = 0; calm < 4;) {
    assert.ok(Date.now() < until, 'the image never came to rest');
    await new Promise((done) => setTimeout(done, 150));
    const seq = await page.$eval('.stage canvas', (canvas) => Number(canvas.dataset.seq ?? -1));
    const last = images.at(-1);
    calm = last && !last.moving && last.seq === seq ? calm + 1 : 0;
  }
}

/** Until a function of the page returns true. Older releases hold puppeteer's own waiting to the page's policy. */
async function until(page, holds) {
  for (let i = 0; i < 200; ++i) {
    if (await page.evaluate(holds)) return;
    await new Promise((done) => setTimeout(done, 100));
  }
  assert.fail(`it did not come to ${holds}`);
}

/** Colours of a coarse grid of the canvas. */
const colours = (page) => page.$eval('.stage canvas', (canvas) => {
  const context = canvas.getContext('2d'), out = [];
  for (let y = 1; y < 12; ++y) for (let x = 1; x < 16; ++x)
    out.push([...context.getImageData(Math.floor((x * canvas.width) / 16), Math.floor((y * canvas.height) / 12), 1, 1).data].join());
  return out;
});

test('Firefox: the gallery lists scenes with their images', { skip }, async () => {
  const view = await open('#/'), { page, close } = view;
  await page.waitForSelector('.card img.loaded', { timeout: 60000 });
  assert.ok((await page.$$('.card')).length >= 5);
  await close();
});

test('Firefox: a scene is drawn, follows the mouse and the keys, and its link gives the view', { skip }, async () => {
  const view = await open('#/scene/torch'), { page, close } = view;
  await settled(view);
  const first = await colours(page);
  assert.ok(new Set(first).size > 40, `${new Set(first).size} colours`);
  const box = await (await page.$('.stage')).boundingBox();
  await page.mouse.move(box.x + 500, box.y + 300);
  await page.mouse.down();
  for (let i = 1; i <= 6; ++i) await page.mouse.move(box.x + 500 + 20 * i, box.y + 300);
  await page.mouse.up();
  await settled(view);
  const turned = await colours(page);
  assert.notDeepEqual(turned, first);
  assert.match(page.url(), /[?&]az=/);
  await page.keyboard.press('r');
  await settled(view);
  assert.deepEqual(await colours(page), first);
  await close();
});

test('Firefox: the editor draws what is typed, and undo takes it back', { skip }, async () => {
  const view = await open('#/new'), { page, close } = view;
  await settled(view);
  const first = await colours(page);
  // The editor is in a shadow root, with constructed style sheets.
  const content = await page.waitForSelector('>>> .cm-content');
  assert.equal(await content.evaluate((one) => getComputedStyle(one.closest('.cm-editor')).display), 'flex');
  await content.click();
  await page.keyboard.down('Control');
  await page.keyboard.press('Home');
  await page.keyboard.up('Control');
  const line = await content.evaluate((one) => [...one.querySelectorAll('.cm-line')].findIndex((row) => /<world|<scene/.test(row.textContent)));
  assert.ok(line >= 0);
  for (let i = 0; i < line; ++i) await page.keyboard.press('ArrowDown');
  await page.keyboard.press('End');
  await page.keyboard.type('<background color="#204060"/>');
  await until(page, () => document.querySelector('.editor-foot .note').textContent.startsWith('Edited'));
  await settled(view);
  const edited = await colours(page);
  assert.ok(edited.includes('32,64,96,255'), [...new Set(edited)].join(' '));
  for (let i = 0; i < 40 && !(await page.$eval('.toolbar .tool', (undo) => undo.ariaDisabled === 'true')); ++i) await page.click('.toolbar .tool');
  await settled(view);
  assert.deepEqual(await colours(page), first);
  await close();
});

test('Firefox: another language, sharing and the keys', { skip }, async () => {
  const view = await open('#/scene/torch'), { page, close } = view;
  await settled(view);
  await page.select('.language select', 'es');
  await until(page, () => document.querySelector('.toolbar .tool').getAttribute('aria-label') === 'Deshacer');
  await page.click('.toolbar .tool.worded');
  await page.waitForSelector('dialog.share[open]');
  await page.keyboard.press('Escape');
  await until(page, () => !document.querySelector('dialog.share'));
  await page.focus('.stage');
  await page.keyboard.type('?');
  await page.waitForSelector('dialog.help[open]');
  await close();
});
