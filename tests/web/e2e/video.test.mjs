// Films of a scene's loop: offered where the service can write them, drawn by it, with cancel.
import assert from 'node:assert/strict';
import { cpSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { after, before, test } from 'node:test';
import { axeFindings, binary, launch, openPage, settled, startServer } from './fixture.mjs';

let server, browser, names;
before(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
  names = (await (await fetch(`${server.url}/version`)).json()).animations;
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

const scene = `<world><camera><position x="0" y="0" z="10"/><lookAt x="0" y="0" z="0"/><projection fov="60" near="1" far="100"/></camera>
  <group name="Ball"><transform><rotate time="2" z="1"/><translate x="3"/></transform>
    <models><model file="sphere_1_16_16.3d"><color><diffuse R="255" G="0" B="0"/><ambient R="255" G="0" B="0"/></color></model></models></group></world>`;
const open = async () => {
  const stored = await fetch(`${server.url}/v1/scenes?public=0`, { method: 'POST', headers: { 'Content-Type': 'application/xml' }, body: scene });
  const view = await openPage(browser, `${server.url}/#/scene/${(await stored.json()).id}`, { viewport: { width: 900, height: 700 }, acceptDownloads: true, bypassCSP: true });
  await settled(view);
  return view;
};
const openExport = async (view) => {
  await view.page.getByRole('button', { name: 'Export', exact: true }).click();
  return view.page.getByRole('dialog', { name: 'Export the animation' });
};
/** Where the red of a film is at some of its moments, as shares of its size, and how long it is. */
const played = (page, bytes, type, times) => page.evaluate(async ([base64, kind, moments]) => {
  const film = document.createElement('video');
  film.muted = true;
  document.body.append(film);
  film.src = `data:${kind};base64,${base64}`;
  await new Promise((done, failed) => Object.assign(film, { onloadeddata: done, onerror: () => failed(new Error(film.error?.message)) }));
  const canvas = new OffscreenCanvas(film.videoWidth, film.videoHeight), context = canvas.getContext('2d'), places = [];
  for (const moment of moments) {
    // The event of the seek may come before its frame.
    await new Promise((done) => {
      const look = (_, { mediaTime }) => (Math.abs(mediaTime - moment) < 0.06 ? done() : film.requestVideoFrameCallback(look));
      film.requestVideoFrameCallback(look);
      film.currentTime = moment;
    });
    context.drawImage(film, 0, 0);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    let [x, y, count] = [0, 0, 0];
    for (let i = 0; i < data.length / 4; ++i) if (data[4 * i] > 80 && data[4 * i + 1] < 60) [x, y, count] = [x + (i % canvas.width), y + Math.floor(i / canvas.width), count + 1];
    places.push({ x: x / count / canvas.width, y: y / count / canvas.height, count });
  }
  film.remove();
  return { seconds: film.duration, width: film.videoWidth, places };
}, [bytes.toString('base64'), type, times]);

for (const [format, type] of [['mp4', 'video/mp4'], ['webm', 'video/webm']])
  test(`one lap is exported as ${format}: the moments of the scene's loop, in its time`, async (t) => {
    if (!names.includes(format)) return t.skip(`the service writes no ${format}: its module of videos is not there`);
    const view = await open(), dialog = await openExport(view);
    await dialog.getByRole('combobox', { name: 'Format' }).selectOption(format);
    await dialog.getByRole('combobox', { name: 'Frames a second' }).selectOption('10');
    await dialog.getByRole('combobox', { name: 'Width' }).selectOption('320');
    const [file] = await Promise.all([view.page.waitForEvent('download'), dialog.getByRole('button', { name: 'Export' }).click()]);
    assert.match(file.suggestedFilename(), new RegExp(`\\.${format}$`));
    const { seconds, width, places } = await played(view.page, readFileSync(await file.path()), type, [0.05, 0.55, 1.05]);
    assert.ok(Math.abs(seconds - 2) < 0.11, `${seconds} s`);
    assert.equal(width, 320);
    const [right, up, left] = places;
    assert.ok(right.x > 0.6 && Math.abs(right.y - 0.5) < 0.05, JSON.stringify(places));
    assert.ok(up.y < 0.35 && Math.abs(up.x - 0.5) < 0.05, JSON.stringify(places));
    assert.ok(left.x < 0.4 && Math.abs(left.y - 0.5) < 0.05, JSON.stringify(places));
    await dialog.waitFor({ state: 'detached' });
    await view.close();
  });

test('a film shows how long it takes and is given up by Cancel; edits are stored first', async (t) => {
  if (!names.includes('mp4')) return t.skip('the service writes no mp4: its module of videos is not there');
  let gone;
  const isGone = new Promise((done) => (gone = done));
  const view = await open(), dialog = await openExport(view);
  await view.page.route('**/turntable?*', () => undefined); // it takes for ever
  view.page.on('requestfailed', (request) => request.url().includes('/turntable') && gone());
  await dialog.getByRole('combobox', { name: 'Format' }).selectOption('mp4');
  await dialog.getByRole('button', { name: 'Export' }).click();
  await dialog.getByText(/^The server draws \d+ frames .* [1-9]\d* s so far/).waitFor();
  assert.equal(await dialog.getByRole('progressbar').getAttribute('value'), null, 'how far it is is not known');
  assert.deepEqual(await axeFindings(view.page), []);
  const cancel = dialog.getByRole('button', { name: 'Cancel' });
  assert.ok(await cancel.evaluate((one) => one === document.activeElement));
  await cancel.click();
  await isGone;
  assert.ok(await dialog.getByRole('button', { name: 'Export' }).evaluate((one) => one === document.activeElement));
  await dialog.getByRole('button', { name: 'Close' }).click();
  await dialog.waitFor({ state: 'detached' });
  await view.page.locator('.stage').press('l');
  await view.page.locator('.stage').press('x'); // a light that moves with the camera is an edit
  await settled(view);
  const again = await openExport(view);
  await again.getByText('store your edits first').waitFor();
  assert.deepEqual(await again.getByRole('combobox', { name: 'Format' }).locator('option').allInnerTexts(), ['animated PNG, exact', 'animated WebP, small']);
  await view.close();
});

test('the formats that are offered are those that the service has', async () => {
  const offered = async (url) => {
    const view = await openPage(browser, `${url}/#/scene/solar-system`, { viewport: { width: 900, height: 700 } });
    await settled(view);
    await view.page.getByRole('button', { name: 'Share', exact: true }).click();
    const choice = view.page.locator('dialog.share').getByRole('combobox', { name: 'Format' });
    await choice.locator('option').first().waitFor({ state: 'attached' });
    const share = await choice.locator('option').evaluateAll((all) => all.map((one) => one.value));
    await choice.selectOption(share.at(-1));
    const download = await view.page.locator('dialog.share a[download]').getAttribute('href');
    assert.match(download, new RegExp(`format=${share.at(-1)}(&|$)`));
    await view.close();
    return share;
  };
  assert.deepEqual((await offered(server.url)).sort(), [...names].sort());
  // A program without its modules beside it.
  const alone = mkdtempSync(join(tmpdir(), 'farol-alone-'));
  cpSync(binary, join(alone, basename(binary)));
  const plain = await startServer({ program: join(alone, basename(binary)) });
  const few = (await (await fetch(`${plain.url}/version`)).json()).animations;
  assert.ok(!few.includes('mp4') && few.includes('apng'), few.join());
  assert.deepEqual((await offered(plain.url)).sort(), [...few].sort());
  await plain.stop();
  rmSync(alone, { recursive: true });
});
