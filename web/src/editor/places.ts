// Places in a text: the service counts lines from 1 and columns in bytes from 1.

/** The index in the line of a column in bytes of UTF-8. */
export function indexOfColumn(line: string, column: number): number {
  let bytes = column - 1, index = 0;
  for (const character of line) {
    if (bytes <= 0) break;
    const code = character.codePointAt(0) ?? 0;
    bytes -= code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    index += character.length;
  }
  return Math.min(index, line.length);
}

/** What to underline from there: a quoted value, an element's name, a word, or the rest. */
export function wordLength(line: string, index: number): number {
  const rest = line.slice(index);
  const found = /^("[^"]*"?|'[^']*'?|<[/?!]?[\w:.-]*|[^\s=<>"'/]+)/.exec(rest)?.[0];
  return Math.max(1, found?.length ?? rest.length);
}

export interface Change {
  from: number;
  to: number;
  insert: string;
}

/** The one replacement that turns a text into another. */
export function changeBetween(before: string, after: string): Change {
  let start = 0;
  const shorter = Math.min(before.length, after.length);
  while (start < shorter && before[start] === after[start]) start += 1;
  let end = 0;
  while (end < shorter - start && before[before.length - 1 - end] === after[after.length - 1 - end]) end += 1;
  return { from: start, to: before.length - end, insert: after.slice(start, after.length - end) };
}
