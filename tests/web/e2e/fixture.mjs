// A server on a free port, a browser, and how the tests look at the page.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { existsSync } from 'node:fs';
import http from 'node:http';
import { createRequire } from 'node:module';
import { after } from 'node:test';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromiumPath } from '../chromium.mjs';

export const root = join(dirname(fileURLToPath(import.meta.url)), '../../..');
const require = createRequire(join(root, 'build/web/package.json'));
/** A package of the page's tests. */
export const requirePackage = (name) => require(name);
export const { chromium } = require('playwright-core');
const axePath = require.resolve('axe-core/axe.min.js');

export const binary = process.env.FAROL_BINARY ?? join(root, 'build/release/farol');

/** What a failed test left open would keep its file from ending. A script that measures is no test, and reports none. */
const open = new Set();
if (process.argv[1]?.endsWith('.test.mjs')) after(() => Promise.all([...open].map((close) => close())));
/** Adds what closes something, once however often it is called. */
const closing = (close) => {
  let closed;
  const once = () => (open.delete(once), closed ??= close());
  open.add(once);
  return once;
};

/** A daemon of its own; `stop` ends it. */
export async function startServer({ program = binary, scenes = join(root, 'scenes'), args = [], workers = 2 } = {}) {
  const child = spawn(program, ['serve', '--port', '0', '--scenes', scenes, '--workers', String(workers), '--wait', '30', '--deadline', '60', ...args], { stdio: ['ignore', 'pipe', 'pipe'] });
  const ended = new Promise((done) => child.on('exit', done));
  const stop = closing(() => (child.kill('SIGTERM'), ended));
  let out = '';
  const url = await new Promise((done, failed) => {
    const timer = setTimeout(() => failed(new Error(`no server after 60 s: ${out}`)), 60000);
    const read = (chunk) => {
      out += chunk;
      const found = /listening on (http:\S+)/.exec(out);
      if (!found) return;
      clearTimeout(timer);
      done(found[1]);
    };
    child.stdout.on('data', read);
    child.stderr.on('data', read);
    child.on('exit', (code) => failed(new Error(`the server ended with ${code}: ${out}`)));
  });
  // The first pictures compile shaders: that is nobody's latency here.
  await fetch(`${url}/readyz`);
  return { url, stop };
}

/** Until it holds, or returns what is no longer null; looked at every few ms. */
export async function until(holds, what, forMs = 60000) {
  for (const end = Date.now() + forMs; ;) {
    const value = await holds();
    if (value) return value;
    assert.ok(Date.now() < end, typeof what === 'function' ? await what() : what);
    await new Promise((done) => setTimeout(done, 10));
  }
}

export async function launch() {
  const browser = await chromium.launch({
    executablePath: chromiumPath,
    args: ['--no-sandbox', '--disable-gpu', '--force-color-profile=srgb'],
  });
  closing(() => browser.close());
  return browser;
}

/** Forwards to a server; `delayOf` says how many ms an answer is held back. */
export function startProxy(target, delayOf) {
  const server = http.createServer((request, response) => {
    const ahead = http.request(target + request.url, { method: request.method, headers: request.headers }, (answer) => {
      const chunks = [];
      answer.on('data', (chunk) => chunks.push(chunk));
      answer.on('end', () => setTimeout(() => {
        response.writeHead(answer.statusCode, answer.headers);
        response.end(Buffer.concat(chunks));
      }, delayOf(new URL(request.url, target))));
    });
    ahead.on('error', () => response.destroy());
    request.pipe(ahead);
  });
  return new Promise((done) => server.listen(0, '127.0.0.1', () => done({
    url: `http://127.0.0.1:${server.address().port}`,
    stop: closing(() => new Promise((closed) => (server.closeAllConnections(), server.close(closed)))),
  })));
}

