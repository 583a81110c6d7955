// The tree of the scene: selection in tree, image and text, the outline, what is hidden or locked; by mouse and keys.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { axeFindings, canvasPixels, draft, draftOf, keptAll, launch, openPage, settled, startServer } from './fixture.mjs';

let server, browser;
before(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

const wide = { viewport: { width: 1000, height: 640 } };
const open = async (scene, options = {}) => {
  const view = await openPage(browser, `${server.url}/#/scene/${scene}`, { ...wide, ...options });
  await settled(view);
  await view.page.getByRole('button', { name: 'Panel', exact: true }).click();
  await view.page.getByRole('tab', { name: 'Tree' }).click();
  await view.page.getByRole('tree').waitFor();
  await settled(view);
  return view;
};
/** A scene of one's own with that text. */
const openDraft = async (text) => {
  const view = await openPage(browser, `${server.url}/#/new`, { ...wide, remembered: draft('*', text) });
  await settled(view);
  return view;
};
const row = (view, name) => view.page.getByRole('treeitem', { name });
const selectedName = (view) => view.page.getByRole('treeitem', { selected: true }).getAttribute('aria-label');
/** Waits for the outline of what is selected; its bright pixels as shares of the stage. */
const outline = async (view) => {
  await settled(view); // an outline of what was selected before is cleared
  await view.page.waitForFunction(() => document.querySelector('.outline')?.dataset.of);
  return view.page.evaluate(() => {
    const canvas = document.querySelector('.outline'), { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let [left, right, top, bottom, count] = [1, 0, 1, 0, 0];
    for (let i = 0; i < data.length / 4; ++i) {
      if (data[4 * i] !== 255) continue;
      const x = (i % canvas.width) / canvas.width, y = Math.floor(i / canvas.width) / canvas.height;
      [left, right, top, bottom, count] = [Math.min(left, x), Math.max(right, x), Math.min(top, y), Math.max(bottom, y), count + 1];
    }
    return { left, right, top, bottom, count };
  });
};
const clickAt = async (view, x, y) => {
  const area = await view.page.locator('.stage').boundingBox();
  await view.page.mouse.click(area.x + x * area.width, area.y + y * area.height);
};

test('what is selected in the tree has an outline in the image and its place in the text', async () => {
  const view = await open('torch');
  await row(view, 'Torch').click();
  const torch = await outline(view);
  assert.ok(torch.left > 0.05 && torch.right < 0.4 && torch.top > 0.5 && torch.bottom < 0.9 && torch.count > 300, JSON.stringify(torch));
  // The floor reaches to the lower edge and both sides.
  await row(view, 'Floor').click();
  assert.ok((await outline(view)).count > torch.count);
  await row(view, 'Torch').click();
  await view.page.getByRole('tab', { name: 'XML' }).click();
  await view.page.locator('.cm-content').waitFor();
  await view.page.waitForFunction(() => document.querySelector('.code').shadowRoot.querySelector('.cm-activeLineGutter')?.textContent === '50');
  await view.close();
});

test('a click in the image selects the model, then its groups; a click beside everything selects nothing', async () => {
  const view = await open('teapots');
  const [x, y] = await view.page.evaluate(async (address) => {
    const url = new URL(address);
    for (const name of ['session', 'seq', 'aa']) url.searchParams.delete(name);
    url.searchParams.set('layer', 'id');
    const bitmap = await createImageBitmap(await (await fetch(`${url.href}&aa=1`)).blob(), { colorSpaceConversion: 'none' });
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height), context = canvas.getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height), of = new Map();
    for (let i = 0; i < data.length; i += 4) {
      const number = data[i] * 65536 + data[i + 1] * 256 + data[i + 2];
      if (number > 1) of.set(number, [...(of.get(number) ?? []), i / 4]);
    }
    const [, pixels] = [...of].sort((a, b) => b[1].length - a[1].length)[0], middle = pixels[pixels.length >> 1];
    return [((middle % canvas.width) + 0.5) / canvas.width, (Math.floor(middle / canvas.width) + 0.5) / canvas.height];
  }, view.full().at(-1).url);
  const names = [];
  for (let i = 0; i < 3; ++i) {
    const before = await view.page.evaluate(() => document.querySelector('.tree').getAttribute('aria-activedescendant'));
    await clickAt(view, x, y);
    const named = await view.page.waitForFunction((old) => {
      const now = document.querySelector('.tree').getAttribute('aria-activedescendant');
      return now !== old && now;
    }, before);
    names.push(await named.jsonValue());
  }
  // From the model outwards; each entry's path begins with that of its group.
  assert.ok(names[0].startsWith(`${names[1]}.`), names.join(' '));
  await view.close();
});

