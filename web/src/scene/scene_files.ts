// The files of a scene: those that it came with, and what was changed here.
import type { Finding } from '../api.ts';

export interface LocalFile {
  path: string;
  file: Blob;
}

/** Values: every change makes another one, so that a history can hold them. */
export interface FileChanges {
  added: readonly LocalFile[]; // new, or in place of one that it came with
  removed: readonly string[]; // of those that it came with
}

export const noChanges: FileChanges = { added: [], removed: [] };
export const isChanged = ({ added, removed }: FileChanges): boolean => added.length > 0 || removed.length > 0;

export interface ListedFile {
  path: string;
  bytes: number;
  state: 'kept' | 'added' | 'replaced';
}

const without = (files: readonly LocalFile[], path: string): LocalFile[] => files.filter((one) => one.path !== path);

export const withFile = ({ added, removed }: FileChanges, path: string, file: Blob): FileChanges =>
  ({ added: [...without(added, path), { path, file }], removed: removed.filter((one) => one !== path) });

/** `came`: it is one of those that the scene came with. */
export const withoutFile = ({ added, removed }: FileChanges, path: string, came: boolean): FileChanges =>
  ({ added: without(added, path), removed: came && !removed.includes(path) ? [...removed, path] : removed });

export function listFiles(came: readonly { path: string; bytes: number }[], { added, removed }: FileChanges): ListedFile[] {
  const own = new Set(came.map((one) => one.path)), fresh = new Set(added.map((one) => one.path));
  return [
    ...came.filter((one) => !removed.includes(one.path) && !fresh.has(one.path)).map((one): ListedFile => ({ ...one, state: 'kept' })),
    ...added.map(({ path, file }): ListedFile => ({ path, bytes: file.size, state: own.has(path) ? 'replaced' : 'added' })),
  ].sort((a, b) => a.path.localeCompare(b.path));
}

/** A file that the document names and that is not there. */
export interface Missing {
  name: string; // as the document writes it
  path: string; // under which it is found
  finding: Finding;
}

export const baseName = (path: string): string => path.replace(/^.*[/\\]/, '');

/** Where a file goes to be found by that name: a path that leads out of the scene is its last part. */
export function pathFor(name: string): string {
  const path = name.replaceAll('\\', '/').replace(/^(\.\/)+/, '');
  const parts = path.split('/');
  return /^[a-z]:|^\/|^\w+:\/\//i.test(path) || parts.some((part) => part === '' || part === '.' || part === '..') ? baseName(path) : path;
}

export function missingOf(findings: readonly Finding[]): Missing[] {
  const out = new Map<string, Missing>();
  for (const finding of findings) {
    const name = finding.code === 'asset.missing' ? /"([^"]+)"/.exec(finding.message)?.[1] : undefined;
    if (name !== undefined && !out.has(name)) out.set(name, { name, path: pathFor(name), finding });
  }
  return [...out.values()];
}

/** The missing one that a dropped file is meant for: of the same name, in any case. */
export const missingFor = (all: readonly Missing[], file: File): Missing | undefined =>
  all.find((one) => baseName(one.path).toLowerCase() === file.name.toLowerCase());

export const isImage = (path: string): boolean => /\.(png|jpe?g|bmp|gif|tga|tiff?|webp|hdr|exr|ppm|pgm|dds|psd|svg)$/i.test(path);

/** Whether what was dropped belongs to the scene on show: images, and files that it misses. */
export const areParts = (missing: readonly Missing[], files: readonly { path: string; file: File }[]): boolean =>
  files.length > 0 && files.every(({ path, file }) => isImage(path) || missingFor(missing, file) !== undefined);
