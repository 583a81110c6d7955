// A whole session by keys alone, and what the accessibility tree says at each step: the name, role and state of what
// has the focus, and what is read out when something changes. docs/how-to/student-use-the-web-page.md has the walk.
import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { canvasPixels, launch, openPage, settled, startServer } from './fixture.mjs';

let server, browser, scratch;
const scene = `<world>
  <title>Two boxes</title>
  <camera>
    <position x="0" y="2" z="10"/>
    <lookAt x="0" y="0" z="0"/>
  </camera>
  <group name="Left">
    <transform><translate x="-2"/></transform>
    <models><model file="box_1.3d"/></models>
  </group>
</world>
`;
before(async () => {
  scratch = mkdtempSync(join(tmpdir(), 'farol-web-'));
  mkdirSync(join(scratch, 'scenes'));
  writeFileSync(join(scratch, 'scenes/boxes.xml'), scene);
  [server, browser] = await Promise.all([startServer({ scenes: join(scratch, 'scenes') }), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
  rmSync(scratch, { recursive: true, force: true });
});

/** A page for keys alone: what the tree of accessibility says of it, and what is read out. */
async function atKeys(options = {}) {
  const view = await openPage(browser, `${server.url}/`, { viewport: { width: 1280, height: 800 }, acceptDownloads: true, ...options });
  await view.context.grantPermissions(['clipboard-read', 'clipboard-write']);
  const client = await view.context.newCDPSession(view.page);
  await client.send('Accessibility.enable');
  const { page } = view;
  // Texts of live regions as they change; a region that comes with its text is not read out, an alert is.
  await page.evaluate(() => {
    window.read_ = [];
    const isLive = (node) => (node.nodeType === 1 ? node : node.parentElement)?.closest('[role=status], [role=alert], [aria-live=polite]');
    new MutationObserver((records) => {
      for (const { target, addedNodes } of records) {
        const region = isLive(target), alerts = [...addedNodes].filter((one) => one.nodeType === 1).flatMap((one) => [one, ...one.querySelectorAll('[role=alert]')]).filter((one) => one.matches('[role=alert]'));
        for (const one of region ? [region] : alerts) window.read_.push(one.textContent.trim());
      }
    }).observe(document.body, { childList: true, subtree: true, characterData: true });
  });
  /** Of what has the focus; of a tree or list with an active entry, that entry. */
  const focused = async () => {
    for (let i = 0; ; ++i) {
      const at = await inTree();
      if ((at.role !== 'none' && at.role !== 'RootWebArea') || i > 100) return at;
      await page.waitForTimeout(20); // the tree follows the page
    }
  };
  const inTree = async () => {
    const { nodes } = await client.send('Accessibility.getFullAXTree');
    const has = (node, name) => node.properties?.find((one) => one.name === name)?.value;
    const inside = nodes.filter((node) => !node.ignored && has(node, 'focused')?.value === true).at(-1);
    const active = has(inside ?? {}, 'activedescendant')?.relatedNodes?.[0]?.backendDOMNodeId, node = nodes.find((one) => active && one.backendDOMNodeId === active) ?? inside;
    if (!node) return { role: 'none', name: '' };
    const states = Object.fromEntries((node.properties ?? []).map(({ name, value }) => [name, value.value]));
    return { role: node.role.value, name: node.name?.value ?? '', value: node.value?.value, ...states };
  };
  const press = (...keys) => keys.reduce((before, key) => before.then(() => page.keyboard.press(key)), Promise.resolve());
  /** By Tab, or Shift+Tab, to what has that role and name. */
  const tabTo = async (role, name, key = 'Tab') => {
    const met = [];
    for (let i = 0; i < 80; ++i) {
      const at = await focused();
      assert.notEqual(at.role, 'RootWebArea', `the focus is nowhere after ${met.join(', ')}`);
      if (at.role === role && (name instanceof RegExp ? name.test(at.name) : at.name === name)) return at;
      if (i > 0) assert.ok(at.name !== '', `a ${at.role} without a name after ${met.join(', ')}: ${await page.evaluate(() => document.activeElement?.outerHTML.slice(0, 200))}`);
      met.push(`${at.role} "${at.name}"`);
      await press(key);
    }
    return assert.fail(`no ${role} ${name} by ${key}: ${[...new Set(met)].join(', ')}`);
  };
  const isOn = async (role, name, states = {}) => {
    let at;
    for (const end = Date.now() + 60000; Date.now() < end;) {
      at = await focused();
      if (at.role === role && (name instanceof RegExp ? name.test(at.name) : at.name === name) && Object.entries(states).every(([key, value]) => String(at[key]) === String(value))) return at;
      await page.waitForTimeout(20);
    }
    return assert.fail(`${JSON.stringify(at)} is not ${role} ${name} ${JSON.stringify(states)}`);
  };
  /** Until all of that is read out, in any order, after what was heard last. */
  const hears = async (...words) => {
    const all = words.map(({ source, flags }) => [source, flags]);
    await page.waitForFunction((list) => list.every(([source, flags]) => window.read_.some((one) => new RegExp(source, flags).test(one))), all, { timeout: 20000 })
      .catch(async () => assert.fail(`${words} was not read out, but ${JSON.stringify(await page.evaluate(() => window.read_))}`));
    await page.evaluate(() => (window.read_ = []));
  };
  return { ...view, focused, press, tabTo, isOn, hears, close: view.close };
}

test('from the gallery to a link: open, orbit, edit, an error and its line, undo, save, compare, share', async () => {
  const keys = await atKeys(), { page, press, tabTo, isOn, hears } = keys;
  // 1. The gallery: the first stop leads past the head of the page.
  await page.getByRole('link', { name: /Two boxes/ }).waitFor();
  await press('Tab');
  await isOn('link', 'Skip to the content');
  await press('Enter');
  await isOn('searchbox', 'Search scenes');
  await page.keyboard.type('boxes');
  await hears(/^1 scene$/);
  const card = await tabTo('link', /^Two boxes/);
  assert.match(card.name, /1 model/);
  // 2. A scene: its name is read out, and the keys are the image's.
  await press('Enter');
  await hears(/^Two boxes · Farol$/);
  await isOn('application', /^Two boxes\. Drag or arrow keys orbit/);
  await settled(keys);
  // 3. Orbit: from where it is seen then.
  const first = await canvasPixels(page);
  await press('ArrowRight', 'ArrowRight', 'ArrowUp');
  await hears(/^Azimuth -?\d[\d.]*°, elevation \d[\d.]*°, distance \d/);
  await settled(keys);
  assert.notDeepEqual(await canvasPixels(page), first);
  await press('Control+z');
  await hears(/^Undone\.$/);
  await settled(keys);
  assert.deepEqual(await canvasPixels(page), first);
  // 4. The panel and its editor.
  await tabTo('button', 'Panel', 'Shift+Tab');
  await isOn('button', 'Panel', { pressed: 'false' });
  await press('Enter');
  await isOn('button', 'Panel', { pressed: 'true' });
  await tabTo('tab', 'View');
  await isOn('tab', 'View', { selected: true });
  await press('ArrowLeft'); // round to the last
  await isOn('tab', 'XML', { selected: true });
  await page.locator('.cm-content').waitFor();
  const editor = await tabTo('textbox', /^XML of the scene/);
  assert.equal(editor.multiline, true);
  assert.match(editor.name, /Escape, then Tab/);
  // 5. An error: what is wrong is read out, and is a button that leads to its line.
  await press('Control+Home', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'End');
  const line = () => page.evaluate(() => document.querySelector('.code').shadowRoot.querySelector('.cm-activeLineGutter').textContent);
  assert.equal(await line(), '9');
  for (let i = 0; i < '_1.3d"/></models>'.length; ++i) await press('ArrowLeft');
  await page.keyboard.type('es');
  await hears(/^Incomplete: placeholders stand for what has errors\. 1 error$/);
  await press('Escape', 'Tab'); // Tab alone indents
  await tabTo('button', /^1 error/, 'Shift+Tab');
  await isOn('button', /^1 error/, { expanded: false });
  await press('Enter');
  await isOn('button', /^1 error/, { expanded: true });
  const finding = await tabTo('button', /^Line 9, column \d+: .*boxes_1\.3d/);
  assert.match(finding.name, /boxes_1/);
  await press('Enter');
  await isOn('textbox', /^XML of the scene/);
  assert.equal(await line(), '9');
  // 6. Undo mends it; the good news is read out, too.
  await press('Control+z');
  await hears(/^Undone\.$/, /^No errors or warnings\.$/);
  await settled(keys);
  assert.deepEqual(await page.evaluate(() => document.querySelector('.drawer')), null);
  // 7. A change that stays, saved as a file.
  await press('Control+Home', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'End');
  assert.equal(await line(), '8');
  for (let i = 0; i < '"/></transform>'.length; ++i) await press('ArrowLeft');
  await press('Backspace');
  await page.keyboard.type('1');
  await press('Escape', 'Tab');
  await tabTo('button', 'Download the XML');
  const [saved] = await Promise.all([page.waitForEvent('download'), press('Enter')]);
  assert.equal(readFileSync(await saved.path(), 'utf8'), scene.replace('x="-2"', 'x="-1"'));
  await isOn('button', 'Download the XML');
  // 8. The comparison with what is stored.
  await settled(keys);
  await tabTo('link', 'Compare', 'Shift+Tab');
  await press('Enter');
  await hears(/^Compare · Farol$/);
  await page.waitForSelector('.compare-stage[aria-busy=false] canvas[data-rest=true]');
  await tabTo('application', /^Both images\./);
  await press('ArrowRight');
  await page.waitForSelector('.compare-stage[aria-busy=false] canvas[data-rest=true]');
  await tabTo('button', 'Compare what is on show');
  await press('Enter');
  await hears(/of the pixels are as good as equal/);
  await isOn('button', 'Compare what is on show');
  await page.locator('.causes a').waitFor();
  const cause = await tabTo('link', /group "Left": x of the translate is too (small|large)/);
  assert.match(cause.name, /line 8/);
  await press('Enter');
  await isOn('textbox', /^XML of the scene/);
  assert.equal(await line(), '8');
  await settled(keys);
  // 9. Sharing: a dialog that takes the focus, names what it is about, and gives it back.
  await press('Escape', 'Shift+Tab');
  await tabTo('button', 'Share', 'Shift+Tab');
  await press('Enter');
  await page.locator('dialog.share').waitFor();
  const dialog = await page.locator('dialog.share').ariaSnapshot();
  assert.match(dialog, /dialog "Share “Two boxes”"/);
  assert.match(dialog, /Your edits are in this browser only/);
  await tabTo('button', 'Copy: This view');
  await press('Enter');
  await hears(/^Link copied\.$/);
  assert.match(await page.evaluate(() => navigator.clipboard.readText()), /#\/scene\/boxes/);
  await tabTo('button', 'Close');
  await press('Enter');
  await page.locator('dialog.share').waitFor({ state: 'detached' });
  await isOn('button', 'Share');
  await keys.close();
});

test('the focus is never lost: closed dialogs, panels and notes give it back', async () => {
  const keys = await atKeys(), { page, press, tabTo, isOn, hears } = keys;
  await page.goto(`${server.url}/#/scene/boxes`);
  await settled(keys);
  await isOn('application', /^Two boxes/);
  // Help, by its key and closed by Escape and by its button.
  await press('?');
  await page.locator('dialog.help').waitFor();
  await press('Escape');
  await isOn('application', /^Two boxes/);
  await press('?');
  await page.locator('dialog.help').waitFor();
  await tabTo('button', 'Close');
  await press('Enter');
  await isOn('application', /^Two boxes/);
  // Asked for again before the browser reports that it is closed.
  await press('?');
  await page.locator('dialog.help').getByRole('button', { name: 'Close' }).evaluate(async (button) => {
    button.click();
    for (let i = 0; i < 20; ++i) await null; // the page draws itself meanwhile
    document.body.dispatchEvent(new KeyboardEvent('keydown', { key: '?', bubbles: true }));
    await new Promise((done) => setTimeout(done, 0));
  });
  await page.locator('dialog.help').waitFor();
  await press('Escape');
  await isOn('application', /^Two boxes/);
  // The tour: each step has the focus, and its end gives it to the image.
  await press('?');
  await page.locator('dialog.help').waitFor();
  await tabTo('button', 'Short tour');
  await press('Enter');
  await isOn('button', 'Next');
  assert.match(await page.locator('.tour').ariaSnapshot(), /dialog "The image"/);
  await press('Escape');
  await isOn('application', /^Two boxes/);
  // An undo that was the last: the button is disabled and keeps the focus.
  await press('ArrowRight');
  await settled(keys);
  await tabTo('button', 'Undo', 'Shift+Tab');
  await press('Enter');
  await hears(/^Undone\.$/);
  await isOn('button', 'Undo', { disabled: true });
  // The panel: closed, the focus is on what opens it.
  await tabTo('button', 'Panel');
  await press('Enter');
  await tabTo('button', 'Close the panel');
  await press('Enter');
  await isOn('button', 'Panel', { pressed: 'false' });
  // A part of the tree is hidden and shown again by the note's button, which goes away.
  await press('Enter');
  await tabTo('tab', 'View');
  await press('ArrowRight');
  await isOn('tab', 'Tree', { selected: true });
  await page.getByRole('tree').waitFor();
  await tabTo('tree', 'Tree of the scene');
  await press('Home', 'ArrowDown', 'ArrowDown');
  await isOn('treeitem', 'Left', { selected: true });
  await press('h');
  await isOn('treeitem', 'Left, hidden', { selected: true });
  await settled(keys);
  await tabTo('button', 'Show all', 'Shift+Tab');
  await press('Enter');
  await page.locator('.hidden-note').waitFor({ state: 'detached' });
  await isOn('application', /^Two boxes/);
  // Discarded edits: their button goes away with them.
  await page.getByRole('tab', { name: 'XML' }).focus();
  await press('Enter');
  await page.locator('.cm-content').waitFor();
  await tabTo('textbox', /^XML of the scene/);
  await press('Control+Home');
  await page.keyboard.type('<!-- mine -->');
  await press('Escape', 'Tab');
  await tabTo('button', 'Discard');
  await press('Enter');
  await isOn('button', 'Reference');
  // A class is graded: the button that began it gives way to the one that stops it, and that one to the next.
  await page.goto(`${server.url}/#/grade`);
  await page.getByRole('button', { name: /example class/ }).focus();
  await press('Enter');
  await page.getByRole('button', { name: 'Grade', exact: true }).waitFor();
  await tabTo('button', 'Grade');
  await press('Enter');
  await isOn('button', 'Cancel');
  await hears(/^Grading \d+ of \d+…$/);
  await press('Enter');
  await isOn('button', /^Go on: \d+ left$/);
  await keys.close();
});
