import './dom.ts';
import assert from 'node:assert/strict';
import { File } from 'node:buffer'; // no global before Node.js 20
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { membersOf as filesIn } from '../../../web/src/grade/archive.ts';
import { forCsv, readCsv } from '../../../web/src/grade/csv.ts';
import { mistakes } from '../../../web/src/grade/example.ts';
import { studentMark, type TaskMark } from '../../../web/src/grade/marks.ts';
import { isStudent, membersOf, studentOf } from '../../../web/src/grade/names.ts';
import { criteriaCsv, gradesCsv, overridesCsv, readGroups, readOverrides } from '../../../web/src/grade/report_tables.ts';
import { checkRubric, comparedPoints, resolved, type Rubric } from '../../../web/src/grade/rubric.ts';
import { lineOf } from '../../../web/src/grade/schema_check.ts';
import { decoded, memberNamed, sourceOf } from '../../../web/src/grade/source.ts';
import { classOf, submissionsOf, subjectsOf, tasksOf } from '../../../web/src/grade/submissions.ts';
import type { GradeTables } from '../../../web/src/grade/tables.ts';
import { tarHeader, tarOf } from '../../../web/src/grade/tar.ts';
import type { Grade, Submission } from '../../../web/src/grade/types.ts';
import { firstCause } from '../../../web/src/views/grade/list_state.ts';
import { ZipWriter } from '../../../web/src/zip.ts';

const tables = JSON.parse(readFileSync('api/schema.json', 'utf8')) as GradeTables;
const file = (path: string, text = path) => ({ path, file: new File([text], path) as never });
const names = (paths: string[]): string[] => subjectsOf(paths.map((path) => file(path))).map((one) => `${one.name} ${one.fileName}`);

/** A zip of these files, made by another program. */
function zipOf(files: Record<string, string | Buffer>): Blob {
  const folder = mkdtempSync(join(tmpdir(), 'farol-class-'));
  for (const [path, text] of Object.entries(files)) {
    mkdirSync(dirname(join(folder, 'in', path)), { recursive: true });
    writeFileSync(join(folder, 'in', path), text);
  }
  const pack = `import sys, zipfile, pathlib
z = zipfile.ZipFile(sys.argv[2], 'w', zipfile.ZIP_DEFLATED)
[z.write(p, p.relative_to(sys.argv[1])) for p in sorted(pathlib.Path(sys.argv[1]).rglob('*')) if p.is_file()]
z.close()`;
  assert.equal(spawnSync('python3', ['-c', pack, join(folder, 'in'), join(folder, 'class.zip')]).status, 0);
  const zip = new Blob([readFileSync(join(folder, 'class.zip'))]);
  rmSync(folder, { recursive: true });
  return zip;
}

/** What Python reads of a zip: none is damaged, names and sizes. */
async function listed(zip: Blob): Promise<string> {
  const list = 'import sys, io, zipfile\nz = zipfile.ZipFile(io.BytesIO(sys.stdin.buffer.read()))\nprint(z.testzip(), [(i.filename, i.file_size) for i in z.infolist()])';
  return spawnSync('python3', ['-c', list], { input: Buffer.from(await zip.arrayBuffer()) }).stdout.toString().trim();
}

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

test('what is dropped becomes submissions', async () => {
  assert.deepEqual(names(['a.xml', 'b.zip', 'notes.txt']), ['a.xml a.xml', 'b.zip b.zip']);
  assert.deepEqual(names(['class/ann/scene.xml', 'class/ann/t.png', 'class/bob.xml', 'class/.DS_Store']), ['ann ann.tar', 'bob.xml bob.xml']);
  assert.deepEqual(names(['ann/scene.xml', 'ann/t/wood.png']), ['ann ann.tar']);
  assert.deepEqual(names(['scene.xml', 'wood.png']), ['scene.xml scene.xml.tar']);
  assert.deepEqual(names(['only.png']), ['only.png only.png']);
  assert.deepEqual(names(['readme.txt']), []);
  // Files that Moodle sends without folders are one a student.
  assert.deepEqual(names(['Ana_1_assignsubmission_file_a.xml', 'Ana_1_assignsubmission_file_wood.png', 'Bo_2_assignsubmission_file_b.xml']),
    ['Ana_1_assignsubmission_file_ Ana_1_assignsubmission_file_.tar', 'Bo_2_assignsubmission_file_ b.xml']);
  await assert.rejects(submissionsOf([{ path: 'class.zip', file: new File([new Uint8Array(17 << 20)], 'class.zip') as never }], []), /class\.zip cannot be read: it is damaged/);
  // Names that are there twice, in two zips.
  const zip = zipOf({ 'Ana_1_assignsubmission_file_/a.xml': '<world/>' });
  const twice = await submissionsOf([{ path: 'class.zip', file: zip as never }, file('bob.xml')], []);
  assert.deepEqual(twice.map(({ id }) => id), ['Ana_1_assignsubmission_file_', 'bob.xml']);
});

