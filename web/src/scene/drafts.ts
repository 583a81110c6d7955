// Edits of scenes, kept in this browser until they are given up.
import { recall, remember } from '../storage.ts';

export interface Draft {
  text: string;
  base: string; // what the text was made from, as a hash: it may have changed on the server since
}

const keyOf = (id: string | null): string => `draft.${id ?? '*'}`;

export function hashText(text: string): string {
  let h = 0x811c9dc5;
  for (let i = 0; i < text.length; ++i) h = Math.imul(h ^ text.charCodeAt(i), 0x01000193);
  return `${text.length}-${(h >>> 0).toString(16)}`;
}

export function loadDraft(id: string | null): Draft | null {
  try {
    const draft = JSON.parse(recall(keyOf(id)) ?? 'null') as Draft | null;
    return draft && typeof draft.text === 'string' && typeof draft.base === 'string' ? draft : null;
  } catch {
    return null;
  }
}

/** False when the browser has no room or allows no storage: the user must be told. */
export const saveDraft = (id: string | null, draft: Draft | null): boolean =>
  remember(keyOf(id), draft && JSON.stringify(draft));
