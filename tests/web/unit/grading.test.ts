import './dom.ts';
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import * as grading from '../../../web/src/grade/grading.ts';
import { reportHtml } from '../../../web/src/grade/report_files.ts';
import { lineOfFault } from '../../../web/src/grade/rubric.ts';
import * as store from '../../../web/src/grade/store.ts';
import type { Task } from '../../../web/src/grade/types.ts';
import { chooseLanguage, language } from '../../../web/src/words.ts';

const taskOf = (name: string): Task => ({ name, rubric: null, reference: { name, fileName: `${name}.xml`, file: new Blob([`<world title="${name}"/>`]) } });
const handedBy = (name: string) => ({ id: name, name, identifier: '', fileName: 'scene.xml', bytes: 8, file: new Blob(['<world/>']) });

test('a rubric that is edited while a submission is read leaves the request as it was asked for', async () => {
  await grading.restore();
  await grading.setTasks([taskOf('arm'), taskOf('torch')], false);
  await grading.addSubmissions([handedBy('Ana')]);
  const sent: { query: URLSearchParams; parts: string[] }[] = [], fetchBefore = globalThis.fetch;
  globalThis.fetch = (async (url: string, { body }: { body: FormData }) => {
    sent.push({ query: new URLSearchParams(url.split('?')[1]), parts: [...body.keys()] });
    return new Response('{"code":"grade.failed","detail":"no"}', { status: 422 });
  }) as never;
  try {
    const run = grading.run();
    for (const at of [0, 1]) grading.setRubric(at, { name: 'rubric.json', text: '{"passMark": 40}' });
    await run;
  } finally {
    globalThis.fetch = fetchBefore;
  }
  assert.equal(grading.stopped.value, '');
  assert.deepEqual(sent.map(({ query, parts }) => `${query.get('task')} not ${query.get('others')}: ${parts.join()}`).sort(), [
    'arm not torch: submission,reference', 'torch not arm: submission,reference']);
});

test('the browser keeps no reference of a task that is gone', async () => {
  await grading.setTasks([taskOf('arm'), taskOf('torch')], false);
  assert.ok(await store.referenceFiles.get('arm'));
  grading.removeTask('arm');
  assert.equal(await store.referenceFiles.get('arm'), null);
  await grading.setTasks([taskOf('house')], false);
  assert.equal(await store.referenceFiles.get('torch'), null);
  assert.ok(await store.referenceFiles.get('house'));
});

test('the line of a fault is found in what each browser writes', () => {
  const text = '{\n "points": 1,\n "weight": }\n';
  assert.equal(lineOfFault(text, 'JSON.parse: unexpected character at line 3 column 12 of the JSON data'), 3); // Firefox
  assert.equal(lineOfFault(text, 'Unexpected token \'}\', ..."weight": } " is not valid JSON at position 27 (line 3 column 12)'), 3); // Chromium
  assert.equal(lineOfFault(text, 'Unexpected token } in JSON at position 10'), 2);
  assert.equal(lineOfFault(text, 'JSON Parse error: Unexpected token'), 4); // Safari
});

test('a translation that comes late does not take the place of a later choice', async () => {
  await Promise.all([chooseLanguage('cs'), chooseLanguage('en')]);
  assert.equal(language.value, 'en');
});

test('a report has the words of the page\'s language', async () => {
  const report = { title: 'Arm', tasks: [''], groups: [], marks: [] };
  const english = await (await reportHtml(report)).text(), own = (JSON.parse(readFileSync('core/languages/pt.json', 'utf8')) as Record<string, string>)['part.page/submissions'];
  assert.ok(own && !english.includes(`"submissions":"${own}"`));
  await chooseLanguage('pt');
  const portuguese = await (await reportHtml(report)).text();
  await chooseLanguage('en');
  assert.ok(portuguese.includes('"language":"pt"') && portuguese.includes(`"submissions":"${own}"`));
});
