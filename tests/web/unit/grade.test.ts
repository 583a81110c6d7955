import assert from 'node:assert/strict';
import { File } from 'node:buffer'; // no global before Node.js 20
import { spawnSync } from 'node:child_process';
import { test } from 'node:test';
import { csvOf } from '../../../web/src/grade/grading.ts';
import { subjectsOf } from '../../../web/src/grade/submissions.ts';
import { tarHeader, tarOf } from '../../../web/src/grade/tar.ts';

const file = (path: string, text = path) => ({ path, file: new File([text], path) });
const names = (paths: string[]): string[] => subjectsOf(paths.map((path) => file(path))).map((one) => `${one.name} ${one.fileName}`);

test('tar reads the archives', async () => {
  const long = `${'folder-'.repeat(18)}/${'name-'.repeat(15)}.png`;
  const files = [file('scene.xml', '<world/>'), file('textures/é.png', 'x'.repeat(1025)), file(long, '')];
  const input = Buffer.from(await tarOf(files).arrayBuffer());
  const { stdout, status } = spawnSync('tar', ['--list', '--file=-', '--quoting-style=literal'], { input, env: { ...process.env, LC_ALL: 'C.UTF-8' } });
  assert.equal(status, 0);
  assert.deepEqual(stdout.toString().trim().split('\n'), files.map(({ path }) => path));
  const text = spawnSync('tar', ['--extract', '--to-stdout', '--file=-', 'scene.xml'], { input }).stdout.toString();
  assert.equal(text, '<world/>');
  assert.throws(() => tarHeader('x'.repeat(200), 0));
});

test('what is dropped becomes submissions', () => {
  assert.deepEqual(names(['a.xml', 'b.zip', 'notes.txt']), ['a.xml a.xml', 'b.zip b.zip']);
  assert.deepEqual(names(['class/ann/scene.xml', 'class/ann/t.png', 'class/bob.xml', 'class/.DS_Store']), ['ann ann.tar', 'bob.xml bob.xml']);
  assert.deepEqual(names(['ann/scene.xml', 'ann/t/wood.png']), ['ann ann.tar']);
  assert.deepEqual(names(['scene.xml', 'wood.png']), ['scene.xml scene.xml.tar']);
  assert.deepEqual(names(['only.png']), ['only.png only.png']);
  assert.deepEqual(names(['readme.txt']), []);
});

test('the table of grades is safe to open', () => {
  const subject = { name: '=cmd', file: new Blob(), fileName: 'x' };
  const grade = { points: 7.5, most: 10, passed: true, findings: [{ code: 'c', message: 'a "b", c', points: 1 }], diagnostics: [] } as never;
  const moodle = { ...subject, name: 'Ana Sá_17_assignsubmission_file_a.xml' };
  assert.deepEqual(csvOf([{ subject, state: 'done', grade }, { subject: moodle, state: 'failed', problem: 'gone' }]).split('\r\n'), [
    'Identifier,Full name,Grade,Maximum Grade,Last modified (grade),Passed,Submission,Feedback comments',
    ',\'=cmd,7.50,10.00,,yes,\'=cmd,"a ""b"", c"',
    'Participant 17,Ana Sá,,,,,Ana Sá_17_assignsubmission_file_a.xml,gone', '',
  ]);
});
