// Archives that are read where they lie: a zip's directory first, its members as they are needed.
import { t } from '../words.ts';

const signature = { local: 0x04034b50, entry: 0x02014b50, end: 0x06054b50, end64: 0x06064b50, locator64: 0x07064b50 };
const endBytes = 22, end64Bytes = 56, locatorBytes = 20, entryBytes = 46, localBytes = 30;
const inExtra16 = 0xffff, inExtra32 = 0xffffffff; // the number is in a field of 64 bits elsewhere (zip64)
const extraOf64 = 1; // the kind of an entry's extra field
const maxDirectoryBytes = 64 * 1024 * 1024, maxEntries = 100_000;
const method = { stored: 0, deflated: 8 };
export const isArchiveName = (path: string): boolean => /\.(zip|tar|tgz|gz|7z|rar)$/i.test(path);

/** A file of a zip, as its directory has it. */
export interface ZipEntry {
  path: string;
  bytes: number;
  packed: number;
  offset: number;
  method: number;
  record: Uint8Array; // 46 bytes of the directory
}

/** Names that are not UTF-8 are read as Latin-1. */
function nameOf(bytes: Uint8Array): string {
  try {
    return new TextDecoder('utf-8', { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder('windows-1252').decode(bytes);
  }
}

const view = async (blob: Blob): Promise<DataView> => new DataView(await blob.arrayBuffer());

const uint64 = (from: DataView, at: number): number => Number(from.getBigUint64(at, true)); // beyond 2^53 it is larger than any file

/** Where a zip's directory is. */
interface Directory {
  count: number;
  size: number;
  begin: number;
}

async function findDirectory(zip: Blob): Promise<Directory | null> {
  const tail = await view(zip.slice(Math.max(0, zip.size - endBytes - 65535 - locatorBytes)));
  let end = tail.byteLength - endBytes;
  while (end >= 0 && tail.getUint32(end, true) !== signature.end) --end;
  if (end < 0) return null;
  const count = tail.getUint16(end + 10, true), size = tail.getUint32(end + 12, true), begin = tail.getUint32(end + 16, true);
  if (count !== inExtra16 && size !== inExtra32 && begin !== inExtra32) return { count, size, begin };
  const locator = end - locatorBytes;
  if (locator < 0 || tail.getUint32(locator, true) !== signature.locator64) return { count, size, begin };
  const at = uint64(tail, locator + 8), record = await view(zip.slice(at, at + end64Bytes));
  if (record.byteLength < end64Bytes || record.getUint32(0, true) !== signature.end64) return null;
  return { count: uint64(record, 32), size: uint64(record, 40), begin: uint64(record, 48) };
}

/** An entry's sizes and place: numbers of 32 bits, or of 64 in its extra field. Null: that field lacks one. */
function extentOf(entry: DataView): Pick<ZipEntry, 'bytes' | 'packed' | 'offset'> | null {
  const nameBytes = entry.getUint16(28, true), extraEnd = entryBytes + nameBytes + entry.getUint16(30, true);
  let at = entryBytes + nameBytes;
  while (at + 4 <= extraEnd && entry.getUint16(at, true) !== extraOf64) at += 4 + entry.getUint16(at + 2, true);
  const end = at + 4 <= extraEnd ? Math.min(extraEnd, at + 4 + entry.getUint16(at + 2, true)) : 0;
  at += 4;
  const numbers = [24, 20, 42].map((place) => {
    const value = entry.getUint32(place, true);
    if (value !== inExtra32) return value;
    at += 8;
    return at <= end ? uint64(entry, at - 8) : Number.NaN;
  });
  const [bytes, packed, offset] = numbers as [number, number, number];
  return numbers.every(Number.isSafeInteger) ? { bytes, packed, offset } : null;
}

/** The files of a zip; null: it is none that can be read here. */
export async function zipEntries(zip: Blob): Promise<ZipEntry[] | null> {
  const found = await findDirectory(zip);
  if (!found) return null;
  const { count, size, begin } = found;
  if (count > maxEntries || size > maxDirectoryBytes || begin + size > zip.size) return null;
  const directory = await view(zip.slice(begin, begin + size));
  const entries: ZipEntry[] = [];
  for (let at = 0; entries.length < count;) {
    if (at + entryBytes > size || directory.getUint32(at, true) !== signature.entry) return null;
    const nameBytes = directory.getUint16(at + 28, true);
    const whole = entryBytes + nameBytes + directory.getUint16(at + 30, true) + directory.getUint16(at + 32, true);
    if (at + whole > size) return null;
    const extent = extentOf(new DataView(directory.buffer, at, whole));
    if (!extent) return null;
    entries.push({
      path: nameOf(new Uint8Array(directory.buffer, at + entryBytes, nameBytes)).replaceAll('\\', '/'),
      ...extent, method: directory.getUint16(at + 10, true),
      record: new Uint8Array(directory.buffer, at, entryBytes).slice(),
    });
    at += whole;
  }
  return entries;
}

/** The bytes of an entry as they are packed. */
async function packedBytes(zip: Blob, { offset, packed }: ZipEntry): Promise<Blob> {
  const local = await view(zip.slice(offset, offset + localBytes));
  if (local.byteLength < localBytes || local.getUint32(0, true) !== signature.local) throw new Error(t('The archive is damaged'));
  const data = offset + localBytes + local.getUint16(26, true) + local.getUint16(28, true);
  if (data + packed > zip.size) throw new Error(t('The archive is damaged'));
  return zip.slice(data, data + packed);
}

/** A zip of these entries under other names, of the bytes as they are packed. */
export async function repacked(zip: Blob, entries: readonly (ZipEntry & { name: string })[]): Promise<Blob> {
  const parts: BlobPart[] = [], directory: BlobPart[] = [];
  let size = 0, directorySize = 0;
  for (const one of entries) {
    const name = new TextEncoder().encode(one.name), entry = new DataView(one.record.slice().buffer);
    if (Math.max(one.bytes, one.packed, size) >= inExtra32) throw new Error(t('{name} is larger than 4 GB', { name: one.name }));
    if (entry.getUint16(6, true) === 45) entry.setUint16(6, 20, true); // no zip64 any more
    entry.setUint16(8, (entry.getUint16(8, true) & ~8) | 0x800, true); // sizes in the header, a name in UTF-8
    entry.setUint32(20, one.packed, true);
    entry.setUint32(24, one.bytes, true);
    entry.setUint16(28, name.length, true);
    entry.setUint16(30, 0, true); // no extra field, no comment
    entry.setUint16(32, 0, true);
    entry.setUint32(42, size, true);
    const record = new Uint8Array(entry.buffer), head = new Uint8Array(localBytes);
    head.set(record.subarray(6, 30), 4);
    new DataView(head.buffer).setUint32(0, signature.local, true);
    new DataView(head.buffer).setUint16(28, 0, true);
    parts.push(head as BlobPart, name as BlobPart, await packedBytes(zip, one));
    directory.push(record as BlobPart, name as BlobPart);
    size += localBytes + name.length + one.packed;
    directorySize += entryBytes + name.length;
  }
  const end = new DataView(new ArrayBuffer(endBytes));
  end.setUint32(0, signature.end, true);
  end.setUint16(8, entries.length, true);
  end.setUint16(10, entries.length, true);
  end.setUint32(12, directorySize, true);
  end.setUint32(16, size, true);
  return new Blob([...parts, ...directory, end.buffer], { type: 'application/zip' });
}

const tooLarge = (max: number): Error => new Error(t('A file is larger than {size} MiB', { size: Math.round(max / 1048576) }));

/** Unpacks a stream; throws Error where more than `max` bytes come out, before they are kept. */
async function unpacked(packed: Blob, format: CompressionFormat, max: number): Promise<Uint8Array> {
  const reader = packed.stream().pipeThrough(new DecompressionStream(format) as ReadableWritablePair<Uint8Array, Uint8Array>).getReader();
  const chunks: Uint8Array[] = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > max) {
      await reader.cancel();
      throw tooLarge(max);
    }
    chunks.push(value);
  }
  return new Uint8Array(await new Blob(chunks as BlobPart[]).arrayBuffer());
}

