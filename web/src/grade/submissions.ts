// What was dropped, as submissions to grade and as tasks: the layouts that `farol grade` reads.
import { t } from '../words.ts';
import { isLitter, stripCommonFolder, type NamedFile } from '../scene/bundle.ts';
import { isArchiveName, repacked, zipEntries, type ZipEntry } from './archive.ts';
import { moodlePrefix, studentOf } from './names.ts';
import { tarOf } from './tar.ts';
import type { Submission, Task } from './types.ts';

/** A scene, an image or an archive, as one file. */
export interface Subject {
  name: string;
  file: Blob;
  fileName: string;
}

export interface Handed extends Submission {
  file: Blob;
}

const maxSentBytes = 16 * 1024 * 1024; // what the service takes; of less it says itself what is wrong

// Of a whole project code, build folders and videos stay here.
const wanted = /\.(xml|3db?|obj|mtl|ply|tri|stl|off|patch|png|jpe?g|webp|bmp|tga|gif|hdr|exr|tiff?|pnm|p[bgp]m|json|toml|zip|tar|tgz|gz|7z|rar)$/i;
const alone = /\.(xml|zip|tar|tgz|gz|7z|rar|png|jpe?g|webp|bmp|tga)$/i;
const picture = /\.(png|jpe?g|webp|bmp|tga)$/i;
const isScene = (path: string): boolean => /\.xml$/i.test(path);
const baseName = (path: string): string => path.replace(/^.*\//, '');
export const stemOf = (path: string): string => baseName(path).replace(/(\.tar)?\.[^.]+$/, '') || baseName(path);

/** One file for all of them: what cannot be a scene stays here, unless there is nothing else. */
function subjectOf(name: string, files: readonly NamedFile[]): Subject {
  const useful = files.filter(({ path }) => wanted.test(path)), kept = useful.length > 0 ? useful : files;
  const [only] = kept;
  if (kept.length === 1 && only) return { name, file: only.file, fileName: baseName(only.path) };
  const paths = stripCommonFolder(kept.map(({ path }) => path));
  return { name, file: tarOf(kept.map(({ file }, i) => ({ path: paths[i] as string, file }))), fileName: `${name}.tar` };
}

/** Names that are there twice get a number, as those of a report. */
function uniqueNames(names: readonly string[]): string[] {
  const seen = new Set<string>();
  return names.map((name) => {
    let unique = name;
    for (let i = 2; seen.has(unique); ++i) unique = `${name} (${i})`;
    seen.add(unique);
    return unique;
  });
}

function handed(subjects: readonly Subject[]): Handed[] {
  const ids = uniqueNames(subjects.map(({ name }) => name));
  return subjects.map(({ file, fileName }, i) => {
    const id = ids[i] as string;
    return { id, ...studentOf(id), fileName, bytes: file.size, file };
  });
}

/** The order of the command line, which depends on no language. */
export const byName = (a: string, b: string): number => (a < b ? -1 : a > b ? 1 : 0);

const grouped = <T>(all: readonly T[], keyOf: (one: T) => string): [string, T[]][] => {
  const groups = new Map<string, T[]>();
  for (const one of all) groups.set(keyOf(one), [...(groups.get(keyOf(one)) ?? []), one]);
  return [...groups].sort(([a], [b]) => byName(a, b));
};

/**
 * Every file at the top that can stand alone is a subject, and so is every folder; a scene that lies
 * among its textures is one with all of them. Files that Moodle sends without folders are one a student.
 */
export function subjectsOf(files: readonly NamedFile[]): Subject[] {
  const kept = files.filter(({ path }) => !isLitter(path));
  const paths = stripCommonFolder(kept.map(({ path }) => path));
  const named = kept.map(({ file }, i) => ({ path: paths[i] as string, file }));
  const scenes = named.filter(({ path }) => !path.includes('/') && isScene(path));
  const [scene] = scenes;
  // Other scenes further down are other submissions, but for a scene.xml, which includes them.
  const others = named.some(({ path }) => isArchiveName(path) || (path.includes('/') && isScene(path)));
  if (scene && scenes.length === 1 && named.length > 1 && !moodlePrefix(scene.path) && (!others || scene.path === 'scene.xml')) {
    const folder = baseName((kept[0] as NamedFile).path.slice(0, -(paths[0] as string).length).replace(/\/$/, ''));
    return [subjectOf(folder || scene.path, named)];
  }
  // A note or a table at the top is no submission.
  const members = named.filter(({ path }) => path.includes('/') || alone.test(path) || moodlePrefix(path));
  return grouped(members, ({ path }) => {
    const top = path.split('/')[0] as string;
    return path.includes('/') ? top : moodlePrefix(top) || top;
  }).map(([name, all]) => subjectOf(name, all.map(({ path, file }) => ({ path: path.includes('/') ? path : path.slice(moodlePrefix(path).length), file }))));
}

/** Whether what lies at the top of an archive are submissions and not the parts of one. */
function isClass(paths: readonly string[], tasks: readonly string[]): boolean {
  if (paths.some((path) => path.split('/').some((part) => moodlePrefix(part) !== ''))) return true;
  if (paths.some((path) => !path.includes('/') && isScene(path))) return paths.every((path) => !path.includes('/') && alone.test(path)) && paths.filter(isScene).length > 2;
  const tops = new Set(paths.filter((path) => isScene(path) || isArchiveName(path)).map((path) => path.split('/')[0] as string));
  const isTask = (top: string): boolean => tasks.some((task) => stemOf(top).toLowerCase() === task.toLowerCase());
  return tops.size > 1 && ![...tops].every(isTask);
}

/** The submissions of a class in one zip, each with a zip of its files; null: it is not the zip of a class. */
export async function classOf(zip: Blob, tasks: readonly string[] = []): Promise<Handed[] | null> {
  const entries = (await zipEntries(zip))?.filter(({ path }) => !isLitter(path.replace(/\/$/, '')));
  if (!entries || entries.length === 0) return null;
  const files = entries.filter(({ path }) => !path.endsWith('/'));
  // Moodle packs no folder around the class; systems that pack a folder do.
  const folder = /^[^/]*\//.exec(files[0]?.path ?? '')?.[0] ?? '';
  const top = folder && !moodlePrefix(folder.slice(0, -1)) && entries.every(({ path }) => path.startsWith(folder)) ? folder : '';
  const below = entries.map((entry) => ({ entry, path: entry.path.slice(top.length) })).filter(({ path }) => path !== '');
  if (!isClass(below.filter(({ path }) => !path.endsWith('/')).map(({ path }) => path), tasks)) return null;
  const groups = grouped(below, ({ path }) => {
    const name = path.split('/')[0] as string;
    return path.includes('/') ? name : moodlePrefix(name) || name;
  });
  return handed(await Promise.all(groups.map(async ([name, members]): Promise<Subject> => {
    const all = members.filter(({ path }) => !path.endsWith('/'));
    const useful = all.filter(({ path }) => wanted.test(path)), kept = useful.length > 0 ? useful : all;
    const renamed = kept.map(({ entry, path }): ZipEntry & { name: string } => ({ ...entry, name: path.includes('/') ? path : path.slice(moodlePrefix(path).length) }));
    return { name, file: await repacked(zip, renamed), fileName: `${name}.zip` };
  })));
}

/** All submissions among what was dropped. */
export async function submissionsOf(files: readonly NamedFile[], tasks: readonly string[]): Promise<Handed[]> {
  const kept = files.filter(({ path }) => !isLitter(path)), classes: Handed[] = [], rest: NamedFile[] = [];
  for (const one of kept) {
    const isZip = /\.zip$/i.test(one.path) && !moodlePrefix(one.path.split('/')[0] as string), members = isZip ? await classOf(one.file, tasks) : null;
    if (isZip && !members && one.file.size > maxSentBytes && !(await zipEntries(one.file)))
      throw new Error(t('{name} cannot be read: it is damaged, or no zip that this page knows. Unpack it and choose the folder.', { name: one.path }));
    if (members) classes.push(...members);
    else rest.push(one);
  }
  return [...classes, ...handed(subjectsOf(rest))];
}

/** Each scene at the top is a task, with the files beside it; else each folder with one, else each image. */
export function tasksOf(files: readonly NamedFile[]): Task[] {
  const kept = files.filter(({ path }) => !isLitter(path) && wanted.test(path) && !/\.json$/i.test(path));
  const paths = stripCommonFolder(kept.map(({ path }) => path));
  const named = kept.map(({ file }, i) => ({ path: paths[i] as string, file }));
  const atTop = named.filter(({ path }) => !path.includes('/'));
  const scenes = atTop.filter(({ path }) => isScene(path) || isArchiveName(path));
  let subjects: Subject[] = scenes.map((scene) => (isArchiveName(scene.path) ? { name: stemOf(scene.path), file: scene.file, fileName: scene.path }
    : subjectOf(stemOf(scene.path), [scene, ...named.filter((one) => !scenes.includes(one))])));
  if (subjects.length === 0)
    subjects = grouped(named.filter(({ path }) => path.includes('/')), ({ path }) => path.split('/')[0] as string)
      .filter(([, all]) => all.some(({ path }) => isScene(path))).map(([name, all]) => subjectOf(name, all));
  if (subjects.length === 0) subjects = atTop.filter(({ path }) => picture.test(path)).map((one) => subjectOf(stemOf(one.path), [one]));
  subjects.sort((a, b) => byName(a.fileName, b.fileName));
  const names = uniqueNames(subjects.map(({ name }) => name));
  return subjects.map((reference, i) => ({ name: names[i] as string, reference: { ...reference, name: names[i] as string }, rubric: null }));
}
