// The text of a document in a submission, for reading beside what is wrong with it.
import { t } from '../words.ts';
import { isArchiveName, membersOf, type Member } from './archive.ts';

const maxDocumentBytes = 1024 * 1024; // as the service's bound of a document

/** As documents are: UTF-8, UTF-16 by its mark, else Latin-1. */
export function decoded(bytes: Uint8Array): string {
  const [first, second] = bytes;
  if (first === 0xff && second === 0xfe) return new TextDecoder('utf-16le').decode(bytes);
  if (first === 0xfe && second === 0xff) return new TextDecoder('utf-16be').decode(bytes);
  try {
    return new TextDecoder('utf-8', { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder('windows-1252').decode(bytes);
  }
}

/** The member that a place names: the whole path, else its end, else the base name alone. */
export function memberNamed(members: readonly Pick<Member, 'path'>[], file: string): number {
  const base = file.replace(/^.*\//, '');
  for (const fits of [(path: string) => path === file, (path: string) => path.endsWith(`/${file}`), (path: string) => path.replace(/^.*\//, '') === base]) {
    const at = members.findIndex(({ path }) => fits(path));
    if (at >= 0) return at;
  }
  return -1;
}

export interface SourceText {
  path: string;
  text: string;
}

/** The document of the name `file`; throws Error with the reason where it cannot be shown. */
export async function sourceOf(submission: Blob, fileName: string, file: string): Promise<SourceText> {
  const isPacked = isArchiveName(fileName);
  if (!isPacked) {
    if (submission.size > maxDocumentBytes) throw new Error(t('The document is larger than 1 MiB'));
    return { path: fileName, text: decoded(new Uint8Array(await submission.arrayBuffer())) };
  }
  const members = await membersOf(submission);
  if (!members) throw new Error(t('This page does not open such an archive (7z, rar): unpack it'));
  const at = memberNamed(members, file), member = members[at];
  if (!member) throw new Error(t('The submission has no file “{file}”', { file }));
  return { path: member.path, text: decoded(await member.read(maxDocumentBytes)) };
}
