// Files that make a scene together: which is the scene, and under which paths the others go.
import { noChanges, type FileChanges } from './scene_files.ts';
import { t } from '../words.ts';

export interface NamedFile {
  path: string; // with forward slashes
  file: File;
}

export interface Bundle {
  name: string;
  loose: Loose | null; // null: an archive, which only the server opens
  body(): { body: BodyInit; headers?: Record<string, string> };
}

/** A document and the files beside it. */
export interface Loose {
  main: string; // the document's path
  files: { path: string; file: Blob }[]; // the document among them
}

/** The multipart body of a document, which may have been edited, and its files with the changes. */
export function formOf({ main, files }: Loose, text?: string, { added, removed }: FileChanges = noChanges): FormData {
  const form = new FormData(), fresh = new Set(added.map((one) => one.path));
  for (const { path, file } of files)
    if (path === main) form.append('scene', text === undefined ? file : new Blob([text], { type: 'application/xml' }), path);
    else if (!fresh.has(path) && !removed.includes(path)) form.append('file', file, path);
  for (const { path, file } of added) form.append('file', file, path);
  return form;
}

const maxFiles = 4000; // below the bound of the service on parts
const wholeFiles = 256; // up to here everything is sent: an edited scene may name what this one does not
const maxBytes = 16 * 1024 * 1024;

// What the generator reads: see generator/registry.cpp.
const meshEndings = /\.(3d|3db|obj|ply|tri|stl|off|patch)$/i;
const archives: [RegExp, string][] = [
  [/\.zip$/i, 'application/zip'],
  [/\.tar$/i, 'application/x-tar'],
  [/\.(tar\.gz|tgz)$/i, 'application/gzip'],
  [/\.7z$/i, 'application/x-7z-compressed'],
  [/\.rar$/i, 'application/vnd.rar'],
];
// What operating systems and tools leave behind in folders.
const litter = /(^|\/)(\.[^/]*|__MACOSX|Thumbs\.db|desktop\.ini|node_modules)(\/|$)/i;

export const isLitter = (path: string): boolean => litter.test(path);

const depth = (path: string): number => path.split('/').length;

/** Without the folders that all paths share. */
export function stripCommonFolder(paths: readonly string[]): string[] {
  let out = [...paths];
  for (;;) {
    const first = out[0]?.split('/')[0];
    if (!first || !out.every((path) => path.startsWith(`${first}/`))) return out;
    out = out.map((path) => path.slice(first.length + 1));
  }
}

/** The scene among XML files: scene.xml or world.xml first, then the outermost, then by name. */
export function mainScene(paths: readonly string[]): string | null {
  const rank = (path: string): number => (/(^|\/)(scene|world|main|index)\.xml$/i.test(path) ? 0 : 1);
  const found = paths.filter((path) => /\.xml$/i.test(path));
  found.sort((a, b) => depth(a) - depth(b) || rank(a) - rank(b) || a.localeCompare(b));
  return found[0] ?? null;
}

const escapeXml = (text: string): string => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');

/** A scene that shows meshes where their files put them, lit from the camera. */
export const meshScene = (paths: readonly string[]): string => `<world>
    <title>${escapeXml((paths[0] ?? '').replace(/^.*\//, ''))}${paths.length > 1 ? ` and ${paths.length - 1} more` : ''}</title>
    <lights>
        <light type="directional" space="camera" alpha="25" beta="35"/>
    </lights>
    <group>
        <models>
${paths.map((path) => `            <model file="${escapeXml(path)}"/>\n`).join('')}        </models>
    </group>
</world>
`;

// As the server compares names: scene/files/spelling.h.
const folded = (name: string): string => {
  let plain = name;
  try {
    plain = decodeURIComponent(name);
  } catch {
    // a percent sign that is one
  }
  return plain.normalize('NFD').toLowerCase();
};
const baseName = (path: string): string => path.replace(/^.*[/\\]/, '');

