// How a drag feels on stages of three sizes: frames a second, and from the hand's movement to its image. Reported, not judged.
//   FAROL_BINARY=build/release/farol node tests/web/measure.mjs [SCENE] [SECONDS] [REPEATS]
import { readdirSync, readFileSync } from 'node:fs';
import { loadavg } from 'node:os';
import { launch, openPage, settled, startServer } from './e2e/fixture.mjs';

const [, , scene = 'solar-system', seconds = '5', repeats = '3'] = process.argv;
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1] ?? Number.NaN;
const percentile = (values, p) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(values.length * p))] ?? Number.NaN;

/** CPU time in ms of this process and each below it: server, workers and browser. Another load does not change it much. */
function cpuMs() {
  const parents = new Map(), times = new Map();
  for (const name of readdirSync('/proc').filter((one) => /^\d+$/.test(one))) {
    try {
      const fields = readFileSync(`/proc/${name}/stat`, 'utf8').replace(/^.*\) /s, '').split(' ');
      parents.set(Number(name), Number(fields[1]));
      times.set(Number(name), 10 * (Number(fields[11]) + Number(fields[12])));
    } catch {
      continue; // it has ended
    }
  }
  const isBelow = (id) => id === process.pid || (parents.has(id) && isBelow(parents.get(id)));
  return new Map([...times].filter(([id]) => isBelow(id)));
}

const [server, browser] = await Promise.all([startServer(), launch()]);
for (const [width, height] of [[512, 512], [1280, 800], [1920, 1080]]) {
  const view = await openPage(browser, `${server.url}/#/scene/${scene}`, { viewport: { width, height: height + 188 } });
  await settled(view);
  const around = height + 188 - (await view.page.locator('.stage').boundingBox()).height; // head, tools and time
  await view.page.setViewportSize({ width, height: Math.round(height + around) });
  await settled(view);
  await view.page.evaluate(() => {
    window.frames_ = [];
    const asked = new Map(), plain = window.fetch;
    let input = 0;
    window.inputs_ = 0;
    addEventListener('pointermove', () => {
      input = performance.now();
      window.inputs_ += 1;
    }, true);
    window.fetch = (url, init) => {
      const seq = new URL(url, location.href).searchParams.get('seq');
      if (seq) asked.set(seq, { input, scale: new URL(url, location.href).searchParams.get('scale') });
      return plain(url, init);
    };
    const canvas = document.querySelector('.stage canvas');
    new MutationObserver(() => {
      const of = asked.get(canvas.dataset.seq);
      if (of?.scale) window.frames_.push({ at: performance.now(), delay: performance.now() - of.input, scale: Number(of.scale), width: canvas.width });
    }).observe(canvas, { attributes: true, attributeFilter: ['data-seq'] });
  });
  const area = await view.page.locator('.stage').boundingBox(), middle = { x: area.x + area.width / 2, y: area.y + area.height / 2 };
  console.log(`stage ${area.width} x ${area.height}, scene ${scene}, load ${loadavg()[0].toFixed(1)}`);
  for (let run = 0; run < Number(repeats); ++run) {
    await view.page.evaluate(() => ((window.frames_ = []), (window.inputs_ = 0)));
    const before = cpuMs();
    await view.page.mouse.move(middle.x, middle.y);
    await view.page.mouse.down();
    // The hand moves within the page, every 8 ms: events sent from here come as slowly as a busy machine lets them.
    await view.page.evaluate(({ x, y, forMs }) => new Promise((done) => {
      const stage = document.querySelector('.stage'), begin = performance.now();
      let i = 0;
      const timer = setInterval(() => {
        i += 1;
        stage.dispatchEvent(new PointerEvent('pointermove', {
          pointerId: 1, bubbles: true, clientX: x + 150 * Math.sin(i / 40), clientY: y + 60 * Math.sin(i / 23),
        }));
        if (performance.now() - begin < forMs) return;
        clearInterval(timer);
        done();
      }, 8);
    }), { ...middle, forMs: Number(seconds) * 1000 });
    await view.page.mouse.up();
    const [frames, inputs] = await view.page.evaluate(() => [window.frames_, window.inputs_]);
    const cpu = [...cpuMs()].reduce((sum, [id, ms]) => sum + ms - (before.get(id) ?? 0), 0) / frames.length; // of those that go on
    const rate = ((frames.length - 1) * 1000) / (frames.at(-1).at - frames[0].at), delays = frames.map((one) => one.delay);
    console.log(`${rate.toFixed(1)} frames/s, input to image median ${median(delays).toFixed(0)} ms (90 % under ${percentile(delays, 0.9).toFixed(0)} ms), ` +
      `${(inputs / Number(seconds)).toFixed(0)} movements/s, ${cpu.toFixed(0)} ms of CPU time a frame, frames ${median(frames.map((one) => one.width))} px wide (scale ${median(frames.map((one) => one.scale))})`);
    await settled(view);
  }
  await view.close();
}
await browser.close();
await server.stop();
