// Zips of files as they are: images, meshes and pages with images hardly get smaller.
const crcTable = Uint32Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c >>> 0;
});

/** The CRC-32 of zip and PNG. */
export function crc32(bytes: Uint8Array): number {
  let crc = 0xffffffff;
  for (const byte of bytes) crc = (crcTable[(crc ^ byte) & 255] as number) ^ (crc >>> 8);
  return (crc ^ 0xffffffff) >>> 0;
}

export class ZipWriter {
  private readonly parts: BlobPart[] = [];
  private readonly directory: BlobPart[] = [];
  private size = 0;
  private directorySize = 0;
  private count = 0;

  /** Adds a file; one is in memory at a time. */
  async add(path: string, file: Blob): Promise<void> {
    const name = new TextEncoder().encode(path), bytes = new Uint8Array(await file.arrayBuffer()), crc = crc32(bytes);
    /** A header of a length, with what both headers have from `at` on. */
    const header = (length: number, signature: number, at: number): DataView => {
      const view = new DataView(new ArrayBuffer(length));
      view.setUint32(0, signature, true);
      view.setUint16(at, 20, true); // version 2.0
      view.setUint16(at + 2, 0x800, true); // a name in UTF-8
      view.setUint32(at + 6, 0x00210000, true); // 1980-01-01: the same class gives the same bytes
      view.setUint32(at + 10, crc, true);
      view.setUint32(at + 14, bytes.length, true);
      view.setUint32(at + 18, bytes.length, true);
      view.setUint16(at + 22, name.length, true);
      return view;
    };
    const local = header(30, 0x04034b50, 4), entry = header(46, 0x02014b50, 6);
    entry.setUint16(4, 20, true);
    entry.setUint32(42, this.size, true);
    this.parts.push(local.buffer as ArrayBuffer, name as BlobPart, file);
    this.directory.push(entry.buffer as ArrayBuffer, name as BlobPart);
    this.size += 30 + name.length + bytes.length;
    this.directorySize += 46 + name.length;
    this.count += 1;
  }

  finish(): Blob {
    const end = new DataView(new ArrayBuffer(22));
    end.setUint32(0, 0x06054b50, true);
    end.setUint16(8, this.count, true);
    end.setUint16(10, this.count, true);
    end.setUint32(12, this.directorySize, true);
    end.setUint32(16, this.size, true);
    return new Blob([...this.parts, ...this.directory, end.buffer as ArrayBuffer], { type: 'application/zip' });
  }
}

export async function zipOf(files: readonly { path: string; file: Blob }[]): Promise<Blob> {
  const zip = new ZipWriter();
  for (const { path, file } of files) await zip.add(path, file);
  return zip.finish();
}
