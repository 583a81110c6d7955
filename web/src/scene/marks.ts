// What the user marked in the tree of a scene. It stays with the draft and is no part of the XML. An element is known
// by the index of its "<" in the text; an edit moves these indices along.
import { changeBetween, type Change } from '../editor/places.ts';

export interface Marks {
  hidden: readonly number[]; // not drawn on this page
  locked: readonly number[]; // not picked in the image and not changed by handles, keys or menus
}

export const noMarks: Marks = { hidden: [], locked: [] };
export const isMarked = ({ hidden, locked }: Marks): boolean => hidden.length > 0 || locked.length > 0;

const tagStarts = (text: string): number[] => [...text.matchAll(/</g)].map((found) => found.index);

/** Returns how an edit moves the index of a "<"; the result is null where the edit removed it. */
export function mover(before: string, after: string): (index: number) => number | null {
  if (before === after) return (index) => index;
  const change = atTag(changeBetween(before, after), before);
  return (index) => moveBy(change, before, index);
}

/**
 * Whole elements that were added or removed: the same change, from the "<" of the first. `<a/><a b="1"/>` from
 * `<a b="1"/>` is seen as `/><a` within the old tag at first.
 */
function atTag(change: Change, before: string): Change {
  let { from, to, insert } = change, piece = insert || before.slice(from, to);
  if (insert !== '' && from !== to) return change;
  while (piece[0] !== '<' && from > 0 && before[from - 1] === piece[piece.length - 1]) {
    piece = before[from - 1] + piece.slice(0, -1);
    from -= 1;
    to -= 1;
    if (insert !== '') insert = piece;
  }
  return piece[0] === '<' ? { from, to, insert } : change;
}

function moveBy({ from, to, insert }: Change, before: string, index: number): number | null {
  if (index < from) return index;
  if (index >= to) return index + insert.length - (to - from);
  // Within what was replaced: a change of values keeps the number of tags, so that their order is the same.
  const olds = tagStarts(before.slice(from, to)), news = tagStarts(insert);
  const at = olds.indexOf(index - from);
  return olds.length === news.length && at >= 0 ? from + (news[at] as number) : null;
}

export function moveMarks({ hidden, locked }: Marks, move: (index: number) => number | null): Marks {
  const all = (indices: readonly number[]): number[] => indices.map(move).filter((index) => index !== null);
  return { hidden: all(hidden), locked: all(locked) };
}

export const toggled = (indices: readonly number[], index: number): number[] =>
  indices.includes(index) ? indices.filter((one) => one !== index) : [...indices, index];
