import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Adaptation } from '../../../web/src/frames/adapt.ts';
import { Line } from '../../../web/src/frames/line.ts';
import { FrameLoop, restDelayMs, type Ask, type Shown } from '../../../web/src/frames/loop.ts';
import { FrameRate, median, parseServerTiming, splitLatency } from '../../../web/src/frames/timing.ts';

const sleep = (ms: number): Promise<void> => new Promise((done) => setTimeout(done, ms));

/** A loop whose answers come when the test says so. */
function harness(rested: (isAtRest: boolean) => void = () => undefined, retryMs: number | null = null) {
  const asked: (Ask & { answer: () => void; fail: (fault: unknown) => void; aborted: () => boolean })[] = [];
  const shown: Shown<string>[] = [], discarded: string[] = [], faults: unknown[] = [];
  const loop = new FrameLoop<string>({
    ask: (ask, signal) => new Promise((done, failed) => {
      signal.addEventListener('abort', () => failed(new DOMException('aborted', 'AbortError')));
      asked.push({ ...ask, answer: () => done({ picture: `#${ask.seq}`, serverTiming: null }), fail: failed, aborted: () => signal.aborted });
    }),
    show: (one) => shown.push(one), discard: (one) => discarded.push(one),
    failed: (fault) => {
      faults.push(fault);
      return retryMs;
    },
    now: () => performance.now(),
    rested,
  });
  return { loop, asked, shown, discarded, faults, last: () => asked[asked.length - 1] };
}

test('an older frame is never shown over a newer one', async () => {
  const { loop, asked, shown, discarded } = harness();
  loop.move();
  loop.move();
  assert.equal(asked.length, 2);
  asked[1]?.answer();
  await sleep(0);
  asked[0]?.answer();
  await sleep(0);
  assert.deepEqual(shown.map((one) => one.seq), [2]);
  assert.deepEqual(discarded, ['#1']);
  loop.stop();
});

test('many movements wait as one, with the newest view', async () => {
  const { loop, asked } = harness();
  for (let i = 0; i < 50; ++i) loop.move();
  assert.equal(asked.length, loop.pace.inFlight);
  asked[0]?.answer();
  await sleep(0);
  assert.equal(asked.length, loop.pace.inFlight + 1);
  loop.stop();
});

test('at rest is what shows the full picture of the last change, with nothing on its way', async () => {
  const rests: boolean[] = [], { loop, last } = harness((isAtRest) => rests.push(isAtRest));
  loop.settle();
  assert.deepEqual(rests, [], 'it begins without rest');
  last()?.answer();
  await sleep(0);
  assert.deepEqual(rests, [true]);
  loop.move();
  assert.deepEqual(rests, [true, false], 'at once');
  last()?.answer(); // a small frame is no rest, nor is the time until the full picture is asked for
  await sleep(restDelayMs + 60);
  assert.equal(rests.length, 2);
  last()?.answer();
  await sleep(0);
  assert.deepEqual(rests, [true, false, true]);
  loop.hold(true);
  loop.settle();
  last()?.answer();
  await sleep(0);
  assert.deepEqual(rests, [true, false, true, false], 'while something plays there is none');
  loop.hold(false);
  assert.equal(rests.at(-1), true);
  loop.settle();
  last()?.fail(new Error('gone'));
  await sleep(0);
  assert.equal(rests.at(-1), false, 'what is on show is older than the last change');
  loop.stop();
});

test('a failure is asked for again, unless something newer was asked for meanwhile', async () => {
  const { loop, asked, last } = harness(undefined, 30);
  loop.settle();
  last()?.fail(new Error('busy'));
  await sleep(60);
  assert.equal(asked.length, 2, 'asked again');
  last()?.fail(new Error('busy'));
  await sleep(0);
  loop.settle();
  last()?.answer();
  await sleep(60);
  assert.equal(asked.length, 3, 'nothing is left to be asked for');
  loop.stop();
});

test('rest asks for the full picture, and a movement gives it up', async () => {
  const { loop, asked, last } = harness();
  loop.move();
  assert.notEqual(asked[0]?.pace, null);
  await sleep(restDelayMs + 60);
  assert.equal(last()?.pace, null);
  const rest = last();
  loop.move();
  assert.equal(rest?.aborted(), true);
  assert.notEqual(last()?.pace, null);
  loop.stop();
});

test('while something plays there is no rest', async () => {
  const { loop, asked } = harness();
  loop.hold(true);
  loop.move();
  await sleep(restDelayMs + 60);
  assert.ok(asked.every((one) => one.pace !== null));
  loop.stop();
});

test('what another scene answers is void', async () => {
  const { loop, asked, shown, faults } = harness();
  loop.settle();
  loop.restart();
  asked[0]?.answer();
  await sleep(0);
  assert.equal(shown.length, 0);
  assert.equal(faults.length, 0);
  loop.stop();
});