const maxNestedBytes = 64 * 1024 * 1024;

/** A file in an archive; its bytes are unpacked when they are asked for. */
export interface Member {
  path: string;
  bytes: number;
  read(max: number): Promise<Uint8Array>;
}

async function readSlice(blob: Blob, max: number): Promise<Uint8Array> {
  if (blob.size > max) throw tooLarge(max);
  return new Uint8Array(await blob.arrayBuffer());
}

async function readEntry(zip: Blob, entry: ZipEntry, max: number): Promise<Uint8Array> {
  const packed = await packedBytes(zip, entry);
  if (entry.method === method.stored) return readSlice(packed, max);
  if (entry.method !== method.deflated) throw new Error(t('A file is packed by a method that this page does not read'));
  return unpacked(packed, 'deflate-raw', max);
}

const tarBlock = 512, maxTarFiles = 50_000;

/** The regular files of a tar: 512 bytes of header each. */
async function tarMembers(tar: Blob): Promise<Member[] | null> {
  const members: Member[] = [];
  for (let at = 0; at + tarBlock <= tar.size && members.length < maxTarFiles;) {
    const header = new Uint8Array(await tar.slice(at, at + tarBlock).arrayBuffer());
    if (header.every((byte) => byte === 0)) break;
    const text = (from: number, length: number): string =>
      (nameOf(header.subarray(from, from + length)).split('\0')[0] ?? '').trim();
    const bytes = Number.parseInt(text(124, 12), 8);
    if (text(257, 5) !== 'ustar' || !(bytes >= 0)) return null;
    const prefix = text(345, 155), path = prefix ? `${prefix}/${text(0, 100)}` : text(0, 100);
    const blob = tar.slice(at + tarBlock, at + tarBlock + bytes);
    if (/^0?$/.test(text(156, 1))) members.push({ path, bytes, read: (max) => readSlice(blob, max) });
    at += tarBlock + Math.ceil(bytes / tarBlock) * tarBlock;
  }
  return members.length > 0 ? members : null;
}

