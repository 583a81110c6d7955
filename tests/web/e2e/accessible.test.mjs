// axe-core over the views of the gallery and of a scene, light and dark, wide and narrow; and that nothing is wider than a
// phone. The grade page's states, the comparison and others have it in their own files.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { axeFindings, launch, openPage, settled, startServer } from './fixture.mjs';

let server, browser;
before(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

const views = {
  gallery: { hash: '#/', ready: (view) => view.page.waitForSelector('.card:not(.ghost)') },
  viewer: { hash: '#/scene/torch', ready: settled },
  inspector: {
    hash: '#/scene/torch', async ready(view) {
      await settled(view);
      await view.page.getByRole('button', { name: 'Panel' }).click();
      await view.page.getByRole('tab', { name: 'Inspect' }).click();
      await view.page.locator('.parts button').first().click();
    },
  },
  editor: { hash: '#/new', ready: (view) => view.page.locator('.cm-content').waitFor() },
};
const looks = [{ colorScheme: 'light', viewport: { width: 1280, height: 800 } }, { colorScheme: 'dark', viewport: { width: 360, height: 740 } }];

for (const [name, { hash, ready }] of Object.entries(views))
  test(`no serious finding of axe: ${name}`, async () => {
    for (const look of looks) {
      const view = await openPage(browser, `${server.url}/${hash}`, { ...look, bypassCSP: true });
      await ready(view);
      assert.deepEqual(await axeFindings(view.page), [], `${name}, ${look.colorScheme}`);
      const width = await view.page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(width <= look.viewport.width, `${name} is ${width} px wide at ${look.viewport.width}`);
      await view.close();
    }
  });

test('everything is reached by the keyboard', async () => {
  const view = await openPage(browser, `${server.url}/#/scene/torch`);
  await settled(view);
  const reached = [];
  for (let i = 0; i < 40; ++i) {
    await view.page.keyboard.press('Tab');
    reached.push(await view.page.evaluate(() => document.activeElement?.getAttribute('aria-label') ?? document.activeElement?.textContent ?? ''));
  }
  for (const wanted of ['Reset', 'Walk', 'fast', 'PNG', 'Panel']) assert.ok(reached.includes(wanted), `${wanted} is not among ${reached}`);
  assert.ok(reached.some((label) => label.startsWith('Torch. Drag or arrow keys')), reached.join());
  await view.close();
});