test('the cursor in the text selects, and edits before it leave the selection where it is', async () => {
  const view = await open('torch');
  await view.page.getByRole('tab', { name: 'XML' }).click();
  await view.page.locator('.cm-content').waitFor();
  // The editor has the lines that are in sight alone.
  const planks = view.page.locator('.cm-line', { hasText: 'planks.jpg' });
  await view.page.locator('.cm-scroller').hover();
  for (let i = 0; i < 40 && await planks.count() === 0; ++i) {
    await view.page.mouse.wheel(0, 100);
    await view.page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  }
  await planks.click(); // in the floor's model
  await view.page.getByRole('tab', { name: 'Tree' }).click();
  assert.equal(await selectedName(view), 'plane_14_140.3d');
  await view.page.getByRole('tab', { name: 'XML' }).click();
  await view.page.evaluate(() => document.querySelector('.code').shadowRoot.querySelector('.cm-content').focus());
  await view.page.keyboard.press('Control+Home');
  await view.page.keyboard.type('<!-- mine -->\n');
  await settled(view);
  await view.page.getByRole('tab', { name: 'Tree' }).click();
  await row(view, 'Head').click();
  await view.page.getByRole('button', { name: 'Undo' }).click();
  await settled(view);
  assert.equal(await selectedName(view), 'Head');
  await view.close();
});

test('a hidden part is not drawn, the page says so, the XML keeps it, and undo and reload know of it', async () => {
  const view = await open('torch');
  const before = await canvasPixels(view.page);
  await row(view, 'Torch').hover();
  await row(view, 'Torch').getByRole('button', { name: 'Hide Torch' }).click();
  await settled(view);
  const hidden = await canvasPixels(view.page);
  assert.notDeepEqual(hidden, before);
  assert.match(await view.page.locator('.hidden-note').innerText(), /1 part is hidden on this page only/);
  assert.equal(await draftOf(view, 'torch'), null); // the document is as it was
  await keptAll(view);
  await view.page.reload();
  await settled(view);
  assert.deepEqual(await canvasPixels(view.page), hidden);
  assert.equal(await view.page.locator('.hidden-note').count(), 1);
  await view.page.getByRole('button', { name: 'Undo' }).click();
  await settled(view);
  assert.deepEqual(await canvasPixels(view.page), before);
  assert.equal(await view.page.locator('.hidden-note').count(), 0);
  await view.page.getByRole('button', { name: 'Redo' }).click();
  await settled(view);
  assert.deepEqual(await canvasPixels(view.page), hidden);
  await view.page.getByRole('button', { name: 'Show all' }).click();
  await settled(view);
  assert.deepEqual(await canvasPixels(view.page), before);
  await view.close();
});

test('hiding moves no camera of a scene that is framed by its models, and a locked part is not picked', async () => {
  const view = await openDraft('<world><group name="Left"><transform><translate x="-3"/></transform><models><model file="sphere_1_16_8.3d"/></models></group><group name="Right"><models><model file="box_1.3d"/></models></group></world>');
  await view.page.getByRole('tab', { name: 'Tree' }).click();
  await settled(view);
  await row(view, 'Right').click();
  const right = await outline(view);
  await view.page.getByRole('tree').focus();
  await row(view, 'Left').click();
  await view.page.keyboard.press('h');
  await settled(view);
  await row(view, 'Right').click();
  const still = await outline(view);
  for (const side of ['left', 'right', 'top', 'bottom']) assert.ok(Math.abs(still[side] - right[side]) < 0.01, `${side}: ${JSON.stringify([right, still])}`);
  await view.page.keyboard.press('l');
  await settled(view);
  await row(view, 'Left').click();
  await clickAt(view, (right.left + right.right) / 2, (right.top + right.bottom) / 2);
  await view.page.getByText('This part is locked.').waitFor();
  assert.equal(await selectedName(view), 'Left, hidden');
  await view.close();
});

