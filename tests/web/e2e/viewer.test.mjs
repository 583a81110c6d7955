// The viewer: that the camera moves as the hand says, by requests and by pixels.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { canvasPixels, close, launch, openPage, picturePixels, settled, startServer, until } from './fixture.mjs';

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
const box = (view) => view.page.locator('.stage').boundingBox();
const vector = (text) => text.split(',').map(Number);
/** The camera as the service says it of the last full picture's view. */
const orbitOf = async (view) => {
  const { camera } = await view.page.evaluate(async (url) => ({ camera: JSON.parse((await fetch(url)).headers.get('X-Farol-Camera')) }), view.full().at(-1).url);
  const d = camera.eye.map((x, i) => x - camera.target[i]), distance = Math.hypot(...d);
  return { azimuth: (Math.atan2(d[0], d[2]) * 180) / Math.PI, elevation: (Math.asin(d[1] / distance) * 180) / Math.PI, distance, target: camera.target };
};

test('the gallery lists the scenes, finds one and opens it', async () => {
  const view = await openPage(browser, `${server.url}/`);
  await view.page.waitForSelector('.card:not(.ghost)');
  const all = await view.page.locator('.card:not(.ghost)').count();
  assert.ok(all >= 14, `${all} cards`);
  await view.page.getByRole('searchbox', { name: 'Search scenes' }).fill('lightho');
  await view.page.waitForFunction(() => document.querySelectorAll('.card').length === 1);
  await view.page.waitForSelector('.card img.loaded', { timeout: 60000 });
  await view.page.locator('.card a').click();
  await settled(view);
  assert.match(view.page.url(), /#\/scene\/lighthouse/);
  assert.equal(await view.page.locator('h1').innerText(), 'Lighthouse');
  await view.close();
});

test('a drag orbits: its frames are small, the resting one is full and is that camera’s', async () => {
  const view = await openScene('torch');
  const start = await orbitOf(view), area = await box(view);
  const first = await canvasPixels(view.page);
  assert.deepEqual([first.width, first.height], [Math.round(area.width), Math.round(area.height)]);
  const [x, y] = [area.x + area.width / 2, area.y + area.height / 2];
  await view.page.mouse.move(x, y);
  await view.page.mouse.down();
  for (let i = 1; i <= 12; ++i) {
    await view.page.mouse.move(x + i * 10, y + i * 5);
    await view.page.waitForTimeout(16);
  }
  await view.page.mouse.up();
  await settled(view);
  const moving = view.moving(), last = view.full().at(-1);
  assert.ok(moving.length >= 2, `${moving.length} frames of the drag`);
  for (const frame of moving) {
    assert.ok(Number(frame.scale) < 1 && frame.format !== 'png' && frame.aa === '1', JSON.stringify(frame));
    assert.equal(frame.session, moving[0].session);
  }
  assert.equal(last.format, 'png');
  // 180 degrees for the height of the stage; down is up.
  close(last.azimuth, start.azimuth - (120 * 180) / area.height, 0.1, 'azimuth');
  close(last.elevation, start.elevation + (60 * 180) / area.height, 0.1, 'elevation');
  close(last.distance, start.distance, 1e-3, 'distance');
  const shown = await canvasPixels(view.page);
  assert.notEqual(shown.digest, first.digest);
  const url = new URL(last.url);
  url.searchParams.delete('session');
  url.searchParams.delete('seq');
  assert.deepEqual(await picturePixels(view.page, url.href), shown);
  await view.close();
});

test('wheel and keys zoom, orbit, slide and reset', async () => {
  const view = await openScene('torch');
  const start = await orbitOf(view), area = await box(view), still = await canvasPixels(view.page);
  await view.page.mouse.move(area.x + 100, area.y + 100);
  await view.page.mouse.wheel(0, 200);
  await settled(view);
  close(view.full().at(-1).distance, start.distance * Math.exp(0.3), 1e-3, 'distance after the wheel');
  await view.page.locator('.stage').focus();
  const press = async (key) => {
    await view.page.keyboard.press(key);
    await settled(view);
    return view.full().at(-1);
  };
  close((await press('ArrowRight')).azimuth, start.azimuth + 5, 0.01, 'azimuth');
  close((await press('ArrowUp')).elevation, start.elevation + 5, 0.01, 'elevation');
  const near = (await press('+')).distance;
  close(near, start.distance * Math.exp(0.3) * 0.9, 1e-3, 'distance after +');
  const before = view.full().at(-1), slid = vector((await press('w')).target), old = vector(before.target);
  assert.equal(slid[1], old[1]);
  const a = (Number(before.azimuth) * Math.PI) / 180;
  close(slid[0] - old[0], -Math.sin(a) * near * 0.06, 1e-4, 'forward x');
  close(slid[2] - old[2], -Math.cos(a) * near * 0.06, 1e-4, 'forward z');
  const reset = await press('r');
  assert.equal(reset.azimuth, undefined);
  assert.deepEqual(await canvasPixels(view.page), still);
  await view.close();
});

test('two fingers zoom and pan, one orbits', async () => {
  const view = await openScene('torch', { hasTouch: true });
  const start = await orbitOf(view), area = await box(view), client = await view.context.newCDPSession(view.page);
  const [x, y] = [area.x + area.width / 2, area.y + area.height / 2];
  const touch = (type, points) => client.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([px, py], id) => ({ x: px, y: py, id })) });
  await touch('touchStart', [[x, y]]);
  for (let i = 1; i <= 6; ++i) await touch('touchMove', [[x + i * 10, y]]);
  await touch('touchEnd', []);
  await settled(view);
  close(view.full().at(-1).azimuth, start.azimuth - (60 * 180) / area.height, 0.5, 'azimuth');
  await touch('touchStart', [[x - 50, y], [x + 50, y]]);
  for (let i = 1; i <= 10; ++i) await touch('touchMove', [[x - 50 - i * 5, y], [x + 50 + i * 5, y]]);
  await touch('touchEnd', []);
  await settled(view);
  close(view.full().at(-1).distance, start.distance / 2, start.distance * 0.03, 'distance after the pinch');
  await view.close();
});

