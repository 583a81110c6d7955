// How the page looks when something is wrong: each state is another one to see, and says what can be done.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { axeFindings, canvasPixels, launch, openPage, settled, startServer } from './fixture.mjs';

let server, browser, scratch;
const model = (file, inside = '') => `<model file="${file}">${inside}</model>`;
const sceneOf = (models, head = '') => `<world>\n${head}<group>\n<models>\n${models.join('\n')}\n</models>\n</group>\n</world>\n`;
const scenes = {
  good: sceneOf([model('box_2_2.3d')], '<lights><light type="directional" dirX="1" dirY="2" dirZ="3"/></lights>\n'),
  warned: sceneOf([model('box_2_2.3d')], '<lights><light type="spot" dirX="1" dirY="2" dirZ="3"/></lights>\n'),
  crate: sceneOf([model('box_2_2.3d', '<texture file="wood.png"/>')]),
  failed: 'sphere { <0, 0, 0>, 1 }\n',
  titled: sceneOf([model('box_2_2.3d'), model('spere_1_8_4.3d')], '<title>Half a house</title>\n'),
  many: sceneOf(Array.from({ length: 16 }, (_, i) => model(`missing-mesh-with-a-rather-long-name-number-${i}.obj`))),
};
before(async () => {
  scratch = mkdtempSync(join(tmpdir(), 'farol-web-'));
  for (const [name, text] of Object.entries(scenes)) writeFileSync(join(scratch, `${name}.xml`), text);
  [server, browser] = await Promise.all([startServer({ scenes: scratch }), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
  rmSync(scratch, { recursive: true, force: true });
});

const wide = { viewport: { width: 1000, height: 640 } };
const open = (hash, options = wide) => openPage(browser, `${server.url}/${hash}`, options);
const inState = (view, state) => view.page.waitForSelector(`.stage-area.is-${state}`, { timeout: 60000 });
const note = (view, state) => view.page.locator(`.state-note.${state}, .state-card.${state}`);
/** The mean brightness of the stage as it is on the screen, 0 to 255. */
const brightness = async (view) => {
  const png = await view.page.locator('.stage').screenshot();
  return view.page.evaluate(async (base64) => {
    const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))]));
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height), context = canvas.getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) sum += data[i] + data[i + 1] + data[i + 2];
    return sum / (data.length / 4) / 3;
  }, png.toString('base64'));
};

test('drawn, with warnings, incomplete and failed look different and say why', async () => {
  for (const [scene, state, counts, text] of [
    ['good', 'drawn', null, null], ['warned', 'warned', /^\d warnings?$/, null],
    ['crate', 'incomplete', '1 error', /placeholders stand for what has errors/], ['failed', 'failed', /^1 error, \d warnings?$/, /This scene cannot be drawn/],
  ]) {
    const view = await open(`#/scene/${scene}`);
    await inState(view, state);
    assert.equal(await view.page.locator('.stage').getAttribute('aria-busy'), 'false', `${scene} does not look like loading`);
    const tab = view.page.locator('.drawer-tab');
    if (counts === null) assert.equal(await tab.count(), 0);
    else assert.match(await tab.innerText(), counts instanceof RegExp ? counts : new RegExp(`^${counts}$`));
    if (text) assert.match(await note(view, state).innerText(), text);
    else assert.equal(await view.page.locator('.stage-notes .state-note').count(), 0);
    if (state === 'failed') assert.match(await note(view, state).innerText(), /The document has no element/);
    await view.close();
  }
});

