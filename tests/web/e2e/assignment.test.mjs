// The student page of an assignment: a check in four languages, and what axe finds in it.
import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { axeFindings, launch, openPage, startServer } from './fixture.mjs';

const token = 'open sesame';
let server, browser, codes;

const scene = (angle, more = '') => `<world><window width="240" height="180"/>
<camera><position x="4" y="3" z="5"/><lookAt x="0" y="0" z="0"/><projection fov="50" near="1" far="50"/></camera>
<lights><light type="directional" dirx="1" diry="2" dirz="1"/></lights>
<group>
 <transform><translate x="1" y="0" z="0"/>
  <rotate angle="${angle}" x="0" y="0" z="1"/></transform>
 <models><model file="box_1_2.3d"/></models>
</group>${more}</world>`;
const ball = '<group><transform><translate x="-1" y="0" z="0"/></transform><models><model file="sphere_0.5_16_12.3d"/></models></group>';
const rubric = {
  points: 20,
  requirements: [
    { id: 'ball', text: 'A ball', points: 4, select: { shape: ['sphere'] } },
    { id: 'boxes', text: 'Two boxes', points: 4, count: 2, select: { shape: ['box'] } },
    { id: 'cone', text: 'A cone that moves', points: 2, select: { shape: ['cone'], moves: true } },
  ],
};

const teach = (path, init = {}) => fetch(`${server.url}/v1/assignments${path}`, { ...init, headers: { Authorization: `Bearer ${token}`, ...init.headers } });

async function assign(id, settings, withRubric = rubric) {
  const form = new FormData();
  form.append('assignment', new Blob([JSON.stringify(settings)]));
  if (withRubric) form.append('rubric', new Blob([JSON.stringify(withRubric)]));
  form.append('reference', new Blob([scene(40, ball)]), 'scene.xml');
  const answer = await teach(`/${id}`, { method: 'PUT', body: form });
  assert.ok(answer.ok, await answer.text());
  const students = { students: ['ana', 'bento', 'carla', 'david'] };
  const issued = await teach(`/${id}/codes`, { method: 'POST', body: JSON.stringify(students) });
  return (await issued.json()).codes.map((one) => one.code);
}

before(async () => {
  [server, browser] = await Promise.all([startServer({ args: ['--token', token, '--check-time', '0.1'] }), launch()]);
  codes = await assign('arm', { title: 'Robot arm', closes: '2199-12-01T12:00:00Z', shows: ['requirements', 'document', 'transforms'], mask: true, tries: 20, triesPerHour: 20 });
});
after(async () => {
  await browser?.close();
  await server?.stop();
});

const file = (text) => ({ name: 'mine.xml', mimeType: 'text/xml', buffer: Buffer.from(text) });
async function checked(view, words, code, text) {
  const [chooser] = await Promise.all([view.page.waitForEvent('filechooser'), view.page.getByRole('button', { name: words.choose }).click()]);
  await chooser.setFiles([file(text)]);
  await view.page.getByRole('textbox').fill(code);
  await view.page.getByRole('button', { name: words.check, exact: true }).click();
  await view.page.getByRole('heading', { name: words.result }).waitFor({ timeout: 60000 });
}

const words = {
  en: { choose: 'Choose files', check: 'Check', result: 'Result', unmet: 'not met', partly: 'partly met', met: 'met', line: 'line 6', differs: 'a transform here differs from the assignment' },
  pt: { choose: 'Escolher ficheiros', check: 'Verificar', result: 'Resultado', unmet: 'não cumprido', partly: 'cumprido em parte', met: 'cumprido', line: 'linha 6', differs: 'uma transformação aqui é diferente da tarefa' },
  es: { choose: 'Elegir archivos', check: 'Comprobar', result: 'Resultado', unmet: 'no cumplido', partly: 'cumplido en parte', met: 'cumplido', line: 'línea 6', differs: 'una transformación aquí difiere de la tarea' },
  cs: { choose: 'Vybrat soubory', check: 'Zkontrolovat', result: 'Výsledek', unmet: 'nesplněno', partly: 'splněno zčásti', met: 'splněno', line: 'řádek 6', differs: 'transformace se tu liší od zadání' },
};