test('play moves the time, and the speed multiplies it', async () => {
  const view = await openScene('solar-system');
  await view.page.getByLabel('Speed').selectOption('8');
  await view.page.locator('.stage').focus();
  await view.page.keyboard.press(' ');
  await view.page.waitForFunction(() => Number.parseFloat(document.querySelector('.time-bar output').textContent) > 2);
  await view.page.keyboard.press(' ');
  await settled(view);
  const times = view.moving().map((frame) => Number(frame.time ?? 0));
  assert.ok(times.length >= 2 && times.every((time, i) => i === 0 || time >= times[i - 1]), times.join());
  assert.ok(Number(view.full().at(-1).time) >= times.at(-1));
  await view.close();
});

test('a deep link restores the view, and the view makes the link', async () => {
  const view = await openScene('torch');
  await view.page.locator('.stage').focus();
  for (const key of ['ArrowLeft', 'ArrowLeft', 'ArrowUp', 'd', '-']) await view.page.keyboard.press(key);
  await settled(view);
  await view.page.getByRole('button', { name: 'Panel' }).click();
  await view.page.getByLabel('Axes').check();
  await settled(view);
  await view.page.getByRole('button', { name: 'Panel', exact: true }).click();
  await settled(view);
  await view.page.waitForURL(/axes=1/); // a moment after the last change
  const link = view.page.url();
  const again = await openPage(browser, link);
  await settled(again);
  const [one, other] = [view.full().at(-1), again.full().at(-1)];
  assert.equal(other.axes, '1');
  for (const name of ['azimuth', 'elevation', 'distance']) close(other[name], Number(one[name]), 0.01, name);
  vector(one.target).forEach((value, i) => close(vector(other.target)[i], value, 1e-4, 'target'));
  await again.close();
  await view.close();
});

test('a stage of another size gets a picture of its size', async () => {
  const view = await openScene('torch', { viewport: { width: 1200, height: 700 } });
  for (const change of [() => view.page.getByRole('button', { name: 'Panel' }).click(), () => view.page.setViewportSize({ width: 1000, height: 640 })]) {
    const before = view.full().length;
    await change();
    await until(() => view.full().length > before, 'no image of the new size was asked for');
    await settled(view);
    const area = await box(view), shown = await canvasPixels(view.page);
    assert.deepEqual([shown.width, shown.height], [Math.round(area.width), Math.round(area.height)]);
  }
  await view.close();
});