/** FAROL_PAGE=web/page: the page comes from that folder, so that a change of it needs no build of the program. */
const pageFrom = (context, folder) => context.route((url) => /^\/(embed|assets\/.*)?$/.test(url.pathname), async (route) => {
  const path = new URL(route.request().url()).pathname.slice(1), name = path === '' ? 'index.html' : path === 'embed' ? 'embed.html' : path, file = join(folder, name);
  if (!existsSync(file)) return route.continue();
  const policy = (await fetch(new URL(path === 'embed' ? '/embed' : '/', route.request().url()))).headers.get('content-security-policy');
  const type = { html: 'text/html', js: 'text/javascript', css: 'text/css', svg: 'image/svg+xml' }[name.split('.').pop()];
  return route.fulfill({ path: file, headers: { 'Content-Type': type, 'Content-Security-Policy': policy } }).catch(() => undefined); // closed meanwhile
});

/** A page with what it asked for; an error in its script fails the test that closes it. `remembered`: what its browser has kept of it. */
export async function openPage(browser, url, { remembered = {}, ...options } = {}) {
  const localStorage = Object.entries(remembered).map(([name, value]) => ({ name, value })), { origin } = new URL(url);
  const context = await browser.newContext({
    viewport: { width: 900, height: 620 }, reducedMotion: 'reduce', ...options,
    ...(localStorage.length > 0 ? { storageState: { cookies: [], origins: [{ origin, localStorage }] } } : {}),
  });
  if (process.env.FAROL_PAGE) await pageFrom(context, process.env.FAROL_PAGE);
  const page = await context.newPage();
  const faults = [], pictures = [], underWay = new Set();
  page.on('pageerror', (error) => faults.push(error.message));
  page.on('console', (message) => {
    if (message.type() === 'error' && /Content Security Policy|Uncaught/.test(message.text())) faults.push(message.text());
  });
  const isCounted = (request) => request.url().startsWith('http') && !/\/thumbnail$/.test(new URL(request.url()).pathname);
  page.on('request', (request) => {
    if (request.isNavigationRequest() && request.frame() === page.mainFrame()) underWay.clear(); // nobody hears of what the last page asked for
    if (isCounted(request)) underWay.add(request);
  });
  for (const event of ['requestfinished', 'requestfailed']) page.on(event, (request) => underWay.delete(request));
  page.on('request', (request) => {
    const parsed = new URL(request.url());
    if (!/\/image$|\/v1\/render$/.test(parsed.pathname)) return;
    pictures.push({ path: parsed.pathname, method: request.method(), url: request.url(), ...Object.fromEntries(parsed.searchParams) });
  });
  await page.goto(url);
  return {
    page, context, pictures, faults, underWay,
    moving: () => pictures.filter((one) => one.scale !== undefined),
    full: () => pictures.filter((one) => one.scale === undefined && one.layer === undefined),
    async close() {
      await context.close();
      assert.deepEqual(faults, []);
    },
  };
}

/**
 * Until the picture at rest is on show, nothing is under way and nothing more comes of what was done: the page says when it
 * rests, and what an event leads to without a request is done within a few frames (effects, layout, sizes).
 */
export async function settled({ page, underWay, full }) {
  const until = Date.now() + 60000;
  for (;;) {
    const seq = await page.evaluate((deadline) => new Promise((done) => {
      let calm = 0;
      const look = () => {
        const stage = document.querySelector('.stage[aria-busy=false][data-rest=true]');
        calm = stage ? calm + 1 : 0;
        if (calm > 4) return done(Number(stage.querySelector('canvas').dataset.seq));
        if (Date.now() > deadline) return done(null);
        return requestAnimationFrame(() => setTimeout(look, 0));
      };
      look();
    }), until).catch((fault) => {
      if (/context was destroyed|navigat/.test(fault.message)) return undefined; // the page is loaded anew
      throw fault;
    });
    if (seq !== undefined && underWay.size === 0 && seq === Number(full().at(-1)?.seq)) return;
    if (seq === null || Date.now() >= until) {
      const shown = await page.evaluate(() => [document.querySelector('.stage-area')?.className, document.querySelector('.stage')?.dataset.rest, document.querySelector('.stage canvas')?.dataset.seq, document.querySelector('.stage-notes')?.textContent].join(', '));
      const asked = full().slice(-2).map((one) => `${one.method} ${one.seq}`).join(', ');
      assert.fail(`the picture never came to rest: ${shown}; asked for ${asked}; under way: ${[...underWay].map((one) => one.url()).join(' ')}`);
    }
    if (underWay.size > 0) await page.waitForTimeout(10);
  }
}

