// A lap of a scene's animation as one file: its frames are asked for one by one and put together here.
import { patient, query, request } from '../api.ts';
import { t } from '../words.ts';
import { crc32 } from '../zip.ts';
import { fetchPicture } from './frame.ts';
import type { Viewer } from './viewer.ts';

export interface AnimationPlan {
  format: 'apng' | 'webp' | 'mp4' | 'webm';
  width: number;
  height: number;
  fps: number;
  from: number; // the moment of the first frame, in s
  seconds: number; // of the scene's time
  speed: number; // of the scene's time in the file
}

export const maxFrames = 600;
/** Of a video, which the service writes. */
export const maxVideoFrames = 120;
const maxVideoPixels = 33_554_432;
export const isVideo = ({ format }: AnimationPlan): boolean => format === 'mp4' || format === 'webm';
export const endingOf = ({ format }: AnimationPlan): string => (format === 'apng' ? 'png' : format);
const maxBytes = 200e6;
const atOnce = 2;

export const frameCount = ({ seconds, speed, fps }: AnimationPlan): number => Math.max(1, Math.round((seconds / speed) * fps));

/** The moment that frame number `index` shows. */
export const frameTime = ({ from, speed, fps }: AnimationPlan, index: number): number => Number((from + (index * speed) / fps).toFixed(4));

/** The most frames that a file of this plan has. */
export const framesLimit = (plan: AnimationPlan): number =>
  (isVideo(plan) ? Math.min(maxVideoFrames, Math.floor(maxVideoPixels / (plan.width * plan.height))) : maxFrames);

/** Whether the service has what is on show: it writes videos of stored scenes. */
export const isAsStored = (viewer: Viewer): boolean => viewer.id !== null && !viewer.edited.value && viewer.marks.value.hidden.length === 0;

/** A lap as a video, which the service draws and writes; it sends nothing before it is done. */
export async function requestVideo(viewer: Viewer, plan: AnimationPlan, signal: AbortSignal): Promise<Blob> {
  const { time: _, ...view } = viewer.pictureOptions(), address = viewer.facts.value?.links.turntable;
  if (!address) throw new Error(t('The scene is not on the server'));
  const asked = { ...view, width: plan.width, height: plan.height, over: 'time', frames: frameCount(plan), fps: plan.fps, format: plan.format };
  return (await patient(() => request(`${address}?${query(asked)}`, { signal }))).blob();
}

/** `progress` gets the number of frames that are there. Rejects when a frame cannot be drawn, or by the signal. */
export async function drawAnimation(viewer: Viewer, plan: AnimationPlan, progress: (done: number) => void, signal: AbortSignal): Promise<Blob> {
  const count = frameCount(plan), frames = new Array<Uint8Array>(count), origin = viewer.origin(), options = viewer.pictureOptions();
  let next = 0, done = 0, bytes = 0;
  const work = async (): Promise<void> => {
    while (next < count) {
      const index = next++;
      const asked = { ...options, width: plan.width, height: plan.height, time: frameTime(plan, index), format: plan.format === 'apng' ? 'png' : 'webp', ...(plan.format === 'webp' ? { quality: 85 } : {}) };
      const response = await patient(() => fetchPicture(origin, asked, signal));
      signal.throwIfAborted();
      if (!response) throw new Error(t('The server did not draw frame {number}', { number: index + 1 }));
      const frame = new Uint8Array(await response.arrayBuffer());
      bytes += frame.length;
      if (bytes > maxBytes) throw new Error(t('The frames have more than {size} MB; choose a smaller size or fewer frames a second', { size: maxBytes / 1e6 }));
      frames[index] = frame;
      progress(++done);
    }
  };
  await Promise.all(Array.from({ length: Math.min(atOnce, count) }, work));
  return plan.format === 'apng' ? apngOf(frames, plan.fps) : animatedWebpOf(frames, plan.fps, plan);
}

const text = (bytes: Uint8Array, at: number): string => String.fromCharCode(...bytes.subarray(at, at + 4));
const viewOf = (bytes: Uint8Array): DataView => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
const broken = (): Error => new Error(t('The server sent a frame that cannot be read'));

interface Chunk {
  name: string;
  data: Uint8Array;
}

function pngChunks(png: Uint8Array): Chunk[] {
  const out: Chunk[] = [], view = viewOf(png);
  if (png.length < 8 || view.getUint32(0) !== 0x89504e47) throw broken();
  for (let at = 8; at + 12 <= png.length;) {
    const length = view.getUint32(at);
    if (at + 12 + length > png.length) throw broken();
    out.push({ name: text(png, at + 4), data: png.subarray(at + 8, at + 8 + length) });
    at += 12 + length;
  }
  return out;
}

