// The grade page's rubric, its effect on marks, and the files that the page writes: held to the service and to `farol grade`.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { axeFindings, binary, launch, openPage, root, startServer } from './fixture.mjs';
import { cellsOf, choose, classZip, file, folderOf, gradeClass, moodle, notAScene, references, rowOf, saved, scene, unzipped } from './grade_class.mjs';

let server, browser, score;
before(async () => {
  [server, browser, score] = await Promise.all([startServer(), launch(), scoreModule()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

async function openGrade(options = {}) {
  const view = await openPage(browser, `${server.url}/#/grade`, { viewport: { width: 1280, height: 900 }, acceptDownloads: true, ...options });
  view.page.setDefaultTimeout(20000);
  return view;
}

/** The page's arithmetic of marks, as a module of Node.js. */
async function scoreModule() {
  const packages = join(root, 'build/web'), { build } = createRequire(join(packages, 'package.json'))('esbuild');
  const { outputFiles } = await build({
    stdin: { contents: "export { rescored } from './score.ts'; export { resolved } from './rubric.ts';", resolveDir: join(root, 'web/src/grade'), loader: 'ts' },
    bundle: true, format: 'esm', write: false, nodePaths: [join(packages, 'node_modules')],
  });
  globalThis.document ??= { documentElement: { lang: '' } };
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString('base64')}`);
}

async function gradeOf(submission, reference, rubric) {
  const form = new FormData();
  form.append('submission', new Blob([submission]), 'submission.xml');
  if (reference) form.append('reference', new Blob([reference]), 'reference.xml');
  form.append('rubric', new Blob([JSON.stringify(rubric)]), 'rubric.json');
  const response = await fetch(`${server.url}/v1/grade?pictures=0`, { method: 'POST', body: form });
  assert.equal(response.status, 200);
  return response.json();
}

const lights = '<light type="point" posx="3" posy="4" posz="3"/><light type="directional" dirx="1" diry="2" dirz="1"/>';
const twoThings = (angle, more, light = lights) => scene(angle, 'box_1_2.3d', light).replace('</group></world>', `</group>${more}</world>`);
const ball = (x) => `<group name="ball"><transform><translate x="${x}" y="0.5" z="1"/></transform><models><model file="sphere_0.6_12_8.3d"/></models></group>`;

test("a changed rubric's marks are those of a new run, or are asked for", async () => {
  const tables = JSON.parse(readFileSync(join(root, 'api/schema.json'), 'utf8')), reference = twoThings(40, ball(-1));
  const submissions = {
    same: reference, sign: twoThings(-40, ball(-1)), 'light missing': twoThings(40, ball(-1), lights.replace(/<light.*?\/>/, '')),
    'no lights, other place': twoThings(40, ball(-2), ''), 'object missing': twoThings(40, ''), 'too much': twoThings(-10, ball(-1) + ball(1)),
    camera: reference.replace('x="4" y="3"', 'x="5" y="3"'), 'unclosed group': reference.replace('</models>\n</group>', '</models>'),
    color: reference.replace('G="90"', 'G="200"'), 'scene error': reference.replace('<rotate angle="40"', '<rotate angle="forty"'), refused: notAScene,
  };
  const weights = (...all) => ({ criteria: ['models', 'transforms', 'materials', 'lights', 'camera'].map((measure, i) => ({ measure, weight: all[i] })).filter(({ weight }) => weight > 0) });
  const measured = { criteria: [{ measure: 'difference', weight: 30 }, { measure: 'transforms', weight: 30 }, { measure: 'coverage', weight: 10 }] };
  const rubrics = [
    [{}, { points: 20 }], [{}, { strictness: 2.5, passMark: 90 }], [{}, weights(5, 40, 10, 30, 15)], [{}, weights(0, 1, 0, 1, 0)], [{}, weights(1, 1, 1, 1, 0)],
    [weights(5, 40, 10, 30, 15), {}], [{}, { criteria: [{ measure: 'transforms', weight: 9, perFinding: 1 }, { measure: 'lights', weight: 3, perFinding: 0.1 }] }],
    [{}, { penalties: { warning: 3, most: 7 } }], [{}, { penalties: { codes: { 'transform.angle-sign': 4.5 } }, points: 50 }], [{ points: 20, strictness: 3 }, { points: 200 }],
    [measured, { criteria: [{ measure: 'difference', weight: 10, tolerance: 0.1, limit: 0.9 }, { measure: 'transforms', weight: 3 }, { measure: 'coverage', weight: 20, limit: 0.2 }] }],
    [measured, { ...measured, strictness: 0.3, points: 10 }],
    [{ requirements: [{ id: 'boxes', text: 'a box', points: 30, select: { shape: ['box'] }, count: 2 }], points: 100 },
      { requirements: [{ id: 'boxes', text: 'a box', points: 11, select: { shape: ['box'] }, count: 2 }], manual: [{ id: 'taste', text: 'looks good', points: 9 }], points: 100 }],
  ];
  let computed = 0, asked = 0;
  for (const [before, now] of rubrics)
    for (const [name, submission] of Object.entries(submissions)) {
      const old = await gradeOf(submission, reference, before), expected = await gradeOf(submission, reference, now), where = `${name}: ${JSON.stringify(before)} to ${JSON.stringify(now)}`;
      const made = score.rescored(old, score.resolved(before, tables), score.resolved(now, tables), tables);
      if (made === null) {
        asked += 1;
        continue;
      }
      computed += 1;
      assert.ok(Math.abs(made.points - expected.points) < 0.0101, `${where}: ${made.points}, and the service says ${expected.points}`);
      assert.deepEqual([made.most, made.passed, made.refused], [expected.most, expected.passed, expected.refused], where);
      assert.deepEqual(made.criteria.map(({ measure }) => measure), expected.criteria.map(({ measure }) => measure), where);
      made.criteria.forEach((one, i) => assert.ok(Math.abs(one.points - expected.criteria[i].points) < 0.0101 && Math.abs(one.most - expected.criteria[i].most) < 0.0101, `${where}: ${one.measure}`));
      made.findings.forEach((one, i) => assert.ok(Math.abs(one.points - expected.findings[i].points) < 0.0101, `${where}: ${one.message}`));
      assert.ok(Math.abs(made.penalty - expected.penalty) < 0.0101, where);
    }
  console.log(`${computed} marks computed, ${asked} asked for`);
  assert.ok(computed >= 130, `${computed} of ${computed + asked} marks were computed`);
  // What no grade holds is never guessed.
  const grade = await gradeOf(submissions.sign, reference, {}), by = (now) => score.rescored(grade, score.resolved({}, tables), score.resolved(now, tables), tables);
  for (const now of [{ views: [{ camera: 'own' }] }, { reveal: 'values' }, measured, { picture: { samples: 4 } }, { penalties: { codes: { 'scene.unknown-attribute': 1 } } },
    { define: [{ id: 'x', select: { shape: ['box'] } }] }]) assert.equal(by(now), null, JSON.stringify(now));
});

const openRubric = async (view) => {
  await view.page.getByRole('tab', { name: 'Rubric' }).click();
  await view.page.getByRole('region', { name: 'Rubric' }).waitFor();
};
const markOf = async (view, name, at = 1) => Number((await cellsOf(view, name))[at].trim().split(/\s/)[0]);

test('the rubric as a form and as JSON: marks follow while it is written, and what is wrong is not applied', async () => {
  const view = await openGrade();
  await choose(view, 'Reference: choose files', [file('reference.xml', references['box.xml'])]);
  await choose(view, 'Submissions: choose files', [file('ana.xml', references['box.xml']), file('bento.xml', scene(-40))]);
  await view.page.getByRole('button', { name: 'Grade', exact: true }).click();
  await view.page.getByText('2 graded.').waitFor({ timeout: 60000 });
  const asked = [];
  view.page.on('request', (request) => {
    if (request.url().includes('/v1/grade')) asked.push(request.url());
  });
  const first = await markOf(view, 'bento');
  await openRubric(view);
  await view.page.getByRole('spinbutton', { name: 'transforms weight' }).fill('90');
  await view.page.getByText(/^1 mark changes: mean/).waitFor();
  const expected = await gradeOf(scene(-40), references['box.xml'], { criteria: [['models', 22], ['transforms', 90], ['textures', 9], ['materials', 9], ['lights', 15], ['camera', 10], ['animation', 10]].map(([measure, weight]) => ({ measure, weight })) });
  assert.ok(expected.points < first);
  assert.ok(Math.abs((await markOf(view, 'bento')) - expected.points) < 0.0101);
  assert.match((await cellsOf(view, 'bento'))[1], /−[\d.]+/);
  assert.equal(await markOf(view, 'ana'), 100);
  await view.page.getByRole('spinbutton', { name: 'points' }).fill('20');
  await view.page.getByRole('button', { name: 'Mark of 20' }).waitFor();
  // As JSON; what is wrong is said with its line, and the marks stay.
  await view.page.getByRole('button', { name: 'JSON' }).click();
  const text = view.page.getByRole('textbox', { name: 'Rubric as JSON' });
  assert.equal(JSON.parse(await text.inputValue()).points, 20);
  await text.fill('{\n  "points": 20,\n  "passMrk": 50\n}');
  await view.page.getByText(/\/passMrk is no key of a rubric/).waitFor();
  await view.page.getByRole('button', { name: 'line 3' }).click();
  assert.equal(await text.evaluate((one) => one.value.slice(one.selectionStart, one.selectionEnd)), '  "passMrk": 50');
  assert.equal((await markOf(view, 'ana')), 20);
  await text.fill('{ "points": 40 }');
  await view.page.getByRole('button', { name: 'Mark of 40' }).waitFor();
  assert.deepEqual(asked, []);
  // Other cameras are rendered again, and only where the button says so.
  await text.fill('{ "points": 40, "views": [{ "name": "one", "camera": "own" }] }');
  await view.page.getByText('2 grades are by an earlier rubric').waitFor();
  assert.equal(asked.length, 0);
  await view.page.getByRole('button', { name: 'Grade these again' }).click();
  await view.page.getByRole('button', { name: 'All is graded' }).waitFor({ timeout: 60000 });
  assert.equal(asked.length, 2);
  assert.equal(await markOf(view, 'bento'), (await gradeOf(scene(-40), references['box.xml'], { points: 40, views: [{ name: 'one', camera: 'own' }] })).points);
  // A requirement by the form.
  await view.page.getByRole('button', { name: 'Form' }).click();
  await view.page.getByText('Requirements and parts marked by hand').click();
  await view.page.getByRole('button', { name: 'Add to manual' }).click();
  await rowOf(view, 'ana').click();
  await view.page.getByRole('tab', { name: 'Details' }).click();
  const field = view.page.getByRole('spinbutton', { name: 'Mark for manual-1' });
  await field.fill('1');
  await view.page.keyboard.press('Tab');
  assert.equal(await markOf(view, 'ana'), 40);
  await view.page.reload();
  await rowOf(view, 'ana').waitFor();
  assert.equal(await markOf(view, 'ana'), 40);
  // Another class with files of these names is not compared with the one that is forgotten.
  await openRubric(view);
  view.page.once('dialog', (question) => void question.accept());
  await view.page.getByRole('button', { name: 'Forget this class' }).click();
  await choose(view, 'Reference: choose files', [file('reference.xml', references['box.xml'])]);
  await choose(view, 'Submissions: choose files', [file('ana.xml', references['box.xml'])]);
  await view.page.getByRole('button', { name: 'Grade', exact: true }).click();
  await view.page.getByText('1 graded.').waitFor({ timeout: 60000 });
  assert.equal((await cellsOf(view, 'ana'))[1].trim(), '100');
  await view.close();
});

test('a rubric of requirements needs no reference', async () => {
  const view = await openGrade();
  const rubric = { title: 'Own scene', requirements: [{ id: 'box', text: 'has a box', points: 3, select: { shape: ['box'] } }, { id: 'cones', text: 'has two cones', points: 4, select: { shape: ['cone'] }, count: 2 }] };
  await choose(view, 'Submissions: choose files', [file('own.json', JSON.stringify(rubric)), file('ana.xml', scene(40))]);
  await view.page.getByRole('button', { name: 'Grade', exact: true }).click();
  await view.page.getByText('1 graded.').waitFor({ timeout: 60000 });
  assert.equal(await markOf(view, 'ana'), 3);
  await rowOf(view, 'ana').click();
  assert.match(await view.page.locator('.criteria').innerText(), /has a box met[\s\S]*has two cones not met/);
  await view.page.locator('.criteria li').first().getByRole('button', { name: /^line \d+/ }).click();
  assert.match(await view.page.locator('.lines [aria-current]').innerText(), /<model file="box_1_2/);
  await view.close();
});

test('the files that the page writes are those of farol grade', async () => {
  const overrides = 'student,task,criterion,mark,comment\nBento Dias,box,lights,3,"half, right"\n11,,,25,by talk\nCarla Lopes,ball,,,look again\n';
  const groups = `submission,full name,identifier\n${moodle('Ana Sá', 7)},Ana Sá,7\n${moodle('Ana Sá', 7)},Rui Nó,12\n`, rubric = { title: 'Two', points: 20, weight: 3 };
  const { folder, remove } = folderOf({ 'class.zip': classZip, ...Object.fromEntries(Object.entries(references).map(([path, text]) => [`reference/${path}`, text])),
    'report/overrides.csv': overrides, 'report/groups.csv': groups, 'rubrics/box.json': JSON.stringify(rubric) });
  const { status, stderr } = spawnSync(binary, ['grade', '--reference', 'reference', 'class.zip', '-o', 'report', '--rubric', 'rubrics', '--feedback', '--jobs', '2'], { cwd: folder, encoding: 'utf8' });
  assert.equal(status, 0, stderr);
  const cli = (name) => readFileSync(join(folder, 'report', name));
  const view = await openGrade({ locale: 'en-GB' });
  await gradeClass(view, { files: [file('overrides.csv', overrides), file('groups.csv', groups), file('box.json', JSON.stringify(rubric))] });
  assert.equal((await saved(view, 'grades.csv')).toString(), cli('grades.csv').toString());
  assert.equal((await saved(view, 'criteria.csv')).toString(), cli('criteria.csv').toString());
  assert.equal((await saved(view, 'junit.xml')).toString(), cli('junit.xml').toString());
  const [ours, theirs] = [JSON.parse(await saved(view, 'report.json')), JSON.parse(cli('report.json'))];
  assert.deepEqual([ours.title, ours.tasks, ours.submissions], [theirs.title, theirs.tasks, theirs.submissions]);
  assert.match((await saved(view, 'overrides.csv')).toString(), /"Bento Dias","box","lights",3,"half, right"/);
  const [pages, wanted] = [unzipped(await saved(view, 'feedback.zip')), unzipped(cli('feedback.zip'))];
  assert.deepEqual(Object.keys(pages).sort(), Object.keys(wanted).sort());
  // The page of the report works without a network, and shows the same.
  const report = await saved(view, 'report.html');
  const reader = await browser.newContext({ offline: true }), page = await reader.newPage();
  await page.setContent(report.toString());
  await page.locator('#list tbody tr', { hasText: 'Bento' }).click();
  assert.match(await page.locator('#summary').innerText(), /^5 submissions/);
  await page.waitForFunction(() => [...document.querySelectorAll('#detail img')].length >= 2 && [...document.querySelectorAll('#detail img')].every((one) => one.naturalWidth === 160));
  await reader.close();
  await view.close();
  remove();
});

test('no serious finding of axe in any state', async () => {
  for (const width of [1280, 360]) {
    const view = await openGrade({ viewport: { width, height: 800 }, bypassCSP: true });
    const check = async (state) => {
      for (const colorScheme of ['light', 'dark']) {
        await view.page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
        await view.page.waitForFunction((theme) => document.documentElement.dataset.theme === theme, colorScheme);
        assert.deepEqual(await axeFindings(view.page), [], `${state}, ${colorScheme}, ${width}`);
      }
      assert.ok(await view.page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${state} is wider than ${width}`);
    };
    await view.page.getByRole('button', { name: 'Try an example class' }).waitFor();
    await check('empty');
    let go;
    const isSeen = new Promise((done) => (go = done));
    await view.page.route('**/v1/grade?*', async (route) => {
      await isSeen;
      await route.continue().catch(() => undefined);
    });
    await choose(view, 'Reference: choose files', Object.entries(references).map(([name, text]) => file(name, text)));
    await choose(view, 'Submissions: choose files', [...Array(3).keys()].map((i) => file(`student ${i}.xml`, i === 2 ? notAScene : scene(40 - 80 * i))));
    await view.page.getByRole('button', { name: 'Grade', exact: true }).click();
    await view.page.getByRole('progressbar').waitFor();
    await check('running');
    go();
    await view.page.getByText('6 graded.').waitFor({ timeout: 60000 });
    await check('table');
    await rowOf(view, 'student 1').click();
    await view.page.locator('.causes .line').first().click();
    await view.page.locator('.lines').waitFor();
    await check('details');
    await openRubric(view);
    await view.page.locator('details.entry').evaluateAll((all) => all.forEach((one) => (one.open = true)));
    await check('rubric');
    await view.page.getByRole('button', { name: 'JSON' }).click();
    await view.page.getByRole('textbox', { name: 'Rubric as JSON' }).fill('{ "x": 1 }');
    await check('rubric with a problem');
    await view.close();
  }
});