test('references are one task or several', () => {
  const tasks = (paths: string[]): string[] => tasksOf(paths.map((path) => file(path))).map(({ name, reference }) => `${name} ${reference?.fileName}`);
  assert.deepEqual(tasks(['reference.xml']), ['reference reference.xml']);
  assert.deepEqual(tasks(['scene.xml', 'wood.png']), ['scene scene.tar']);
  assert.deepEqual(tasks(['all/house.xml', 'all/robot.xml', 'all/wood.png']), ['house house.tar', 'robot robot.tar']);
  assert.deepEqual(tasks(['all/house/scene.xml', 'all/house/a.png', 'all/robot/scene.xml']), ['house house.tar', 'robot scene.xml']);
  assert.deepEqual(tasks(['one.png', 'two.png', 'rubric.json']), ['one one.png', 'two two.png']);
  assert.deepEqual(tasks(['house.zip', 'robot.tar.gz']), ['house house.zip', 'robot robot.tar.gz']);
  assert.deepEqual(tasks(['readme.txt']), []);
});

test("Moodle's zip of a class is a zip a submission", async () => {
  const zip = zipOf({
    'Ana Sá_17_assignsubmission_file_/scene.xml': '<world/>'.repeat(99), 'Ana Sá_17_assignsubmission_file_/tex/wood.png': 'wood',
    'Ana Sá_17_assignsubmission_file_/film.mp4': 'x'.repeat(999), 'Bento_18_assignsubmission_file_robot.xml': '<world></world>',
    'Carla_19_assignsubmission_file_/work.docx': 'words', '__MACOSX/x': 'x',
  });
  const subjects = await classOf(zip);
  assert.deepEqual(subjects?.map((one) => `${one.id}|${one.name}|${one.identifier}`), [
    'Ana Sá_17_assignsubmission_file_|Ana Sá|Participant 17', 'Bento_18_assignsubmission_file_|Bento|Participant 18', 'Carla_19_assignsubmission_file_|Carla|Participant 19']);
  assert.deepEqual(await Promise.all((subjects ?? []).map((one) => listed(one.file))), [
    "None [('Ana Sá_17_assignsubmission_file_/scene.xml', 792), ('Ana Sá_17_assignsubmission_file_/tex/wood.png', 4)]",
    "None [('robot.xml', 15)]", "None [('Carla_19_assignsubmission_file_/work.docx', 5)]"]);
  assert.equal(await classOf(new Blob(['no zip'])), null);
  // A name that is not UTF-8 is Latin-1: é is one byte of the directory, and two in what is sent.
  const bytes = Buffer.from(await zipOf({ 'class/Rex_5_assignsubmission_file_/a_.xml': 'x' }).arrayBuffer()), latin = Buffer.from(bytes.toString('latin1').replaceAll('a_.xml', 'a\xe9.xml'), 'latin1');
  assert.equal(await listed((await classOf(new Blob([latin])))?.[0]?.file as Blob), "None [('Rex_5_assignsubmission_file_/aé.xml', 1)]");
  assert.equal(await classOf(zip.slice(40)), null);
});

