// Names of files in the document.
import { baseName, pathFor, withFile, type FileChanges, type Missing } from './scene_files.ts';
import { applyEdits, parseXml, setValue, walkXml, type Edit } from './xml.ts';

const ending = (path: string): string => /\.[^./\\]*$/.exec(path)?.[0].toLowerCase() ?? '';

/** The document with another name for a file, wherever an attribute has the old one. */
export function renameInText(text: string, from: string, to: string): string {
  const edits: Edit[] = [];
  for (const element of walkXml(parseXml(text)))
    for (const attribute of element.attributes) if (pathFor(attribute.value) === from) edits.push(setValue(attribute, to));
  return applyEdits(text, edits);
}

export const timesNamed = (text: string, path: string): number => {
  let count = 0;
  for (const element of walkXml(parseXml(text))) for (const { value } of element.attributes) if (pathFor(value) === path) count += 1;
  return count;
};

/**
 * A file for one that is missing: under the name that the document has, or, where it is of another kind, under its
 * own beside it; then the document names that.
 */
export function withRepair(text: string, changes: FileChanges, missing: Missing, file: File): { text: string; changes: FileChanges } {
  if (ending(file.name) === ending(missing.path)) return { text, changes: withFile(changes, missing.path, file) };
  const path = missing.path.slice(0, missing.path.length - baseName(missing.path).length) + file.name;
  return { text: renameInText(text, missing.path, path), changes: withFile(changes, path, file) };
}
