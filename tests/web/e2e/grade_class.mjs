// A small class for the tests of the grade page.
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';

export const scene = (angle, shape = 'box_1_2.3d', light = '<light type="directional" dirx="1" diry="2" dirz="1"/>') => `<world><window width="160" height="120"/>
<camera><position x="4" y="3" z="5"/><lookAt x="0" y="0" z="0"/><projection fov="50" near="1" far="50"/></camera>
<lights>${light}</lights>
<group>
 <transform><translate x="1" y="0" z="0"/>
  <rotate angle="${angle}" x="0" y="0" z="1"/></transform>
 <models><model file="${shape}"><color><diffuse R="200" G="90" B="40"/></color></model></models>
</group></world>`;
export const notAScene = 'sphere { <0, 0, 0>, 1 }';

export const file = (name, text) => ({ name, mimeType: name.endsWith('.json') ? 'application/json' : 'application/octet-stream', buffer: Buffer.from(text) });

export const choose = async (view, button, files) => {
  const [chooser] = await Promise.all([view.page.waitForEvent('filechooser'), view.page.getByRole('button', { name: button }).click()]);
  await chooser.setFiles(files);
};

/** Writes files into a new folder: its path, and a function that removes it. */
export function folderOf(files) {
  const folder = mkdtempSync(join(tmpdir(), 'farol-grade-'));
  for (const [path, text] of Object.entries(files)) {
    mkdirSync(dirname(join(folder, path)), { recursive: true });
    writeFileSync(join(folder, path), text);
  }
  return { folder, remove: () => rmSync(folder, { recursive: true }) };
}

/** A zip of files, as another program packs it. */
export function zipOf(files) {
  const { folder, remove } = folderOf(files);
  const pack = `import sys, zipfile, pathlib
z = zipfile.ZipFile(sys.argv[2], 'w', zipfile.ZIP_DEFLATED)
[z.write(p, p.relative_to(sys.argv[1])) for p in sorted(pathlib.Path(sys.argv[1]).rglob('*')) if p.is_file()]
z.close()`;
  const { status, stderr } = spawnSync('python3', ['-c', pack, folder, `${folder}.zip`], { encoding: 'utf8' });
  if (status !== 0) throw new Error(stderr);
  const bytes = readFileSync(`${folder}.zip`);
  rmSync(`${folder}.zip`);
  remove();
  return bytes;
}

/** Opens a zip: contents by path. */
export function unzipped(bytes) {
  const script = 'import sys, io, json, zipfile\nz = zipfile.ZipFile(io.BytesIO(sys.stdin.buffer.read()))\nassert z.testzip() is None\nprint(json.dumps({i.filename: z.read(i).decode() for i in z.infolist()}))';
  const { status, stdout, stderr } = spawnSync('python3', ['-c', script], { input: bytes, encoding: 'utf8', maxBuffer: 1 << 28 });
  if (status !== 0) throw new Error(stderr);
  return JSON.parse(stdout);
}

export const moodle = (name, number) => `${name}_${number}_assignsubmission_file_`;

/** Moodle's zip of a class with two tasks, "box" and "ball". */
export const references = { 'box.xml': scene(40), 'ball.xml': scene(20, 'sphere_1_8_8.3d') };
export const classFiles = {
  [`${moodle('Ana Sá', 7)}/box.xml`]: scene(40), [`${moodle('Ana Sá', 7)}/ball.xml`]: scene(20, 'sphere_1_8_8.3d'),
  [`${moodle('Bento Dias', 8)}/work.zip`]: zipOf({ 'Box (final).xml': scene(-40), 'ball/scene.xml': scene(20, 'cone_1_2_8_4.3d') }),
  [`${moodle('Carla Lopes', 9)}box.xml`]: scene(40, 'box_1_2.3d', ''), [`${moodle('Carla Lopes', 9)}ball.xml`]: scene(25, 'sphere_1_8_8.3d'),
  [`${moodle('Duarte Melo', 10)}/box.xml`]: notAScene, [`${moodle('Duarte Melo', 10)}/ball.xml`]: scene(20, 'sphere_1_8_8.3d').replace('200', '40'),
  [`${moodle('Eva Pinto', 11)}/report.docx`]: 'words',
};
export const classZip = zipOf(classFiles);

/** Drops the class on the page and grades it. */
export async function gradeClass(view, { files = [], count = 10 } = {}) {
  await choose(view, 'Reference: choose files', Object.entries(references).map(([name, text]) => file(name, text)));
  await view.page.getByRole('list').getByText('ball', { exact: true }).waitFor();
  await choose(view, 'Submissions: choose files', [file('class.zip', classZip), ...files]);
  await view.page.locator('#list tbody tr').first().waitFor();
  await view.page.getByRole('button', { name: 'Grade', exact: true }).click();
  await view.page.getByText(`${count} graded.`).waitFor({ timeout: 120000 });
}

export const rowOf = (view, name) => view.page.locator('#list tbody tr', { hasText: name });
export const cellsOf = (view, name) => rowOf(view, name).locator('td').allInnerTexts();

/** Saves a report of the page. */
export async function saved(view, name) {
  await view.page.locator('.exports > summary').click();
  const [download] = await Promise.all([view.page.waitForEvent('download'), view.page.getByRole('button', { name: new RegExp(`^${name}`) }).click()]);
  return readFileSync(await download.path());
}
