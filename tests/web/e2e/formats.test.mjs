// The formats of animations that the page offers are those that the service can write.
import assert from 'node:assert/strict';
import { cpSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { after, before, test } from 'node:test';
import { binary, launch, openPage, settled, startServer } from './fixture.mjs';

let server, browser, names;
before(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
  names = (await (await fetch(`${server.url}/version`)).json()).animations;
});
after(async () => {
  await browser?.close();
  await server?.stop();
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