test('a scene with errors has its title, and the name of its file where none can be read', async () => {
  const view = await open('#/scene/titled');
  await inState(view, 'incomplete');
  await view.page.waitForFunction(() => document.title === 'Half a house · Farol');
  assert.equal(await view.page.locator('h1').innerText(), 'Half a house');
  await view.page.evaluate(() => (location.hash = '#/scene/failed'));
  await inState(view, 'failed');
  assert.equal(await view.page.locator('h1').innerText(), 'failed');
  // A stored scene that nobody gave a title; its id is in the address alone.
  const { id } = await (await fetch(`${server.url}/v1/scenes?public=1`, { method: 'POST', body: scenes.good, headers: { 'Content-Type': 'application/xml' } })).json();
  await view.page.evaluate((hash) => (location.hash = hash), `#/scene/${encodeURIComponent(id)}`);
  await settled(view);
  assert.equal(await view.page.locator('h1').innerText(), 'Untitled scene');
  await view.page.evaluate(() => (location.hash = '#/'));
  await view.page.getByRole('link', { name: /^Untitled scene/ }).waitFor();
  assert.ok(!(await view.page.locator('main').innerText()).includes(id.slice(1)), 'the id is not shown');
  assert.equal((await fetch(`${server.url}/v1/scenes/${encodeURIComponent(id)}`, { method: 'DELETE' })).status, 204);
  await view.close();
});

test('beside open findings nothing is covered: the tools on a wide screen, the head on a phone', async () => {
  const bottom = async (locator) => {
    const { y, height } = await locator.boundingBox();
    return y + height;
  };
  const view = await open('#/scene/titled', { ...wide, remembered: { 'farol.panel': 'tree' } });
  await inState(view, 'incomplete');
  await view.page.getByRole('treeitem', { name: 'box_2_2.3d', exact: true }).click();
  await settled(view);
  const bar = view.page.locator('.gizmo-bar'), tab = view.page.locator('.drawer-tab');
  assert.ok(await view.page.locator('.drawer-body').isVisible());
  assert.ok((await bottom(bar)) <= (await tab.boundingBox()).y, 'the tools end above the findings');
  assert.ok((await bar.boundingBox()).y >= (await bottom(note(view, 'incomplete'))), 'and begin below the note');
  // What has no mesh is none to be saved.
  await view.page.getByRole('tab', { name: /^Files/ }).click();
  await view.page.getByRole('button', { name: 'Download box_2_2.3d as OBJ' }).waitFor();
  assert.equal(await view.page.getByRole('button', { name: /spere.* as OBJ/ }).count(), 0);
  await view.close();
  const phone = await open('#/scene/titled', { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true, deviceScaleFactor: 1 });
  await inState(phone, 'incomplete');
  const [icon, words] = await Promise.all([note(phone, 'incomplete').locator('svg').boundingBox(), note(phone, 'incomplete').locator('span').boundingBox()]);
  assert.ok(icon.y < words.y + words.height && words.x > icon.x + icon.width, 'the icon is beside its words');
  await phone.page.getByRole('button', { name: 'Panel', exact: true }).tap();
  await phone.page.locator('.panel').waitFor();
  assert.ok((await phone.page.locator('.drawer-tab').boundingBox()).y >= (await bottom(phone.page.locator('.toolbar'))), 'the findings end below the tools');
  await phone.close();
});

test('what cannot be stored says why, where it was asked for', async () => {
  const view = await open('#/scene/titled');
  await inState(view, 'incomplete');
  await view.page.locator('.stage').focus();
  for (const key of ['l', 'x']) await view.page.keyboard.press(key); // a light that moves with the camera is an edit
  await settled(view);
  await view.page.getByRole('button', { name: 'Share', exact: true }).click();
  await view.page.getByRole('button', { name: 'Store them and get a link' }).click();
  assert.match(await view.page.locator('dialog.share').getByRole('alert').innerText(), /^Not stored\. .*spere_1_8_4/);
  await view.page.keyboard.press('Escape');
  await view.close();
});