test('a zip is a class where what lies at its top are submissions', async () => {
  const ids = async (files: Record<string, string>, tasks: string[] = []) => (await classOf(zipOf(files), tasks))?.map(({ id }) => id) ?? null;
  assert.equal(await ids({ 'scene.xml': 'x', 'wood.png': 'x' }), null);
  assert.equal(await ids({ 'work/scene.xml': 'x', 'work/a/part.xml': 'x' }), null);
  assert.deepEqual(await ids({ 'class/ann/scene.xml': 'x', 'class/bob/scene.xml': 'x' }), ['ann', 'bob']);
  assert.equal(await ids({ 'house/scene.xml': 'x', 'robot/scene.xml': 'x' }, ['house', 'robot']), null);
  assert.deepEqual(await ids({ 'top/Ana_1_assignsubmission_file_/a.xml': 'x' }), ['Ana_1_assignsubmission_file_']);
});

test('the document of a place is found in archives, two deep', async () => {
  const inner = Buffer.from(await zipOf({ 'robot/scene.xml': '<world>\n</world>' }).arrayBuffer());
  const outer = zipOf({ 'Ana/work.zip': inner, 'Ana/readme.xml': '<a/>' });
  assert.deepEqual((await filesIn(outer))?.map(({ path }) => path), ['Ana/readme.xml', 'Ana/work.zip', 'Ana/work.zip/robot/scene.xml']);
  assert.deepEqual(await sourceOf(outer, 'Ana.zip', 'scene.xml'), { path: 'Ana/work.zip/robot/scene.xml', text: '<world>\n</world>' });
  const tar = tarOf([file('a/scene.xml', 'é')]), gz = new Blob([spawnSync('gzip', ['-c'], { input: Buffer.from(await tar.arrayBuffer()) }).stdout]);
  assert.equal((await sourceOf(tar, 'x.tar', 'scene.xml')).text, 'é');
  assert.equal((await sourceOf(gz, 'x.tgz', 'a/scene.xml')).text, 'é');
  await assert.rejects(sourceOf(outer, 'Ana.zip', 'gone.xml'), /no file “gone.xml”/);
  await assert.rejects(sourceOf(new Blob(['Rar!..']), 'x.rar', 'scene.xml'), /7z, rar/);
  await assert.rejects(sourceOf(zipOf({ 'big.xml': 'x'.repeat(2 << 20) }), 'b.zip', 'big.xml'), /larger than 1 MiB/);
  assert.equal(decoded(new Uint8Array([0xe9])), 'é');
  assert.equal(memberNamed([{ path: 'a/x.xml' }, { path: 'x.xml' }], 'x.xml'), 1);
});

test('an archive in an archive that cannot be unpacked hides nothing else', async () => {
  const pack = "import io, sys, zipfile\nout = io.BytesIO()\nz = zipfile.ZipFile(out, 'w')\nz.writestr('old.zip', 'x' * 5000, zipfile.ZIP_BZIP2)\nz.writestr('scene.xml', '<world/>')\nz.close()\nsys.stdout.buffer.write(out.getvalue())";
  const zip = new Blob([spawnSync('python3', ['-c', pack]).stdout]);
  assert.equal((await sourceOf(zip, 'a.zip', 'scene.xml')).text, '<world/>');
  const nested = zipOf({ 'a.zip': Buffer.from(await zipOf({ 'a.xml': 'x'.repeat(3000) }).arrayBuffer()), 'b.zip': Buffer.from(await zipOf({ 'b.xml': 'y' }).arrayBuffer()) });
  const paths = async (left: number): Promise<string[]> => ((await filesIn(nested, 2, { left })) ?? []).map(({ path }) => path);
  assert.deepEqual(await paths(1e6), ['a.zip', 'a.zip/a.xml', 'b.zip', 'b.zip/b.xml']);
  assert.deepEqual(await paths(200), ['a.zip', 'a.zip/a.xml', 'b.zip']);
});

