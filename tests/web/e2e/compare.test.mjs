// Two scenes compared: one camera, every way to show them, findings with lines, links, files and images.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { axeFindings, draft, launch, openPage, settled, startServer } from './fixture.mjs';

let server, browser;
before(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

const wide = { viewport: { width: 1000, height: 640 } };
/** Until nothing newer is on its way, and so many images rest. */
const rest = ({ page }, expected = 2) => page.waitForFunction((count) => {
  const stage = document.querySelector('.compare-stage[aria-busy=false]');
  return stage && [...stage.querySelectorAll('canvas')].filter((one) => one.dataset.rest === 'true').length === count;
}, expected, { timeout: 60000 });
const open = async (first, second, options = {}) => {
  const view = await openPage(browser, `${server.url}/#/compare/${encodeURIComponent(first)}/${encodeURIComponent(second)}${options.view ?? ''}`, { ...wide, ...options });
  await rest(view);
  return view;
};
/** Edits of the scene torch, as they are in a browser: the torch one to the right. */
const openDraft = async (options = {}) => {
  const source = await (await fetch(`${server.url}/v1/scenes/torch/source`)).text();
  return open('torch', 'draft:torch', { ...options, remembered: draft('torch', source.replace('x="-2.35"', 'x="-1.35"')) });
};
const mode = async (view, name) => {
  await view.page.getByRole('group', { name: 'How they are shown' }).getByRole('button', { name }).click();
  await rest(view, name === 'Difference' ? 1 : 2);
};
/** Digests of what the canvases hold. */
const pixels = (view) => view.page.locator('.compared canvas').evaluateAll((all) => Promise.all(all.map(async (canvas) => {
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  return [...new Uint8Array(await crypto.subtle.digest('SHA-256', data))].join();
})));
const images = (view) => view.pictures.filter((one) => one.format === 'png');

test('edits and the stored scene: findings in words, with the line that opens in the editor', async () => {
  const view = await openDraft();
  const [a, b] = await pixels(view);
  assert.notEqual(a, b);
  await view.page.getByRole('button', { name: 'Compare what is on show' }).click();
  const cause = view.page.locator('.causes a');
  await cause.waitFor({ timeout: 60000 });
  assert.equal(await cause.count(), 1);
  assert.match(await cause.innerText(), /group "Torch": x of the translate is too (small|large).*line 52/);
  assert.match(await view.page.locator('.compare-words').innerText(), /of the pixels are as good as equal.*\n+.*FLIP/);
  await cause.click();
  await settled(view);
  await view.page.waitForFunction(() => document.querySelector('.code')?.shadowRoot?.querySelector('.cm-activeLineGutter')?.textContent === '52');
  await view.page.locator('.editor-foot').getByRole('link', { name: 'Compare' }).click();
  await rest(view);
  await view.close();
});

test('a movement while the images are compared changes neither what is compared nor the page', async () => {
  const view = await open('torch', 'teapots');
  // The first image is written out only after newer ones are on show.
  const count = await view.page.evaluate(() => {
    const plain = OffscreenCanvas.prototype.convertToBlob;
    OffscreenCanvas.prototype.convertToBlob = async function (...given) {
      await window.moved_;
      return plain.apply(this, given);
    };
    window.moved_ = new Promise((done) => (window.go_ = done));
    return [...document.querySelectorAll('.compared canvas')].map((one) => Number(one.dataset.count));
  });
  const [sent] = await Promise.all([
    view.page.waitForRequest((request) => request.url().endsWith('/v1/compare')),
    (async () => {
      await view.page.getByRole('button', { name: 'Compare what is on show' }).click();
      await view.page.getByRole('application').press('ArrowRight');
      await view.page.waitForFunction((before) => [...document.querySelectorAll('.compared canvas')].every((one, i) => Number(one.dataset.count) > before[i]), count);
      await view.page.evaluate(() => window.go_());
    })(),
  ]);
  assert.ok((await sent.response()).ok());
  await view.page.locator('.compare-words p').first().waitFor();
  assert.equal(await view.page.locator('.compare-words .problem').count(), 0);
  await view.close();
});

test('equal scenes say so, and the exchange of the two goes the other way', async () => {
  const view = await open('torch', 'torch');
  const [a, b] = await pixels(view);
  assert.equal(a, b);
  await view.page.getByRole('button', { name: 'Compare what is on show' }).click();
  await view.page.getByText('The images are equal, pixel by pixel.').waitFor({ timeout: 60000 });
  await view.page.getByText('The scenes have the same models').waitFor({ timeout: 60000 });
  await view.page.getByRole('textbox', { name: 'Second' }).or(view.page.getByRole('combobox', { name: 'Second' })).fill('teapots');
  await view.page.keyboard.press('Enter');
  await rest(view);
  const before = await pixels(view);
  await view.page.getByRole('button', { name: 'Exchange the two' }).click();
  await rest(view);
  await view.page.waitForFunction(() => location.hash.startsWith('#/compare/teapots/torch'));
  assert.notDeepEqual(await pixels(view), before);
  await view.close();
});

test('one camera moves both, and the link shows the same', async () => {
  const view = await open('torch', 'teapots');
  const first = images(view).slice(-2);
  assert.deepEqual(new Set(first.map((one) => one.path)), new Set(['/v1/scenes/torch/image', '/v1/scenes/teapots/image']));
  await view.page.getByRole('application').focus();
  for (let i = 0; i < 4; ++i) await view.page.keyboard.press('ArrowRight');
  await rest(view);
  const moved = images(view).slice(-2);
  for (const name of ['azimuth', 'elevation', 'distance', 'target', 'fov', 'width', 'height']) {
    assert.ok(moved[0][name], name);
    assert.equal(moved[0][name], moved[1][name], name);
  }
  const shown = await pixels(view);
  await view.page.waitForFunction(() => /az=/.test(location.hash));
  const other = await openPage(browser, view.page.url(), wide);
  await rest(other);
  assert.deepEqual(await pixels(other), shown);
  await other.close();
  await view.page.getByRole('checkbox', { name: 'Each by its own camera' }).check();
  await view.page.getByRole('application').focus();
  await view.page.keyboard.press('r');
  await rest(view);
  assert.ok(images(view).slice(-2).every((one) => one.eye === undefined && one.azimuth === undefined));
  await view.close();
});

test('slider, in turn and difference show what they say', async () => {
  const view = await openDraft();
  await mode(view, 'Slider');
  const slider = view.page.getByRole('slider', { name: 'Where the second image begins' });
  await slider.fill('30');
  assert.match(await view.page.locator('.compared').last().evaluate((one) => getComputedStyle(one).clipPath), /30%/);
  await mode(view, 'In turn');
  const visible = () => view.page.locator('.compared').evaluateAll((all) => all.map((one) => getComputedStyle(one).visibility === 'visible'));
  assert.deepEqual(await visible(), [true, false]); // with reduced motion nothing blinks by itself
  await view.page.getByRole('button', { name: 'Show the second' }).click();
  assert.deepEqual(await visible(), [false, true]);
  await view.page.getByRole('application').focus();
  await view.page.keyboard.press(' ');
  assert.deepEqual(await visible(), [true, false]);
  await mode(view, 'Difference');
  await view.page.waitForFunction(() => /[1-9]/.test(/: (.*)%/.exec(document.querySelector('.compared figcaption').textContent)?.[1] ?? ''));
  // Far above the torch nothing differs; where it was and is, much.
  const [above, below] = await view.page.evaluate(() => {
    const canvas = document.querySelector('canvas.difference'), { width, height } = canvas, context = canvas.getContext('2d');
    const most = (y, h) => context.getImageData(0, y, width, h).data.reduce((max, x, i) => (i % 4 < 3 ? Math.max(max, x) : max), 0);
    return [most(0, height >> 3), most(height >> 1, height >> 1)];
  });
  assert.equal(above, 0);
  assert.ok(below > 100, String(below));
  await view.page.waitForFunction(() => location.hash.endsWith('show=difference'));
  await view.close();
});

test('an image is compared in its own size; files that are gone are asked for again', async () => {
  const png = Buffer.from(await (await fetch(`${server.url}/v1/scenes/torch/image?width=320&height=240`)).arrayBuffer());
  const view = await openPage(browser, `${server.url}/#/compare/torch/`, wide);
  await view.page.getByText('Choose two').waitFor();
  const [chooser] = await Promise.all([view.page.waitForEvent('filechooser'), view.page.getByRole('button', { name: 'Files…' }).last().click()]);
  await chooser.setFiles([{ name: 'wanted.png', mimeType: 'image/png', buffer: png }]);
  await rest(view, 2);
  assert.deepEqual(await view.page.locator('.compared canvas').evaluateAll((all) => all.map((one) => `${one.width}x${one.height}`)), ['320x240', '320x240']);
  await view.page.getByRole('button', { name: 'Compare what is on show' }).click();
  await view.page.getByText('The images are equal, pixel by pixel.').waitFor({ timeout: 60000 });
  await view.page.waitForFunction(() => location.hash.includes('file%3Awanted.png'));
  await view.page.reload();
  await view.page.getByText('This browser does not have these files any more').waitFor();
  await view.close();
});

test('a scene of files and a scene that is not there', async () => {
  const view = await openPage(browser, `${server.url}/#/compare/no-such-scene/`, wide);
  await view.page.locator('.problem').waitFor();
  const [chooser] = await Promise.all([view.page.waitForEvent('filechooser'), view.page.getByRole('button', { name: 'Files…' }).first().click()]);
  await chooser.setFiles([{ name: 'mine.xml', mimeType: 'text/xml', buffer: Buffer.from('<world><title>Mine</title><group><models><model file="box_1_2.3d"/></models></group></world>') }]);
  await view.page.getByRole('combobox', { name: 'Second' }).fill('teapots');
  await view.page.keyboard.press('Enter');
  await rest(view);
  assert.equal(await view.page.locator('.compared figcaption').first().innerText(), 'First: Mine');
  assert.equal(await view.page.locator('.problem').count(), 0);
  await view.close();
});

test('no serious finding of axe in each way to compare, light and dark, wide and phone', async () => {
  for (const look of [{ colorScheme: 'light', viewport: { width: 1280, height: 800 } }, { colorScheme: 'dark', viewport: { width: 360, height: 740 } }]) {
    const view = await openDraft({ ...look, bypassCSP: true });
    for (const name of ['Side by side', 'Slider', 'In turn', 'Difference']) {
      await mode(view, name);
      assert.deepEqual(await axeFindings(view.page), [], `${name}, ${look.colorScheme}`);
    }
    await view.page.getByRole('button', { name: 'Compare what is on show' }).click();
    await view.page.locator('.causes a').waitFor({ timeout: 60000 });
    assert.deepEqual(await axeFindings(view.page), [], `findings, ${look.colorScheme}`);
    assert.ok((await view.page.evaluate(() => document.documentElement.scrollWidth)) <= look.viewport.width, 'width');
    await view.close();
  }
});
