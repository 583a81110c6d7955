// Help, labels, and the page under a finger.
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

const phone = { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true, deviceScaleFactor: 1 };
const open = async (options) => {
  const view = await openPage(browser, `${server.url}/#/scene/torch`, options);
  await settled(view);
  return view;
};

test('? opens the keys at their top, and the tour goes through the page by keyboard', async () => {
  for (const look of [{ viewport: { width: 1280, height: 800 } }, { viewport: { width: 360, height: 500 } }]) {
    const view = await open({ ...look, bypassCSP: true });
    await view.page.keyboard.press('?');
    const dialog = view.page.locator('dialog.help');
    await dialog.waitFor();
    assert.equal(await dialog.evaluate((one) => one.scrollTop), 0);
    assert.ok(await view.page.getByRole('heading', { name: 'Keys' }).isVisible());
    assert.deepEqual(await axeFindings(view.page), []);
    await view.page.getByRole('button', { name: 'Short tour' }).click();
    const seen = [];
    for (let i = 0; i < 4; ++i) {
      const tour = view.page.locator('.tour');
      await tour.waitFor();
      seen.push(await tour.locator('h2').innerText());
      assert.equal(await view.page.locator('[data-tour]').count(), 1);
      const box = await tour.boundingBox();
      assert.ok(box.x >= 0 && box.y >= 0 && box.x + box.width <= look.viewport.width && box.y + box.height <= look.viewport.height, JSON.stringify(box));
      await view.page.keyboard.press('Enter'); // the next step has the focus
    }
    assert.deepEqual(seen, ['The image', 'The tools', 'The panel', 'Share']);
    await view.page.locator('.tour').waitFor({ state: 'detached' });
    assert.equal(await view.page.locator('[data-tour]').count(), 0);
    await view.close();
  }
});

test('on a wide screen every tool has a visible label, and a tooltip with its key', async () => {
  const view = await open({ viewport: { width: 1440, height: 900 } });
  const tools = await view.page.locator('.toolbar .tool').evaluateAll((all) => all.map((one) => [one.innerText.trim(), one.title]));
  assert.ok(tools.length >= 10);
  for (const [label, title] of tools) assert.ok(label.length > 1 && title.length > 1, `${label} / ${title}`);
  for (const key of ['(Ctrl+Z)', '(R)', '(M)', '(L)', '(T)', '(?)']) assert.ok(tools.some(([, title]) => title.endsWith(key)), key);
  assert.equal(await view.page.locator('.hud').count(), 0, 'the statistics are off');
  await view.page.getByRole('button', { name: 'Statistics' }).click();
  assert.equal(await view.page.locator('.hud').count(), 1);
  await view.close();
});

test('on a phone every target has 44 pixels, and panels are sheets over the image', async () => {
  const view = await open({ ...phone, bypassCSP: true });
  const stage = await view.page.locator('.stage').boundingBox();
  for (const tab of [null, 'View', 'Tree', 'Inspect', 'Files', 'XML']) {
    if (tab) {
      if (!(await view.page.locator('.panel').isVisible())) await view.page.getByRole('button', { name: 'Panel', exact: true }).tap();
      await view.page.getByRole('tab', { name: tab }).tap();
      await settled(view);
      const sheet = await view.page.locator('.panel').boundingBox();
      assert.ok(Math.abs(sheet.y + sheet.height - 740) < 2 && sheet.width === 360, JSON.stringify(sheet));
    }
    if (tab === 'XML') { // its last line of tools is in the sheet, too
      await view.page.locator('.cm-content').waitFor();
      const foot = await view.page.locator('.editor-foot').boundingBox();
      assert.ok(foot.y + foot.height <= 741, JSON.stringify(foot));
    }
    const small = await view.page.locator('button:visible, a:visible, select:visible').evaluateAll((all) => all.filter((one) => {
      const box = one.getBoundingClientRect();
      return box.width > 0 && !one.classList.contains('skip') && (box.height < 43.5 || box.width < 43.5);
    }).map((one) => `${one.getAttribute('aria-label') ?? one.textContent}: ${one.getBoundingClientRect().width} x ${one.getBoundingClientRect().height}`));
    assert.deepEqual(small, [], `${tab}`);
    assert.ok((await view.page.evaluate(() => document.documentElement.scrollWidth)) <= 360);
  }
  assert.deepEqual(await view.page.locator('.stage').boundingBox(), stage, 'the sheet does not resize the image');
  assert.deepEqual(await axeFindings(view.page), []);
  await view.close();
});