test('zip64: sizes, places and counts of 64 bits are read, and what claims more than there is is refused', async () => {
  // Python writes zip64 where a number is above its limits: here all are.
  const pack = (limit: number, isMarked = true): Blob => {
    const bytes = spawnSync('python3', ['-c', `import io, sys, zipfile
zipfile.ZIP64_LIMIT = zipfile.ZIP_FILECOUNT_LIMIT = ${limit}
out = io.BytesIO()
z = zipfile.ZipFile(out, 'w', zipfile.ZIP_DEFLATED)
for name, angle in (('Ana Sá_7', 40), ('Bento_8', -40)):
    with z.open(zipfile.ZipInfo(f'{name}_assignsubmission_file_/scene.xml'), 'w', force_zip64=True) as entry:
        entry.write(f'<world angle="{angle}"/>'.encode() * 9)
z.close()
sys.stdout.buffer.write(out.getvalue())`]).stdout, at = bytes.lastIndexOf('PK\x05\x06', undefined, 'latin1');
    if (isMarked) bytes.fill(0xff, at + 8, at + 20); // the numbers are in the record of 64 bits alone
    return new Blob([bytes]);
  };
  for (const zip of [pack(1), pack(1, false), pack(1 << 30, false)]) {
    const students = await classOf(zip);
    assert.deepEqual(students?.map(({ name, identifier }) => [name, identifier]), [['Ana Sá', 'Participant 7'], ['Bento', 'Participant 8']]);
    assert.equal(await listed(students?.[1]?.file as Blob), "None [('Bento_8_assignsubmission_file_/scene.xml', 180)]");
    assert.equal((await sourceOf(zip, 'class.zip', 'scene.xml')).text, '<world angle="40"/>'.repeat(9));
  }
  const whole = Buffer.from(await pack(1).arrayBuffer()), end = whole.indexOf(Buffer.from('PK\x06\x06', 'latin1'));
  const changed = (change: (bytes: Buffer) => void): Blob => {
    const bytes = Buffer.from(whole);
    change(bytes);
    return new Blob([bytes]);
  };
  for (const at of [32, 40, 48]) {
    assert.equal(await classOf(changed((bytes) => bytes.writeBigUInt64LE(0xffff_ffff_ffff_fff0n, end + at))), null, `number at ${at}`);
    assert.equal(await classOf(changed((bytes) => bytes.writeBigUInt64LE(1n << 33n, end + at))), null, `number at ${at}`);
  }
  const locator = whole.indexOf(Buffer.from('PK\x06\x07', 'latin1'));
  assert.equal(await classOf(changed((bytes) => bytes.writeBigUInt64LE(1n << 60n, locator + 8))), null, 'the end record elsewhere');
  // The extra field of an entry: cut short, or with sizes that the file does not have.
  const entry = whole.indexOf(Buffer.from('PK\x01\x02', 'latin1')), extra = entry + 46 + whole.readUInt16LE(entry + 28);
  assert.equal(whole.readUInt16LE(extra), 1, 'the field of zip64');
  assert.equal(await classOf(changed((bytes) => bytes.writeUInt16LE(8, extra + 2))), null, 'a number is missing');
  assert.equal(await classOf(changed((bytes) => bytes.writeUInt16LE(0x9999, extra))), null, 'no such field');
  await assert.rejects(classOf(changed((bytes) => bytes.writeBigUInt64LE(1n << 33n, extra + 12))), /scene\.xml is larger than 4 GB/);
  await assert.rejects(classOf(changed((bytes) => bytes.writeBigUInt64LE(1n << 20n, extra + 12))), /The archive is damaged/);
});

test('a zip that the page writes is read by others', async () => {
  const zip = new ZipWriter();
  await zip.add('Ana Sá_1/feedback.html', new Blob(['<p>']));
  await zip.add('empty.html', new Blob([]));
  assert.equal(await listed(zip.finish()), "None [('Ana Sá_1/feedback.html', 3), ('empty.html', 0)]");
});

