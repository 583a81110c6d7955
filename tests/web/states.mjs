// Takes the pictures of the five views that once were the worst: docs/benchmarks/web-page.md shows them
// before and after.
//   FAROL_BINARY=build/release/farol node tests/web/states.mjs NAME [FOLDER]    NAME: before, after
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { launch, openPage, root, startServer, webp } from './e2e/fixture.mjs';

const [, , name = 'after', out = join(root, 'docs/images')] = process.argv;
const scratch = mkdtempSync(join(tmpdir(), 'farol-states-')), scenes = join(scratch, 'scenes');
mkdirSync(scenes);

const texture = `<world>
  <title>A crate</title>
  <camera><position x="2.4" y="1.8" z="3"/><lookAt x="0" y="0" z="0"/><projection fov="45" near="0.1" far="50"/></camera>
  <lights><light type="directional" dirX="0.3" dirY="1" dirZ="0.7"/></lights>
  <group>
    <models>
      <model file="box_2_1.3d"><texture file="textures/wood.png"/></model>
    </models>
  </group>
</world>
`;
const shapes = ['spheer_1_16_8.3d', 'box.3dd', 'cilindro_1_2.obj', 'tours_1_0.3_16_8.3d', 'con_1_2_16_3.3d'];
const findings = `<world>
  <title>Homework, first try</title>
  <lights><light type="directonal"/><light type="spot"/><light type="point" posX="a"/></lights>
  <group>
    <transform><translat x="1"/><rotate angle="1.57" y="1"/><scale x="0"/></transform>
    <models>
      <model file="box_1_1.3d"><color><diffuse R="300"/><specluar R="1"/></color></model>
      <model file="sphere_1_16_8.3d"><texture file="earth.jpg"/></model>
      <model fle="box_1.3d"/>
${shapes.map((file) => `      <model file="${file}"/>`).join('\n')}
    </models>
    <colour R="2"/>
  </group>
</world>
`;
writeFileSync(join(scenes, 'crate.xml'), texture);
writeFileSync(join(scenes, 'homework.xml'), findings);
writeFileSync(join(scenes, 'failed.xml'), 'sphere { <0, 0, 0>, 1 }\n');

const box = (angle) => `<world><window width="320" height="240"/>
<camera><position x="4" y="3" z="5"/><lookAt x="0" y="0" z="0"/><projection fov="50" near="1" far="50"/></camera>
<lights><light type="directional" dirx="1" diry="2" dirz="1"/></lights>
<group><transform><rotate angle="${angle}" x="0" y="1" z="0"/></transform><models><model file="box_2_2.3d"/></models></group></world>`;
const students = [['Ana Reis', 35], ['Bento Dias', -35], ['Carla Lopes', 35], ['Duarte Melo', 80]];
for (const [i, [student, angle]] of students.entries()) {
  mkdirSync(join(scratch, 'class', `${student}_${1001 + i}_assignsubmission_file`), { recursive: true });
  writeFileSync(join(scratch, 'class', `${student}_${1001 + i}_assignsubmission_file`, 'scene.xml'), box(angle));
}
spawnSync('python3', ['-c', 'import shutil, sys; shutil.make_archive(sys.argv[1], "zip", sys.argv[2])', join(scratch, 'class'), join(scratch, 'class')]);
writeFileSync(join(scratch, 'reference.xml'), box(35));

const [server, browser] = await Promise.all([startServer({ scenes }), launch()]);
const pause = (view) => view.page.waitForTimeout(4000);
const views = {
  failed: ['#/scene/failed', pause],
  texture: ['#/scene/crate', pause],
  findings: ['#/scene/homework', pause],
  dead: ['#/scene/~0123456789abcdef0123456789abcdef', pause],
  zip: ['#/grade', async (view) => {
    for (const [button, file] of [['Reference: choose files', 'reference.xml'], ['Submissions: choose files', 'class.zip']]) {
      const [chooser] = await Promise.all([view.page.waitForEvent('filechooser'), view.page.getByRole('button', { name: button }).click()]);
      await chooser.setFiles(join(scratch, file));
    }
    await view.page.getByRole('button', { name: 'Grade', exact: true }).click();
    await view.page.getByText(/^\d+ graded/).first().waitFor({ timeout: 120000 });
    await pause(view);
  }],
};
const converter = await browser.newPage();
for (const [key, [hash, ready]] of Object.entries(views)) {
  const view = await openPage(browser, `${server.url}/${hash}`, { colorScheme: 'light', viewport: { width: 960, height: 640 } });
  await ready(view);
  const path = join(out, `web-${name}-${key}.webp`);
  writeFileSync(path, await webp(converter, await view.page.screenshot(), 0.7));
  console.log(path);
  await view.close();
}
await browser.close();
await server.stop();
rmSync(scratch, { recursive: true, force: true });
