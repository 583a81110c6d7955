// Every tool and setting of the viewer: what it asks the server for, and that the picture is another.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { canvasPixels, close, draftOf, launch, openPage, picturePixels, settled, startServer, until } from './fixture.mjs';

let server, browser;
before(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

const openScene = async (id, options) => {
  const view = await openPage(browser, `${server.url}/#/scene/${id}`, options);
  await settled(view);
  return view;
};
const last = (view) => view.full().at(-1);
/** Does it, waits until another full picture than before has come to rest, and returns what it was asked with. */
async function asks(view, act) {
  const before = view.full().length;
  await act();
  await until(() => view.full().length > before, 'no picture was asked for');
  await settled(view);
  return last(view);
}

test('the keys work as soon as a scene is open, and after a click on a tool', async () => {
  const view = await openPage(browser, `${server.url}/`);
  await view.page.locator('.card a', { hasText: 'Torch' }).click();
  await settled(view);
  const first = (await asks(view, () => view.page.keyboard.press('ArrowRight'))).azimuth;
  await asks(view, () => view.page.getByRole('button', { name: 'fast' }).click());
  const second = (await asks(view, () => view.page.keyboard.press('ArrowRight'))).azimuth;
  close(second, Number(first) + 5, 0.01, 'azimuth');
  // By the keyboard a tool keeps the focus, and the keys are its own.
  await view.page.getByRole('button', { name: 'Walk' }).focus();
  await view.page.keyboard.press('Enter');
  assert.equal(await view.page.evaluate(() => document.activeElement.getAttribute('aria-label')), 'Walk');
  await view.close();
});

test('right drag and Shift with a drag pan: the target moves across the view', async () => {
  for (const pan of ['right', 'shift']) {
    const view = await openScene('torch');
    await asks(view, () => view.page.keyboard.press('ArrowRight'));
    const from = last(view), area = await view.page.locator('.stage').boundingBox();
    const [x, y] = [area.x + area.width / 2, area.y + area.height / 2];
    await asks(view, async () => {
      if (pan === 'shift') await view.page.keyboard.down('Shift');
      await view.page.mouse.move(x, y);
      await view.page.mouse.down({ button: pan === 'shift' ? 'left' : 'right' });
      for (let i = 1; i <= 5; ++i) await view.page.mouse.move(x + i * 12, y);
      await view.page.mouse.up({ button: pan === 'shift' ? 'left' : 'right' });
      if (pan === 'shift') await view.page.keyboard.up('Shift');
    });
    const to = last(view), step = to.target.split(',').map((value, i) => Number(value) - Number(from.target.split(',')[i]));
    assert.deepEqual([to.azimuth, to.elevation, to.distance], [from.azimuth, from.elevation, from.distance]);
    // What the hand holds follows it: 60 px to the right, the target as far to the left.
    const a = (Number(to.azimuth) * Math.PI) / 180, fov = Number(to.fov ?? 60);
    const worldPerPx = (2 * Number(to.distance) * Math.tan((fov * Math.PI) / 360)) / area.height;
    assert.ok(step[0] * Math.cos(a) - step[2] * Math.sin(a) < -30 * worldPerPx, `${pan}: ${step}`);
    close(step[1], 0, 1e-4, 'height of the target');
    await view.close();
  }
});

test('two fingers side by side pan', async () => {
  const view = await openScene('torch', { hasTouch: true });
  await asks(view, () => view.page.keyboard.press('ArrowRight'));
  const from = last(view), area = await view.page.locator('.stage').boundingBox(), client = await view.context.newCDPSession(view.page);
  const [x, y] = [area.x + area.width / 2, area.y + area.height / 2];
  const touch = (type, points) => client.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([px, py], id) => ({ x: px, y: py, id })) });
  await asks(view, async () => {
    await touch('touchStart', [[x - 40, y], [x + 40, y]]);
    for (let i = 1; i <= 8; ++i) await touch('touchMove', [[x - 40, y + i * 8], [x + 40, y + i * 8]]);
    await touch('touchEnd', []);
  });
  const to = last(view);
  close(to.distance, Number(from.distance), Number(from.distance) * 0.02, 'distance');
  assert.equal(to.azimuth, from.azimuth);
  assert.ok(Number(to.target.split(',')[1]) > Number(from.target.split(',')[1]), 'the target goes up when the fingers go down');
  await view.close();
});

/** Sets and takes back each [option, value, set, unset]: asked for, drawn otherwise, and as before. */
async function checkSettings(scene, settingsOf) {
  const view = await openScene(scene, { viewport: { width: 1000, height: 700 } });
  const { page } = view;
  await asks(view, () => page.getByRole('button', { name: 'Panel' }).click());
  const own = (await canvasPixels(page)).digest;
  for (const [option, value, set, unset] of settingsOf(page)) {
    const begun = view.pictures.length;
    await set();
    const wanted = () => view.pictures.slice(begun).find((one) => one[option] === value && one.scale === undefined);
    await until(wanted, `${option}=${value} was not asked for`);
    await page.waitForFunction((seq) => Number(document.querySelector('.stage canvas').dataset.seq) >= seq, Number(wanted().seq));
    assert.notEqual((await canvasPixels(page)).digest, own, `${option}=${value} draws the same`);
    await asks(view, unset);
    assert.equal(last(view)[option], undefined);
    assert.equal((await canvasPixels(page)).digest, own, `${option} taken back`);
  }
  return view;
}