test('tables are read as spreadsheets write them', () => {
  assert.equal(forCsv('=a "b"'), '"\'=a ""b"""');
  const table = readCsv('\uFEFFStudent;Mark;Comment\r\n"Ana\nSá";7,5;"a;""b"""\r\n;;\r\n\'=x;;\r\n', 'o.csv', ['student', 'mark', 'comment']);
  assert.deepEqual([table.count, table.at(0, 'student'), table.at(0, 'comment'), table.at(1, 'student'), table.at(0, 'task')], [2, 'Ana\nSá', 'a;"b"', '=x', '']);
  assert.throws(() => readCsv('a,b\n', 'o.csv', ['student']), /o\.csv, line 1: there is no column "student"/);
  assert.deepEqual(readOverrides('student,mark,comment\nana,"7,5",x\nrui,,y\n', 'o.csv'), [
    { student: 'ana', task: '', criterion: '', mark: 7.5, comment: 'x' }, { student: 'rui', task: '', criterion: '', mark: null, comment: 'y' }]);
  assert.throws(() => readOverrides('student,mark,comment\n\nana,many,x\n', 'o.csv'), /line 3: the mark is "many"/);
  const rows = [{ student: '-a', task: 't', criterion: 'lights', mark: 3, comment: 'c, "d"' }];
  assert.deepEqual(readOverrides(overridesCsv(rows), 'o.csv'), rows);
  assert.deepEqual(readGroups('submission,full name,identifier\nA,Ana,Participant 3\n', 'g.csv'), [{ submission: 'A', name: 'Ana', identifier: '3' }]);
});

const ana: Submission = { id: 'Ana Sá_17_assignsubmission_file_', ...studentOf('Ana Sá_17_assignsubmission_file_'), fileName: 'a.zip', bytes: 1 };
const grade = (points: number, more: Partial<Grade> = {}): Grade => ({
  state: 'graded', points, most: 100, passed: true, refused: false, present: 1, visible: true, penalty: 0, unexplained: { points: 0, share: 0 }, diagnostics: [], views: [],
  criteria: [{ measure: 'lights', points, most: 50, reason: 'x' }], findings: [], ...more,
});
const rubric = resolved({}, tables);
const task = (name: string, one: Grade): TaskMark => ({ task: name, grade: one, state: 'done' });

test('who is meant by a row', () => {
  assert.ok(['ana sá', 'ANA SÁ_17_assignsubmission_file_', '17', 'participant 17'].every((who) => isStudent(who, ana)));
  assert.ok(!['', 'ana', '7'].some((who) => isStudent(who, ana)));
  assert.deepEqual(membersOf([{ submission: '17', name: 'Bo', identifier: '4' }], ana), [{ name: 'Bo', identifier: '4' }]);
});

test("a person's mark stands over the program's", () => {
  const row = (criterion: string, mark: number | null, more = {}) => ({ student: '17', task: '', criterion, mark, comment: '', ...more });
  const marked = (rows: ReturnType<typeof row>[], one = grade(40)) => studentMark(ana, [task('', one)], [rubric], rows);
  assert.deepEqual([marked([row('Lights', 70)]).points, marked([row('lights', 5)]).points], [50, 5]); // at most the criterion's
  assert.deepEqual([marked([row('', 30)]).points, marked([row('', 30)]).overridden, marked([row('', 30)]).passed], [30, true, false]);
  assert.deepEqual(marked([row('', null, { comment: 'well' })]).comments, ['well']);
  const none = studentMark(ana, [{ task: '', failure: { code: 'x', message: 'gone' }, state: 'done' }], [rubric], []);
  assert.deepEqual([none.graded, none.points], [false, 0]);
  const two = [task('a', grade(40)), task('b', grade(20, { most: 20 }))], rubrics = [rubric, { ...rubric, points: 20, weight: 3 } as Rubric];
  assert.equal(studentMark(ana, two, rubrics, []).points, 85); // (40 % + 3 x 100 %) / 4
  assert.equal(studentMark(ana, two, rubrics, [row('', 0, { task: 'B' })]).points, 10);
});

test("the grade book's tables", () => {
  const cause = { code: 'light.missing', criterion: 'lights', message: 'a "spot", light', points: 1.5, seen: true, spoils: 0, places: [] };
  const marks = [studentMark(ana, [task('', grade(40, { findings: [cause] }))], [rubric], [{ student: '17', task: '', criterion: 'lights', mark: 41, comment: 'ok' }]),
    studentMark({ ...ana, id: '=cmd', name: '', identifier: '' }, [{ task: '', failure: { code: 'x', message: 'gone' }, state: 'done' }], [rubric], [])];
  const report = { title: 'R', tasks: [''], groups: [], marks };
  assert.deepEqual(gradesCsv(report).split('\r\n'), [
    'Identifier,Full name,Grade,Maximum Grade,Last modified (grade),Passed,Submission,Feedback comments',
    '"Participant 17","Ana Sá",41.00,100.00,,no,"Ana Sá_17_assignsubmission_file_","lights: ok\na ""spot"", light (-1.50)"',
    '"","",,100.00,,,"\'=cmd","gone"', '']);
  assert.deepEqual(criteriaCsv(report).split('\r\n'), ['Identifier,Full name,Submission,Grade,By hand,"lights"',
    '"Participant 17","Ana Sá","Ana Sá_17_assignsubmission_file_",41.00,yes,41.00', '"","","\'=cmd",,,', '']);
});

