// The files of a scene: what it misses is dropped on it; they are replaced, renamed, removed and saved.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { axeFindings, canvasPixels, draftOf, drop, launch, middleOf, onePixel, openPage, settled, startServer, until } from './fixture.mjs';

let server, browser, scratch;
const green = [0, 255, 0], red = [255, 0, 0], blue = [0, 0, 255];
const scene = (texture) => `<world>
  <camera><position x="0" y="0" z="3"/><lookAt x="0" y="0" z="0"/><projection fov="45" near="0.1" far="50"/></camera>
  <lights><light type="directional" dirX="0" dirY="0" dirZ="1"/></lights>
  <group>
    <models>
      <model file="box_2_1.3d">
        <texture file="${texture}"/>
        <color><diffuse R="255" G="255" B="255"/></color>
      </model>
    </models>
  </group>
</world>
`;
before(async () => {
  scratch = mkdtempSync(join(tmpdir(), 'farol-web-'));
  const put = (path, content) => {
    mkdirSync(join(scratch, 'scenes', path, '..'), { recursive: true });
    writeFileSync(join(scratch, 'scenes', path), content);
  };
  put('crate/scene.xml', scene('textures/wood.bmp'));
  put('whole/scene.xml', scene('textures/leaf.bmp'));
  put('whole/textures/leaf.bmp', onePixel(...green));
  [server, browser] = await Promise.all([startServer({ scenes: join(scratch, 'scenes') }), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
  rmSync(scratch, { recursive: true, force: true });
});

const wide = { viewport: { width: 1000, height: 640 }, acceptDownloads: true };
const open = async (id, options = {}) => {
  const view = await openPage(browser, `${server.url}/#/scene/${id}`, { ...wide, ...options });
  await settled(view);
  return view;
};
const openFiles = async (view) => {
  await view.page.getByRole('button', { name: 'Panel', exact: true }).click();
  await view.page.getByRole('tab', { name: /^Files/ }).click();
  await view.page.locator('.file-row').first().waitFor();
  await settled(view);
};
const row = (view, name) => view.page.locator('.file-row', { has: view.page.getByText(name, { exact: true }) });
const inState = (view, state) => view.page.waitForSelector(`.stage-area.is-${state}`, { timeout: 60000 });
/** Until the middle of the picture is mostly of that colour. */
async function shows(view, colour, what) {
  const isIt = (at) => at.every((x, i) => (colour[i] > 0 ? x > 60 && x > 2 * Math.max(...at.filter((_, k) => colour[k] === 0)) : true));
  await until(async () => isIt(await middleOf(view)), async () => `${what}: ${await middleOf(view)} is not ${colour}`);
}
async function saved(view, act) {
  const [download] = await Promise.all([view.page.waitForEvent('download'), act()]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

test('a missing texture that is dropped on its finding is drawn, and is there after a reload', async () => {
  const view = await open('crate');
  await inState(view, 'incomplete');
  const finding = view.page.locator('.drawer .findings li.error').first();
  assert.match(await finding.innerText(), /textures\/wood\.bmp/);
  await drop(view.page, [{ name: 'photo.bmp', bytes: onePixel(...green) }], '.drawer .findings li.error');
  await inState(view, 'drawn');
  await shows(view, green, 'the dropped texture');
  assert.equal(await view.page.locator('.drawer').count(), 0);
  assert.equal(view.full().at(-1).base, 'crate');
  await view.page.reload();
  await settled(view);
  await shows(view, green, 'after the reload');
  await view.page.getByRole('button', { name: 'Discard the edits' }).first().click();
  await inState(view, 'incomplete');
  await view.page.reload();
  await settled(view);
  await inState(view, 'incomplete');
  await view.close();
});

test('dropped anywhere a file goes where it is missed; one of another kind is named in the XML', async () => {
  let view = await open('crate');
  await drop(view.page, [{ name: 'Wood.bmp', bytes: onePixel(...blue) }]);
  await inState(view, 'drawn');
  await shows(view, blue, 'dropped on the page');
  assert.match(view.page.url(), /scene\/crate/);
  await view.close();
  view = await open('crate');
  const png = await view.page.evaluate(async () => {
    const canvas = new OffscreenCanvas(2, 2), context = canvas.getContext('2d');
    context.fillStyle = '#f00';
    context.fillRect(0, 0, 2, 2);
    return [...new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer())];
  });
  await drop(view.page, [{ name: 'brick.png', bytes: Buffer.from(png) }], '.drawer .findings li.error');
  await inState(view, 'drawn');
  await shows(view, red, 'a PNG for a BMP');
  assert.match(await draftOf(view, 'crate'), /<texture file="textures\/brick\.png"\/>/);
  await view.close();
});

test('the files tab lists what there is and what is missing, and replaces, renames and removes', async () => {
  const view = await open('whole');
  await openFiles(view);
  assert.deepEqual(await view.page.locator('.file-row .file-name').allInnerTexts(), ['scene.xml', 'textures/leaf.bmp', 'box_2_1.3d']);
  await drop(view.page, [{ name: 'other.bmp', bytes: onePixel(...red) }], '.file-row:has-text("leaf.bmp")');
  await shows(view, red, 'replaced');
  assert.match(await row(view, 'textures/leaf.bmp').innerText(), /replaced here/);
  await view.page.getByRole('button', { name: 'Rename textures/leaf.bmp' }).click();
  await view.page.getByRole('textbox', { name: 'New name of textures/leaf.bmp' }).fill('skins/brick.bmp');
  await view.page.keyboard.press('Enter');
  await row(view, 'skins/brick.bmp').waitFor();
  assert.match(await draftOf(view, 'whole'), /<texture file="skins\/brick\.bmp"\/>/);
  await settled(view);
  await shows(view, red, 'renamed');
  await inState(view, 'drawn');
  await view.page.getByRole('button', { name: 'Remove skins/brick.bmp' }).click();
  await inState(view, 'incomplete');
  assert.match(await row(view, 'skins/brick.bmp').innerText(), /named in line \d+; drop it here/);
  assert.equal(await view.page.locator('.tabs .count').innerText(), '1');
  const [chooser] = await Promise.all([view.page.waitForEvent('filechooser'), view.page.getByRole('button', { name: 'Add the file skins/brick.bmp' }).click()]);
  await chooser.setFiles({ name: 'x.bmp', mimeType: 'image/bmp', buffer: onePixel(...blue) });
  await shows(view, blue, 'chosen');
  await inState(view, 'drawn');
  await view.close();
});

test('the scene is saved as XML and zip; the zip holds what is on show, and draws it again', async () => {
  const view = await open('whole');
  await openFiles(view);
  const xml = await saved(view, () => view.page.getByRole('button', { name: 'Download the scene’s XML' }).click());
  assert.equal(xml.bytes.toString(), scene('textures/leaf.bmp'));
  const leaf = await saved(view, () => view.page.getByRole('button', { name: 'Download textures/leaf.bmp' }).click());
  assert.ok(leaf.bytes.equals(onePixel(...green)));
  await drop(view.page, [{ name: 'note.bmp', bytes: onePixel(...red) }], '.sections');
  await row(view, 'note.bmp').waitFor();
  const zip = await saved(view, () => view.page.getByRole('button', { name: 'All as zip' }).click());
  writeFileSync(join(scratch, 'all.zip'), zip.bytes);
  const listed = spawnSync('python3', ['-c', 'import sys, zipfile\nz = zipfile.ZipFile(sys.argv[1])\nassert z.testzip() is None\nprint(*sorted(z.namelist()), sep="\\n")', join(scratch, 'all.zip')], { encoding: 'utf8' });
  assert.equal(listed.stdout, 'note.bmp\nscene.xml\ntextures/leaf.bmp\n', listed.stderr);
  await settled(view);
  const shown = await canvasPixels(view.page);
  await drop(view.page, [{ name: 'all.zip', bytes: zip.bytes }]);
  await view.page.waitForURL(/#\/scene\/(~|%7E)/);
  await settled(view);
  await view.page.getByRole('tab', { name: /^Files/ }).waitFor();
  assert.deepEqual(await canvasPixels(view.page), shown);
  await view.close();
});

test('a generated mesh is saved as OBJ, PLY and STL', async () => {
  const view = await open('whole');
  await openFiles(view);
  const mesh = (form) => saved(view, () => view.page.getByRole('button', { name: `Download box_2_1.3d as ${form}` }).click());
  const obj = await mesh('OBJ'), ply = await mesh('PLY'), stl = await mesh('STL');
  assert.equal(obj.name, 'box_2_1.obj');
  assert.match(obj.bytes.toString(), /^v /m);
  assert.equal(ply.bytes.subarray(0, 3).toString(), 'ply');
  const triangles = stl.bytes.readUInt32LE(80);
  assert.equal(triangles, 12);
  assert.equal(stl.bytes.length, 84 + 50 * triangles);
  // A closed box: its signed volume is that of the shape, and every normal is of length 1.
  let volume = 0;
  for (let i = 0; i < triangles; ++i) {
    const at = (k) => [0, 1, 2].map((axis) => stl.bytes.readFloatLE(84 + 50 * i + 12 * k + 4 * axis));
    const [normal, a, b, c] = [0, 1, 2, 3].map(at);
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
    assert.ok(Math.abs(Math.hypot(...normal) - 1) < 1e-5);
  }
  assert.ok(Math.abs(volume - 8) < 1e-4, `volume ${volume}`);
  await view.close();
});

test('stored, the scene has the files that were added', async () => {
  const view = await open('crate');
  await drop(view.page, [{ name: 'wood.bmp', bytes: onePixel(...green) }]);
  await shows(view, green, 'added');
  await settled(view);
  const shown = await canvasPixels(view.page);
  await view.page.getByRole('button', { name: 'Panel', exact: true }).click();
  await view.page.getByRole('tab', { name: 'XML' }).click();
  await view.page.getByRole('button', { name: 'Store and share' }).click();
  await view.page.waitForURL(/#\/scene\/(~|%7E)/);
  const other = await openPage(browser, view.page.url(), wide);
  await settled(other);
  assert.deepEqual(await canvasPixels(other.page), shown);
  await other.close();
  await view.close();
});

test('no serious finding of axe in the files tab', async () => {
  for (const look of [{ colorScheme: 'light' }, { colorScheme: 'dark', viewport: { width: 360, height: 740 } }])
    for (const id of ['crate', 'whole']) {
      const view = await open(id, { ...look, bypassCSP: true });
      await openFiles(view);
      assert.deepEqual(await axeFindings(view.page), [], `${id}, ${look.colorScheme}`);
      assert.ok((await view.page.evaluate(() => document.documentElement.scrollWidth)) <= view.page.viewportSize().width);
      await view.close();
    }
});
