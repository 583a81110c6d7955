// The timeline of an animated scene: frames, keys, speed, and the export of its lap.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { axeFindings, canvasPixels, close, launch, openPage, settled, startServer } from './fixture.mjs';

let server, browser;
before(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

const ring = (time) => `<world><window width="320" height="240"/><camera><position x="0" y="4" z="9"/><lookAt x="0" y="0" z="0"/></camera>
  <lights><light type="directional" x="1" y="2" z="3"/></lights>
  <group name="Ring"><transform><rotate time="${time}" x="0" y="1" z="0"/></transform>
    <models><model file="box_2_1.3d"><color><diffuse R="200" G="40" B="20"/></color></model></models>
    <group name="Moon"><transform><rotate time="${time / 2}" x="0" y="1" z="0"/><translate x="3"/></transform>
      <models><model file="sphere_0.6_16_8.3d"/></models></group></group></world>`;

async function store(text) {
  const answer = await fetch(`${server.url}/v1/scenes?public=0`, { method: 'POST', headers: { 'Content-Type': 'application/xml' }, body: text });
  assert.ok(answer.ok, await answer.clone().text());
  return (await answer.json()).id;
}

async function open(text, options = {}) {
  const view = await openPage(browser, `${server.url}/#/scene/${await store(text)}`, options);
  await settled(view);
  return view;
}

const asked = (view) => Number(view.full().at(-1).time ?? 0);
const time = (view) => view.page.locator('.time-bar output').innerText();

test('frames are stepped by buttons and keys, and each is drawn', async () => {
  const view = await open(ring(4));
  const first = await canvasPixels(view.page);
  await view.page.getByRole('button', { name: 'Frame on' }).click();
  await settled(view);
  close(asked(view), 0.04, 1e-9, 'a frame');
  assert.notDeepEqual(await canvasPixels(view.page), first);
  await view.page.locator('.stage').press(',');
  await settled(view);
  assert.equal(asked(view), 0);
  assert.deepEqual(await canvasPixels(view.page), first);
  await view.page.locator('.stage').press(','); // before the first comes the last
  await settled(view);
  close(asked(view), 3.96, 1e-9, 'the last frame');
  await view.close();
});

test('keys are where something is where it began, and have names', async () => {
  const view = await open(ring(4));
  const next = view.page.getByRole('button', { name: 'Next key' });
  await next.waitFor(); // once the document is read
  assert.equal((await view.page.locator('.time-bar .keys path').getAttribute('d')).match(/M/g).length, 3);
  const first = await canvasPixels(view.page);
  await next.click();
  assert.equal(await time(view), '2.0 s');
  assert.equal(await view.page.locator('.key-name').innerText(), 'Moon: 1 turn');
  await settled(view);
  assert.equal(asked(view), 2);
  assert.notDeepEqual(await canvasPixels(view.page), first, 'the ring is half way');
  await view.page.locator('.stage').press('n');
  assert.equal(await view.page.locator('.key-name').innerText(), 'Ring: 1 turn · Moon: 2 turns');
  await settled(view);
  assert.deepEqual(await canvasPixels(view.page), first, 'all is where it began');
  await view.page.locator('.stage').press('b');
  assert.equal(await time(view), '2.0 s');
  await view.close();
});

test('an edit of a time moves the keys', async () => {
  const view = await open(ring(4), { viewport: { width: 1000, height: 640 } });
  await view.page.getByRole('button', { name: 'Next key' }).waitFor();
  await view.page.getByRole('button', { name: 'Panel', exact: true }).click();
  await view.page.getByRole('tab', { name: 'XML' }).click();
  await view.page.locator('.code .cm-content').click();
  await view.page.keyboard.press('Control+a');
  await view.page.keyboard.press('Delete');
  await view.page.keyboard.insertText(ring(6));
  await settled(view);
  await view.page.waitForFunction(() => Number(document.querySelector('.time-bar input').max) === 6);
  await view.page.getByRole('button', { name: 'Next key' }).click();
  assert.equal(await time(view), '3.0 s');
  await view.close();
});

/** The frames of an animated image as the browser decodes them: each a digest, with its length in ms. */
const decoded = (page, bytes, type) => page.evaluate(async ([base64, kind]) => {
  const data = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const decoder = new ImageDecoder({ data, type: kind });
  await decoder.completed;
  await decoder.tracks.ready;
  const out = [];
  for (let frameIndex = 0; frameIndex < decoder.tracks.selectedTrack.frameCount; ++frameIndex) {
    const { image } = await decoder.decode({ frameIndex });
    const canvas = new OffscreenCanvas(image.displayWidth, image.displayHeight), context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const digest = new Uint8Array(await crypto.subtle.digest('SHA-256', context.getImageData(0, 0, canvas.width, canvas.height).data)).join();
    out.push({ ms: image.duration / 1000, width: canvas.width, height: canvas.height, digest });
  }
  return { frames: out, repeats: decoder.tracks.selectedTrack.repetitionCount };
}, [bytes.toString('base64'), type]);

async function exported(view, { format = 'apng', rate = '5', width = '320' } = {}) {
  await view.page.getByRole('button', { name: 'Export', exact: true }).click();
  const dialog = view.page.getByRole('dialog', { name: 'Export the animation' });
  await dialog.getByRole('combobox', { name: 'Format' }).selectOption(format);
  await dialog.getByRole('combobox', { name: 'Frames a second' }).selectOption(rate);
  await dialog.getByRole('combobox', { name: 'Width' }).selectOption(width);
  return dialog;
}

test('the lap is exported frame by frame, exactly as the service draws it, and as WebP', async () => {
  const view = await open(ring(2), { acceptDownloads: true, bypassCSP: true, viewport: { width: 900, height: 700 } });
  const dialog = await exported(view);
  assert.match(await dialog.getByRole('status').innerText(), /^One lap: 10 frames of 320 × \d+, 2 s at the speed 1×\.$/);
  assert.deepEqual(await axeFindings(view.page), []);
  const [apng] = await Promise.all([view.page.waitForEvent('download'), dialog.getByRole('button', { name: 'Export' }).click()]);
  assert.match(apng.suggestedFilename(), /\.png$/);
  const { frames, repeats } = await decoded(view.page, readFileSync(await apng.path()), 'image/png');
  assert.deepEqual(frames.map(({ ms }) => ms), Array(10).fill(200));
  assert.equal(repeats, Number.POSITIVE_INFINITY);
  assert.equal(new Set(frames.map(({ digest }) => digest)).size, 10);
  const requests = view.pictures.filter((one) => one.width === '320' && one.format === 'png' && one.session === undefined);
  assert.deepEqual(requests.map((one) => Number(one.time)).sort((a, b) => a - b), Array.from({ length: 10 }, (_, i) => i / 5));
  for (const index of [0, 3, 9]) {
    const { url } = requests.find((one) => Number(one.time) === index / 5);
    const alone = await decoded(view.page, Buffer.from(await (await fetch(url)).arrayBuffer()), 'image/png');
    assert.equal(frames[index].digest, alone.frames[0].digest, `frame ${index}`);
  }
  await dialog.waitFor({ state: 'detached' });
  const again = await exported(view, { format: 'webp', rate: '15' });
  const [webp] = await Promise.all([view.page.waitForEvent('download'), again.getByRole('button', { name: 'Export' }).click()]);
  const moving = await decoded(view.page, readFileSync(await webp.path()), 'image/webp');
  assert.equal(moving.frames.length, 30);
  assert.equal(moving.frames.reduce((sum, { ms }) => sum + ms, 0), 2000);
  assert.equal(moving.frames[0].width, 320);
  await view.close();
});

test('an export shows how far it is, and is stopped by Cancel; one that is too long does not begin', async () => {
  const view = await open(ring(50));
  const dialog = await exported(view, { rate: '30' });
  assert.match(await dialog.getByRole('status').innerText(), /1,500 frames|1500 frames/);
  assert.match(await dialog.getByRole('status').innerText(), /600 frames at most/);
  assert.ok(await dialog.getByRole('button', { name: 'Export' }).isDisabled());
  await dialog.getByRole('combobox', { name: 'Frames a second' }).selectOption('10');
  await dialog.getByRole('button', { name: 'Export' }).click();
  await view.page.waitForFunction(() => Number(document.querySelector('progress')?.value) >= 3);
  assert.match(await dialog.innerText(), /Frame \d+ of 500/);
  await dialog.getByRole('button', { name: 'Cancel' }).click();
  await dialog.getByRole('button', { name: 'Export' }).waitFor();
  const frames = () => view.pictures.filter((one) => one.session === undefined && one.width === '320'), begun = frames().length;
  // As long as four more frames would take, one after the other.
  await view.page.evaluate(async (address) => {
    for (let i = 0; i < 4; ++i) {
      const url = new URL(address);
      url.searchParams.set('time', String(40 + i));
      await (await fetch(url)).blob();
    }
  }, frames()[0].url);
  assert.equal(frames().length, begun + 4, 'no frame is asked for after it was stopped');
  assert.ok(await dialog.getByRole('button', { name: 'Export' }).isEnabled());
  await view.close();
});

test('no serious finding of axe with the timeline on a phone, and nothing is wider than it', async () => {
  const view = await open(ring(4), { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true, deviceScaleFactor: 1, bypassCSP: true });
  await view.page.getByRole('button', { name: 'Next key' }).tap();
  assert.deepEqual(await axeFindings(view.page), []);
  assert.ok((await view.page.evaluate(() => document.documentElement.scrollWidth)) <= 360);
  await view.close();
});