test('a part of the page that is on its way has its place, and none where it will lie over the page', async () => {
  const view = await open('#/scene/good');
  await settled(view);
  let go;
  const isSeen = new Promise((done) => (go = done));
  await view.page.route(/\/assets\/(help_dialog|grade_page)-/, async (route) => {
    await isSeen;
    await route.fallback();
  });
  const tools = await view.page.locator('.toolbar').boundingBox();
  await view.page.getByRole('button', { name: 'Help' }).click();
  await view.page.locator('.toolbar .lazy').waitFor({ state: 'attached' });
  assert.ok(!(await view.page.locator('.toolbar .lazy').isVisible()));
  assert.deepEqual(await view.page.locator('.toolbar').boundingBox(), tools);
  await view.page.evaluate(() => (location.hash = '#/grade'));
  await view.page.getByText('Loading…').waitFor();
  const inset = await view.page.getByText('Loading…').evaluate((one) => Number.parseFloat(getComputedStyle(one).paddingLeft));
  assert.ok(inset >= 12, `${inset} px from the edge`);
  go();
  await view.page.getByRole('button', { name: 'Try an example class' }).waitFor();
  await view.close();
});

test('while a scene is drawn for the first time the page says so', async () => {
  const view = await open('#/');
  let release;
  const held = new Promise((done) => (release = done));
  await view.page.route(/\/image\?/, async (route) => {
    await held;
    await route.continue();
  });
  await view.page.evaluate(() => (location.hash = '#/scene/good'));
  await inState(view, 'loading');
  assert.equal(await view.page.locator('.stage').getAttribute('aria-busy'), 'true');
  release();
  await settled(view);
  await inState(view, 'drawn');
  await view.close();
});

test('findings never change the size of the picture, and all of them are listed', async () => {
  const sizes = [];
  for (const scene of ['good', 'many']) {
    const view = await open(`#/scene/${scene}`);
    await settled(view);
    sizes.push(await view.page.locator('.stage').boundingBox());
    if (scene === 'many') {
      // The header of the picture has no room for all.
      assert.equal(await view.page.locator('.drawer-tab').innerText(), '16 errors');
      const tab = view.page.locator('.drawer-tab'), body = view.page.locator('.drawer-body');
      assert.ok(await body.isVisible(), 'a scene that opens with errors shows them');
      assert.equal(await body.locator('.findings li').count(), 16);
      const pixels = await canvasPixels(view.page);
      await tab.click();
      assert.ok(!(await body.isVisible()));
      assert.equal(await tab.getAttribute('aria-expanded'), 'false');
      sizes.push(await view.page.locator('.stage').boundingBox());
      assert.deepEqual(await canvasPixels(view.page), pixels);
      await tab.click();
      await body.getByRole('button', { name: /^Line 5, / }).click();
      await view.page.waitForFunction(() => document.querySelector('.code')?.shadowRoot?.querySelector('.cm-activeLineGutter')?.textContent === '5');
    }
    await view.close();
  }
  assert.deepEqual(sizes, sizes.map(() => sizes[0]));
});

test('when an edit cannot be drawn the last image stays, dimmed, and comes back', async () => {
  const view = await open('#/scene/good');
  await settled(view);
  await view.page.getByRole('button', { name: 'Panel' }).click();
  await view.page.getByRole('tab', { name: 'XML' }).click();
  await view.page.locator('.cm-content').click();
  await settled(view);
  const pixels = await canvasPixels(view.page), before = await brightness(view);
  await view.page.keyboard.press('Control+a');
  await view.page.keyboard.press('Delete');
  await view.page.keyboard.insertText('nothing');
  await inState(view, 'failed');
  assert.match(await note(view, 'failed').innerText(), /last version that could be/);
  assert.deepEqual(await canvasPixels(view.page), pixels);
  const dimmed = await brightness(view);
  assert.ok(dimmed < 0.75 * before, `${dimmed} is not darker than ${before}`);
  await view.page.locator('.cm-content').click();
  for (let i = 0; i < 3; ++i) await view.page.keyboard.press('Control+z');
  await inState(view, 'drawn');
  await view.close();
});