/** The base names that a text may mean: what stands in quotes, and each word. */
function namesIn(text: string, names: Set<string>): void {
  // Names with blanks, also behind the words of a material library: "map_Kd -s 1 1 1 my wood.png".
  const mostWords = 12;
  const ends = text.split(/["'\r\n]+/).flatMap((line) => {
    const words = line.trim().split(/[ \t]+/);
    return words.slice(0, mostWords).map((_, i) => words.slice(i).join(' '));
  });
  for (const word of [...text.split(/[\s"'<>=,;]+/), ...ends]) {
    const name = baseName(word.trim().replace(/\/+$/, '')); // the slash of an empty tag
    if (name === '' || name.length > 1024) continue;
    names.add(folded(name));
    // "bezier_comet_10.3d" means comet.patch.
    for (const part of name.split('_')) names.add(`${folded(part)}.patch`);
  }
}

const isLibraryUser = ({ path }: NamedFile): boolean => /\.(obj|mtl)$/i.test(path);

/** A document's text, or the beginning of a mesh, where libraries are named. */
async function textOf(file: File): Promise<string> {
  const bytes = await (/\.xml$/i.test(file.name) ? file : file.slice(0, 65536)).arrayBuffer();
  const [first, second] = new Uint8Array(bytes);
  const coding = first === 0xff && second === 0xfe ? 'utf-16le' : first === 0xfe && second === 0xff ? 'utf-16be' : 'utf-8';
  return new TextDecoder(coding).decode(bytes);
}

/**
 * What scenes need of a whole project: its documents, the files that they name, and the material libraries and
 * pictures of these. Everything where that is little. The server's rule: scene/files/bundle.h.
 */
export async function neededFiles(files: readonly NamedFile[]): Promise<NamedFile[]> {
  const bytes = files.reduce((sum, { file }) => sum + file.size, 0);
  if (files.length <= wholeFiles && bytes <= maxBytes) return [...files];
  const isDocument = (one: NamedFile): boolean => /\.xml$/i.test(one.path) && one.file.size <= 1048576;
  const documents = files.filter(isDocument), names = new Set<string>();
  // Without a document the meshes are shown: see bundleOf.
  const taken = new Set(documents.length > 0 ? documents : files.filter((one) => meshEndings.test(one.path)));
  for (const one of taken) if (documents.length > 0 || isLibraryUser(one)) namesIn(await textOf(one.file), names);
  for (let round = 0; round < 3; ++round) { // meshes name libraries, which name pictures
    const fresh = files.filter((one) => !taken.has(one) && names.has(folded(baseName(one.path))));
    for (const one of fresh) taken.add(one);
    for (const one of fresh) if (isLibraryUser(one)) namesIn(await textOf(one.file), names);
  }
  return files.filter((one) => taken.has(one));
}

export async function bundleOf(files: readonly NamedFile[]): Promise<Bundle | { message: string }> {
  const kept = await neededFiles(files.filter(({ path }) => !isLitter(path)));
  const only = kept.length === 1 ? kept[0] : undefined;
  const archive = only && archives.find(([ending]) => ending.test(only.path));
  const bytes = kept.reduce((sum, { file }) => sum + file.size, 0);
  if (bytes > maxBytes) return { message: t('These files are {size} MiB; the server takes 16 MiB', { size: (bytes / 1048576).toFixed(1) }) };
  if (only && archive)
    return { name: only.path, loose: null, body: () => ({ body: only.file, headers: { 'Content-Type': archive[1] } }) };
  if (kept.length > maxFiles) return { message: t('These are {count} files; the server takes {most} at once', { count: kept.length, most: maxFiles }) };
  const paths = stripCommonFolder(kept.map(({ path }) => path));
  const parts = kept.map(({ file }, i) => ({ path: paths[i] as string, file: file as Blob }));
  let main = mainScene(paths);
  if (!main) {
    const meshes = paths.filter((path) => meshEndings.test(path));
    if (meshes.length === 0)
      return { message: t('There is no scene (.xml), mesh (.3d, .3db, .obj, .ply, .stl, .off, .tri, .patch) or archive (.zip, .tar, .tar.gz) among these files') };
    main = 'scene.xml';
    parts.push({ path: main, file: new Blob([meshScene(meshes)], { type: 'application/xml' }) });
  }
  const loose = { main, files: parts };
  return { name: kept[0]?.path.split('/')[0] ?? main, loose, body: () => ({ body: formOf(loose) }) };
}
