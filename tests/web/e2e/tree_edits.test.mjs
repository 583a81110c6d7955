// The tree's menu: shapes, lights, groups and textures are added, doubled and deleted in the manner of the document;
// the image shows each, and undo takes each back.
import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { canvasPixels, draftOf, launch, onePixel, openPage, settled, startServer, until } from './fixture.mjs';

let server, browser, scratch;
// Tabs, single quotes, ends of lines as Windows writes them.
const text = `<?xml version='1.0' encoding='utf-8'?>
<world>
	<camera>
		<position x='0' y='0' z='10'/>
		<lookAt x='0' y='0' z='0'/>
		<projection fov='60' near='1' far='100'/>
	</camera>
	<group name='Left'>
		<transform>
			<translate x='-3' y='0' z='0'/>
		</transform>
		<models>
			<model file='box_1.3d'>
				<color>
					<diffuse R='200' G='0' B='0'/>
				</color>
			</model>
		</models>
	</group>
	<group name='Right'>
		<transform>
			<translate x='3' y='0' z='0'/>
		</transform>
	</group>
</world>
`;
before(async () => {
  scratch = mkdtempSync(join(tmpdir(), 'farol-web-'));
  mkdirSync(join(scratch, 'scenes/tidy'), { recursive: true });
  writeFileSync(join(scratch, 'scenes/tidy/scene.xml'), text.replaceAll('\n', '\r\n'));
  [server, browser] = await Promise.all([startServer({ scenes: join(scratch, 'scenes') }), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
  rmSync(scratch, { recursive: true, force: true });
});

const open = async () => {
  const view = await openPage(browser, `${server.url}/#/scene/tidy`, { viewport: { width: 1000, height: 640 }, acceptDownloads: true });
  await settled(view);
  await view.page.getByRole('button', { name: 'Panel', exact: true }).click();
  await view.page.getByRole('tab', { name: 'Tree' }).click();
  await view.page.getByRole('tree').waitFor();
  await settled(view);
  return view;
};
const row = (view, name) => view.page.getByRole('treeitem', { name });
const add = async (view, what) => {
  const asked = view.full().length;
  await view.page.getByRole('combobox', { name: 'Add to the scene' }).selectOption(what);
  await drawn(view, asked);
};
/** Until a newer image than those asked for before rests. */
const drawn = async (view, asked) => {
  await until(() => view.full().length > asked, 'no image was asked for');
  await settled(view);
};
const act = async (view, does) => {
  const asked = view.full().length;
  await does();
  await drawn(view, asked);
};
const undo = (view) => act(view, () => view.page.getByRole('button', { name: 'Undo' }).click());
/** The document as the draft has it; as it is stored where there is none. */
const written = (view) => draftOf(view, 'tidy');
/** How much of the left and of the right half is of a kind: red, lit otherwise, or nothing. */
const halves = (view) => view.page.evaluate(() => {
  const canvas = document.querySelector('.stage canvas'), { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  const out = { left: { red: 0, green: 0, grey: 0 }, right: { red: 0, green: 0, grey: 0 } };
  for (let i = 0; i < data.length / 4; ++i) {
    const [r, g, b] = data.subarray(4 * i, 4 * i + 3), half = i % canvas.width < canvas.width / 2 ? out.left : out.right;
    if (r > 40 && r > 2 * g) half.red += 1;
    else if (g > 40 && g > 2 * r) half.green += 1;
    else if (r > 30 && Math.abs(r - g) < 8 && Math.abs(g - b) < 8) half.grey += 1;
  }
  return out;
});
/** The outline of what is selected: its bright pixels' middle, as a share of the stage's width. */
const outlineX = async (view) => {
  await view.page.waitForFunction(() => document.querySelector('.outline')?.dataset.of);
  return view.page.evaluate(() => {
    const canvas = document.querySelector('.outline'), { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let [sum, count] = [0, 0];
    for (let i = 0; i < data.length / 4; ++i) if (data[4 * i] === 255) [sum, count] = [sum + (i % canvas.width), count + 1];
    return sum / count / canvas.width;
  });
};

test('a shape goes into the selected group, is drawn there and is selected; undo takes it back', async () => {
  const view = await open(), before = await canvasPixels(view.page), empty = await halves(view);
  assert.ok(empty.left.red > 500 && empty.right.grey === 0, JSON.stringify(empty));
  await row(view, 'Right').click();
  await add(view, 'sphere');
  const added = text.replace("<translate x='3' y='0' z='0'/>\n\t\t</transform>\n", "<translate x='3' y='0' z='0'/>\n\t\t</transform>\n\t\t<models> <model file='sphere_1.3d'/> </models>\n");
  assert.equal(await written(view), added);
  const now = await halves(view);
  assert.ok(now.right.grey > 1000 && now.left.red === empty.left.red, JSON.stringify(now));
  assert.equal(await view.page.getByRole('treeitem', { selected: true }).getAttribute('aria-label'), 'sphere_1.3d');
  const stage = await view.page.locator('.stage').boundingBox(), middle = await outlineX(view);
  const expected = 0.5 + 3 / (2 * 10 * Math.tan(Math.PI / 6) * (stage.width / stage.height));
  assert.ok(Math.abs(middle - expected) < 0.02, `${middle} is not ${expected}`);
  await undo(view);
  assert.equal(await written(view), null);
  assert.deepEqual(await canvasPixels(view.page), before);
  // Without a selection it comes into a group of its own.
  await view.page.getByRole('tree').press('Escape');
  await add(view, 'cone');
  assert.equal(await written(view), text.replace('\t</group>\n</world>', "\t</group>\n\t<group> <models> <model file='cone_1_0.5.3d'/> </models> </group>\n</world>"));
  await undo(view);
  assert.deepEqual(await canvasPixels(view.page), before);
  await view.close();
});

test('a light is written before the groups and lights the image; a group takes what is added next', async () => {
  const view = await open(), before = await canvasPixels(view.page), dark = await halves(view);
  await add(view, 'light directional');
  const lit = text.replace("\t<group name='Left'>", "\t<lights> <light type='directional' dirX='2' dirY='4' dirZ='2'/> </lights>\n\t<group name='Left'>");
  assert.equal(await written(view), lit);
  assert.notDeepEqual(await canvasPixels(view.page), before);
  assert.ok((await halves(view)).left.red > 0.3 * dark.left.red);
  await undo(view);
  assert.equal(await written(view), null);
  assert.deepEqual(await canvasPixels(view.page), before);
  await row(view, 'Right').click();
  await add(view, 'group');
  const grouped = text.replace("<translate x='3' y='0' z='0'/>\n\t\t</transform>\n", "<translate x='3' y='0' z='0'/>\n\t\t</transform>\n\t\t<group name='New group'/>\n");
  assert.equal(await written(view), grouped);
  assert.deepEqual(await canvasPixels(view.page), before, 'an empty group is not seen');
  assert.equal(await view.page.getByRole('treeitem', { selected: true }).getAttribute('aria-label'), 'New group');
  await add(view, 'box');
  assert.equal(await written(view), grouped.replace("<group name='New group'/>", "<group name='New group'>\n\t\t\t<models> <model file='box_1.3d'/> </models>\n\t\t</group>"));
  assert.ok((await halves(view)).right.grey > 500);
  await undo(view);
  assert.equal(await written(view), grouped);
  await undo(view);
  assert.equal(await written(view), null);
  assert.deepEqual(await canvasPixels(view.page), before);
  await view.close();
});

test('a texture is added to the selected model with its file; undo takes back both', async () => {
  const view = await open(), before = await canvasPixels(view.page);
  await row(view, 'box_1.3d').click();
  const asked = view.full().length;
  const [chooser] = await Promise.all([view.page.waitForEvent('filechooser'), view.page.getByRole('combobox', { name: 'Add to the scene' }).selectOption('texture')]);
  await chooser.setFiles([{ name: "it's green.bmp", mimeType: 'image/bmp', buffer: onePixel(0, 255, 0) }]);
  await drawn(view, asked);
  assert.equal(await written(view), text.replace('\t\t\t\t</color>\n', "\t\t\t\t</color>\n\t\t\t\t<texture file='it&apos;s green.bmp'/>\n"));
  const { left } = await halves(view);
  assert.equal(left.red, 0, 'the red of the material, times a green texture');
  assert.equal(await view.page.locator('.drawer').count(), 0, 'no finding');
  await view.page.getByRole('tab', { name: /^Files/ }).click();
  await view.page.getByText("it's green.bmp", { exact: true }).waitFor();
  await undo(view);
  assert.equal(await view.page.getByText("it's green.bmp", { exact: true }).count(), 0);
  assert.deepEqual(await canvasPixels(view.page), before);
  assert.equal(await written(view), null);
  await view.close();
});

test('a group is doubled, moved aside and deleted; each is a step, and the saved file has the ends of lines it came with', async () => {
  const view = await open(), before = await canvasPixels(view.page), one = await halves(view);
  const group = text.slice(text.indexOf("<group name='Left'>"), text.indexOf('</group>') + '</group>'.length);
  await row(view, 'Left').click();
  await act(view, () => view.page.getByRole('tree').press('Control+d'));
  assert.equal(await written(view), text.replace(group, `${group}\n\t${group}`));
  assert.equal(await row(view, 'Left').count(), 2);
  assert.equal(await row(view, 'Left').nth(1).getAttribute('aria-selected'), 'true');
  const x = view.page.getByRole('spinbutton', { name: 'Position X' });
  await act(view, async () => {
    await x.fill('3');
    await x.press('Enter');
  });
  const moved = text.replace(group, `${group}\n\t${group.replace("'-3'", "'3'")}`);
  assert.equal(await written(view), moved);
  const two = await halves(view);
  assert.ok(two.left.red === one.left.red && Math.abs(two.right.red - one.left.red) < 0.03 * one.left.red, JSON.stringify(two));
  await row(view, 'Left').first().click();
  await act(view, () => view.page.getByRole('tree').press('Delete'));
  assert.equal(await written(view), text.replace("'-3'", "'3'"));
  const other = await halves(view);
  assert.deepEqual([other.left.red, other.right.red], [0, two.right.red]);
  await view.page.getByRole('tab', { name: 'XML' }).click();
  const [saved] = await Promise.all([view.page.waitForEvent('download'), view.page.getByRole('button', { name: 'Download the XML' }).click()]);
  assert.equal(readFileSync(await saved.path(), 'utf8'), text.replace("'-3'", "'3'").replaceAll('\n', '\r\n'));
  await view.page.getByRole('tab', { name: 'Tree' }).click(); // the stage has its size again
  await undo(view);
  assert.equal(await written(view), moved);
  assert.deepEqual(await halves(view), two);
  await undo(view);
  await undo(view);
  assert.equal(await written(view), null);
  assert.deepEqual(await canvasPixels(view.page), before);
  await view.close();
});
