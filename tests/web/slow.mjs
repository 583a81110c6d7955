// What a slow line costs: 150 ms a round trip, 1.5 Mbit/s. Reported, not judged.
//   FAROL_BINARY=build/release/farol node tests/web/slow.mjs [SCENE] [REPEATS]
import { launch, openPage, settled, startServer, throttle } from './e2e/fixture.mjs';

const [, , scene = 'torch', repeats = '3'] = process.argv;
const [server, browser] = await Promise.all([startServer(), launch()]);
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1] ?? Number.NaN;
const until = (view, what, arg) => view.page.waitForFunction(what, arg, { timeout: 60000, polling: 20 });

for (const [width, height] of [[512, 512], [1280, 800], [1920, 1080]]) {
  const runs = [];
  for (let run = 0; run < Number(repeats); ++run) {
    const view = await openPage(browser, `${server.url}/#/new`, { viewport: { width, height } });
    await settled(view);
    await throttle(view);
    let bytes = 0;
    const client = await view.context.newCDPSession(view.page);
    await client.send('Network.enable');
    client.on('Network.loadingFinished', (event) => (bytes += event.encodedDataLength));
    const figures = {};
    let begin = performance.now();
    const note = (name) => Object.assign(figures, { [name]: performance.now() - begin, [`${name}Bytes`]: bytes });
    await view.page.evaluate((id) => (location.hash = `#/scene/${id}`), scene);
    await until(view, () => document.querySelector('.stage .preview')?.naturalWidth > 0 || Number(document.querySelector('.stage canvas')?.dataset.seq) > 0);
    note('first');
    const isSharp = () => {
      const canvas = document.querySelector('.stage canvas');
      return Number(canvas.dataset.seq) > 0 && canvas.width >= document.querySelector('.stage').clientWidth;
    };
    await until(view, isSharp);
    note('sharp');
    await settled(view);
    const area = await view.page.locator('.stage').boundingBox();
    const [x, y] = [area.x + area.width / 2, area.y + area.height / 2];
    await view.page.mouse.move(x, y);
    await view.page.mouse.down();
    for (let i = 1; i <= 50; ++i) {
      await view.page.mouse.move(x + 3 * i, y);
      await view.page.waitForTimeout(40);
    }
    const moving = view.moving().length;
    [begin, bytes] = [performance.now(), 0];
    await view.page.mouse.up();
    await until(view, isSharp);
    note('drag');
    figures.frames = moving;
    runs.push(figures);
    await view.close();
  }
  const of = (name) => median(runs.map((one) => one[name]));
  console.log(`${width} x ${height}: first image ${of('first').toFixed(0)} ms, ${(of('firstBytes') / 1000).toFixed(0)} kB; sharp ${of('sharp').toFixed(0)} ms, ` +
    `${(of('sharpBytes') / 1000).toFixed(0)} kB; sharp after a drag ${of('drag').toFixed(0)} ms, ${(of('dragBytes') / 1000).toFixed(0)} kB`);
}
await browser.close();
await server.stop();