async function membersHere(archive: Blob): Promise<Member[] | null> {
  const [a, b] = new Uint8Array(await archive.slice(0, 2).arrayBuffer());
  if (a === 0x1f && b === 0x8b) return tarMembers(new Blob([(await unpacked(archive, 'gzip', maxNestedBytes)) as BlobPart]));
  if (a !== 0x50 || b !== 0x4b) return tarMembers(archive);
  const entries = await zipEntries(archive);
  return entries && entries.filter(({ path }) => !path.endsWith('/'))
    .map((entry) => ({ path: entry.path, bytes: entry.bytes, read: (max: number) => readEntry(archive, entry, max) }));
}

/** Bytes of archives in archives that may still be unpacked. */
interface Budget {
  left: number;
}

async function membersWithin(archive: Member, depth: number, budget: Budget): Promise<Member[] | null> {
  const bytes = await archive.read(Math.min(maxNestedBytes, budget.left));
  budget.left -= bytes.length;
  return membersOf(new Blob([bytes as BlobPart]), depth - 1, budget);
}

/**
 * The files of a zip, tar or tar.gz, and of archives in it, two deep, below a folder of their name. An archive in it that is
 * damaged, or too large, is listed alone. Null: it is none that a browser can read (7z, rar).
 */
export async function membersOf(archive: Blob, depth = 2, budget: Budget = { left: 4 * maxNestedBytes }): Promise<Member[] | null> {
  const members = await membersHere(archive);
  if (!members || depth === 0) return members;
  const all: Member[] = [];
  for (const member of members) {
    all.push(member);
    if (!isArchiveName(member.path) || member.bytes > Math.min(maxNestedBytes, budget.left)) continue;
    const inner = await membersWithin(member, depth, budget).catch(() => null);
    for (const one of inner ?? []) all.push({ ...one, path: `${member.path}/${one.path}` });
  }
  return all;
}
