// What was dropped, as subjects to grade: one scene with its files each.
import { isLitter, stripCommonFolder, type NamedFile } from '../scene/bundle.ts';
import { tarOf } from './tar.ts';

export interface Subject {
  name: string;
  file: Blob;
  fileName: string;
}

const archive = /\.(zip|tar|tgz|gz|7z|rar)$/i;
// Of a whole project code, build folders and videos stay here.
const wanted = /\.(xml|3db?|obj|mtl|ply|tri|stl|off|patch|png|jpe?g|webp|bmp|tga|gif|hdr|exr|tiff?|pnm|p[bgp]m|json|toml|zip|tar|tgz|gz|7z|rar)$/i;
const alone = /\.(xml|zip|tar|tgz|gz|7z|rar|png|jpe?g|webp)$/i;
const isScene = (path: string): boolean => /\.xml$/i.test(path);

function subjectOf(name: string, files: readonly NamedFile[]): Subject {
  const [only] = files;
  if (files.length === 1 && only && alone.test(only.path)) return { name, file: only.file, fileName: only.path.replace(/^.*\//, '') };
  const paths = stripCommonFolder(files.map(({ path }) => path));
  return { name, file: tarOf(files.map(({ file }, i) => ({ path: paths[i] as string, file }))), fileName: `${name}.tar` };
}

/** Who handed it in, by Moodle's names of folders and files: `Name_id_assignsubmission_file_`. */
export function studentOf(name: string): { name: string; identifier: string } {
  const found = /^(.{1,200})_([0-9]{1,18})_assignsubmission_[a-z]+(?:_|$)/.exec(name);
  return found ? { name: found[1] as string, identifier: `Participant ${found[2]}` } : { name, identifier: '' };
}

/**
 * Every file at the top that can stand alone is a subject, and so is every folder; a scene that lies
 * among its textures is one with all of them.
 */
export function subjectsOf(files: readonly NamedFile[]): Subject[] {
  const kept = files.filter(({ path }) => !isLitter(path) && wanted.test(path));
  const paths = stripCommonFolder(kept.map(({ path }) => path));
  const named = kept.map(({ file }, i) => ({ path: paths[i] as string, file }));
  const scenes = named.filter(({ path }) => !path.includes('/') && isScene(path));
  const [scene] = scenes;
  // Other scenes further down are other submissions, but for a scene.xml, which includes them.
  const others = named.some(({ path }) => archive.test(path) || (path.includes('/') && isScene(path)));
  if (scene && scenes.length === 1 && named.length > 1 && (!others || scene.path === 'scene.xml')) {
    const folder = (kept[0] as NamedFile).path.slice(0, -(paths[0] as string).length).replace(/\/$/, '').replace(/^.*\//, '');
    return [subjectOf(folder || scene.path, named)];
  }
  const groups = new Map<string, NamedFile[]>();
  for (const one of named) {
    const name = one.path.split('/')[0] as string;
    if (!one.path.includes('/') && !alone.test(name)) continue; // a rubric, a note
    const members = groups.get(name);
    if (members) members.push(one);
    else groups.set(name, [one]);
  }
  return [...groups].sort(([a], [b]) => a.localeCompare(b)).map(([name, members]) => subjectOf(name, members));
}