test('light mode under a finger turns the light, not the camera', async () => {
  const view = await open(phone);
  await view.page.getByRole('button', { name: 'Light', exact: true }).tap();
  const area = await view.page.locator('.stage').boundingBox(), client = await view.context.newCDPSession(view.page);
  const [x, y] = [area.x + area.width / 2, area.y + area.height / 2];
  const touch = (type, points) => client.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([px, py], id) => ({ x: px, y: py, id })) });
  await touch('touchStart', [[x, y]]);
  for (let i = 1; i <= 6; ++i) await touch('touchMove', [[x + 10 * i, y]]);
  await touch('touchEnd', []);
  await view.page.getByText(/Camera light: alpha/).waitFor();
  await settled(view);
  assert.equal(view.full().at(-1).azimuth, undefined);
  assert.equal(view.full().at(-1).method, 'POST');
  await view.close();
});

/** The translations that a reload asks for. */
async function translationsOf(view) {
  const out = [], note = (request) => out.push(.../\/assets\/(pt|es|cs)-\w+\.js$/.exec(request.url())?.slice(1) ?? []);
  view.page.on('request', note);
  await view.page.reload();
  await settled(view);
  view.page.off('request', note);
  return out;
}

test('the page is in the browser’s language; the choice is kept, and findings and dates follow it', async () => {
  const text = '<world><group><models><model file="sphere_1_8_4.3d" colr="red"/></models></group></world>';
  const stored = await fetch(`${server.url}/v1/scenes?public=0`, { method: 'POST', headers: { 'Content-Type': 'application/xml' }, body: text });
  assert.ok(stored.ok, await stored.clone().text());
  const view = await openPage(browser, `${server.url}/#/scene/${(await stored.json()).id}`, { locale: 'pt-BR', viewport: { width: 1280, height: 800 } });
  await settled(view);
  const { page } = view, language = () => page.locator('html').getAttribute('lang'), findings = async () => {
    const tab = page.locator('.drawer-tab');
    await tab.waitFor();
    if ((await tab.getAttribute('aria-expanded')) === 'false') await tab.click();
    return page.locator('.drawer .findings > li').first().innerText();
  };
  assert.equal(await language(), 'pt');
  await page.getByRole('button', { name: 'Anular' }).waitFor();
  assert.match(await findings(), /^Linha 1, coluna \d+: /);
  assert.equal(await page.locator('.drawer .findings small').count(), 0, 'the catalogue is in English');
  assert.deepEqual(await translationsOf(view), ['pt'], 'one translation is loaded');
  await page.getByRole('combobox', { name: 'Língua' }).selectOption('cs');
  await page.getByRole('button', { name: 'Sdílet' }).waitFor();
  await page.waitForFunction(() => /^Řádek 1, sloupec/.test(document.querySelector('.drawer .findings > li')?.innerText ?? ''));
  assert.equal(await language(), 'cs');
  await page.reload();
  await settled(view);
  assert.equal(await language(), 'cs');
  await page.getByRole('combobox', { name: 'Jazyk' }).selectOption('en');
  await page.getByRole('button', { name: 'Share' }).waitFor();
  assert.match(await findings(), /^Line 1, column/);
  await page.locator('.drawer .findings small').first().waitFor();
  await view.close();
});

test('in every language all links, tabs and tools of time are in sight, on a wide screen and a phone', async () => {
  for (const locale of ['en', 'pt', 'es', 'cs']) {
    const view = await openPage(browser, `${server.url}/#/scene/solar-system`, { locale, viewport: { width: 1280, height: 800 }, hasTouch: true, remembered: { 'farol.panel': 'view' } });
    await settled(view);
    for (const [width, height] of [[1280, 800], [360, 740]]) {
      await view.page.setViewportSize({ width, height });
      await settled(view);
      const cut = await view.page.locator('.head nav, .tabs').evaluateAll((all) => all.filter((one) => one.scrollWidth > one.clientWidth).map((one) => `${one.className || one.tagName}: ${one.scrollWidth} in ${one.clientWidth}`));
      assert.deepEqual(cut, [], `${locale}, ${width}`);
      const rows = await view.page.locator('.time-bar .tool').evaluateAll((all) => [...new Set(all.map((one) => one.getBoundingClientRect().bottom))]);
      assert.equal(rows.length, 1, `${locale}, ${width}: the tools of time end at ${rows}`);
    }
    await view.page.evaluate(() => (location.hash = '#/grade'));
    await view.page.locator('.drops').waitFor();
    const [wanted, given] = await view.page.locator('.head nav').evaluate((one) => [one.scrollWidth, one.clientWidth]);
    assert.ok(wanted <= given, `${locale}: where one is marked, the links take ${wanted} of ${given}`);
    await view.close();
  }
});

test('in English no translation is loaded', async () => {
  const view = await open({});
  assert.deepEqual(await translationsOf(view), []);
  await view.close();
});
