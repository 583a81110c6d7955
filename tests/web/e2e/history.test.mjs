// One history: what is undone and done again, whatever it was, and after a reload.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { canvasPixels, draftOf, drop, keptAll, launch, onePixel, openPage, settled, startServer } from './fixture.mjs';

let server, browser;
before(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

const open = async (options = {}) => {
  const view = await openPage(browser, `${server.url}/#/scene/torch`, { viewport: { width: 1000, height: 640 }, ...options });
  await settled(view);
  return view;
};
const tab = async (view, name) => {
  if (!(await view.page.locator('.panel').isVisible())) await view.page.getByRole('button', { name: 'Panel', exact: true }).click();
  await view.page.getByRole('tab', { name }).click();
};
const key = async (view, keys) => {
  await view.page.keyboard.press(keys);
  await settled(view);
};
const draftText = (view) => draftOf(view, 'torch');

test('Ctrl+Z goes back over camera, inspector, editor and files, and Ctrl+Shift+Z forward, pixel by pixel', async () => {
  const view = await open();
  // The stage is as wide beside every panel but the editor.
  const pixels = async () => {
    await tab(view, 'Files');
    await settled(view);
    return canvasPixels(view.page);
  };
  const shown = [await pixels()];
  const step = async (act) => {
    await act();
    shown.push(await pixels());
  };
  await step(async () => {
    // One movement, one step: a busy machine may let time pass between keys from here.
    await view.page.locator('.stage').evaluate((stage) => {
      for (let i = 0; i < 3; ++i) stage.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft', code: 'ArrowLeft', bubbles: true, cancelable: true }));
    });
  });
  await step(async () => {
    await tab(view, 'Inspect');
    await view.page.locator('.parts button').filter({ hasText: 'Light' }).first().click();
    await view.page.getByRole('slider', { name: 'Diffuse red' }).fill('10');
  });
  await step(async () => {
    await tab(view, 'XML');
    await view.page.locator('.cm-content').click();
    await view.page.keyboard.press('Control+Home');
    await view.page.keyboard.press('End');
    await view.page.keyboard.insertText('<background color="#204060"/>');
  });
  await step(() => drop(view.page, [{ name: 'extra.bmp', bytes: onePixel(9, 9, 9) }]));
  const last = await draftText(view);
  assert.match(last, /#204060/);
  for (let i = shown.length - 2; i >= 0; --i) {
    if (i === 2) { // in the editor, too
      await tab(view, 'XML');
      await view.page.locator('.cm-content').click();
    }
    await view.page.keyboard.press('Control+z');
    assert.deepEqual(await pixels(), shown[i], `undone to ${i}`);
  }
  assert.ok(await view.page.getByRole('button', { name: 'Undo', exact: true }).isDisabled());
  assert.equal(await draftText(view), null);
  for (let i = 1; i < shown.length; ++i) {
    if (i % 2) await view.page.keyboard.press('Control+Shift+Z');
    else await view.page.getByRole('button', { name: 'Redo', exact: true }).click();
    assert.deepEqual(await pixels(), shown[i], `done again ${i}`);
  }
  assert.ok(await view.page.getByRole('button', { name: 'Redo', exact: true }).isDisabled());
  assert.equal(await draftText(view), last);
  // Another change ends the way forward; a discard is a step like others.
  await tab(view, 'XML');
  await key(view, 'Control+z');
  await view.page.getByRole('button', { name: 'Discard', exact: true }).click();
  await settled(view);
  assert.equal(await view.page.getByRole('button', { name: 'Redo', exact: true }).isDisabled(), true);
  await key(view, 'Control+z');
  assert.match(await draftText(view), /#204060/);
  await view.close();
});

test('the history is there after a reload', async () => {
  const view = await open();
  const first = await canvasPixels(view.page);
  await tab(view, 'XML');
  await view.page.locator('.cm-content').click();
  await settled(view);
  const wide = await canvasPixels(view.page);
  assert.notDeepEqual(wide, first); // of another size
  await view.page.keyboard.press('Control+Home');
  await view.page.keyboard.press('End');
  await view.page.keyboard.insertText('<background color="#204060"/>');
  await view.page.locator('.stage').focus();
  await key(view, 'ArrowLeft');
  const turned = await canvasPixels(view.page);
  await key(view, 'Control+z');
  const one = await canvasPixels(view.page);
  await keptAll(view);
  await view.page.reload();
  await settled(view);
  await view.page.locator('.cm-content').waitFor();
  await settled(view);
  assert.deepEqual(await canvasPixels(view.page), one);
  await view.page.locator('.stage').focus();
  await key(view, 'Control+Shift+Z');
  assert.deepEqual(await canvasPixels(view.page), turned);
  await key(view, 'Control+z');
  await key(view, 'Control+z');
  assert.deepEqual(await canvasPixels(view.page), wide);
  await view.close();
});

test('the editor is the same one, with its selection, when other panels were open', async () => {
  const view = await open();
  await tab(view, 'XML');
  await view.page.locator('.cm-content').click();
  await view.page.keyboard.press('Control+End');
  await view.page.keyboard.press('Shift+ArrowUp');
  const state = () => view.page.evaluate(() => {
    const root = document.querySelector('.code').shadowRoot;
    return [root.querySelector('.cm-editor').farolMark ?? null, root.querySelector('.cm-activeLineGutter')?.textContent ?? null, root.querySelector('.cm-scroller').scrollTop];
  });
  await view.page.evaluate(() => (document.querySelector('.code').shadowRoot.querySelector('.cm-editor').farolMark = 'same'));
  const before = await state();
  assert.equal(before[0], 'same');
  for (const name of ['Inspect', 'Files', 'View']) await tab(view, name);
  await view.page.getByRole('button', { name: 'Panel', exact: true }).click();
  await tab(view, 'XML');
  assert.deepEqual((await state()).slice(0, 2), before.slice(0, 2));
  await view.close();
});
