// How a drag feels: frames a second, and from the hand's movement to its picture. Reported, not judged.
//   FAROL_BINARY=build/release/farol node tests/web/measure.mjs [SCENE] [SECONDS] [REPEATS]
import { launch, openPage, settled, startServer } from './e2e/fixture.mjs';

const [, , scene = 'solar-system', seconds = '5', repeats = '3'] = process.argv;
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1] ?? Number.NaN;
const percentile = (values, p) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(values.length * p))] ?? Number.NaN;

const [server, browser] = await Promise.all([startServer(), launch()]);
const view = await openPage(browser, `${server.url}/#/scene/${scene}`, { viewport: { width: 512, height: 700 } });
await settled(view);
const { height } = await view.page.locator('.stage').boundingBox();
await view.page.setViewportSize({ width: 512, height: Math.round(700 + 512 - height) });
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
const area = await view.page.locator('.stage').boundingBox();
console.log(`stage ${area.width} x ${area.height}, scene ${scene}`);
for (let run = 0; run < Number(repeats); ++run) {
  await view.page.evaluate(() => ((window.frames_ = []), (window.inputs_ = 0)));
  await view.page.mouse.move(area.x + 256, area.y + 256);
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
  }), { x: area.x + 256, y: area.y + 256, forMs: Number(seconds) * 1000 });
  await view.page.mouse.up();
  const [frames, inputs] = await view.page.evaluate(() => [window.frames_, window.inputs_]);
  const rate = ((frames.length - 1) * 1000) / (frames.at(-1).at - frames[0].at), delays = frames.map((one) => one.delay);
  console.log(`${rate.toFixed(1)} frames/s, input to picture median ${median(delays).toFixed(0)} ms (90 % under ${percentile(delays, 0.9).toFixed(0)} ms), ` +
    `${(inputs / Number(seconds)).toFixed(0)} movements/s, frames ${median(frames.map((one) => one.width))} px wide (scale ${median(frames.map((one) => one.scale))})`);
  await settled(view);
}
await view.close();
await browser.close();
await server.stop();
