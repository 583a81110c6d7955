// The grade page: a class, its table, a submission's details, what a reload keeps; and the token that a server may want.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { keptAll, launch, openPage, settled, startServer, until } from './fixture.mjs';
import { cellsOf, choose, file, folderOf, gradeClass, notAScene, references, rowOf, scene } from './grade_class.mjs';

let server, guarded, browser, few;
before(async () => {
  // A gallery of many scenes would keep its server busy, and an upload waits for its turn.
  few = folderOf({ 'box.xml': scene(0) });
  [server, guarded, browser] = await Promise.all([startServer(), startServer({ scenes: few.folder, args: ['--token', 'open sesame'] }), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
  await guarded?.stop();
  few?.remove();
});

async function openGrade(options = {}) {
  const view = await openPage(browser, `${server.url}/#/grade`, { viewport: { width: 1280, height: 900 }, ...options });
  view.page.setDefaultTimeout(20000);
  return view;
}
const taskOf = (view, name) => view.page.locator('#detail').getByRole('button', { name, exact: true }).click();
const names = (view) => view.page.locator('#list tbody tr td:first-child button').allInnerTexts();

test("Moodle's zip of a class and a folder of references: a row a student, a column a task", async () => {
  const view = await openGrade(), sent = [];
  view.page.on('request', (request) => {
    if (new URL(request.url()).pathname === '/v1/grade') sent.push(new URL(request.url()).searchParams);
  });
  await gradeClass(view);
  assert.deepEqual(await names(view), ['Ana Sá', 'Bento Dias', 'Carla Lopes', 'Duarte Melo', 'Eva Pinto']);
  assert.deepEqual(await view.page.locator('#list thead th').allInnerTexts(), ['Submission ▲', 'Mark of 100', 'ball', 'box', 'Result', 'First cause'].map((text) => text.replace(' ▲', '')));
  const ana = await cellsOf(view, 'Ana Sá'), bento = await cellsOf(view, 'Bento Dias'), duarte = await cellsOf(view, 'Duarte Melo'), eva = await cellsOf(view, 'Eva Pinto');
  assert.match(ana[0], /^Ana Sá\s+Participant 7$/);
  assert.deepEqual(ana.slice(1, 5).map((text) => text.trim()), ['100', '100', '100', 'passed']);
  // An archive in the archive; its names mean the tasks.
  assert.ok(Number(bento[3]) > 50 && Number(bento[3]) < 100 && Number(bento[2]) < 100, bento.join());
  assert.equal(duarte[3], '–');
  assert.ok(Number(duarte[2]) > 50);
  assert.deepEqual([eva[1].trim(), eva[4]], ['–', 'not graded']);
  assert.match(eva[5], /it holds nothing that has the name of "ball"/);
  assert.match(await view.page.locator('#summary').innerText(), /^5 submissions, \d passed, 1 not graded, median [\d.]+ of 100 points$/);
  assert.equal(sent.length, 10);
  assert.ok(sent.every((query) => [query.get('task'), query.get('others')].sort().join() === 'ball,box'));
  // The reference's images are asked for until they are here.
  assert.ok(sent.filter((query) => query.get('pictures') === '2').length < 6);
  await view.close();
});

test('the table is sorted and filtered, and survives a reload', async () => {
  const view = await openGrade();
  await gradeClass(view);
  await view.page.getByRole('button', { name: 'Mark of 100' }).click();
  assert.equal((await names(view))[0], 'Ana Sá');
  assert.equal(await view.page.locator('#list th').nth(1).getAttribute('aria-sort'), 'descending');
  await view.page.getByRole('button', { name: 'Mark of 100' }).click();
  assert.equal((await names(view)).at(-1), 'Ana Sá');
  await view.page.getByRole('combobox', { name: 'State' }).selectOption('not graded');
  assert.deepEqual(await names(view), ['Eva Pinto']);
  await view.page.getByRole('button', { name: 'Show all' }).click();
  await view.page.getByRole('combobox', { name: 'Cause' }).selectOption('transform.angle-sign');
  assert.deepEqual(await names(view), ['Bento Dias']);
  await view.page.getByRole('button', { name: 'Show all' }).click();
  await view.page.getByLabel('From %').fill('99');
  assert.deepEqual(await names(view), ['Ana Sá']);
  await view.page.getByRole('button', { name: 'Show all' }).click();
  await view.page.getByRole('searchbox', { name: 'Filter' }).fill('wrong sign');
  assert.deepEqual(await names(view), ['Bento Dias']);
  await rowOf(view, 'Bento').click();
  await view.page.getByRole('spinbutton', { name: 'Mark for the submission' }).fill('61.5');
  await view.page.getByRole('textbox', { name: 'Comment on the submission' }).fill('late');
  await view.page.keyboard.press('Tab');
  await keptAll(view);
  const asked = [];
  view.page.on('request', (request) => {
    if (request.url().includes('/v1/grade')) asked.push(request.url());
  });
  await view.page.reload();
  await rowOf(view, 'Bento').waitFor();
  assert.deepEqual(await names(view), ['Bento Dias']);
  assert.match((await cellsOf(view, 'Bento'))[1], /^61\.5/);
  assert.match(await view.page.locator('#detail h2').innerText(), /Bento Dias/);
  assert.equal(await view.page.getByRole('textbox', { name: 'Comment on the submission' }).inputValue(), 'late');
  await view.page.waitForFunction(() => document.querySelector('#detail .images img')?.naturalWidth === 160);
  assert.deepEqual(asked, []);
  // All is forgotten where it is asked for.
  view.page.once('dialog', (question) => void question.accept());
  await view.page.getByRole('button', { name: 'Forget this class' }).click();
  await view.page.getByRole('button', { name: 'Try an example class' }).waitFor();
  await view.page.reload();
  await view.page.getByRole('button', { name: 'Try an example class' }).waitFor();
  assert.equal(await view.page.evaluate(() => new Promise((done) => {
    const opening = indexedDB.open('farol');
    opening.onsuccess = () => {
      const all = opening.result.transaction('kept').objectStore('kept').getAllKeys(IDBKeyRange.bound('grade/file', 'grade/z'));
      all.onsuccess = () => done(all.result.length);
    };
  })), 0);
  await view.close();
});

/** The colour in the middle of an image on the page. */
const pixels = (locator) => locator.evaluate((image) => {
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
  const context = canvas.getContext('2d');
  context.drawImage(image, 0, 0);
  return [...context.getImageData(0, 0, canvas.width, canvas.height).data];
});
const differing = (a, b) => a.filter((value, i) => Math.abs(value - b[i]) > 24).length;

test('details: both images and their difference, causes with lines, and the document there', async () => {
  const view = await openGrade();
  await gradeClass(view);
  await rowOf(view, 'Bento').click();
  await taskOf(view, 'box');
  const detail = view.page.locator('#detail'), image = (name) => detail.locator('figure', { hasText: name }).locator('img');
  await image('Reference').waitFor();
  await view.page.waitForFunction(() => [...document.querySelectorAll('#detail .images img')].every((one) => one.complete && one.naturalWidth === 160));
  await detail.getByRole('button', { name: /^own camera/ }).click();
  await view.page.waitForFunction(() => [...document.querySelectorAll('#detail .images img')].every((one) => one.complete && one.naturalWidth === 160));
  // The reference is what the service draws of it; the submission differs where the difference is bright.
  const drawn = await view.page.evaluate(async (xml) => {
    const response = await fetch('v1/render?width=160&height=120&aa=1', { method: 'POST', body: xml, headers: { 'Content-Type': 'application/xml' } });
    const bitmap = await createImageBitmap(await response.blob()), canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [160, 120];
    const context = canvas.getContext('2d');
    context.drawImage(bitmap, 0, 0);
    return [...context.getImageData(0, 0, 160, 120).data];
  }, references['box.xml']);
  const reference = await pixels(image('Reference')), submission = await pixels(image('Submission')), difference = await pixels(image('Difference'));
  // Of 76800 values; JPEG's rounding alone is beyond 24 levels at a few edges.
  assert.ok(differing(reference, drawn) < 100, `${differing(reference, drawn)} values of the reference differ from its render`);
  assert.ok(differing(reference, submission) > 300, `${differing(reference, submission)} values differ`);
  // The difference is bright where they differ, and dark elsewhere.
  const places = [[], []];
  for (let i = 0; i < reference.length; i += 4) places[Math.abs(reference[i] - submission[i]) > 24 ? 1 : 0].push(Math.max(...difference.slice(i, i + 3)));
  const [dark, bright] = places.map((all) => all.reduce((sum, value) => sum + value, 0) / all.length);
  assert.ok(bright > 2 * dark && bright > 20, `${bright} where they differ, ${dark} elsewhere`);
  await detail.getByRole('button', { name: 'Slider' }).click();
  const slider = detail.getByRole('slider', { name: 'Share of the submission that is shown' });
  await slider.fill('20');
  assert.equal(await detail.locator('.compare .over').evaluate((one) => one.style.clipPath), 'inset(0px 80% 0px 0px)');
  await detail.getByRole('button', { name: 'Difference' }).click();
  assert.equal(await detail.locator('.images img').count(), 1);
  // A cause names a line: it opens the document of the inner archive there.
  const cause = detail.locator('.causes li').first();
  assert.match(await cause.innerText(), /wrong sign[\s\S]*−[\d.]+/);
  await cause.getByRole('button', { name: 'line 6' }).click();
  const source = detail.getByRole('region', { name: /^Line 6 of .*work\.zip\/Box \(final\)\.xml$/ });
  await source.waitFor();
  assert.match(await source.locator('[aria-current]').innerText(), /<rotate angle="-40"/);
  assert.ok(await source.evaluate((one) => one === document.activeElement));
  assert.equal(await detail.locator('.source [contenteditable], .source textarea').count(), 0);
  await detail.getByRole('button', { name: 'Close the document' }).click();
  // Another panel begins at its top.
  const body = view.page.locator('.panels > [role=tabpanel]');
  await body.evaluate((one) => (one.scrollTop = 400));
  assert.ok((await body.evaluate((one) => one.scrollTop)) > 100);
  await view.page.getByRole('tab', { name: 'Rubric' }).click();
  await view.page.getByRole('region', { name: 'Rubric' }).waitFor();
  assert.equal(await body.evaluate((one) => one.scrollTop), 0);
  await view.page.getByRole('tab', { name: 'Details' }).click();
  // The other task is another cause.
  await taskOf(view, 'ball');
  assert.match(await detail.locator('.causes').first().innerText(), /cone|shape/);
  await view.close();
});

test("a person's marks: of a criterion, of a task, of the whole; a comment", async () => {
  const view = await openGrade();
  await gradeClass(view);
  await rowOf(view, 'Bento').click();
  await taskOf(view, 'box');
  const field = (name) => view.page.getByRole('spinbutton', { name: `Mark for ${name}`, exact: true });
  const mark = async (at) => Number((await cellsOf(view, 'Bento'))[at].trim());
  const before = await mark(3), program = Number(await field('transforms').getAttribute('placeholder'));
  await field('transforms').fill('1');
  await field('transforms').press('Enter');
  await view.page.keyboard.press('Tab');
  assert.ok(Math.abs((await mark(3)) - (before - program + 1)) < 0.011, `${await mark(3)} of ${before} - ${program} + 1`);
  assert.match((await cellsOf(view, 'Bento'))[4], /changed by hand/);
  // Never more than the criterion has.
  await field('transforms').fill('900');
  await view.page.keyboard.press('Tab');
  assert.ok((await mark(3)) <= 100);
  await field('box').fill('50');
  await view.page.keyboard.press('Tab');
  assert.equal(await mark(3), 50);
  await field('the submission').fill('12');
  await view.page.keyboard.press('Tab');
  assert.equal(await mark(1), 12);
  for (const name of ['transforms', 'box', 'the submission']) {
    await field(name).fill('');
    await view.page.keyboard.press('Tab');
  }
  assert.equal(await mark(3), before);
  // A submission that could not be graded gets a mark.
  await rowOf(view, 'Eva').click();
  await field('the submission').fill('40');
  await view.page.keyboard.press('Tab');
  assert.equal((await cellsOf(view, 'Eva'))[4].split(/\s/)[0], 'failed');
  await view.close();
});

test('one after the other by the keyboard alone', async () => {
  const view = await openGrade();
  await gradeClass(view);
  const { keyboard } = view.page, chosen = () => view.page.locator('#detail h2').innerText();
  await keyboard.press('j');
  assert.equal(await chosen(), 'Ana Sá');
  await keyboard.press('ArrowDown');
  assert.equal(await chosen(), 'Bento Dias');
  await keyboard.press('k');
  assert.equal(await chosen(), 'Ana Sá');
  await keyboard.press('/');
  await keyboard.type('carla');
  assert.deepEqual(await names(view), ['Carla Lopes']);
  await keyboard.press('Escape');
  await keyboard.press('j');
  assert.equal(await chosen(), 'Carla Lopes');
  // A field keeps its keys.
  await view.page.getByRole('textbox', { name: 'Comment on the submission' }).focus();
  await keyboard.type('jk/');
  assert.equal(await view.page.getByRole('textbox', { name: 'Comment on the submission' }).inputValue(), 'jk/');
  // The table's row is reached by Tab, the panels by arrows.
  await view.page.getByRole('tab', { name: 'Details' }).focus();
  await keyboard.press('ArrowRight');
  assert.ok(await view.page.getByRole('tab', { name: 'Rubric' }).evaluate((one) => one === document.activeElement && one.ariaSelected === 'true'));
  await view.close();
});

test('a whole session by the keyboard alone, with the example class and its mistakes', async () => {
  const view = await openGrade({ acceptDownloads: true }), { keyboard } = view.page;
  /** Tabs until the focus is on an element of that name. */
  const tabTo = async (name) => {
    for (let i = 0; i < 120; ++i) {
      await keyboard.press('Tab');
      const focused = await view.page.evaluate(() => document.activeElement?.getAttribute('aria-label') ?? document.activeElement?.textContent?.trim() ?? '');
      if (name.test(focused)) return;
    }
    assert.fail(`Tab never came to ${name}`);
  };
  await tabTo(/^Try an example class$/);
  await keyboard.press('Enter');
  await view.page.getByText('7 submissions', { exact: true }).first().waitFor();
  await view.page.waitForFunction(() => document.activeElement?.textContent === 'Grade' && document.activeElement.closest('.go'));
  await keyboard.press('Enter');
  await view.page.getByText('14 graded.').waitFor({ timeout: 120000 });
  assert.equal((await cellsOf(view, 'Ana Reis'))[1].trim(), '100');
  assert.match((await cellsOf(view, 'Bento Dias')).at(-1), /wrong sign/);
  assert.match((await cellsOf(view, 'Carla Lopes')).at(-1), /wrong order/);
  assert.match((await cellsOf(view, 'Gil Vaz')).join(), /not graded/);
  await keyboard.press('j');
  await keyboard.press('j');
  assert.equal(await view.page.locator('#detail h2').innerText(), 'Bento Dias');
  await tabTo(/^line 91$/);
  await keyboard.press('Enter');
  await view.page.waitForFunction(() => document.activeElement?.classList.contains('lines'));
  await tabTo(/^Mark for transforms$/);
  await keyboard.type('0');
  await keyboard.press('Tab');
  await keyboard.type('see me');
  await keyboard.press('Tab');
  await view.page.locator('#list tr', { hasText: 'Bento' }).getByText('changed by hand').waitFor();
  await keyboard.press('Escape');
  await tabTo(/^Save as$/);
  await keyboard.press('Enter');
  await tabTo(/^criteria\.csv/);
  const [download] = await Promise.all([view.page.waitForEvent('download'), keyboard.press('Enter')]);
  assert.equal(download.suggestedFilename(), 'criteria.csv');
  await view.close();
});

test('a run is cancelled and goes on', async () => {
  const view = await openGrade();
  let held = [];
  await view.page.route('**/v1/grade?*', (route) => new Promise((done) => held.push(() => done(route.continue().catch(() => undefined)))));
  await choose(view, 'Reference: choose files', [file('reference.xml', scene(40))]);
  await choose(view, 'Submissions: choose files', ['a', 'b', 'c', 'd'].map((name, i) => file(`${name}.xml`, scene(40 + i))));
  await view.page.getByRole('button', { name: 'Grade', exact: true }).click();
  await view.page.getByText('Grading 0 of 4…').waitFor();
  const release = async () => {
    (await until(() => held.shift(), 'nothing is graded'))();
  };
  await release();
  await view.page.getByText('Grading 1 of 4…').waitFor();
  await view.page.getByRole('button', { name: 'Cancel' }).click();
  await view.page.getByRole('button', { name: 'Go on: 3 left' }).waitFor();
  held = [];
  await view.page.unroute('**/v1/grade?*');
  await view.page.reload();
  await view.page.getByRole('button', { name: 'Go on: 3 left' }).click();
  await view.page.getByText('4 graded.').waitFor({ timeout: 60000 });
  // A server that is gone stops the run, and says so; nothing is lost.
  await view.page.route('**/v1/grade?*', (route) => route.abort());
  await view.page.getByRole('button', { name: 'Grade all again' }).click();
  await view.page.getByText('The server does not answer').waitFor();
  await view.page.unroute('**/v1/grade?*');
  await view.page.getByRole('button', { name: 'Grade', exact: true }).click();
  await view.page.getByText('4 graded.').waitFor({ timeout: 60000 });
  assert.equal((await cellsOf(view, 'a.xml'))[1].trim(), '100');
  await view.close();
});

test('a reference that cannot be read is said once, and stops the run', async () => {
  const view = await openGrade();
  await choose(view, 'Reference: choose files', [file('reference.xml', notAScene)]);
  await choose(view, 'Submissions: choose files', [file('a.xml', scene(40)), file('b.xml', scene(41))]);
  await view.page.getByRole('button', { name: 'Grade', exact: true }).click();
  await view.page.getByText(/The task “reference” cannot be graded: .*no element/).waitFor({ timeout: 60000 });
  await choose(view, 'Submissions: choose files', [file('notes.txt', 'x')]);
  await view.page.getByText('There is no scene, archive or image among these files.').waitFor();
  await choose(view, 'Submissions: choose files', [file('overrides.csv', 'student,mark,comment\na.xml,many,\n')]);
  await view.page.getByText('overrides.csv, line 2: the mark is "many"; expected a number of 0 or more').waitFor();
  await view.close();
});

test('a browser that keeps nothing, or has no room, is said in words', async () => {
  for (const [name, words] of [['QuotaExceededError', 'The browser has no more room'], ['SecurityError', 'The browser keeps nothing of this page']]) {
    const view = await openPage(browser, 'about:blank');
    await view.page.addInitScript((error) => {
      IDBObjectStore.prototype.put = () => {
        throw new DOMException('no', error);
      };
    }, name);
    await view.page.goto(`${server.url}/#/grade`);
    await choose(view, 'Reference: choose files', [file('reference.xml', scene(40))]);
    await choose(view, 'Submissions: choose files', [file('a.xml', scene(-40))]);
    await view.page.getByText(words).waitFor();
    // The class is graded all the same, with its images.
    await view.page.getByRole('button', { name: 'Grade', exact: true }).click();
    await view.page.getByText('1 graded.').waitFor({ timeout: 60000 });
    await rowOf(view, 'a.xml').click();
    await view.page.waitForFunction(() => document.querySelector('#detail .images img')?.naturalWidth === 160);
    await view.close();
  }
});

test('single files and a phone: nothing is cut off', async () => {
  const view = await openGrade({ viewport: { width: 360, height: 740 }, hasTouch: true });
  await choose(view, 'Reference: choose files', [file('reference.xml', scene(40))]);
  await choose(view, 'Submissions: choose files', [file('Ana Sá_7_assignsubmission_file_a.xml', scene(40)), file('bento.xml', scene(-40)), file('carla.xml', notAScene)]);
  await choose(view, 'Submissions: choose files', [file('rubric.json', '{"title": "Of twenty", "points": 20}')]);
  await view.page.getByRole('button', { name: 'Grade', exact: true }).click();
  await view.page.getByText('3 graded.').waitFor({ timeout: 60000 });
  await rowOf(view, 'bento').click();
  await view.page.waitForFunction(() => document.querySelector('#detail .images img')?.naturalWidth === 160);
  await view.page.locator('.causes .line').first().click();
  await view.page.locator('.lines').waitFor();
  assert.deepEqual(await view.page.locator('#list, #detail, .criteria, .side, .source, .filters, .drops').evaluateAll((all) =>
    all.filter((one) => one.scrollWidth > one.clientWidth + 1 || one.getBoundingClientRect().right > 360).map((one) => one.id || one.className)), []);
  assert.ok(await view.page.evaluate(() => document.documentElement.scrollWidth <= 360));
  await view.close();
});

test('a server that wants a token is given it once', async () => {
  const view = await openPage(browser, `${guarded.url}/`);
  const sent = [];
  view.page.on('request', (request) => {
    if (request.method() !== 'GET') sent.push(request.headers()['authorization'] ?? '');
  });
  const dialog = view.page.getByRole('dialog', { name: 'This server wants a token' });
  const answer = async (text) => {
    await dialog.getByLabel('Token').fill(text);
    await dialog.getByRole('button', { name: 'Go on' }).click();
  };
  await view.page.waitForSelector('.card:not(.ghost)');
  await choose(view, 'Open files', [file('box.xml', scene(10))]);
  await dialog.waitFor();
  await answer('a guess');
  await dialog.getByText(/token is wrong/i).waitFor();
  await answer('open sesame');
  await view.page.waitForURL(/#\/scene\/(~|%7E)/);
  await settled(view);
  assert.deepEqual(sent, ['', 'Bearer a guess', 'Bearer open sesame']);
  // After a reload it is still known: deleting asks for no token.
  await view.page.reload();
  await settled(view);
  await view.page.getByRole('button', { name: 'Panel', exact: true }).click();
  view.page.once('dialog', (question) => void question.accept());
  await view.page.getByRole('button', { name: 'Delete from the server' }).click();
  await view.page.waitForURL(/#\/$/);
  await view.page.waitForSelector('.card:not(.ghost)');
  assert.equal(sent.at(-1), 'Bearer open sesame');
  assert.ok(!(await dialog.isVisible()));
  await view.close();
});

test('who gives no token sees the scene, and is told that it was not stored', async () => {
  const view = await openPage(browser, `${guarded.url}/`);
  await view.page.waitForSelector('.card:not(.ghost)');
  await choose(view, 'Open files', [file('box.xml', scene(10))]);
  await view.page.getByRole('dialog', { name: 'This server wants a token' }).getByRole('button', { name: 'Cancel' }).click();
  await view.page.getByText('Shown, but not stored').waitFor();
  await settled(view);
  assert.equal(view.full().at(-1).path, '/v1/render');
  await view.close();
});