test('a failure is told once, and the loop goes on', async () => {
  const { loop, asked, shown, faults } = harness();
  loop.settle();
  asked[0]?.fail(new Error('no'));
  await sleep(0);
  assert.equal(faults.length, 1);
  loop.settle();
  asked[1]?.answer();
  await sleep(0);
  assert.equal(shown.length, 1);
  assert.ok(loop.idle);
});

const latency = (total: number, network = 2) => ({ total, network, queue: 0, prepare: 0, draw: total - network, encode: 0 });

test('slow frames shrink, fast ones grow, and never to the full size', () => {
  const adaptation = new Adaptation();
  const first = adaptation.pace.scale;
  for (let i = 0; i < 40; ++i) adaptation.add(latency(200));
  assert.ok(adaptation.pace.scale < first);
  for (let i = 0; i < 400; ++i) adaptation.add(latency(6));
  assert.ok(adaptation.pace.scale > first && adaptation.pace.scale < 1);
});

test('a long way to the server is met by more requests, not by smaller frames', () => {
  const adaptation = new Adaptation();
  const first = adaptation.pace;
  for (let i = 0; i < 40; ++i) adaptation.add(latency(130, 120));
  assert.ok(adaptation.pace.inFlight > first.inFlight);
  assert.ok(adaptation.pace.scale >= first.scale);
  assert.equal(adaptation.pace.format, 'webp');
});

test('the time of a picture is split by Server-Timing', () => {
  assert.deepEqual(parseServerTiming('queue;dur=1.5, draw;desc="x";dur=3,encode'), { queue: 1.5, draw: 3 });
  const split = splitLatency(20, 'queue;dur=1, parse;dur=2, geometry;dur=3, draw;dur=4, readback;dur=1, encode;dur=2');
  assert.deepEqual(split, { total: 20, queue: 1, prepare: 5, draw: 5, encode: 2, network: 7, page: 0 });
  // Where the last byte's time is known, the rest is the page's own: it is not blamed on the network.
  const busy = splitLatency(20, 'queue;dur=1, draw;dur=9', 12);
  assert.deepEqual([busy.network, busy.page, busy.total], [2, 8, 20]);
  assert.equal(splitLatency(1, 'draw;dur=5').network, 0);
  assert.equal(median([3, 1, 2]), 2);
  const rate = new FrameRate();
  for (let i = 0; i <= 10; ++i) rate.add(i * 40);
  assert.ok(Math.abs(rate.rate(400) - 25) < 1e-9);
});

test('the line: the best of the last answers, and how many requests fill it', () => {
  const line = new Line();
  assert.ok(!line.isKnown && !line.isSlow && line.requestsFor(20000, 10) === 2);
  line.add({ bytes: 500, firstByteMs: 170, transferMs: 0 }, 10); // too small to show a bandwidth
  assert.deepEqual([line.bytesPerMs, line.isSlow], [Number.POSITIVE_INFINITY, true]); // but the way is long
  line.add({ bytes: 18700, firstByteMs: 175, transferMs: 100 }, 20);
  assert.deepEqual([line.roundTripMs, line.bytesPerMs, line.isSlow], [160, 187, true]);
  assert.equal(line.requestsFor(9350, 10), 5); // 50 ms each, 160 ms the way
  assert.equal(line.requestsFor(37400, 10), 2);
  // A near server on a busy machine is not a slow line.
  const near = new Line();
  near.add({ bytes: 500, firstByteMs: 25, transferMs: 0 }, 20);
  near.add({ bytes: 20000, firstByteMs: 30, transferMs: 60 }, 20);
  assert.ok(!near.isSlow);
  // Four better answers later the slow one is forgotten.
  for (let i = 0; i < 4; ++i) line.add({ bytes: 60000, firstByteMs: 22, transferMs: 10 }, 20);
  assert.ok(!line.isSlow);
});

test('the first full picture waits for the small one, which shows the line', async () => {
  const asked: (Ask & { answer: () => void })[] = [];
  const loop = new FrameLoop<string>({
    ask: (ask) => new Promise((done) => asked.push({
      ...ask, answer: () => done({ picture: '', serverTiming: null, wire: { wireMs: 300, bytes: 20000, firstByteMs: 160, transferMs: 107 } }),
    })),
    show: () => undefined, discard: () => undefined, failed: () => null, now: () => performance.now(), waitsForLine: true,
  });
  loop.move();
  await sleep(restDelayMs + 80);
  assert.equal(asked.length, 1);
  asked[0]?.answer();
  await sleep(10);
  assert.deepEqual(asked.map((one) => one.pace === null), [false, true]);
  assert.ok(loop.line.isSlow);
  loop.stop();
});
