// What may be dropped: a mesh of every kind, several files, archives.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { binary, canvasPixels, drop, dropFolder, launch, middleOf, onePixel, openPage, root, settled, startServer } from './fixture.mjs';

let server, browser, scratch;
before(async () => {
  scratch = mkdtempSync(join(tmpdir(), 'farol-web-'));
  mkdirSync(join(scratch, 'gallery'));
  writeFileSync(join(scratch, 'gallery/box.xml'), '<world><group><models><model file="box_1.3d"/></models></group></world>');
  [server, browser] = await Promise.all([startServer({ scenes: join(scratch, 'gallery') }), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
  rmSync(scratch, { recursive: true, force: true });
});

const run = (command, ...args) => {
  const { status, stderr, error } = spawnSync(command, args, { encoding: 'utf8', cwd: scratch });
  assert.equal(status, 0, `${command} ${args.join(' ')}: ${error ?? stderr}`);
};
/** Drops files on the gallery; what opened is on show. */
async function opened(files, page) {
  const view = page ?? await openPage(browser, `${server.url}/`);
  if (page) await view.page.evaluate(() => (location.hash = '#/'));
  await view.page.waitForSelector('.card:not(.ghost)');
  await drop(view.page, files);
  await view.page.waitForURL(/#\/scene\/(~|%7E)/);
  await settled(view);
  return view;
}
const file = (name) => ({ name: name.replace(/^.*\//, ''), bytes: readFileSync(join(scratch, name)) });
/** How many of the picture's pixels are not of its corner's colour. */
const covered = (view) => view.page.evaluate(() => {
  const canvas = document.querySelector('.stage canvas'), { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let i = 4; i < data.length; i += 4) count += data[i] !== data[0] || data[i + 1] !== data[1] || data[i + 2] !== data[2] ? 1 : 0;
  return count / (canvas.width * canvas.height);
});

test('a mesh of every kind that is read opens alone, lit and framed', async () => {
  for (const name of ['box.3d', 'box.3db', 'box.obj', 'box.ply']) run(binary, 'generate', 'box', '2', '1', name);
  writeFileSync(join(scratch, 'roof.stl'), ['solid roof', ...[[[2, 0, 0], [0, 0, 0], [1, 1, 1]], [[2, 0, 2], [2, 0, 0], [1, 1, 1]], [[0, 0, 2], [2, 0, 2], [1, 1, 1]], [[0, 0, 0], [0, 0, 2], [1, 1, 1]]]
    .map((corners) => `facet normal 0 0 0\nouter loop\n${corners.map((one) => `vertex ${one.join(' ')}`).join('\n')}\nendloop\nendfacet`), 'endsolid roof', ''].join('\n'));
  writeFileSync(join(scratch, 'roof.off'), 'OFF\n5 4 0\n0 0 0\n2 0 0\n2 0 2\n0 0 2\n1 1 1\n3 1 0 4\n3 2 1 4\n3 3 2 4\n3 0 3 4\n');
  cpSync(join(root, 'generator/data/teapot.patch'), join(scratch, 'teapot.patch'));
  let view;
  for (const name of ['box.3d', 'box.3db', 'box.obj', 'box.ply', 'roof.stl', 'roof.off', 'teapot.patch']) {
    view = await opened([file(name)], view);
    assert.equal(await view.page.locator('h1').innerText(), name);
    const share = await covered(view);
    assert.ok(share > 0.05 && share < 0.95, `${name} covers ${share} of the picture`);
  }
  await view.close();
});

test('several meshes are shown together', async () => {
  run(binary, 'generate', 'box', '2', '1', 'one.obj');
  run(binary, 'generate', 'sphere', '1', '16', '8', 'two.ply');
  const view = await opened([file('one.obj'), file('two.ply')]);
  assert.equal(await view.page.locator('h1').innerText(), 'one.obj and 1 more');
  const { counts } = await (await fetch(`${server.url}/v1/scenes/${decodeURIComponent(/scene\/([^?]+)/.exec(view.page.url())[1])}`)).json();
  assert.equal(counts.models, 2);
  await view.close();
});

test('a scene dropped with its texture, zipped and as a tar gives the same picture', async () => {
  mkdirSync(join(scratch, 'ball'), { recursive: true });
  cpSync(join(root, 'scenes/solar-system/earth.jpg'), join(scratch, 'ball/earth.jpg'));
  writeFileSync(join(scratch, 'ball/scene.xml'), '<world><group><models><model file="sphere_1_32_16.3d"><texture file="earth.jpg"/></model></models></group></world>');
  run('python3', '-m', 'zipfile', '-c', 'ball.zip', 'ball/');
  run('tar', '-czf', 'ball.tar.gz', 'ball');
  run('tar', '-cf', 'ball.tar', 'ball');
  const digests = [];
  let view;
  for (const files of [['ball/scene.xml', 'ball/earth.jpg'], ['ball.zip'], ['ball.tar.gz'], ['ball.tar']]) {
    view = await opened(files.map(file), view);
    digests.push((await canvasPixels(view.page)).digest);
  }
  await view.close();
  assert.deepEqual(digests, digests.map(() => digests[0]));
});

const isGreen = ([red, green, blue]) => green > 60 && green > 2 * red && green > 2 * blue;

test('of a dropped folder with build folders only what the scene needs is sent', async () => {
  const files = [
    { path: 'work/scenes/scene.xml', bytes: Buffer.from('<world><group><models><model file="box_2_1.3d"><texture file="../tex/leaf.bmp"/></model></models></group></world>') },
    { path: 'work/tex/leaf.bmp', bytes: onePixel(0, 255, 0) },
    { path: 'work/.git/config', bytes: Buffer.from('x') },
  ];
  for (let i = 0; i < 400; ++i) files.push({ path: `work/build/o${i}.o`, bytes: Buffer.from(`object ${i}`) });
  const view = await openPage(browser, `${server.url}/`);
  await view.page.waitForSelector('.card:not(.ghost)');
  let sent = '';
  view.page.on('request', (request) => {
    if (request.method() === 'POST' && /\/v1\/scenes/.test(request.url())) sent = request.postData() ?? '';
  });
  await dropFolder(view.page, files);
  await view.page.waitForURL(/#\/scene\/(~|%7E)/);
  await settled(view);
  assert.ok(isGreen(await middleOf(view)), `${await middleOf(view)} is not the texture's green`);
  assert.ok(!sent.includes('object 7') && !sent.includes('.git'), 'build folders were sent');
  await view.close();
});

test('a zip in a zip opens', async () => {
  mkdirSync(join(scratch, 'inner'), { recursive: true });
  writeFileSync(join(scratch, 'inner/scene.xml'), '<world><group><models><model file="box_2_1.3d"><color><diffuse R="0" G="200" B="0"/></color></model></models></group></world>');
  run('python3', '-m', 'zipfile', '-c', 'inner.zip', 'inner/');
  run('python3', '-m', 'zipfile', '-c', 'outer.zip', 'inner.zip');
  const view = await opened([file('outer.zip')]);
  assert.ok(isGreen(await middleOf(view)), `${await middleOf(view)} is not the box's green`);
  await view.close();
});

test('an OBJ file has the colours of the material library beside it', async () => {
  writeFileSync(join(scratch, 'tile.obj'), 'mtllib tile.mtl\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nusemtl leaf\n'
    + 'f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n');
  writeFileSync(join(scratch, 'tile.mtl'), 'newmtl leaf\nKd 0.05 0.9 0.05\n');
  const view = await opened([file('tile.obj'), file('tile.mtl')]);
  assert.ok(isGreen(await middleOf(view)), `${await middleOf(view)} is not the library's green`);
  await view.close();
});

test('what is no scene is told in a sentence, and the page stays', async () => {
  const view = await openPage(browser, `${server.url}/`);
  await view.page.waitForSelector('.card:not(.ghost)');
  await drop(view.page, [{ name: 'notes.pdf', bytes: Buffer.from('%PDF-1.4') }]);
  await view.page.getByText('There is no scene (.xml), mesh (').waitFor();
  await drop(view.page, [{ name: 'broken.zip', bytes: Buffer.from('PK\x03\x04 and nothing more') }]);
  await view.page.getByRole('heading', { name: '“broken.zip” has problems' }).waitFor();
  assert.match(view.page.url(), /\/(#\/)?$/);
  await view.close();
});

test('a scene that cannot be read is a card that says why, here and on the plain page', async () => {
  const folder = join(scratch, 'served');
  mkdirSync(folder);
  writeFileSync(join(folder, 'good.xml'), '<world title="Good"><group><models><model file="box_1_2.3d"/></models></group></world>');
  writeFileSync(join(folder, 'bad.xml'), '<world>\n<group><models>\n<model file="nothing.3d"/></models></group></world>');
  const own = await startServer({ scenes: folder });
  const { scenes } = await (await fetch(`${own.url}/v1/scenes`)).json(), { problem } = scenes.find((one) => !one.valid);
  const view = await openPage(browser, `${own.url}/`);
  const text = await view.page.locator('.card.broken .description').innerText();
  assert.ok(text.startsWith('Line 3') && text.includes(problem.message.slice(1, 20)), text);
  assert.equal(await view.page.locator('.card').count(), 2);
  await view.page.goto(`${own.url}/plain`);
  assert.ok((await view.page.locator('li.bad').innerText()).includes(problem.message));
  await view.close();
  await own.stop();
});
