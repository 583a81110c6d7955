// Where the time of a picture went, from its Server-Timing header and the clock here.
import type { Transfer } from './line.ts';

export interface Latency {
  total: number; // ms, from the request to the decoded picture
  network: number; // under way: what the server did not spend until the last byte came
  queue: number;
  prepare: number; // parse and geometry
  draw: number; // draw and readback
  encode: number;
  page: number; // decoding, and waiting for this page, which may be busy
}

/** "queue;dur=1.5, draw;dur=3" -> { queue: 1.5, draw: 3 } */
export function parseServerTiming(header: string | null): Record<string, number> {
  const out: Record<string, number> = {};
  for (const entry of (header ?? '').split(',')) {
    const [name, ...parameters] = entry.split(';').map((part) => part.trim());
    const dur = parameters.find((part) => part.startsWith('dur='));
    const value = Number(dur?.slice(4));
    if (name && dur && Number.isFinite(value)) out[name] = value;
  }
  return out;
}

/** `wire` is the time from the request to its last byte; null where the browser does not tell it. */
export function splitLatency(total: number, header: string | null, wire: number | null = null): Latency {
  const t = parseServerTiming(header);
  const of = (...names: string[]): number => names.reduce((sum, name) => sum + (t[name] ?? 0), 0);
  const queue = of('queue'), prepare = of('parse', 'geometry'), draw = of('draw', 'readback'), encode = of('encode');
  const until = wire === null ? total : Math.min(wire, total);
  return { total, queue, prepare, draw, encode, network: Math.max(0, until - queue - prepare - draw - encode), page: total - until };
}

/** Frames a second over the last second, from the times at which frames were shown. */
export class FrameRate {
  private times: number[] = [];
  add(now: number): void {
    this.times.push(now);
    if (this.times.length > 240) this.times.shift();
  }
  rate(now: number): number {
    const recent = this.times.filter((time) => now - time <= 1000);
    const first = recent[0], last = recent[recent.length - 1];
    if (first === undefined || last === undefined || last === first) return 0;
    return ((recent.length - 1) * 1000) / (last - first);
  }
  clear(): void {
    this.times = [];
  }
}

export interface WireTime extends Transfer {
  wireMs: number; // from the request to its last byte, with the connection
}

/** How an answer came. It frees the browser's record, which holds few of them. */
export function takeWireTime(url: string): WireTime | null {
  const entry = performance.getEntriesByName(url, 'resource').at(-1) as PerformanceResourceTiming | undefined;
  performance.clearResourceTimings();
  if (!entry || entry.responseEnd <= 0) return null;
  return {
    wireMs: entry.responseEnd - entry.startTime, bytes: entry.encodedBodySize,
    firstByteMs: entry.responseStart - entry.requestStart, transferMs: entry.responseEnd - entry.responseStart,
  };
}

export function median(values: readonly number[]): number {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  if (sorted.length === 0) return 0;
  if (sorted.length % 2) return sorted[middle] as number;
  return ((sorted[middle - 1] as number) + (sorted[middle] as number)) / 2;
}
