// Thumbnails a few at a time, so that a full gallery does not fill the server's queue.
import { patient, request } from './api.ts';

const atOnce = 3;
const waiting: (() => void)[] = [];
let running = 0;

const turn = (): Promise<void> => new Promise((start) => {
  waiting.push(start);
  next();
});

function next(): void {
  if (running >= atOnce) return;
  const start = waiting.shift();
  if (!start) return;
  running += 1;
  start();
}

/** The picture's address, when it is in the browser's cache. */
export const thumbnail = (url: string, signal: AbortSignal): Promise<string> =>
  patient(async () => {
    await turn();
    try {
      signal.throwIfAborted();
      await request(url, { signal });
      return url;
    } finally {
      running -= 1;
      next();
    }
  });
