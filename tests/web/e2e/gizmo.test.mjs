// Handles over the image: a drag, keys and typed numbers change the XML's own numbers, and the image with them.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { axeFindings, canvasPixels, close, draftOf as draftById, launch, openPage, settled, startServer } from './fixture.mjs';

let server, browser;
before(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

const wide = { viewport: { width: 1000, height: 640 } };
const camera = '<camera><position x="0" y="0" z="10"/><lookAt x="0" y="0" z="0"/><up x="0" y="1" z="0"/><projection fov="60" near="1" far="100"/></camera>';
/** A stored scene with that text, and the tree beside it. */
const openDraft = async (text, options = {}) => {
  const stored = await fetch(`${server.url}/v1/scenes?public=0`, { method: 'POST', headers: { 'Content-Type': 'application/xml' }, body: text });
  assert.ok(stored.ok, await stored.clone().text());
  const { id } = await stored.json(), view = await openPage(browser, `${server.url}/#/scene/${id}`, { ...wide, ...options, remembered: { 'farol.panel': 'tree' } });
  await view.page.locator('.toolbar').waitFor();
  if (!(await view.page.locator('.panel').isVisible())) { // a phone begins without a panel
    await view.page.getByRole('button', { name: 'Panel', exact: true }).click();
    await view.page.getByRole('tab', { name: 'Tree' }).click();
  }
  await view.page.getByRole('tree').waitFor();
  await settled(view);
  return Object.assign(view, { id, text });
};
const select = async (view, name) => {
  await view.page.getByRole('treeitem', { name }).first().click();
  await view.page.waitForFunction(() => document.querySelector('.outline')?.dataset.of);
};
/** The edited text; without edits, as it was stored. */
const draftOf = async (view) => (await draftById(view, view.id)) ?? view.text;
const tool = (view, name) => view.page.getByRole('toolbar', { name: 'Handles of what is selected' }).getByRole('button', { name, exact: true }).click();
/** The middle of a part of a handle, in pixels of the window. */
const middleOfHandle = async (view, id, part = '.fill') => {
  const box = await view.page.locator(`[data-handle="${id}"] ${part}`).boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
};
const dragBy = async (view, [x, y], dx, dy, key) => {
  await view.page.mouse.move(x, y);
  await view.page.mouse.down();
  if (key) await view.page.keyboard.down(key);
  for (let i = 1; i <= 8; ++i) await view.page.mouse.move(x + (dx * i) / 8, y + (dy * i) / 8);
  await view.page.mouse.up();
  if (key) await view.page.keyboard.up(key);
  await settled(view);
};
/** The middle of the pixels that are red, as shares of the canvas. */
const redAt = (view) => view.page.evaluate(() => {
  const canvas = document.querySelector('.stage canvas'), { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let [x, y, count] = [0, 0, 0];
  for (let i = 0; i < data.length / 4; ++i)
    if (data[4 * i] > 100 && data[4 * i + 1] < 60) [x, y, count] = [x + (i % canvas.width), y + Math.floor(i / canvas.width), count + 1];
  return { x: x / count / canvas.width, y: y / count / canvas.height, count };
});
const redBall = (transform) => `<world>\n  ${camera}\n  <group name="Ball">${transform}\n    <models>\n      <model file="sphere_0.5_32_16.3d"><color><diffuse R="255" G="0" B="0"/><ambient R="255" G="0" B="0"/></color></model>\n    </models>\n  </group>\n</world>\n`;
/** World units of the image's height at the distance of 10. */
const high = 2 * 10 * Math.tan(Math.PI / 6);

test('a drag of an arrow changes one number, the image moves as far, and one undo takes it back', async () => {
  const text = redBall('\n    <transform>\n      <translate x="-1.50" y="0.25" z="0" />\n    </transform>');
  const view = await openDraft(text);
  await select(view, 'Ball');
  const before = await redAt(view), pixels = await canvasPixels(view.page), stage = await view.page.locator('.stage').boundingBox();
  const perPixel = high / stage.height;
  close((before.x - 0.5) * stage.width * perPixel, -1.5, 0.03, 'where the ball is');
  await dragBy(view, await middleOfHandle(view, 'move-X'), 120, 30);
  const after = await draftOf(view), x = /<translate x="(-?\d+\.\d\d)" y="0.25" z="0" \/>/.exec(after)?.[1];
  assert.ok(x, after);
  assert.equal(after.replace(`x="${x}"`, 'x="-1.50"'), text);
  close(x, -1.5 + 120 * perPixel, 0.06, 'x');
  const moved = await redAt(view);
  close((moved.x - 0.5) * stage.width * perPixel, Number(x), 0.03, 'where the ball is now');
  close(moved.y, before.y, 0.003, 'its height');
  await view.page.getByRole('button', { name: 'Undo' }).click();
  await settled(view);
  assert.equal(await draftOf(view), text);
  assert.deepEqual(await canvasPixels(view.page), pixels);
  await view.page.getByRole('button', { name: 'Redo' }).click();
  await settled(view);
  assert.equal(await draftOf(view), after);
  await view.close();
});

test('the plane and the middle move two numbers and all; snapping and Shift keep to steps', async () => {
  const view = await openDraft(redBall('\n    <transform><translate x="0" y="0" z="0"/></transform>'));
  await select(view, 'Ball');
  await dragBy(view, await middleOfHandle(view, 'move-XY'), 60, -40);
  const [, x, y, z] = /<translate x="(.*?)" y="(.*?)" z="(.*?)"/.exec(await draftOf(view));
  assert.ok(Number(x) > 0.5 && Number(y) > 0.3 && z === '0', `${x} ${y} ${z}`);
  await dragBy(view, await middleOfHandle(view, 'move-XYZ'), -60, 40);
  const [, u, v] = /<translate x="(.*?)" y="(.*?)" z="(.*?)"/.exec(await draftOf(view));
  close(u, 0, 0.06, 'back to x');
  close(v, 0, 0.06, 'back to y');
  await view.page.getByRole('button', { name: /^Snap to steps of 0.5/ }).click();
  const perPixel = high / (await view.page.locator('.stage').boundingBox()).height;
  await dragBy(view, await middleOfHandle(view, 'move-X'), Math.round(1.1 / perPixel), 0);
  assert.match(await draftOf(view), /<translate x="1(\.0+)?" /);
  await dragBy(view, await middleOfHandle(view, 'move-X'), 7, 0, 'Shift'); // Shift: without steps
  assert.match(await draftOf(view), /<translate x="1\.\d+" /);
  await view.close();
});

test('a group without transforms gets a translate in the spelling of its dialect', async () => {
  const view = await openDraft(redBall(''));
  await select(view, 'Ball');
  await dragBy(view, await middleOfHandle(view, 'move-Y'), 0, -60);
  assert.match(await draftOf(view), /<group name="Ball">\n {4}<transform> <translate x="0" y="[\d.]+" z="0"\/> <\/transform>\n {4}<models>/);
  assert.ok((await redAt(view)).y < 0.47);
  await view.close();
  const old = `<scene>\n  <group>\n    <translate Z="-20"/>\n    <model file="box_1.3d" diffR="1" diffG="0" diffB="0"/>\n  </group>\n  <group name="Ball">\n    <model file="sphere_1_16_8.3d" diffR="1" diffG="0" diffB="0"/>\n  </group>\n</scene>`;
  const other = await openDraft(old);
  await select(other, 'Ball');
  await dragBy(other, await middleOfHandle(other, 'move-Y'), 0, -60);
  assert.match(await draftOf(other), /<group name="Ball">\n {4}<translate X="0" Y="[\d.]+" Z="0"\/>\n {4}<model/);
  assert.equal(await other.page.locator('.findings .error').count(), 0);
  await other.close();
});

test('turning changes the angle alone where the axis is the ring’s; scaling multiplies', async () => {
  const text = redBall('\n    <transform><rotate angle="10" x="0" y="0" z="1" /></transform>');
  const view = await openDraft(text);
  await select(view, 'Ball');
  await tool(view, 'Turn');
  const stage = await view.page.locator('.stage').boundingBox(), middle = [stage.x + stage.width / 2, stage.y + stage.height / 2];
  const radius = await view.page.locator('[data-handle="turn-z-2"] .hit').evaluate((path) => path.getBBox().width / 2);
  const [x, y] = [middle[0] + radius * Math.cos(0.6), middle[1] + radius * Math.sin(0.6)]; // beside the other rings
  await dragBy(view, [x, y], middle[0] + radius * Math.cos(-0.6) - x, middle[1] + radius * Math.sin(-0.6) - y);
  const angle = /<rotate angle="([\d.]+)" x="0" y="0" z="1" \/>/.exec(await draftOf(view))?.[1];
  close(angle, 10 + (1.2 * 180) / Math.PI, 1.5, 'angle');
  await tool(view, 'Scale');
  const before = await redAt(view);
  await dragBy(view, await middleOfHandle(view, 'scale-XYZ'), 60, -60);
  const factors = /<rotate [^>]*\/> <scale x="([\d.]+)" y="\1" z="\1" ?\/>/.exec(await draftOf(view));
  assert.ok(factors, await draftOf(view));
  close(factors[1], Math.exp(120 / 150), 0.01, 'factor');
  close((await redAt(view)).count / before.count, Number(factors[1]) ** 2, 0.35, 'area');
  await view.close();
});

test('by keys alone: select in the tree, move by arrows, type numbers, undo', async () => {
  const text = redBall('\n    <transform><translate x="0" y="0" z="0"/></transform>');
  const view = await openDraft(text);
  await view.page.getByRole('tree').focus();
  await view.page.keyboard.press('Home');
  await view.page.keyboard.press('ArrowDown');
  await view.page.keyboard.press('ArrowDown');
  const x = view.page.getByRole('slider', { name: 'Move along X' });
  await x.waitFor();
  const reached = async (locator, keys) => {
    for (let i = 0; i < 60; ++i) {
      if (await locator.evaluate((one) => one === document.activeElement)) return;
      await view.page.keyboard.press(keys);
    }
    assert.fail('not reached');
  };
  await reached(x, 'Shift+Tab');
  assert.equal(await x.getAttribute('aria-valuetext'), 'x 0');
  await view.page.keyboard.press('ArrowRight');
  await view.page.keyboard.press('ArrowRight');
  assert.ok(await x.evaluate((one) => one === document.activeElement));
  assert.equal(await x.getAttribute('aria-valuenow'), '1');
  await settled(view);
  assert.match(await draftOf(view), /<translate x="1(\.0)?" y="0" z="0"\/>/);
  // The tools are one stop of Tab; arrows, Home and End go from one to the next.
  const tools = view.page.getByRole('toolbar', { name: 'Handles of what is selected' }).getByRole('button');
  const focused = () => tools.evaluateAll((all) => all.findIndex((one) => one === document.activeElement));
  assert.deepEqual(await tools.evaluateAll((all) => all.map((one) => one.tabIndex)), [-1, 0, -1, -1, -1, -1]);
  await reached(tools.nth(1), 'Tab');
  for (const [key, at] of [['ArrowDown', 2], ['ArrowRight', 3], ['ArrowUp', 2], ['End', 5], ['ArrowDown', 0], ['ArrowLeft', 5], ['Home', 0], ['ArrowDown', 1], ['ArrowDown', 2]]) {
    await view.page.keyboard.press(key);
    assert.equal(await focused(), at, key);
  }
  await view.page.keyboard.press('Enter');
  assert.equal(await tools.nth(2).getAttribute('aria-pressed'), 'true');
  await view.page.keyboard.press('Tab');
  assert.equal(await focused(), -1, 'Tab leaves the tools');
  await view.page.keyboard.press('Shift+Tab');
  assert.equal(await focused(), 2, 'and comes back to where it was');
  await view.page.keyboard.press('ArrowUp');
  await view.page.keyboard.press('Enter');
  const height = view.page.getByRole('spinbutton', { name: 'Position Y' });
  await reached(height, 'Tab');
  await view.page.keyboard.press('Control+A');
  await view.page.keyboard.type('1.25');
  await view.page.keyboard.press('Enter');
  await settled(view);
  assert.match(await draftOf(view), /<translate x="1(\.0)?" y="1.25" z="0"\/>/);
  const ball = await redAt(view), stage = await view.page.locator('.stage').boundingBox();
  close((0.5 - ball.y) * high, 1.25, 0.03, 'height of the ball');
  close((ball.x - 0.5) * stage.width * (high / stage.height), 1, 0.03, 'place of the ball');
  await view.page.getByRole('tree').focus();
  await view.page.keyboard.press('Control+z');
  await settled(view);
  assert.match(await draftOf(view), /<translate x="1(\.0)?" y="0" z="0"\/>/);
  await view.page.keyboard.press('Control+z');
  await settled(view);
  assert.equal(await draftOf(view), text);
  await view.close();
});

test('lights are moved and turned; what has no handles says why', async () => {
  const light = '<lights><light type="point" posx="0.0" posy="2.0" posz="1.0"/></lights>';
  const view = await openDraft(redBall('').replace('  <group', `  ${light}\n  <models><model file="box_0.2.3d"/></models>\n  <group name="Spun"><transform><rotate time="5" y="1"/></transform></group>\n  <group`));
  await view.page.getByRole('treeitem', { name: 'Light point' }).click();
  await view.page.locator('[data-handle="move-X"]').waitFor();
  await dragBy(view, await middleOfHandle(view, 'move-X'), 80, 0);
  assert.match(await draftOf(view), /posx="\d\.\d+" posy="2.0" posz="1.0"/);
  const note = view.page.locator('.gizmo-note');
  await tool(view, 'Scale');
  assert.equal(await note.innerText(), 'A light has no size.');
  await tool(view, 'Turn');
  await view.page.getByRole('treeitem', { name: 'Spun' }).click();
  assert.match(await note.innerText(), /turns with time/);
  await view.page.getByRole('treeitem', { name: 'box_0.2.3d' }).click();
  assert.match(await note.innerText(), /put it in a group/);
  await view.page.getByRole('treeitem', { name: 'Ball' }).click();
  await view.page.getByRole('tree').focus();
  await view.page.keyboard.press('l');
  assert.equal(await note.innerText(), 'This part is locked.');
  assert.equal(await view.page.locator('.handle').count(), 0);
  await view.close();
});

test('a handle that goes away during its drag lets go: the next drag is another step', async () => {
  const text = redBall('\n    <transform><translate x="0" y="0" z="0"/></transform>'), view = await openDraft(text);
  await select(view, 'Ball');
  const [x, y] = await middleOfHandle(view, 'move-X');
  await view.page.mouse.move(x, y);
  await view.page.mouse.down();
  await view.page.mouse.move(x + 40, y, { steps: 4 });
  // As by a second finger.
  await view.page.evaluate(() => [...document.querySelectorAll('.gizmo-bar button')].find((one) => one.ariaLabel === 'Select without handles').click());
  await view.page.waitForFunction(() => !document.querySelector('.handle'));
  await view.page.mouse.up();
  const first = await draftOf(view);
  assert.notEqual(first, text);
  await tool(view, 'Move');
  await dragBy(view, await middleOfHandle(view, 'move-Y'), 0, -50);
  assert.notEqual(await draftOf(view), first);
  await view.page.getByRole('button', { name: 'Undo' }).click();
  await settled(view);
  assert.equal(await draftOf(view), first);
  await view.close();
});

test('the middle of the handles is where an animated group is at that time', async () => {
  const points = [[2, 0, 0], [0, 2, 0], [-2, 0, 0], [0, -2, 0]].map(([x, y, z]) => `<point x="${x}" y="${y}" z="${z}"/>`).join('');
  const view = await openDraft(redBall(`\n    <transform><translate time="8" align="true">${points}</translate><rotate time="3" z="1"/></transform>`));
  await select(view, 'Ball');
  for (const time of ['1', '5.5']) {
    await view.page.locator('.time-bar input[type=range]').first().fill(time);
    await settled(view);
    const ball = await redAt(view), stage = await view.page.locator('.stage').boundingBox(), [x, y] = await middleOfHandle(view, 'move-XYZ');
    close((x - stage.x) / stage.width, ball.x, 0.004, `x at ${time} s`);
    close((y - stage.y) / stage.height, ball.y, 0.004, `y at ${time} s`);
  }
  await view.close();
});

test('beside a turn with time a still one is added and turned; words and a line lead to what handles leave as it is', async () => {
  const text = redBall('\n    <transform>\n      <translate x="-1" y="0" z="0"/>\n      <rotate time="8" x="0" y="1" z="0"/>\n      <translate x="2" y="0" z="0"/>\n      <rotate time="-5" x="0" y="1" z="0"/>\n    </transform>');
  const view = await openDraft(text);
  await select(view, 'Ball');
  const notes = view.page.locator('.gizmo-note');
  assert.deepEqual((await notes.allInnerTexts()).map((one) => /once in (\d+) s.*line (\d+)$/s.exec(one)?.slice(1)), [['8', '6'], ['5', '8']]);
  await tool(view, 'Turn');
  // The plane of the ring about X is seen from its edge: the keys turn it.
  const before = await canvasPixels(view.page), ring = view.page.getByRole('slider', { name: 'Turn about Z' });
  await ring.focus();
  for (let i = 0; i < 3; ++i) await ring.press('PageUp');
  await settled(view);
  const turned = text.replace('<translate x="2" y="0" z="0"/>\n', '<translate x="2" y="0" z="0"/>\n      <rotate angle="450" x="0" y="0" z="1"/>\n');
  assert.equal((await draftOf(view)).replace(/angle="[\d.]+"/, 'angle="450"'), turned);
  assert.notDeepEqual(await canvasPixels(view.page), before, 'turned in the image, too');
  const seconds = view.page.getByRole('spinbutton', { name: 'Seconds a turn' }).first();
  await seconds.fill('0');
  await seconds.press('Enter');
  assert.equal((await draftOf(view)).includes('time="0"'), false, 'a turn in no time is none');
  await seconds.fill('12');
  await seconds.press('Enter');
  await settled(view);
  assert.match(await draftOf(view), /<rotate time="12" x="0" y="1" z="0"\/>/);
  assert.match((await notes.allInnerTexts())[0], /once in 12 s/);
  await view.page.setViewportSize({ width: 360, height: 740 });
  for (const note of await notes.all()) {
    const { x, width } = await note.boundingBox();
    assert.ok(x >= 0 && x + width <= 360, `from ${x}, ${width} wide`);
  }
  await view.page.setViewportSize(wide.viewport);
  await notes.first().getByRole('button', { name: 'line 6' }).click();
  await view.page.waitForFunction(() => document.querySelector('.code')?.shadowRoot?.querySelector('.cm-activeLineGutter')?.textContent === '6');
  await view.close();
});

test('a finger drags a handle on a phone, and the scene does not orbit', async () => {
  const view = await openDraft(redBall('\n    <transform><translate x="0" y="0" z="0"/></transform>'), { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
  await select(view, 'Ball');
  await view.page.getByRole('button', { name: 'Panel', exact: true }).click(); // it covers the lower half of the stage
  await settled(view);
  const [x, y] = await middleOfHandle(view, 'move-X'), client = await view.context.newCDPSession(view.page);
  const touch = (type, points) => client.send('Input.dispatchTouchEvent', { type, touchPoints: points });
  await touch('touchStart', [{ x, y }]);
  for (let i = 1; i <= 6; ++i) await touch('touchMove', [{ x: x + 8 * i, y: y + 5 }]);
  await touch('touchEnd', []);
  await settled(view);
  assert.match(await draftOf(view), /<translate x="\d\.\d+" y="0" z="0"\/>/);
  assert.equal(view.full().at(-1).azimuth, undefined);
  await view.close();
});

test('no serious finding of axe with handles of each kind, light and dark, wide and phone', async () => {
  for (const look of [{ colorScheme: 'light', viewport: { width: 1280, height: 800 } }, { colorScheme: 'dark', viewport: { width: 360, height: 740 } }]) {
    const view = await openDraft(redBall('\n    <transform><translate x="0" y="0" z="0"/></transform>'), { ...look, bypassCSP: true });
    await select(view, 'Ball');
    for (const name of ['Move', 'Turn', 'Scale']) {
      await tool(view, name);
      assert.deepEqual(await axeFindings(view.page), [], `${name}, ${look.colorScheme}`);
    }
    assert.ok((await view.page.evaluate(() => document.documentElement.scrollWidth)) <= look.viewport.width);
    await view.close();
  }
});

test('two clicks measure a distance in world units, by the key alone without a selection', async () => {
  const two = redBall('<transform><translate x="-2" y="0" z="0"/></transform>').replace('</world>',
    redBall('<transform><translate x="2" y="0" z="-1"/></transform>').match(/<group[\s\S]*<\/group>/)[0] + '</world>');
  const view = await openDraft(two, { bypassCSP: true });
  await view.page.locator('.stage').focus();
  await view.page.keyboard.press('5');
  const note = view.page.locator('.gizmo-note');
  await note.getByText('Click the first place to measure from.').waitFor();
  const stage = await view.page.locator('.stage').boundingBox(), focal = stage.height / 2 / Math.tan(Math.PI / 6);
  // The fronts of the balls: rays from the eye at (0, 0, 10) through their middles meet them half a unit before.
  const front = (x, z) => {
    const length = Math.hypot(x, z - 10), share = (length - 0.5) / length;
    return [x * share, 10 + (z - 10) * share];
  };
  const [a, b] = [front(-2, 0), front(2, -1)];
  const click = ([x, z]) => view.page.mouse.click(stage.x + stage.width / 2 + (focal * x) / (10 - z), stage.y + stage.height / 2);
  await click(a);
  await note.getByText('Click the second place.').waitFor({ timeout: 20000 });
  await click(b);
  await note.getByText('Distance').waitFor({ timeout: 20000 });
  const text = await note.innerText(), [, distance, error] = text.match(/Distance ([\d.]+), off by at most ([\d.]*\d)/).map(Number);
  // A click is within a pixel, which is 0.013 units there.
  assert.ok(Math.abs(distance - Math.hypot(a[0] - b[0], a[1] - b[1])) < 0.05, text);
  assert.ok(error > 0 && error < 0.01, text);
  assert.equal(await view.page.locator('.measure circle').count(), 2);
  assert.deepEqual(await axeFindings(view.page), []);
  await view.page.mouse.click(stage.x + 30, stage.y + stage.height - 30);
  await view.page.getByText('There is nothing to measure to at this place.').waitFor({ timeout: 20000 });
  // A change of the scene ends the measurement.
  await view.page.getByRole('treeitem', { name: 'Ball' }).first().click();
  await view.page.getByRole('spinbutton', { name: 'Position Y' }).fill('1');
  await view.page.keyboard.press('Enter');
  await note.getByText('Click the first place to measure from.').waitFor();
  assert.equal(await view.page.locator('.measure circle').count(), 0);
  await view.close();
});