/** What a browser remembers that has these edits of a scene. */
export const draft = (id, text) => ({ [`farol.draft.${id}`]: JSON.stringify({ text, base: '' }) });

/** The edits of a scene as the browser keeps them, of a new one by '*'. They are kept a moment after a change, and at once where the page may be left. */
export const draftOf = ({ page }, id) => page.evaluate((key) => {
  dispatchEvent(new Event('pagehide'));
  return JSON.parse(localStorage.getItem(key))?.text ?? null;
}, `farol.draft.${id}`);

/** Until the browser has all that the page has given it to keep. */
export const keptAll = ({ page }) => page.evaluate(() => new Promise((done, failed) => {
  dispatchEvent(new Event('pagehide'));
  const opening = indexedDB.open('farol');
  opening.onerror = () => failed(opening.error);
  opening.onsuccess = () => {
    // Transactions on a store are done in their order.
    const transaction = opening.result.transaction('kept', 'readwrite');
    transaction.objectStore('kept').count();
    transaction.oncomplete = () => (opening.result.close(), done());
  };
}));

/** What the canvas shows, as a digest and a size; and the same of a picture at an address. */
export const canvasPixels = (page) => page.evaluate(async () => {
  const canvas = document.querySelector('.stage canvas');
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  const digest = await crypto.subtle.digest('SHA-256', data);
  return { width: canvas.width, height: canvas.height, digest: [...new Uint8Array(digest)].join() };
});

export const picturePixels = (page, url) => page.evaluate(async (address) => {
  const response = await fetch(address, { cache: 'no-store' });
  if (!response.ok) throw new Error(`${response.status} ${await response.text()}`);
  const bitmap = await createImageBitmap(await response.blob());
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [bitmap.width, bitmap.height];
  const context = canvas.getContext('2d', { alpha: false });
  context.drawImage(bitmap, 0, 0);
  const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
  const digest = await crypto.subtle.digest('SHA-256', data);
  return { width: canvas.width, height: canvas.height, digest: [...new Uint8Array(digest)].join() };
}, url);

/** Drops files on the page, as a hand would: [{ name, bytes }]. */
export async function drop(page, files, selector = 'body') {
  const data = await page.evaluateHandle((list) => {
    const transfer = new DataTransfer();
    for (const { name, base64 } of list) transfer.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
    return transfer;
  }, files.map(({ name, bytes }) => ({ name, base64: Buffer.from(bytes).toString('base64') })));
  await page.dispatchEvent(selector, 'dragover', { dataTransfer: data });
  await page.dispatchEvent(selector, 'drop', { dataTransfer: data });
}

/**
 * Drops a folder of files [{ path, bytes }]. Scripts cannot make a folder's entry, so that the page is given ones
 * that answer as a browser's do: at most a hundred of a folder's entries at a time.
 */
