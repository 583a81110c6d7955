// A tar file (ustar) of files of this browser: how a scene and its files travel as one part.
import { t } from '../words.ts';

const block = 512;

const bytesOf = (text: string): Uint8Array => new TextEncoder().encode(text);

/** A path in a header: at most 100 bytes, and 155 more of folders before it. Null: too long. */
function splitPath(path: string): [string, string] | null {
  if (bytesOf(path).length <= 100) return [path, ''];
  for (let slash = path.indexOf('/'); slash >= 0; slash = path.indexOf('/', slash + 1))
    if (bytesOf(path.slice(slash + 1)).length <= 100 && bytesOf(path.slice(0, slash)).length <= 155)
      return [path.slice(slash + 1), path.slice(0, slash)];
  return null;
}

export function tarHeader(path: string, size: number): Uint8Array {
  const parts = splitPath(path);
  if (!parts) throw new Error(t('The path “{path}…” is too long', { path: path.slice(0, 60) }));
  const header = new Uint8Array(block);
  const put = (at: number, text: string): void => header.set(bytesOf(text), at);
  const octal = (at: number, digits: number, value: number): void => put(at, value.toString(8).padStart(digits, '0'));
  put(0, parts[0]);
  octal(100, 7, 0o644);
  octal(108, 7, 0);
  octal(116, 7, 0);
  octal(124, 11, size);
  octal(136, 11, 0);
  put(148, ' '.repeat(8));
  put(156, '0');
  put(257, 'ustar');
  put(263, '00');
  put(345, parts[1]);
  octal(148, 6, header.reduce((sum, byte) => sum + byte, 0));
  header[154] = 0;
  return header;
}

export function tarOf(files: readonly { path: string; file: Blob }[]): Blob {
  const parts: BlobPart[] = [];
  for (const { path, file } of files) {
    parts.push(tarHeader(path, file.size) as BlobPart, file, new Uint8Array((block - (file.size % block)) % block));
  }
  parts.push(new Uint8Array(2 * block));
  return new Blob(parts, { type: 'application/x-tar' });
}
