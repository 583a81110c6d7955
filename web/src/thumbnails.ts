// Thumbnails a few at a time, so that a full gallery does not fill the server's queue.
import { Problem, request } from './api.ts';

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

/** The picture's address. A busy server is asked again a little later, and not for ever. */
export async function thumbnail(url: string, signal: AbortSignal): Promise<string> {
  for (let attempt = 1; ; ++attempt) {
    await turn();
    try {
      if (signal.aborted) throw new DOMException('aborted', 'AbortError');
      await request(url, { signal }); // into the browser's cache, which the picture is then taken from
      return url;
    } catch (fault) {
      if (!(fault instanceof Problem && fault.busy) || attempt > 4) throw fault;
      await new Promise((done) => setTimeout(done, (fault.retryAfterS ?? 1) * 1000 * attempt));
    } finally {
      running -= 1;
      next();
    }
  }
}
