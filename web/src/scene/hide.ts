// A document without some of its elements, with every other one at its line and column.
import { spellings } from './language.ts';
import { applyEdits, parseXml, walkXml, type Edit, type XmlElement } from './xml.ts';

/** What an element draws or lights by itself; groups and transforms stay, since random places count them. */
const drawn = new Set((['model', 'light', 'xml'] as const).flatMap((name) => spellings(name)).map((name) => name.toLowerCase()));

const bytesOf = (code: number): number => (code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4);
/** Columns are bytes of UTF-8. */
const blanks = (text: string): string => text.replace(/[^\n]/gu, (character) => ' '.repeat(bytesOf(character.codePointAt(0) ?? 0)));

/** Blanks the models, lights and includes of the elements whose "<" has one of these indices. */
export function withoutElements(text: string, indices: readonly number[]): string {
  const edits: Edit[] = [];
  const visit = (elements: readonly XmlElement[], isHidden: boolean): void => {
    for (const element of elements) {
      const hides = isHidden || indices.includes(element.start);
      if (hides && drawn.has(element.name.toLowerCase()))
        edits.push({ from: element.start, to: element.end, insert: blanks(text.slice(element.start, element.end)) });
      else visit(element.children, hides);
    }
  };
  visit(parseXml(text), false);
  return applyEdits(text, edits);
}

/** Whether the element or one around it has one of these indices. */
export function isWithin(element: XmlElement, indices: readonly number[]): boolean {
  for (let at: XmlElement | null = element; at; at = at.parent) if (indices.includes(at.start)) return true;
  return false;
}

/** The element whose "<" has this index. */
export function elementAt(roots: readonly XmlElement[], index: number): XmlElement | undefined {
  for (const element of walkXml(roots)) {
    if (element.start === index) return element;
    if (element.start > index) return undefined;
  }
  return undefined;
}