test('the tree works by the keyboard alone, as an ARIA tree', async () => {
  const view = await open('torch');
  const tree = view.page.getByRole('tree');
  await view.page.getByRole('tab', { name: 'Tree' }).focus();
  for (let i = 0; i < 8 && !(await tree.evaluate((one) => one === document.activeElement)); ++i) await view.page.keyboard.press('Tab');
  assert.ok(await tree.evaluate((one) => one === document.activeElement));
  const press = async (key) => {
    await view.page.keyboard.press(key);
    await settled(view); // hiding reads the text first
    return selectedName(view);
  };
  assert.equal(await press('Home'), 'Scene');
  assert.equal(await press('ArrowDown'), 'Camera');
  assert.equal(await press('ArrowUp'), 'Scene');
  const active = await tree.getAttribute('aria-activedescendant');
  assert.equal(await view.page.locator(`[id="${active}"]`).getAttribute('aria-label'), 'Scene');
  await press('ArrowLeft');
  assert.equal(await row(view, 'Scene').getAttribute('aria-expanded'), 'false');
  assert.equal(await view.page.getByRole('treeitem').count(), 1);
  await press('ArrowRight');
  for (let i = 0; i < 6; ++i) await press('ArrowDown');
  assert.equal(await selectedName(view), 'Floor');
  const before = await canvasPixels(view.page);
  assert.equal(await press('h'), 'Floor, hidden');
  await settled(view);
  assert.notDeepEqual(await canvasPixels(view.page), before);
  await view.page.keyboard.press('Control+z');
  await settled(view);
  assert.deepEqual(await canvasPixels(view.page), before);
  assert.equal(await press('l'), 'Floor, locked');
  await view.page.keyboard.press('Enter');
  await view.page.waitForFunction(() => document.querySelector('.code')?.shadowRoot?.querySelector('.cm-activeLineGutter')?.textContent === '20');
  await view.close();
});

test('a tree of thousands of entries is as quick, and finds by name', async () => {
  const groups = Array.from({ length: 3000 }, (_, i) => `<group name="Part ${i}"><models><model file="box_1.3d"/></models></group>`).join('\n');
  const view = await openDraft(`<world>\n<group name="All">\n${groups}\n</group>\n</world>`);
  await view.page.getByRole('tab', { name: 'Tree' }).click();
  await view.page.getByRole('tree').focus();
  await view.page.keyboard.press('Home');
  await view.page.keyboard.press('ArrowDown');
  await view.page.keyboard.press('ArrowRight');
  assert.ok((await view.page.getByRole('treeitem').count()) < 80);
  await view.page.keyboard.press('End');
  assert.equal(await selectedName(view), 'Part 2999');
  await view.page.getByRole('searchbox', { name: 'Find in the tree' }).fill('part 1234');
  await row(view, 'Part 1234').click();
  assert.equal(await selectedName(view), 'Part 1234');
  await view.close();
});

test('no serious finding of axe in the tree, selected, hidden and locked', async () => {
  for (const look of [{ colorScheme: 'light', viewport: { width: 1280, height: 800 } }, { colorScheme: 'dark', viewport: { width: 360, height: 740 } }]) {
    const view = await open('torch', { ...look, bypassCSP: true });
    await row(view, 'Torch').click();
    await view.page.getByRole('tree').focus();
    await view.page.keyboard.press('h');
    await view.page.keyboard.press('l');
    await settled(view);
    assert.deepEqual(await axeFindings(view.page), [], look.colorScheme);
    assert.ok((await view.page.evaluate(() => document.documentElement.scrollWidth)) <= look.viewport.width);
    await view.close();
  }
});
