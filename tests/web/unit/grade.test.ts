import assert from 'node:assert/strict';
import { File } from 'node:buffer'; // no global before Node.js 20
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { csvOf } from '../../../web/src/grade/grading.ts';
import { subjectsOf } from '../../../web/src/grade/submissions.ts';
import { classOf } from '../../../web/src/grade/zip.ts';
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

test("Moodle's zip of a class is a zip a submission", async () => {
  const folder = mkdtempSync(join(tmpdir(), 'farol-class-'));
  const write = (path: string, text: string): void => {
    mkdirSync(dirname(join(folder, path)), { recursive: true });
    writeFileSync(join(folder, path), text);
  };
  write('Ana Sá_17_assignsubmission_file_/scene.xml', '<world/>'.repeat(99));
  write('Ana Sá_17_assignsubmission_file_/tex/wood.png', 'wood');
  write('Bento_18_assignsubmission_file_robot.xml', '<world></world>');
  const pack = `import sys, zipfile, pathlib
z = zipfile.ZipFile(sys.argv[2], 'w', zipfile.ZIP_DEFLATED)
[z.write(p, p.relative_to(sys.argv[1])) for p in sorted(pathlib.Path(sys.argv[1]).rglob('*')) if p.is_file()]
z.close()`;
  const list = 'import sys, io, zipfile\nz = zipfile.ZipFile(io.BytesIO(sys.stdin.buffer.read()))\nprint(z.testzip(), [(i.filename, i.file_size) for i in z.infolist()])';
  assert.equal(spawnSync('python3', ['-c', pack, folder, join(folder, 'class.zip')]).status, 0);
  const zip = new Blob([readFileSync(join(folder, 'class.zip'))]);
  const subjects = await classOf(zip);
  assert.deepEqual(subjects?.map((one) => one.name), ['Ana Sá_17_assignsubmission_file_', 'Bento_18_assignsubmission_file_']);
  const listed = await Promise.all((subjects ?? []).map(async ({ file }) =>
    spawnSync('python3', ['-c', list], { input: Buffer.from(await file.arrayBuffer()) }).stdout.toString().trim()));
  assert.deepEqual(listed, [
    "None [('Ana Sá_17_assignsubmission_file_/scene.xml', 792), ('Ana Sá_17_assignsubmission_file_/tex/wood.png', 4)]",
    "None [('Bento_18_assignsubmission_file_robot.xml', 15)]"]);
  assert.equal(await classOf(new Blob(['no zip'])), null);
  assert.equal(await classOf((subjects ?? [])[0]?.file.slice(40) ?? zip), null);
  rmSync(folder, { recursive: true });
});
