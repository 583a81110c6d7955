// axe-core over every view, light and dark, wide and narrow; and that nothing is wider than a phone.
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
  grade: {
    hash: '#/grade', async ready(view) {
      const file = (name, text) => ({ name, mimeType: 'text/xml', buffer: Buffer.from(text) });
      const scene = (model) => `<world><group><models><model file="${model}"/></models></group></world>`;
      for (const [button, files] of [
        ['Reference: choose files', [file('reference.xml', scene('box_1_2.3d'))]],
        ['Submissions: choose files', [file('a.xml', scene('box_1_2.3d')), file('b.xml', scene('sphere_1_16_8.3d')), file('c.xml', '<world>')]],
      ]) {
        const [chooser] = await Promise.all([view.page.waitForEvent('filechooser'), view.page.getByRole('button', { name: button }).click()]);
        await chooser.setFiles(files);
      }
      await view.page.getByRole('button', { name: 'Grade', exact: true }).click();
      await view.page.getByText('3 graded.').waitFor({ timeout: 120000 });
      await view.page.locator('#list tbody tr', { hasText: 'b.xml' }).click();
    },
  },
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