export async function dropFolder(page, files, selector = 'body') {
  const data = await page.evaluateHandle((list) => {
    const fileEntry = (path, base64) => ({
      isFile: true, isDirectory: false, fullPath: `/${path}`,
      file: (done) => done(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], path.replace(/^.*\//, ''))),
    });
    const folderEntry = (path) => ({
      isFile: false, isDirectory: true, fullPath: `/${path}`,
      createReader: () => {
        const inside = list.filter((one) => one.path.startsWith(`${path}/`));
        const names = [...new Set(inside.map((one) => one.path.slice(path.length + 1).split('/')[0]))];
        return {
          readEntries: (done) => done(names.splice(0, 100).map((name) => {
            const own = inside.find((one) => one.path === `${path}/${name}`);
            return own ? fileEntry(own.path, own.base64) : folderEntry(`${path}/${name}`);
          })),
        };
      },
    });
    const transfer = new DataTransfer();
    transfer.items.add(new File([], 'folder'));
    DataTransferItem.prototype.webkitGetAsEntry = () => folderEntry(list[0].path.split('/')[0]);
    return transfer;
  }, files.map(({ path, bytes }) => ({ path, base64: Buffer.from(bytes).toString('base64') })));
  await page.dispatchEvent(selector, 'dragover', { dataTransfer: data });
  await page.dispatchEvent(selector, 'drop', { dataTransfer: data });
}

export const close = (actual, expected, tolerance, what) =>
  assert.ok(Math.abs(Number(actual) - expected) <= tolerance, `${what}: ${actual} is not ${expected}`);

/** A PNG as WebP: the browser has an encoder. */
export const webp = async (page, png, quality = 0.85) => Buffer.from(await page.evaluate(async ([base64, q]) => {
  const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  canvas.getContext('2d').drawImage(bitmap, 0, 0);
  const bytes = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/webp', quality: q })).arrayBuffer());
  let text = '';
  for (let i = 0; i < bytes.length; i += 4096) text += String.fromCharCode(...bytes.subarray(i, i + 4096));
  return btoa(text);
}, [png.toString('base64'), quality]), 'base64');

/** Serious findings of axe-core; the page is opened with bypassCSP, for its policy keeps foreign scripts out. */
export async function axeFindings(page) {
  if (!(await page.evaluate(() => 'axe' in window))) await page.addScriptTag({ path: axePath });
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  return violations.filter((one) => ['serious', 'critical'].includes(one.impact))
    .map((one) => `${one.id}: ${one.nodes.map((node) => node.target.join(' ')).slice(0, 4).join('; ')}`);
}

/** A BMP image of one pixel. */
export function onePixel(red, green, blue) {
  const bmp = Buffer.concat([Buffer.from('BM'), Buffer.alloc(56)]);
  for (const [at, value] of [[2, 58], [10, 54], [14, 40], [18, 1], [22, 1]]) bmp.writeUInt32LE(value, at);
  bmp.writeUInt16LE(1, 26);
  bmp.writeUInt16LE(24, 28);
  [blue, green, red].forEach((value, i) => bmp.writeUInt8(value, 54 + i));
  return bmp;
}

/** The colour of the canvas's middle, red, green, blue. */
export const middleOf = (view) => view.page.evaluate(() => {
  const canvas = document.querySelector('.stage canvas');
  return [...canvas.getContext('2d').getImageData(canvas.width >> 1, canvas.height >> 1, 1, 1).data].slice(0, 3);
});

/**
 * Forwards to a server over a slow line: half of `latencyMs` on each way, and all answers together at `bytesPerMs`.
 * Both can be changed while it runs. `most` counts the small frames that were under way at once.
 */
export async function startLine(target, { latencyMs = 150, bytesPerMs = 187.5 } = {}) {
  const line = { latencyMs, bytesPerMs, most: 0 };
  let free = 0; // when the line has sent what was given to it
  let small = 0; // requests for small frames that are not answered
  const later = (ms) => new Promise((done) => setTimeout(done, ms));
  const server = http.createServer(async (request, response) => {
    if (request.url.includes('scale=')) {
      line.most = Math.max(line.most, ++small);
      response.on('close', () => --small);
    }
    await later(line.latencyMs / 2);
    const ahead = http.request(target + request.url, { method: request.method, headers: request.headers }, async (answer) => {
      await later(line.latencyMs / 2);
      response.writeHead(answer.statusCode, answer.headers);
      for await (const chunk of answer)
        for (let at = 0; at < chunk.length; at += 1400) {
          const piece = chunk.subarray(at, at + 1400), now = performance.now();
          free = Math.max(free, now) + piece.length / line.bytesPerMs;
          if (free - now > 4) await later(free - now);
          response.write(piece);
        }
      response.end();
    });
    ahead.on('error', () => response.destroy());
    response.on('close', () => ahead.destroy());
    request.pipe(ahead);
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  return Object.assign(line, {
    url: `http://127.0.0.1:${server.address().port}`,
    stop: closing(() => new Promise((closed) => (server.closeAllConnections(), server.close(closed)))),
  });
}

/** A line as CDP emulates it: 150 ms a round trip, 1.5 Mbit/s. */
export const slowLine = { offline: false, latency: 150, downloadThroughput: 187500, uploadThroughput: 187500 };

export async function throttle(view, line = slowLine) {
  const client = await view.context.newCDPSession(view.page);
  await client.send('Network.enable');
  await client.send('Network.emulateNetworkConditions', line);
}