test('walking: the arrows turn, W moves ahead', async () => {
  const view = await openScene('third-person-ship');
  await view.page.locator('.stage').focus();
  await view.page.keyboard.press('m');
  await settled(view);
  const { eye, target } = view.full().at(-1);
  await view.page.keyboard.press('w');
  await settled(view);
  const moved = vector(view.full().at(-1).eye), from = vector(eye), ahead = vector(target).map((x, i) => x - from[i]);
  const step = moved.map((x, i) => x - from[i]), far = Math.hypot(...step);
  close(step.reduce((sum, x, i) => sum + x * ahead[i], 0), far, far * 1e-3, 'the step goes ahead');
  await view.page.keyboard.press('ArrowLeft');
  await settled(view);
  const last = view.full().at(-1), look = vector(last.target).map((x, i) => x - vector(last.eye)[i]);
  const yaw = (v) => (Math.atan2(v[0], v[2]) * 180) / Math.PI;
  close(yaw(look) - yaw(ahead), 5, 0.01, 'five degrees to the left');
  await view.close();
});

test('walking with an entity: it stays in front while the world goes by', async () => {
  const view = await openScene('third-person-ship');
  await view.page.locator('.stage').focus();
  await view.page.keyboard.press('m');
  await settled(view);
  /** The model numbers about the middle of the picture, and how many pixels show each. */
  const models = () => view.page.evaluate(async (address) => {
    const url = new URL(address);
    for (const name of ['session', 'seq']) url.searchParams.delete(name);
    Object.entries({ layer: 'id', aa: '1', format: 'png' }).forEach(([name, value]) => url.searchParams.set(name, value));
    const bitmap = await createImageBitmap(await (await fetch(url)).blob(), { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height), context = canvas.getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height), counts = {};
    for (let i = 0; i < data.length; i += 4) {
      const number = data[i] * 65536 + data[i + 1] * 256 + data[i + 2];
      counts[number] = (counts[number] ?? 0) + 1;
    }
    return counts;
  }, view.full().at(-1).url);
  const first = await models(), before = await canvasPixels(view.page);
  // The entity is drawn after the scene, and so has the highest numbers.
  const ship = Object.keys(first).map(Number).sort((a, b) => b - a).slice(0, 2);
  for (const keys of [['ArrowLeft', 'ArrowLeft'], ['ArrowUp'], ['w', 'w', 'w'], ['d']]) {
    for (const key of keys) await view.page.keyboard.press(key);
    await settled(view);
    const now = await models();
    for (const number of ship) assert.equal(now[number], first[number], `model ${number} after ${keys}`);
  }
  assert.notEqual((await canvasPixels(view.page)).digest, before.digest);
  const last = view.full().at(-1), look = vector(last.target).map((x, i) => x - vector(last.eye)[i]);
  assert.ok(look[1] < -0.05, 'the up arrow turns down');
  await view.page.keyboard.press('m');
  await settled(view);
  assert.equal(view.full().at(-1).eye, undefined, 'orbiting again');
  await view.close();
});

test('light mode turns the camera’s light, and quality keys choose the samples', async () => {
  const view = await openScene('torch');
  await view.page.locator('.stage').focus();
  await view.page.keyboard.press('p');
  await settled(view);
  assert.equal(view.full().at(-1).aa, '16');
  await view.page.keyboard.press('o');
  await settled(view);
  assert.equal(view.full().at(-1).aa, '1');
  const before = await canvasPixels(view.page);
  await view.page.keyboard.press('l');
  for (const key of ['x', 'x', 'a']) await view.page.keyboard.press(key);
  await settled(view);
  assert.equal(view.full().at(-1).method, 'POST');
  assert.equal(view.full().at(-1).base, 'torch');
  assert.notDeepEqual(await canvasPixels(view.page), before);
  const draft = await view.page.evaluate(() => JSON.parse(localStorage.getItem('farol.draft.torch')).text);
  assert.match(draft, /space="camera" alpha="10" beta="5"/);
  await view.close();
});
