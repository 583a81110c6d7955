// The HTML report of a class, as a teacher opens it: from a file, without a server.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { binary, launch } from './fixture.mjs';

let browser, scratch;
const scene = (angle) => `<world><window width="160" height="120"/>
<camera><position x="4" y="3" z="5"/><lookAt x="0" y="0" z="0"/><projection fov="50" near="1" far="50"/></camera>
<lights><light type="directional" dirx="1" diry="2" dirz="1"/></lights>
<group>
 <transform><translate x="1" y="0" z="0"/>
  <rotate angle="${angle}" x="0" y="0" z="1"/></transform>
 <models><model file="box_1_2.3d"/></models>
</group></world>`;
const missing = '<world><group><models>\n<model file="a.3d"/>\n<model file="a.3d"/>\n</models></group></world>';

before(async () => {
  scratch = mkdtempSync(join(tmpdir(), 'farol-report-'));
  const hand = (name, text) => {
    const folder = join(scratch, 'class', `${name}_assignsubmission_file_`);
    mkdirSync(folder, { recursive: true });
    if (text) writeFileSync(join(folder, 'scene.xml'), text);
  };
  writeFileSync(join(scratch, 'reference.xml'), scene(40));
  hand('Ana Reis_11', scene(40));
  hand('Bento Dias_12', scene(-40));
  hand('Carla <b>Sá_13', missing);
  hand('Duarte Lopes_14', '');
  const rubric = { title: 'Boxes', points: 20, criteria: [{ measure: 'difference', weight: 3 }, { measure: 'transforms', weight: 1 }] };
  writeFileSync(join(scratch, 'rubric.json'), JSON.stringify(rubric));
  const images = { criteria: ['flip', 'ssim', 'normals', 'depth'].map((measure) => ({ measure, weight: 1 })) };
  writeFileSync(join(scratch, 'images.json'), JSON.stringify(images));
  for (const [out, ...more] of [['default'], ['boxes', '--rubric', 'rubric.json'], ['images', '--rubric', 'images.json']]) {
    const { status, stderr } = spawnSync(binary, ['grade', '--reference', 'reference.xml', 'class', '-o', out, ...more], { cwd: scratch, encoding: 'utf8' });
    assert.equal(status, 0, stderr);
  }
  browser = await launch();
});
after(async () => {
  await browser?.close();
  rmSync(scratch, { recursive: true, force: true });
});

async function open(report, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  const page = await context.newPage(), faults = [];
  page.on('pageerror', (error) => faults.push(error.message));
  page.on('request', (request) => {
    if (!/^(file|data):/.test(request.url())) faults.push(`asked for ${request.url()}`);
  });
  await page.goto(pathToFileURL(join(scratch, report, 'report.html')).href);
  return {
    page, rows: page.locator('#list tbody tr'), detail: page.locator('#detail'),
    names: () => page.locator('#list tbody tr td:first-child').evaluateAll((cells) => cells.map((cell) => cell.firstChild.textContent)),
    async close() {
      await context.close();
      assert.deepEqual(faults, []);
    },
  };
}

test('the table is sorted and filtered, and says what could not be graded', async () => {
  const { page, names, rows, close } = await open('default');
  assert.deepEqual(await names(), ['Ana Reis', 'Bento Dias', 'Carla <b>Sá', 'Duarte Lopes']);
  assert.match(await page.locator('#summary').innerText(), /^4 submissions, \d passed, 1 could not be graded, median [\d.]+ of 100 points$/);
  await page.getByRole('button', { name: 'Points' }).click();
  assert.equal((await names())[0], 'Ana Reis');
  await page.getByRole('button', { name: 'Points' }).click();
  assert.equal((await names()).at(-1), 'Ana Reis');
  await page.getByRole('searchbox').fill('not graded');
  assert.deepEqual(await names(), ['Duarte Lopes']);
  await page.getByRole('searchbox').fill('bento sign');
  assert.equal(await rows.count(), 1);
  await close();
});

test('findings carry their lines, the slider shows either picture, the heat map is there', async () => {
  const { page, rows, detail, close } = await open('default');
  await rows.filter({ hasText: 'Bento' }).click();
  assert.match(await detail.locator('.findings').first().innerText(), /wrong sign[\s\S]*6 >\s*<rotate angle="-40"/);
  const loaded = await detail.locator('.side img').evaluateAll((images) => Promise.all(images.map((one) => one.decode().then(() => one.naturalWidth))));
  assert.equal(loaded.length, 3); // the reference, the submission, the difference
  assert.ok(loaded.every((width) => width > 0));
  const slider = detail.getByRole('slider'), line = detail.locator('.compare hr');
  await slider.fill('20');
  assert.equal(await line.evaluate((one) => one.style.left), '20%');
  const box = await detail.locator('.compare').boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.8, box.y + box.height / 2);
  await page.mouse.up();
  assert.equal(await slider.inputValue(), '80');
  // The view that differs most is shown first.
  const shares = await detail.locator('.tabs button').allInnerTexts(), share = (text) => Number(/([\d.]+) %$/.exec(text)?.[1] ?? 0);
  assert.equal(share(await detail.locator('.tabs button[aria-pressed=true]').innerText()), Math.max(...shares.map(share)));
  await page.keyboard.press('ArrowDown');
  assert.equal(await detail.locator('h2').innerText(), 'Carla <b>Sá');
  // Two places of one message are one entry, with both lines and the first one's text.
  const entries = (await detail.locator('.findings li').allInnerTexts()).filter((entry) => entry.startsWith('error:'));
  assert.equal(entries.length, 1);
  assert.match(entries[0], /lines 2, 3[\s\S]*2 >\s*<model file="a.3d"/);
  // Without a scene there are no points, but the reason.
  await page.keyboard.press('ArrowDown');
  assert.match(await detail.innerText(), /not graded[\s\S]*it holds no \.xml file/);
  assert.equal(await detail.locator('.points').count(), 0);
  await close();
});

test('measures that the rubric leaves out are not shown', async () => {
  const [all, some] = await Promise.all([open('images'), open('boxes')]);
  for (const one of [all, some]) await one.rows.filter({ hasText: 'Bento' }).click();
  assert.match(await all.detail.innerText(), /FLIP mean 0\.\d+/);
  assert.match(await all.detail.innerText(), /other normals/);
  assert.match(await some.detail.innerText(), /Differs: [\d.]+ %/);
  assert.doesNotMatch(await some.detail.innerText(), /FLIP|SSIM|elsewhere|normals|depth/i);
  const { submissions } = JSON.parse(readFileSync(join(scratch, 'boxes/report.json'), 'utf8'));
  const view = submissions.find((one) => one.name === 'Bento Dias').tasks[0].grade.views[0];
  assert.deepEqual(Object.keys(view), ['name', 'time', 'width', 'height', 'difference']);
  await Promise.all([all.close(), some.close()]);
});

test('a phone shows it without scrolling sideways', async () => {
  const { page, rows, close } = await open('default', { viewport: { width: 360, height: 740 }, colorScheme: 'dark' });
  await rows.filter({ hasText: 'Bento' }).click();
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 360);
  assert.equal(await page.evaluate(() => document.querySelector('#list').scrollWidth - document.querySelector('#list').clientWidth), 0);
  await close();
});
