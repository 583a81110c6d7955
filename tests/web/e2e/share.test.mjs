// What leaves the page: links and images; and what they do not hold.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { axeFindings, canvasPixels, launch, openPage, settled, startServer } from './fixture.mjs';

let server, browser;
before(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

const open = async (options = {}) => {
  const view = await openPage(browser, `${server.url}/#/scene/torch`, { acceptDownloads: true, ...options });
  await settled(view);
  return view;
};
const openDialog = async (view) => {
  await view.page.getByRole('button', { name: 'Share', exact: true }).click();
  await view.page.locator('dialog.share').waitFor();
};
const line = (view, name) => view.page.locator('.share').getByRole('textbox', { name, exact: true }).inputValue();

test('the dialog says what a link does not hold; edits are stored first, and then are in it', async () => {
  const view = await open({ viewport: { width: 1200, height: 800 } });
  await openDialog(view);
  assert.equal(await view.page.locator('.share-warning').count(), 0);
  assert.equal(await view.page.locator('#share-title').innerText(), 'Share “Torch”');
  const [webp] = await Promise.all([view.page.waitForEvent('download'), view.page.getByRole('button', { name: 'WebP, small' }).click()]);
  assert.equal(readFileSync(await webp.path()).subarray(8, 12).toString(), 'WEBP');
  await view.page.keyboard.press('Escape');
  await view.page.locator('dialog.share').waitFor({ state: 'detached' });
  for (const key of ['l', 'x', 'a']) await view.page.locator('.stage').press(key);
  await settled(view);
  const shown = await canvasPixels(view.page);
  await openDialog(view);
  assert.match(await view.page.locator('.share').innerText(), /edits are in this browser only[\s\S]*Not in it: light mode, the open panel, your edits\./);
  await view.page.getByRole('button', { name: 'Store them and get a link' }).click();
  await view.page.waitForURL(/#\/scene\/(~|%7E)/);
  await settled(view);
  await openDialog(view);
  assert.equal(await view.page.locator('.share-warning').count(), 0);
  assert.match(await view.page.locator('.share').innerText(), /It was uploaded and is kept until/);
  const link = await line(view, 'This view');
  const guest = await openPage(browser, link, { viewport: { width: 1200, height: 800 } });
  await settled(guest);
  assert.deepEqual(await canvasPixels(guest.page), shown);
  assert.equal(await guest.page.locator('h1').innerText(), 'Torch'); // an id only in the address
  await guest.close();
  await view.close();
});

test('no serious finding of axe in the dialog', async () => {
  for (const look of [{ colorScheme: 'light' }, { colorScheme: 'dark', viewport: { width: 360, height: 740 } }]) {
    const view = await open({ ...look, bypassCSP: true });
    await openDialog(view);
    assert.deepEqual(await axeFindings(view.page), [], look.colorScheme);
    await view.close();
  }
});
