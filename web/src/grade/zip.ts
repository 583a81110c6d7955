// The zip of a class, as Moodle sends it: a zip a submission, of the bytes as they are packed.
const signature = { local: 0x04034b50, entry: 0x02014b50, end: 0x06054b50 };
const endBytes = 22, entryBytes = 46, localBytes = 30;
const maxDirectoryBytes = 64 * 1024 * 1024;

interface Entry {
  path: string;
  name: Uint8Array;
  record: Uint8Array; // 46 bytes of the directory
  packed: number;
  offset: number;
}

const view = async (blob: Blob): Promise<DataView> => new DataView(await blob.arrayBuffer());

/** The files of a zip; null: it is none that can be read here. */
async function entriesOf(zip: Blob): Promise<Entry[] | null> {
  const tail = await view(zip.slice(Math.max(0, zip.size - endBytes - 65535)));
  let end = tail.byteLength - endBytes;
  while (end >= 0 && tail.getUint32(end, true) !== signature.end) --end;
  if (end < 0) return null;
  const count = tail.getUint16(end + 10, true), size = tail.getUint32(end + 12, true), begin = tail.getUint32(end + 16, true);
  if (size > maxDirectoryBytes || begin + size > zip.size) return null;
  const directory = await view(zip.slice(begin, begin + size));
  const entries: Entry[] = [];
  for (let at = 0; entries.length < count;) {
    if (at + entryBytes > size || directory.getUint32(at, true) !== signature.entry) return null;
    const nameBytes = directory.getUint16(at + 28, true);
    const whole = entryBytes + nameBytes + directory.getUint16(at + 30, true) + directory.getUint16(at + 32, true);
    if (at + whole > size) return null;
    const name = new Uint8Array(directory.buffer, at + entryBytes, nameBytes);
    entries.push({
      path: new TextDecoder().decode(name).replaceAll('\\', '/'), name,
      record: new Uint8Array(directory.buffer, at, entryBytes).slice(),
      packed: directory.getUint32(at + 20, true), offset: directory.getUint32(at + 42, true),
    });
    at += whole;
  }
  return entries;
}

/** A zip of these entries, under their own names. */
async function repacked(zip: Blob, entries: readonly Entry[]): Promise<Blob> {
  const parts: BlobPart[] = [], directory: BlobPart[] = [];
  let size = 0, directorySize = 0;
  for (const { name, record, packed, offset } of entries) {
    const local = await view(zip.slice(offset, offset + localBytes));
    const data = offset + localBytes + local.getUint16(26, true) + local.getUint16(28, true);
    const entry = new DataView(record.buffer);
    entry.setUint16(8, (entry.getUint16(8, true) & ~8) | 0x800, true); // sizes in the header, a name in UTF-8
    entry.setUint16(30, 0, true); // no extra field, no comment
    entry.setUint16(32, 0, true);
    entry.setUint32(42, size, true);
    const head = new Uint8Array(localBytes);
    head.set(record.subarray(6, 30), 4);
    new DataView(head.buffer).setUint32(0, signature.local, true);
    new DataView(head.buffer).setUint16(28, 0, true);
    parts.push(head as BlobPart, name as BlobPart, zip.slice(data, data + packed));
    directory.push(record as BlobPart, name as BlobPart);
    size += localBytes + name.length + packed;
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

const moodle = /^(.{1,200}_[0-9]{1,18}_assignsubmission_[a-z]+(?:_|$))/;

/** The submissions of a class in one zip, each with a zip of its files; null: it is not the zip of a class. */
export async function classOf(zip: Blob): Promise<{ name: string; file: Blob; fileName: string }[] | null> {
  const entries = await entriesOf(zip);
  const groups = new Map<string, Entry[]>();
  for (const entry of entries ?? []) {
    const found = entry.path.split('/').map((part) => moodle.exec(part)?.[1]).find((name) => name !== undefined);
    if (!found || entry.path.endsWith('/')) continue;
    const members = groups.get(found);
    if (members) members.push(entry);
    else groups.set(found, [entry]);
  }
  if (groups.size === 0) return null;
  return Promise.all([...groups].sort(([a], [b]) => a.localeCompare(b)).map(async ([name, members]) =>
    ({ name, file: await repacked(zip, members), fileName: `${name}.zip` })));
}