test('a dead link says so, and leads home', async () => {
  for (const [hash, heading, way] of [
    ['#/scene/~0123456789abcdef0123456789abcdef', 'This scene is not here any more', 'All scenes'],
    ['#/scene/goood', 'There is no such scene', 'Search for “goood”'], ['#/sceen/good', 'There is no such page', 'All scenes'],
    ['#/scene/%E0%A4%A', 'There is no such page', 'New scene'],
  ]) {
    const view = await open(hash);
    await view.page.getByRole('heading', { name: heading }).waitFor();
    assert.equal(await view.page.locator('.stage, .toolbar, .drawer').count(), 0, 'nothing looks like a scene');
    assert.match(await view.page.title(), /^Not found/);
    assert.doesNotMatch(await view.page.locator('main').innerText(), /\/v1\/|GET/);
    await view.page.getByRole('link', { name: way, exact: true }).click();
    if (way === 'New scene') await settled(view);
    else await view.page.waitForSelector('main.gallery');
    if (way.startsWith('Search')) assert.equal(await view.page.getByRole('searchbox').inputValue(), 'goood');
    await view.close();
  }
});

test('a scene that is deleted while it is on show is gone, with its last image', async () => {
  const view = await open('#/');
  const { id } = await (await fetch(`${server.url}/v1/scenes`, { method: 'POST', body: scenes.good, headers: { 'Content-Type': 'application/xml' } })).json();
  await view.page.evaluate((hash) => (location.hash = hash), `#/scene/${encodeURIComponent(id)}`);
  await settled(view);
  const pixels = await canvasPixels(view.page);
  assert.equal((await fetch(`${server.url}/v1/scenes/${encodeURIComponent(id)}`, { method: 'DELETE' })).status, 204);
  await view.page.locator('.stage').focus();
  await view.page.keyboard.press('ArrowLeft');
  await inState(view, 'gone');
  assert.match(await note(view, 'failed').innerText(), /not on the server any more/);
  assert.deepEqual(await canvasPixels(view.page), pixels);
  await view.close();
});

test('without the server the page says so, and goes on by itself when it is back', async () => {
  const view = await open('#/');
  await view.page.route(/\/v1\//, (route) => route.abort());
  await view.page.evaluate(() => (location.hash = '#/scene/good'));
  await inState(view, 'offline');
  assert.match(await note(view, 'offline').innerText(), /does not answer/);
  await view.page.unroute(/\/v1\//);
  await settled(view); // nobody did anything
  await inState(view, 'drawn');
  const pixels = await canvasPixels(view.page);
  // From now on it does not ask again by itself: the button alone does.
  await view.page.evaluate(() => {
    const plain = window.setTimeout;
    window.setTimeout = (act, ms, ...given) => (ms >= 1000 ? 0 : plain(act, ms, ...given));
  });
  await view.page.route(/\/v1\//, (route) => route.abort());
  await view.page.locator('.stage').focus();
  await view.page.keyboard.press('ArrowLeft');
  await inState(view, 'offline');
  assert.deepEqual(await canvasPixels(view.page), pixels);
  await view.page.unroute(/\/v1\//);
  await view.page.getByRole('button', { name: 'Try now' }).click();
  await inState(view, 'drawn');
  await settled(view);
  assert.notDeepEqual(await canvasPixels(view.page), pixels);
  await view.close();
});

test('no serious finding of axe in any state', async () => {
  for (const look of [{ colorScheme: 'light', viewport: { width: 1280, height: 800 } }, { colorScheme: 'dark', viewport: { width: 360, height: 740 } }])
    for (const [hash, selector] of [
      ['#/scene/warned', '.is-warned'], ['#/scene/many', '.is-incomplete .drawer-body:not([hidden])'], ['#/scene/failed', '.is-failed'],
      ['#/scene/goood', 'main.gone'], ['offline', '.is-offline'],
    ]) {
      const view = await open(hash === 'offline' ? '#/' : hash, { ...look, bypassCSP: true });
      if (hash === 'offline') {
        await view.page.route(/\/v1\//, (route) => route.abort());
        await view.page.evaluate(() => (location.hash = '#/scene/good'));
      }
      await view.page.waitForSelector(selector, { timeout: 60000 });
      assert.deepEqual(await axeFindings(view.page), [], `${hash}, ${look.colorScheme}`);
      assert.ok((await view.page.evaluate(() => document.documentElement.scrollWidth)) <= look.viewport.width, `${hash} is too wide`);
      await view.close();
    }
});