function pngChunk(name: string, data: Uint8Array): Uint8Array {
  const out = new Uint8Array(12 + data.length), view = viewOf(out);
  view.setUint32(0, data.length);
  for (let i = 0; i < 4; ++i) out[4 + i] = name.charCodeAt(i);
  out.set(data, 8);
  view.setUint32(8 + data.length, crc32(out.subarray(4, 8 + data.length)));
  return out;
}

const numbers = (...values: readonly number[]): Uint8Array => {
  const out = new Uint8Array(4 * values.length), view = viewOf(out);
  values.forEach((value, i) => view.setUint32(4 * i, value));
  return out;
};

/** An animated PNG of images of one size and form, exactly as they are; it repeats for ever. */
export function apngOf(frames: readonly Uint8Array[], fps: number): Blob {
  const parts: Uint8Array[] = [new Uint8Array([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10])];
  let head = '', sequence = 0;
  frames.forEach((frame, index) => {
    const chunks = pngChunks(frame), own = chunks.find(({ name }) => name === 'IHDR')?.data;
    if (!own || own.length < 13) throw broken();
    if (index === 0) {
      head = own.join();
      parts.push(pngChunk('IHDR', own), pngChunk('acTL', numbers(frames.length, 0)));
      for (const { name, data } of chunks.slice(0, chunks.findIndex((one) => one.name === 'IDAT'))) if (name !== 'IHDR') parts.push(pngChunk(name, data));
    }
    if (own.join() !== head) throw broken();
    const control = new Uint8Array(26), view = viewOf(control), size = viewOf(own);
    view.setUint32(0, sequence++);
    view.setUint32(4, size.getUint32(0));
    view.setUint32(8, size.getUint32(4));
    view.setUint16(20, 1);
    view.setUint16(22, fps);
    parts.push(pngChunk('fcTL', control));
    for (const { name, data } of chunks) {
      if (name !== 'IDAT') continue;
      if (index === 0) parts.push(pngChunk('IDAT', data));
      else {
        const numbered = new Uint8Array(4 + data.length);
        viewOf(numbered).setUint32(0, sequence++);
        numbered.set(data, 4);
        parts.push(pngChunk('fdAT', numbered));
      }
    }
  });
  parts.push(pngChunk('IEND', new Uint8Array()));
  return new Blob(parts as BlobPart[], { type: 'image/apng' });
}

function riffChunk(name: string, ...data: readonly Uint8Array[]): Uint8Array {
  const length = data.reduce((sum, one) => sum + one.length, 0), out = new Uint8Array(8 + length + (length % 2));
  for (let i = 0; i < 4; ++i) out[i] = name.charCodeAt(i);
  viewOf(out).setUint32(4, length, true);
  let at = 8;
  for (const one of data) {
    out.set(one, at);
    at += one.length;
  }
  return out;
}

/** Little-endian numbers of 24 bits. */
const triples = (...values: readonly number[]): Uint8Array => Uint8Array.from(values.flatMap((value) => [value & 255, (value >> 8) & 255, (value >> 16) & 255]));

/** An animated WebP of opaque images of one size; it repeats for ever. */
export function animatedWebpOf(frames: readonly Uint8Array[], fps: number, { width, height }: { width: number; height: number }): Blob {
  const size = triples(width - 1, height - 1);
  const parts = [riffChunk('VP8X', new Uint8Array([2, 0, 0, 0]), size), riffChunk('ANIM', new Uint8Array([0, 0, 0, 255, 0, 0]))];
  frames.forEach((frame, index) => {
    if (frame.length < 20 || text(frame, 0) !== 'RIFF' || text(frame, 8) !== 'WEBP') throw broken();
    const view = viewOf(frame);
    let pixels: Uint8Array | null = null;
    for (let at = 12; at + 8 <= frame.length;) {
      const length = view.getUint32(at + 4, true), name = text(frame, at), end = at + 8 + length + (length % 2);
      if (end > frame.length) throw broken();
      if (name === 'VP8 ' || name === 'VP8L') pixels = frame.subarray(at, end);
      at = end;
    }
    if (!pixels) throw broken();
    // Of the rounded moments of this frame and the next, so that the whole has its length.
    const ms = Math.round((1000 * (index + 1)) / fps) - Math.round((1000 * index) / fps);
    parts.push(riffChunk('ANMF', triples(0, 0), size, triples(ms), new Uint8Array([2]), pixels)); // 2: it replaces what was there
  });
  const length = 4 + parts.reduce((sum, one) => sum + one.length, 0), head = new Uint8Array(12);
  head.set([0x52, 0x49, 0x46, 0x46]);
  viewOf(head).setUint32(4, length, true);
  head.set([0x57, 0x45, 0x42, 0x50], 8);
  return new Blob([head, ...parts] as BlobPart[], { type: 'image/webp' });
}