test('every setting asks for its option, draws another picture, and back', async () => {
  const view = await checkSettings('torch', (page) => {
    const choose = (name, value) => () => page.getByRole('combobox', { name, exact: true }).selectOption(value);
    const tick = (name, on) => () => page.getByRole('checkbox', { name, exact: true }).setChecked(on);
    return [
      ...['points', 'wireframe', 'solid', 'chess', 'flat'].map((mode) => ['shading', mode, choose('Shading', mode), choose('Shading', '')]),
      ['shading', 'wireframe', tick('Wireframe', true), tick('Wireframe', false)],
      ['axes', '1', tick('Axes', true), tick('Axes', false)],
      ['focus', '1', tick('Camera’s target', true), tick('Camera’s target', false)],
      ['debug', '1', tick('Outlines and normals', true), tick('Outlines and normals', false)],
      ['aa', '16', choose('Samples a pixel', '16'), choose('Samples a pixel', '')],
      ...['depth', 'normal', 'id'].map((layer) => ['layer', layer, choose('Shows', layer), choose('Shows', '')]),
    ];
  });
  // The error bound is a slider of powers of two.
  const own = (await canvasPixels(view.page)).digest;
  assert.equal((await asks(view, () => view.page.getByRole('slider', { name: 'Precision of shapes' }).fill('3'))).error, '8');
  assert.notEqual((await canvasPixels(view.page)).digest, own);
  await view.close();
});

test('what is see-through is drawn model by model, exactly, or opaque', async () => {
  // Two sheets that cross: sorted as wholes one is wrong in half of the image.
  const sheet = (turn, colour) => `<group><transform><rotate angle="${turn}" x="0" y="1" z="0"/><rotate angle="90" x="1" y="0" z="0"/></transform>
    <models><model file="plane_3_1.3d"><color><emissive ${colour} A="128"/><diffuse R="0" G="0" B="0" A="128"/></color></model></models></group>`;
  const text = `<world><window width="320" height="240"/><camera><position x="0" y="0.5" z="5"/><lookAt x="0" y="0" z="0"/></camera>
    <lights><light type="directional" x="0" y="0" z="1"/></lights>${sheet(40, 'R="255" G="0" B="0"')}${sheet(-40, 'R="0" G="0" B="255"')}</world>`;
  const stored = await fetch(`${server.url}/v1/scenes?public=0`, { method: 'POST', headers: { 'Content-Type': 'application/xml' }, body: text });
  assert.ok(stored.ok, await stored.clone().text());
  const view = await checkSettings((await stored.json()).id, (page) => ['exact', 'off'].map((word) => ['transparency', word,
    () => page.getByRole('combobox', { name: 'See-through' }).selectOption(word), () => page.getByRole('combobox', { name: 'See-through' }).selectOption('')]));
  await view.close();
});

test('the background is chosen, and given back to the scene', async () => {
  const view = await checkSettings('carousel', (page) => [
    ['background', '#ff8800', () => page.locator('input[type=color]').fill('#ff8800'), () => page.getByRole('button', { name: 'the scene’s own' }).click()],
  ]);
  await view.close();
});

test('curves are drawn where the scene has some, and the counts tell what was culled', async () => {
  const view = await openScene('solar-system', { viewport: { width: 1000, height: 700 } });
  await asks(view, () => view.page.getByRole('button', { name: 'Panel' }).click());
  const before = (await canvasPixels(view.page)).digest;
  assert.equal((await asks(view, () => view.page.getByRole('checkbox', { name: 'Curves' }).check())).curves, '1');
  assert.notEqual((await canvasPixels(view.page)).digest, before);
  await view.page.getByRole('checkbox', { name: 'Culling counts' }).check();
  const stats = await view.page.evaluate(async (url) => JSON.parse((await fetch(url)).headers.get('X-Farol-Stats')), last(view).url);
  const text = await view.page.locator('.hud').innerText();
  assert.match(text, new RegExp(`\\b${stats.culled} culled`));
  assert.match(text, new RegExp(`\\b${stats.instances} instances drawn of ${stats.instances + stats.culled}`));
  // Where the time went adds up to the whole.
  const [total, ...parts] = [...(await view.page.locator('.hud .split').innerText()).matchAll(/[\d.]+/g)].map(Number);
  assert.deepEqual([...(await view.page.locator('.hud .split').innerText()).matchAll(/[a-z]{3,}/g)].map(String), ['network', 'queue', 'prepare', 'draw', 'encode', 'page']);
  close(parts.reduce((sum, part) => sum + part, 0), total, 4, 'the parts together'); // each is rounded to a millisecond
  await view.close();
});

