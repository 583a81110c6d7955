// The editor, the inspector and uploads: text in, marks and pictures out.
import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync, cpSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { axeFindings, canvasPixels, draftOf, launch, openPage, root, settled, startServer } from './fixture.mjs';

let server, browser, scratch;
before(async () => {
  scratch = mkdtempSync(join(tmpdir(), 'farol-web-'));
  [server, browser] = await Promise.all([startServer(), launch()]);
});
after(async () => {
  await browser?.close();
  await server?.stop();
  rmSync(scratch, { recursive: true, force: true });
});

const openEditor = async (view) => {
  await view.page.getByRole('button', { name: 'Panel' }).click();
  await view.page.getByRole('tab', { name: 'XML' }).click();
  await view.page.locator('.cm-content').waitFor();
  await settled(view);
};
/** Puts the cursor behind the first place of a text, and types. */
async function typeAfter(view, text, typed, erase = 0) {
  await view.page.locator('.cm-content').click();
  await view.page.keyboard.press('Control+f');
  await view.page.locator('.cm-search input[name=search]').fill(text);
  await view.page.keyboard.press('End'); // the field takes its text in when a key is let go
  await view.page.keyboard.press('Enter');
  await view.page.keyboard.press('Escape');
  await view.page.keyboard.press('ArrowRight');
  for (let i = 0; i < erase; ++i) await view.page.keyboard.press('Backspace');
  await view.page.keyboard.insertText(typed);
}
/** The lines that carry a squiggle of that severity. */
const marked = (view, severity) => view.page.locator(`.cm-line:has(.cm-lintRange-${severity})`).allInnerTexts();

test('what is typed is drawn; an error marks its line and names the fix', async () => {
  const view = await openPage(browser, `${server.url}/#/scene/torch`, { viewport: { width: 1000, height: 640 } });
  await settled(view);
  await openEditor(view);
  const source = await (await fetch(`${server.url}/v1/scenes/torch/source`)).text();
  const file = /<model file="([^"]+)"/.exec(source)[1], before = await canvasPixels(view.page);
  await typeAfter(view, '<model file="', 'x');
  await view.page.locator('.drawer.error .drawer-tab').click();
  await view.page.locator('.findings .error').first().waitFor();
  const lines = await marked(view, 'error');
  assert.equal(lines.length, 1);
  assert.match(lines[0], new RegExp(`"x${file.replaceAll('.', '\\.')}"`));
  const sentence = await view.page.locator('.findings .error').first().innerText();
  assert.match(sentence, new RegExp(`Line ${source.slice(0, source.indexOf(`<model file="${file}"`)).split('\n').length}, column \\d+: There is no file`));
  await view.page.locator('.cm-lintRange-error').hover();
  await view.page.locator('.cm-tooltip .cm-diagnostic').waitFor();
  // A marked box stands for the missing mesh.
  await settled(view);
  const placeholder = await canvasPixels(view.page);
  assert.notDeepEqual(placeholder, before);
  // Where nothing can be drawn, the last image stays.
  await view.page.locator('.cm-content').click();
  await view.page.keyboard.press('Control+a');
  await view.page.keyboard.press('Delete'); // text over a selection: the browser would add styles of its own
  await view.page.keyboard.insertText('sphere { <0, 0, 0>, 1 }');
  await view.page.locator('.findings .error').filter({ hasText: 'Line 1' }).first().waitFor();
  assert.deepEqual(await canvasPixels(view.page), placeholder);
  // Mended, it is drawn again; another number is another picture.
  await view.page.locator('.cm-content').click();
  for (let i = 0; i < 3; ++i) await view.page.keyboard.press('Control+z');
  await view.page.waitForFunction(() => document.querySelectorAll('.findings .error').length === 0);
  await view.close();
});

test('edits outlive a reload, and can be given up', async () => {
  const view = await openPage(browser, `${server.url}/#/scene/torch`, { viewport: { width: 1000, height: 640 } });
  await settled(view);
  await openEditor(view);
  const before = await canvasPixels(view.page);
  await typeAfter(view, '<world>', '\n    <background color="#ff0000"/>');
  await view.page.reload(); // at once: nothing waits for a pause
  await settled(view);
  await view.page.getByText('Your edits of this scene were restored.').waitFor();
  assert.match(await draftOf(view, 'torch'), /<background color="#ff0000"\/>/);
  assert.equal(view.full().at(-1).method, 'POST');
  await view.page.getByRole('button', { name: 'Discard the edits' }).first().click();
  await settled(view);
  assert.equal(await draftOf(view, 'torch'), null);
  assert.equal(view.full().at(-1).method, 'GET');
  void before;
  await view.close();
});

