// A class of 200 on the grade page: memory of the page's script, and times. Reported, not judged.
//   FAROL_BINARY=build/release/farol node tests/web/class.mjs [SUBMISSIONS]
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { launch, openPage, startServer } from './e2e/fixture.mjs';
import { choose, file, scene } from './e2e/grade_class.mjs';

const count = Number(process.argv[2] ?? 200), folder = mkdtempSync(join(tmpdir(), 'farol-class-')), zip = join(folder, 'class.zip');
// Each student has a scene, a texture of 1.5 MB that nothing packs, and a film that stays in the browser.
const pack = `import os, sys, zipfile
noise, scene = os.urandom(1500000), sys.stdin.read()
z = zipfile.ZipFile(sys.argv[1], 'w', zipfile.ZIP_STORED)
for i in range(int(sys.argv[2])):
    folder = f'Student {i:04d}_{1000 + i}_assignsubmission_file_/'
    z.writestr(folder + 'scene.xml', scene.replace('angle="40"', f'angle="{40 if i % 4 == 0 else i}"'))
    z.writestr(folder + 'texture.png', noise)
    z.writestr(folder + 'film.mp4', noise)
z.close()`;
if (spawnSync('python3', ['-c', pack, zip, String(count)], { input: scene(40) }).status !== 0) throw new Error('no zip was made');

const [server, browser] = await Promise.all([startServer(), launch()]);
const view = await openPage(browser, `${server.url}/#/grade`, { viewport: { width: 1280, height: 900 } });
view.page.setDefaultTimeout(1800000);
const session = await view.context.newCDPSession(view.page);
await session.send('Performance.enable');
const heapMiB = async () => (await session.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'JSHeapUsedSize').value / 1048576;
let begin = Date.now();
async function log(what) {
  const seconds = ((Date.now() - begin) / 1000).toFixed(1);
  await session.send('HeapProfiler.collectGarbage');
  console.log(`${what}: ${seconds} s, heap ${(await heapMiB()).toFixed(1)} MiB`);
  begin = Date.now();
}

await choose(view, 'Reference: choose files', [file('reference.xml', scene(40))]);
await log('reference');
await choose(view, 'Submissions: choose files', zip);
await view.page.getByText(`${count} submissions`, { exact: true }).first().waitFor();
await log(`${(statSync(zip).size / 1e6).toFixed(0)} MB of ${count} submissions read`);
await view.page.getByRole('button', { name: 'Grade', exact: true }).click();
let highest = 0;
const timer = setInterval(async () => (highest = Math.max(highest, await heapMiB())), 300);
await view.page.getByText(`${count} graded.`).waitFor();
clearInterval(timer);
console.log(`highest heap with garbage: ${highest.toFixed(1)} MiB`);
await log('graded');
await view.page.reload();
await view.page.getByText(`${count} graded.`).waitFor();
await log('loaded again');
await view.page.getByRole('tab', { name: 'Rubric' }).click();
const times = [];
for (let i = 0; i < 15; ++i)
  times.push(await view.page.evaluate(async (value) => {
    const input = document.querySelector('input[aria-label="transforms weight"]'), start = performance.now();
    input.value = value;
    input.dispatchEvent(new Event('input', { bubbles: true }));
    await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
    return performance.now() - start;
  }, String(30 + i)));
console.log(`from a changed weight to all marks: median ${times.sort((a, b) => a - b)[7].toFixed(0)} ms`);
await view.close();
await browser.close();
await server.stop();
rmSync(folder, { recursive: true });