test('the time slider draws its moment', async () => {
  const view = await openScene('solar-system');
  const before = (await canvasPixels(view.page)).digest;
  const { time } = await asks(view, () => view.page.getByRole('slider', { name: 'Time in seconds' }).fill('7.5'));
  assert.equal(time, '7.5');
  assert.notEqual((await canvasPixels(view.page)).digest, before);
  assert.match(await view.page.locator('.time-bar output').innerText(), /^7\.5 s$/);
  await view.page.waitForURL(/[?&]t=7\.5/);
  await view.close();
});

test('the command, the download and the link give the picture that is shown', async () => {
  const view = await openScene('torch', { acceptDownloads: true, permissions: ['clipboard-read', 'clipboard-write'] });
  await asks(view, () => view.page.keyboard.press('ArrowLeft'));
  const shown = await canvasPixels(view.page), copied = () => view.page.evaluate(() => navigator.clipboard.readText());
  await view.page.getByRole('button', { name: 'Share', exact: true }).click();
  await view.page.getByRole('button', { name: 'Copy: curl' }).click();
  await view.page.getByText('Command copied.').waitFor();
  const url = /^curl '([^']+)' -o picture\.png$/.exec(await copied())?.[1];
  assert.ok(url, await copied());
  assert.deepEqual(await picturePixels(view.page, url), shown);
  const [download] = await Promise.all([view.page.waitForEvent('download'), view.page.getByRole('button', { name: 'PNG, exact' }).click()]);
  assert.equal(download.suggestedFilename(), 'torch.png');
  const answer = Buffer.from(await (await fetch(url)).arrayBuffer());
  assert.ok(readFileSync(await download.path()).equals(answer), 'the file is the picture');
  await view.page.getByRole('button', { name: 'Copy: This view' }).click();
  await view.page.getByText('Link copied.').waitFor();
  const other = await openPage(browser, await copied());
  await settled(other);
  assert.deepEqual(await canvasPixels(other.page), shown);
  await other.close();
  await view.close();
});

test('the turntable goes round in small frames, and stops at a full picture', async () => {
  const view = await openScene('torch');
  const before = view.moving().length, rested = view.full().length;
  await view.page.keyboard.press('t');
  await until(() => view.moving().length >= before + 6, 'it does not turn');
  assert.equal(view.full().length, rested, 'no full picture while it turns');
  const stopped = await asks(view, () => view.page.keyboard.press('t'));
  const azimuths = [...view.moving().slice(before).map((one) => Number(one.azimuth)), Number(stopped.azimuth)];
  assert.ok(azimuths.every((one, i) => i === 0 || (one - azimuths[i - 1] + 360) % 360 < 180), azimuths.join());
  assert.ok(new Set(azimuths).size > 3, azimuths.join());
  await view.page.getByRole('button', { name: 'Share', exact: true }).click();
  const href = await view.page.locator('.share').getByRole('link', { name: 'Download' }).getAttribute('href');
  const short = new URL(href, server.url);
  short.searchParams.set('frames', '4');
  const answer = await fetch(short);
  assert.equal(answer.status, 200, await answer.clone().text());
  assert.ok(Buffer.from(await answer.arrayBuffer()).includes('acTL'), 'an animated PNG');
  await view.close();
});

test('light and dark are chosen, and stay', async () => {
  const view = await openPage(browser, `${server.url}/`, { colorScheme: 'light' });
  const ground = () => view.page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number)[0]);
  assert.ok((await ground()) > 200);
  await view.page.getByRole('button', { name: 'Dark theme' }).click();
  assert.ok((await ground()) < 60);
  await view.page.reload();
  await view.page.getByRole('button', { name: 'Light theme' }).waitFor();
  assert.ok((await ground()) < 60);
  await view.close();
});

test('the inspector changes a model’s material and texture in the XML', async () => {
  const view = await openScene('solar-system', { viewport: { width: 1000, height: 700 } });
  await view.page.getByRole('button', { name: 'Panel' }).click();
  await view.page.getByRole('tab', { name: 'Inspect' }).click();
  await view.page.getByRole('searchbox', { name: 'Find a light or model' }).fill('Sun');
  await view.page.locator('.parts button').first().click();
  await settled(view);
  const before = (await canvasPixels(view.page)).digest;
  const drawn = async (act) => {
    const asked = await asks(view, act);
    assert.equal(asked.method, 'POST');
    return (await canvasPixels(view.page)).digest;
  };
  const other = await drawn(() => view.page.getByRole('combobox', { name: 'Texture' }).selectOption('earth.jpg'));
  assert.notEqual(other, before);
  const glowing = await drawn(() => view.page.getByRole('slider', { name: 'Emissive red' }).fill('0'));
  assert.notEqual(glowing, other);
  const draft = await draftOf(view, 'solar-system');
  const sun = draft.slice(draft.indexOf('<group name="Sun">'), draft.indexOf('</models>'));
  assert.match(sun, /<texture file="earth\.jpg"/);
  assert.match(sun, /<emissive R="0"/);
  await view.page.getByRole('button', { name: 'Discard the edits' }).first().click();
  await settled(view);
  assert.equal((await canvasPixels(view.page)).digest, before);
  await view.close();
});