test('the first cause is that of the task that lost most', () => {
  const cause = (code: string, points: number) => ({ code, criterion: 'models', message: code, points, seen: true, spoils: 0, places: [] });
  const first = (...grades: Grade[]): string => firstCause(studentMark(ana, grades.map((one, i) => task(String(i), one)), grades.map(() => rubric), []));
  assert.equal(first(grade(40)), 'x');
  assert.equal(first(grade(50)), '');
  assert.equal(first(grade(90, { findings: [cause('a', 1), cause('b', 3)] }), grade(0, { findings: [cause('model.missing', 0)] })), 'model.missing');
  const error = { code: 'xml.unclosed', severity: 'error' as const, message: 'no end tag' };
  assert.equal(first(grade(60, { penalty: 40, criteria: [], diagnostics: [error] })), 'no end tag');
  assert.equal(first(grade(90, { findings: [cause('a', 1)] }), grade(95, { state: 'not graded', refused: true, reason: { code: 'c', message: 'no scene' } })), 'no scene');
});

test('a rubric is checked by the schema of the service, with lines', () => {
  const problems = (text: string): string[] => checkRubric(text, tables).problems.map(({ line, pointer, message }) => `${line} ${pointer} ${message}`);
  assert.deepEqual(problems(readFileSync('api/examples/rubric.json', 'utf8')), []);
  assert.deepEqual(problems(readFileSync('api/examples/solar.json', 'utf8')), []);
  assert.deepEqual(problems('{}'), []);
  assert.match(problems('{\n "points": \n}')[0] ?? '', /^\d {2}is no JSON/);
  assert.deepEqual(problems('{\n "points": "many",\n "criteria": [\n  { "measure": "lights", "weight": 2000 }\n ]\n}'), [
    '2 /points is "many"; expected a number from 0.01 to 10000', '4 /criteria/0/weight is "2000"; expected a number from 0 to 1000']);
  assert.match(problems('{"wieght": 1}')[0] ?? '', /^1 \/wieght is no key of a rubric; expected one of title, points/);
  assert.deepEqual(problems('{"criteria":[{"measure":"lights"},\n{"measure":"lights"}]}'), ['2 /criteria/1/measure is duplicated: "lights"']);
  assert.deepEqual(problems('{"points": 2,\n"manual":[{"id":"a","text":"b","points":3}]}'), ['1 /points is 2; requirements and parts marked by hand have 3 together']);
  assert.match(problems('{"criteria":[{"measure":"flip","tolerance":0.6}]}')[0] ?? '', /\/criteria\/0\/tolerance is not below the limit, 0.5/);
  assert.equal(lineOf('{"a": [1,\n {"b/c": 2}]}', '/a/1/b~1c'), 2);
});

test('what a rubric leaves out is the default', () => {
  assert.deepEqual(resolved({ criteria: [{ measure: 'flip' }, { measure: 'models', weight: 3 }] }, tables).criteria, [
    { measure: 'flip', weight: 5, tolerance: 0.05, limit: 0.5 }, { measure: 'models', weight: 3, perFinding: 0.5 }]);
  const solar = resolved(JSON.parse(readFileSync('api/examples/solar.json', 'utf8')) as Record<string, unknown>, tables);
  assert.equal(comparedPoints(solar), 0);
});

test('the mistakes of the example change a scene of the project', () => {
  const xml = readFileSync('scenes/robot-arm/scene.xml', 'utf8');
  for (const [name, plant] of Object.entries(mistakes)) assert.equal(plant(xml) === xml, name === 'none', name);
  assert.equal(mistakes.sign('<world/>'), null);
});