test('completion offers the elements and attributes of the schema', async () => {
  const view = await openPage(browser, `${server.url}/#/new`, { viewport: { width: 1000, height: 640 } });
  await settled(view);
  await view.page.locator('.cm-content').waitFor();
  await typeAfter(view, '<light type="directional"', ' cu');
  await view.page.keyboard.press('Control+Space');
  const options = view.page.locator('.cm-tooltip-autocomplete li');
  await options.first().waitFor();
  assert.equal((await options.allInnerTexts())[0], 'cutoff');
  await view.page.keyboard.press('Escape');
  await view.close();
});

test('the reference shows the element at the cursor, marks the attribute, and can be browsed', async () => {
  const view = await openPage(browser, `${server.url}/#/new`, { viewport: { width: 1200, height: 900 }, bypassCSP: true });
  await settled(view);
  await view.page.locator('.cm-content').waitFor();
  await typeAfter(view, '<light type="directional"', ' cutoff="20');
  const reference = view.page.getByRole('region', { name: 'Reference' }), element = reference.getByRole('combobox', { name: 'Element' });
  await view.page.waitForFunction(() => document.querySelector('.reference select')?.value === 'light');
  // As in the service's own tables.
  const { elements } = JSON.parse(readFileSync(join(root, 'api/schema.json'), 'utf8')), light = elements.find(({ name }) => name === 'light');
  assert.deepEqual(await reference.locator('dt').allInnerTexts(), light.attributes.map(({ name }) => name));
  assert.ok((await reference.innerText()).includes(light.attributes.find(({ name }) => name === 'cutoff').meaning.replaceAll('`', '')));
  assert.equal(await reference.locator('.here dt').innerText(), 'cutoff');
  assert.deepEqual(await axeFindings(view.page), []);
  await element.selectOption('model');
  assert.equal(await reference.locator('.here').count(), 0);
  await reference.getByRole('button', { name: 'color', exact: true }).click();
  assert.equal(await element.inputValue(), 'color');
  // What is selected in the tree is the element at the cursor.
  await view.page.getByRole('tab', { name: 'Tree' }).click();
  await view.page.getByRole('treeitem', { name: 'Camera' }).click();
  await view.page.getByRole('tab', { name: 'XML' }).click();
  await view.page.waitForFunction(() => document.querySelector('.reference select')?.value === 'camera');
  await view.page.getByRole('button', { name: 'Reference', exact: true }).click();
  await reference.waitFor({ state: 'detached' });
  await view.page.reload();
  await view.page.locator('.cm-content').waitFor();
  assert.equal(await reference.count(), 0, 'it stays closed');
  await view.close();
});

test('a click on a pixel selects the line of its model', async () => {
  const view = await openPage(browser, `${server.url}/#/scene/solar-system`, { viewport: { width: 1000, height: 640 } });
  await settled(view);
  await openEditor(view);
  const area = await view.page.locator('.stage').boundingBox();
  // The sun is where the scene's camera has its origin: find a pixel of it in the picture of numbers.
  const url = new URL(view.full().at(-1).url);
  for (const name of ['session', 'seq', 'aa']) url.searchParams.delete(name);
  url.searchParams.set('layer', 'id');
  const places = await (await fetch(`${server.url}/v1/scenes/solar-system/models`)).json();
  const sun = places.copies.findIndex((element) => places.models[element].model === 'sphere_1_48_32.3d') + 1;
  const [x, y] = await view.page.evaluate(async ([address, number]) => {
    const bitmap = await createImageBitmap(await (await fetch(`${address}&aa=1`)).blob(), { colorSpaceConversion: 'none' });
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [bitmap.width, bitmap.height];
    const context = canvas.getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height), found = [];
    for (let i = 0; i < data.length; i += 4)
      if (data[i] * 65536 + data[i + 1] * 256 + data[i + 2] === number) found.push(i / 4);
    const middle = found[found.length >> 1];
    return [((middle % canvas.width) + 0.5) / canvas.width, (Math.floor(middle / canvas.width) + 0.5) / canvas.height];
  }, [url.href, sun]);
  await view.page.mouse.click(area.x + x * area.width, area.y + y * area.height);
  await view.page.waitForFunction((line) => {
    const root = document.querySelector('.code').shadowRoot;
    return root.querySelector('.cm-activeLineGutter')?.textContent === String(line);
  }, places.models[places.copies[sun - 1]].line);
  await view.close();
});

