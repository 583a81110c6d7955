// Takes the pictures of docs/images anew: light and dark at 1280 x 800, and at the width of a phone.
//   FAROL_BINARY=build/release/farol node tests/web/screenshots.mjs [FOLDER] [VIEW...]
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { launch, openPage, root, settled, startServer, webp } from './e2e/fixture.mjs';

const [, , out = join(root, 'docs/images'), ...wanted] = process.argv;
const [server, browser] = await Promise.all([startServer(), launch()]);
const looks = {
  '': { colorScheme: 'light', viewport: { width: 1280, height: 800 } },
  '-dark': { colorScheme: 'dark', viewport: { width: 1280, height: 800 } },
  '-phone': { colorScheme: 'dark', viewport: { width: 360, height: 740 }, hasTouch: true },
};

/** A scene of one file, for grading: nothing beside it is needed. */
const tower = (turn, color, lights = 1) => `<world>
 <window width="640" height="480"/>
 <camera><position x="7" y="5" z="8"/><lookAt x="0" y="1.4" z="0"/><projection fov="40" near="1" far="60"/></camera>
 <lights>${lights ? '\n  <light type="directional" dirx="1" diry="2" dirz="1.5"/>' : ''}\n  <light type="point" posx="-4" posy="5" posz="3" diffR="0.5" diffG="0.5" diffB="0.6"/>\n </lights>
 <group name="ground"><models><model file="plane_9_8.3d"><color><diffuse R="90" G="110" B="96"/></color></model></models></group>
 <group name="tower">
  <transform><translate y="1"/></transform>
  <models><model file="cylinder_1_2_32_4.3d"><color><diffuse R="${color}"/></color></model></models>
  <group name="beam">
   <transform><translate y="2.2"/><rotate angle="${turn}" y="1"/></transform>
   <models><model file="box_2.6_2.3d"><color><diffuse R="235" G="200" B="80"/></color></model></models>
  </group>
 </group>
</world>`;
const red = '190" G="60" B="50', grey = '150" G="150" B="150';
const file = (name, text) => ({ name, mimeType: 'text/xml', buffer: Buffer.from(text) });

const views = {
  async gallery(view) {
    await view.page.waitForSelector('.card img.loaded', { timeout: 60000 });
    // Until every thumbnail that is in sight is there.
    await view.page.waitForFunction(() => [...document.querySelectorAll('.card .thumbnail')].every((one) =>
      one.getBoundingClientRect().top > innerHeight || one.querySelector('img.loaded')), null, { timeout: 60000 });
  },
  viewer: settled,
  /** The timeline at a key, in another language. */
  async time(view) {
    await settled(view);
    await view.page.locator('.language select').selectOption('pt');
    const next = view.page.getByRole('button', { name: 'Chave seguinte' });
    for (let i = 0; i < 4; ++i) await next.click();
    await settled(view);
  },
  async share(view) {
    await settled(view);
    await view.page.getByRole('button', { name: 'Share', exact: true }).click();
    await view.page.locator('dialog.share').waitFor();
  },
  async editor(view) {
    await settled(view);
    if (!(await view.page.locator('.panel').isVisible())) await view.page.getByRole('button', { name: 'Panel', exact: true }).click();
    await view.page.getByRole('tab', { name: 'XML' }).click();
    await view.page.locator('.cm-content').click();
    await view.page.keyboard.press('Control+f');
    await view.page.locator('.cm-search input[name=search]').fill('.jpg"');
    await view.page.keyboard.press('End');
    await view.page.keyboard.press('Enter');
    await view.page.keyboard.press('Escape');
    await view.page.keyboard.press('ArrowLeft');
    await view.page.keyboard.insertText('x');
    await view.page.locator('.drawer.error .drawer-tab').click();
    await view.page.locator('.findings .error').first().waitFor();
    await view.page.waitForFunction(() => document.querySelector('.code').shadowRoot.querySelector('.cm-lintRange-error'));
  },
  async grade(view) {
    const choose = async (button, files) => {
      const [chooser] = await Promise.all([view.page.waitForEvent('filechooser'), view.page.getByRole('button', { name: button }).click()]);
      await chooser.setFiles(files);
    };
    const named = (name, number) => `${name}_${number}_assignsubmission_file_scene.xml`;
    await choose('Reference: choose files', [file('reference.xml', tower(35, red))]);
    await choose('Submissions: choose files', [
      file(named('Ana Reis', 1001), tower(35, red)), file(named('Bento Dias', 1002), tower(-35, red)), file(named('Carla Lopes', 1003), tower(35, grey)),
      file(named('Duarte Melo', 1004), tower(35, red, 0)), file(named('Eva Pinto', 1005), tower(35, red).replace('</models></group>', '</models>')),
    ]);
    await view.page.getByRole('button', { name: 'Grade', exact: true }).click();
    await view.page.getByText('5 graded.').waitFor({ timeout: 120000 });
    await view.page.locator('#list tbody tr', { hasText: 'Bento' }).click();
    await view.page.evaluate(async () => {
      await Promise.all([...document.querySelectorAll('#detail img')].map((one) => one.decode()));
      scrollBy(0, document.querySelector(innerWidth > 900 ? '.go' : '#detail').getBoundingClientRect().top - 12);
    });
    await view.page.waitForTimeout(300);
  },
};
const places = { gallery: '#/', viewer: '#/scene/solar-system', time: '#/scene/solar-system', share: '#/scene/torch', editor: '#/scene/can-and-pawns', grade: '#/grade' };

const converter = await browser.newPage();
for (const [name, ready] of Object.entries(views).filter(([view]) => wanted.length === 0 || wanted.includes(view)))
  for (const [suffix, look] of Object.entries(looks)) {
    const view = await openPage(browser, `${server.url}/${places[name]}`, look);
    await ready(view);
    await view.page.mouse.move(0, 0);
    await view.page.waitForTimeout(400); // fades and the overlay's last numbers
    const path = join(out, `web-${name}${suffix}.webp`);
    writeFileSync(path, await webp(converter, await view.page.screenshot()));
    console.log(path);
    await view.close();
  }
await browser.close();
await server.stop();
