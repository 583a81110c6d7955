// What a scene is called: by its document, by its file, or as one without a title. An id is no title.
import { t } from '../words.ts';

const entities: Record<string, string> = { amp: '&', lt: '<', gt: '>', quot: '"', apos: "'" };
const plain = (text: string): string => text.replaceAll(/&(amp|lt|gt|quot|apos);/g, (_, name: string) => entities[name] as string).replaceAll(/\s+/g, ' ').trim();
const maxCommentLength = 60; // a longer comment is no title

/** As far as it can be read: the document may have errors anywhere. */
export function titleIn(text: string): string {
  const written = text.replaceAll(/<!--[\s\S]*?(-->|$)/g, '');
  const element = /<title\b[^>]*>([^<]*)/i.exec(written)?.[1] ?? '', attribute = /^\s*(?:<\?[^>]*>\s*)*<\w+\b[^<>]*?\btitle\s*=\s*(["'])([^<>]*?)\1/i.exec(written)?.[2] ?? '';
  return plain(element) || plain(attribute);
}

function firstComment(text: string): string {
  const comment = plain(/^\s*(?:<\?[^>]*>\s*)*<!--([\s\S]*?)-->/.exec(text)?.[1] ?? '');
  return comment.length <= maxCommentLength ? comment : '';
}

/** `text`: its document, where that is known; the service names a scene that it cannot read, or that has no title, by its id. */
export function titleOf(id: string | null, title: string, text: string | null): string {
  const last = id?.replace(/^.*\//, '') ?? '', isStored = id === null || id.startsWith('~');
  if (title && title !== last) return title;
  const own = titleIn(text ?? '');
  if (own) return own;
  return isStored ? firstComment(text ?? '') || t('Untitled scene') : last;
}