test('the inspector’s sliders write into the XML and leave its lines', async () => {
  const view = await openPage(browser, `${server.url}/#/scene/torch`, { viewport: { width: 1000, height: 640 } });
  await settled(view);
  await view.page.getByRole('button', { name: 'Panel' }).click();
  await view.page.getByRole('tab', { name: 'Inspect' }).click();
  await view.page.locator('.parts button').filter({ hasText: 'Light' }).first().click();
  await settled(view);
  const before = await canvasPixels(view.page), source = await (await fetch(`${server.url}/v1/scenes/torch/source`)).text();
  await view.page.getByRole('slider', { name: 'Diffuse red' }).fill('10');
  await settled(view);
  assert.notDeepEqual(await canvasPixels(view.page), before);
  const draft = (await draftOf(view, 'torch')).split('\n'), lines = source.split('\n');
  assert.equal(draft.length, lines.length);
  assert.equal(draft.filter((line, i) => line !== lines[i]).length, 1);
  await view.page.getByRole('button', { name: 'Discard the edits' }).first().click();
  await view.close();
});

test('a folder with textures is stored and opened, and its link works for others', async () => {
  const folder = join(scratch, 'my-scene');
  mkdirSync(join(folder, 'textures'), { recursive: true });
  cpSync(join(root, 'scenes/solar-system/earth.jpg'), join(folder, 'textures/earth.jpg'));
  writeFileSync(join(folder, 'ball.xml'), '<world><title>My ball</title><group><models><model file="sphere_1_32_16.3d"><texture file="textures/earth.jpg"/></model></models></group></world>');
  const view = await openPage(browser, `${server.url}/`);
  await view.page.waitForSelector('.card:not(.ghost)');
  const [chooser] = await Promise.all([view.page.waitForEvent('filechooser'), view.page.getByRole('button', { name: 'Open a folder' }).click()]);
  await chooser.setFiles(folder);
  await view.page.waitForURL(/#\/scene\/~|#\/scene\/%7E/);
  await settled(view);
  assert.equal(await view.page.locator('h1').innerText(), 'My ball');
  const shown = await canvasPixels(view.page);
  const other = await openPage(browser, view.page.url());
  await settled(other);
  assert.deepEqual(await canvasPixels(other.page), shown);
  // The texture was found: without it the ball would be one colour.
  assert.ok(readFileSync(join(folder, 'textures/earth.jpg')).length > 0);
  const colors = await other.page.evaluate(() => {
    const canvas = document.querySelector('.stage canvas'), { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const seen = new Set();
    for (let i = 0; i < data.length; i += 4) seen.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
    return seen.size;
  });
  assert.ok(colors > 500, `${colors} colours`);
  await other.close();
  await view.close();
});

test('a broken scene that is dropped shows its diagnostics, and is mended in place', async () => {
  const view = await openPage(browser, `${server.url}/`, { viewport: { width: 1000, height: 640 } });
  await view.page.waitForSelector('.card:not(.ghost)');
  const broken = '<world><title>A try</title>\n  <group>\n    <models>\n      <model file="nothing.3d"/>\n      <model file="sphere_1_16_8.3d"/>\n    </models>\n  </group>\n</world>\n';
  const data = await view.page.evaluateHandle((text) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([text], 'broken.xml', { type: 'text/xml' }));
    return transfer;
  }, broken);
  await view.page.dispatchEvent('body', 'dragover', { dataTransfer: data });
  await view.page.dispatchEvent('body', 'drop', { dataTransfer: data });
  await view.page.locator('.findings .error').first().waitFor();
  await view.page.locator('.cm-content').waitFor();
  assert.equal(await view.page.locator('h1').innerText(), 'A try');
  await view.page.waitForFunction(() => document.querySelector('.code').shadowRoot.querySelector('.cm-lintRange-error'));
  assert.deepEqual((await marked(view, 'error')).map((line) => line.trim()), ['<model file="nothing.3d"/>']);
  await typeAfter(view, 'nothing.3d', 'box_1_1.3d', 10);
  await settled(view);
  assert.equal(await view.page.locator('.findings .error').count(), 0);
  await view.page.getByRole('button', { name: 'Store and share' }).click();
  await view.page.waitForURL(/#\/scene\/(~|%7E)/);
  await settled(view);
  await view.close();
});