for (const [language, text] of Object.entries(words))
  test(`a check shows what is met, with lines, and axe finds nothing: ${language}`, async () => {
    const wide = { colorScheme: 'light', viewport: { width: 1000, height: 900 } }, phone = { colorScheme: 'dark', viewport: { width: 360, height: 740 } };
    // In two languages all is done on the phone.
    const looks = ['pt', 'cs'].includes(language) ? [phone, wide] : [wide, phone];
    const view = await openPage(browser, `${server.url}/#/assignments/arm`, { ...looks[0], locale: language, bypassCSP: true });
    await checked(view, text, codes[Object.keys(words).indexOf(language)], scene(-40, ball));
    const states = (await view.page.locator('.requirements .state').allTextContents()).map((one) => one.trim());
    assert.deepEqual(states, [text.met, text.partly, text.unmet]);
    const all = await view.page.locator('.result').innerText();
    assert.match(all, new RegExp(`${text.differs}\\s*${text.line}`));
    assert.equal(await view.page.locator('html').getAttribute('lang'), language);
    assert.equal(await view.page.locator('.mask rect').count(), 192);
    await view.page.locator('.pictures img').evaluate((image) => image.decode());
    assert.ok(!all.includes('40'), 'an angle of the reference is shown');
    for (const { colorScheme, viewport } of looks) {
      await view.page.setViewportSize(viewport);
      await view.page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
      await view.page.waitForFunction((theme) => document.documentElement.dataset.theme === theme, colorScheme);
      assert.deepEqual(await axeFindings(view.page), [], `${language}, ${colorScheme}`);
      const width = await view.page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(width <= viewport.width, `${width} px wide at ${viewport.width}`);
      if (process.env.FAROL_SCREENSHOTS) {
        mkdirSync(process.env.FAROL_SCREENSHOTS, { recursive: true });
        await view.page.screenshot({ path: join(process.env.FAROL_SCREENSHOTS, `assignment-${language}-${colorScheme}.png`), fullPage: true });
      }
    }
    await view.close();
  });

test('the switch changes the language and is remembered', async () => {
  const view = await openPage(browser, `${server.url}/#/assignments/arm`, { locale: 'de-AT' });
  await view.page.getByRole('button', { name: words.en.check, exact: true }).waitFor();
  await view.page.getByRole('combobox').selectOption('cs');
  await view.page.getByRole('button', { name: words.cs.check, exact: true }).waitFor();
  await view.page.reload();
  await view.page.getByRole('button', { name: words.cs.check, exact: true }).waitFor();
  await view.close();
});

test('a scene that was dropped is checked, and a right one has no place that differs', async () => {
  const [code] = await assign('drop', { title: 'Drop', shows: ['models', 'transforms', 'document'] }, null);
  const view = await openPage(browser, `${server.url}/#/assignments/drop`, { locale: 'en' });
  await view.page.getByRole('textbox').fill(code);
  assert.ok(await view.page.getByRole('button', { name: 'Check', exact: true }).isDisabled());
  const transfer = await view.page.evaluateHandle((text) => {
    const data = new DataTransfer();
    data.items.add(new File([text], 'right.xml', { type: 'text/xml' }));
    return data;
  }, scene(40, ball));
  await view.page.locator('.drop-box').dispatchEvent('drop', { dataTransfer: transfer });
  await view.page.getByText('right.xml').waitFor();
  await view.page.getByRole('button', { name: 'Check', exact: true }).click();
  await view.page.getByText('75 to 100 % of the points').waitFor({ timeout: 60000 });
  await view.page.getByText('No place was found.').waitFor();
  await view.page.getByText('No errors or warnings.').waitFor();
  await view.close();
});

test('a wrong code, a closed assignment and a missing one are explained', async () => {
  await assign('closed', { title: 'Closed', closes: '2001-12-01T12:00:00Z' }, null);
  const view = await openPage(browser, `${server.url}/#/assignments/arm`, { locale: 'pt' });
  const [chooser] = await Promise.all([view.page.waitForEvent('filechooser'), view.page.getByRole('button', { name: words.pt.choose }).click()]);
  await chooser.setFiles([file(scene(40))]);
  await view.page.getByRole('textbox').fill('none');
  await view.page.getByRole('button', { name: words.pt.check, exact: true }).click();
  await view.page.getByText('o código falta ou está errado').waitFor();
  await view.page.goto(`${server.url}/#/assignments/closed`);
  await view.page.getByText('Fechada desde').waitFor();
  await view.page.goto(`${server.url}/#/assignments/nothing`);
  await view.page.getByText('Não há nenhuma tarefa com este nome.').waitFor();
  await view.close();
});

