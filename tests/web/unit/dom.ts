// What modules of the page set when they are loaded, where there is no page; and what browsers have that Node.js 18 lacks.
import { Duplex } from 'node:stream';
import { createGunzip, createInflate, createInflateRaw } from 'node:zlib';

Object.assign(globalThis, { document: { documentElement: { lang: '' } } });

/** The formats of browsers; Node.js 18 has no deflate-raw. */
class Decompression {
  readonly readable: unknown;
  readonly writable: unknown;

  constructor(format: string) {
    const { readable, writable } = Duplex.toWeb(format === 'gzip' ? createGunzip() : format === 'deflate' ? createInflate() : createInflateRaw());
    this.readable = readable;
    this.writable = writable;
  }
}

try {
  new DecompressionStream('deflate-raw');
} catch {
  Object.assign(globalThis, { DecompressionStream: Decompression });
}
