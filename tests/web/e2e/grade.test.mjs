// The grade page, and the token that a server may want.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { launch, openPage, settled, startServer } from './fixture.mjs';

let server, guarded, browser;
before(async () => {
  [server, guarded, browser] = await Promise.all([startServer(), startServer({ args: ['--token', 'open sesame'] }), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
  await guarded?.stop();
});

const scene = (angle) => `<world><window width="160" height="120"/>
<camera><position x="4" y="3" z="5"/><lookAt x="0" y="0" z="0"/><projection fov="50" near="1" far="50"/></camera>
<lights><light type="directional" dirx="1" diry="2" dirz="1"/></lights>
<group>
 <transform><translate x="1" y="0" z="0"/>
  <rotate angle="${angle}" x="0" y="0" z="1"/></transform>
 <models><model file="box_1_2.3d"/></models>
</group></world>`;
const file = (name, text) => ({ name, mimeType: name.endsWith('.json') ? 'application/json' : 'text/xml', buffer: Buffer.from(text) });
const choose = async (view, button, files) => {
  const [chooser] = await Promise.all([view.page.waitForEvent('filechooser'), view.page.getByRole('button', { name: button }).click()]);
  await chooser.setFiles(files);
};

test('the grade page sends each submission, and shows points, findings and pictures', async () => {
  const view = await openPage(browser, `${server.url}/#/grade`, { acceptDownloads: true });
  const sent = [];
  view.page.on('response', (response) => {
    if (new URL(response.url()).pathname === '/v1/grade') sent.push(response.status());
  });
  const go = view.page.getByRole('button', { name: 'Grade', exact: true });
  assert.ok(await go.isDisabled());
  await choose(view, 'Reference: choose files', [file('reference.xml', scene(40))]);
  await choose(view, 'Submissions: choose files', [file('Ana Sá_7_assignsubmission_file_a.xml', scene(40)), file('bento.xml', scene(-40)), file('carla.xml', 'sphere { <0, 0, 0>, 1 }')]);
  await choose(view, 'Submissions: choose files', [file('rubric.json', '{"title": "Of twenty", "points": 20}')]);
  await view.page.getByText('3 submissions').waitFor();
  await go.click();
  await view.page.getByText('3 graded.').waitFor({ timeout: 60000 });
  assert.deepEqual(sent, [200, 200, 200]);
  const row = (name) => view.page.locator('#list tbody tr', { hasText: name }), detail = view.page.locator('#detail');
  const cell = (name, number) => row(name).locator('td').nth(number).innerText();
  assert.match(await row('Ana Sá').locator('td').first().innerText(), /^Ana Sá\s+Participant 7$/);
  assert.equal(await cell('Ana Sá', 1), '20 / 20');
  assert.equal(await cell('carla', 2), 'not graded');
  assert.equal(await cell('carla', 1), '–');
  assert.match(await cell('carla', 3), /the document has no element/);
  const lost = Number.parseFloat(await cell('bento', 1));
  assert.ok(lost > 0 && lost < 20, `${lost} points`);
  assert.match(await view.page.locator('#summary').innerText(), /^3 submissions, \d passed, 1 could not be graded, median [\d.]+ of 20 points$/);
  await view.page.getByRole('searchbox', { name: 'Filter' }).fill('wrong sign');
  assert.equal(await view.page.locator('#list tbody tr').count(), 1);
  await row('bento').click();
  assert.match(await detail.locator('.findings').first().innerText(), /line 6[\s\S]*6 >\s*<rotate angle="-40"/);
  // Both pictures were drawn: they have sizes of their own.
  await view.page.waitForFunction(() => {
    const pictures = [...document.querySelectorAll('#detail img')];
    return pictures.length >= 2 && pictures.every((one) => one.complete && one.naturalWidth === 160);
  });
  // What is chosen stays in sight while more is added.
  await view.page.getByRole('searchbox', { name: 'Filter' }).fill('');
  await choose(view, 'Submissions: choose files', [file('duarte.xml', scene(41))]);
  assert.equal(await cell('duarte', 2), 'waiting');
  assert.equal(await detail.locator('h2').innerText(), 'bento.xml');
  const [download] = await Promise.all([view.page.waitForEvent('download'), view.page.getByRole('button', { name: 'CSV' }).click()]);
  const table = readFileSync(await download.path(), 'utf8').trim().split('\r\n');
  assert.equal(table.length, 5);
  assert.equal(table[0], 'Identifier,Full name,Grade,Maximum Grade,Last modified (grade),Passed,Submission,Feedback comments');
  assert.equal(table.find((line) => line.includes('Ana')), 'Participant 7,Ana Sá,20.00,20.00,,yes,Ana Sá_7_assignsubmission_file_a.xml,');
  assert.match(table.find((line) => line.includes('bento')), /sign/);
  // On a phone nothing of the details is cut off.
  await view.page.setViewportSize({ width: 360, height: 740 });
  assert.deepEqual(await view.page.locator('#list, #detail, #detail .points, #detail .side').evaluateAll((all) =>
    all.filter((one) => one.scrollWidth > one.clientWidth || one.getBoundingClientRect().right > 360).map((one) => one.id || one.className)), []);
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
