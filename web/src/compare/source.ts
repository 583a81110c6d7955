// What can be compared: a stored scene, edits of this browser, and files: a scene, an archive or an image.
import { getFiles, getScene, getSource, query, request, scenePath, validate, type Options, type SceneFacts } from '../api.ts';
import { kept } from '../kept.ts';
import { bundleOf, type NamedFile } from '../scene/bundle.ts';
import { loadDraft } from '../scene/drafts.ts';
import { zipOf } from '../zip.ts';
import { bodyOf, fetchPicture, type Origin } from '../scene/frame.ts';
import { isImage, listFiles, noChanges, type FileChanges } from '../scene/scene_files.ts';
import { newScene } from '../scene/template.ts';
import { titleOf } from '../scene/title.ts';

/** As an address names it: a scene's id, "draft:ID" ("draft:*" for a new scene), or "file:NAME". */
export type SourceName = string;

export interface Opened {
  name: SourceName;
  title: string;
  facts: SceneFacts | null; // null: an image
  image: { bitmap: ImageBitmap; blob: Blob } | null;
  /** Requests an image; undefined where a newer request took its place. */
  ask(options: Options, signal: AbortSignal): Promise<Response | undefined>;
  /** The scene with its files, for the service to read. */
  part(): Promise<{ blob: Blob; fileName: string }>;
  page: string; // where it can be opened, as an address of this page; empty: nowhere
}

const files = new Map<SourceName, readonly NamedFile[]>();

/** Keeps files for as long as the page is open. Each choice has a name that no other has: two students hand in scene.xml. */
export function fileSource(chosen: readonly NamedFile[]): SourceName {
  const own = `file:${chosen[0]?.path.split('/')[0] ?? ''}`;
  let name = own;
  for (let number = 2; files.has(name); ++number) name = `${own} (${number})`;
  files.set(name, chosen);
  return name;
}

export const isLinkable = (name: SourceName): boolean => name !== '' && !/^(draft|file):/.test(name);

/** The scenes with edits in this browser. */
export function draftNames(): SourceName[] {
  try {
    return Object.keys(localStorage).filter((key) => key.startsWith('farol.draft.')).map((key) => `draft:${key.slice('farol.draft.'.length)}`).sort();
  } catch {
    return [];
  }
}

async function wholeOf(origin: Origin, text: string): Promise<Blob> {
  const id = origin.id, list = id === null ? { main: 'scene.xml', files: [] } : await getFiles(id);
  const out = [{ path: list.main, file: new Blob([text]) as Blob }];
  for (const { path } of listFiles(list.files.filter((one) => one.path !== list.main), origin.files)) {
    const local = origin.files.added.find((one) => one.path === path)?.file;
    out.push({ path, file: local ?? (await (await request(`${scenePath(id ?? '')}/file?${query({ path })}`)).blob()) });
  }
  return zipOf(out);
}

function sceneOf(name: SourceName, title: string, facts: SceneFacts, origin: Origin, page: string): Opened {
  return {
    name, title, facts, image: null, page,
    ask: (options, signal) => fetchPicture(origin, options, signal),
    part: async () => ({ blob: await wholeOf(origin, origin.text ?? (await getSource(origin.id ?? ''))), fileName: 'scene.zip' }),
  };
}

const pageOf = (id: string): string => `#/scene/${id.split('/').map(encodeURIComponent).join('/')}`;

async function openDraft(name: SourceName): Promise<Opened> {
  const key = name.slice('draft:'.length), id = key === '*' ? null : key, draft = loadDraft(id);
  const beside = await kept<{ files: FileChanges }>(`draft.${key}`), changes = beside?.files ?? noChanges;
  const text = draft?.text ?? (id === null ? newScene : await getSource(id)), origin: Origin = { id, text, loose: null, files: changes };
  const facts = await validate(bodyOf(origin), id), title = titleOf(id, facts.title, text);
  return sceneOf(name, title, { ...facts, id: id ?? '' }, origin, id === null ? '#/new' : pageOf(id));
}

async function openFiles(name: SourceName): Promise<Opened | null> {
  const chosen = files.get(name), only = chosen?.length === 1 ? chosen[0] : undefined;
  if (!chosen) return null; // of an earlier visit
  if (only && isImage(only.path)) {
    const bitmap = await createImageBitmap(only.file);
    return { name, title: only.path, facts: null, image: { bitmap, blob: only.file }, page: '', ask: async () => undefined, part: async () => ({ blob: only.file, fileName: only.path }) };
  }
  const bundle = await bundleOf(chosen);
  if ('message' in bundle) throw new Error(bundle.message);
  const facts = { ...(await validate(bundle.body(), null)), id: '' }, title = facts.title || bundle.name, { loose } = bundle;
  if (loose) {
    const main = loose.files.find(({ path }) => path === loose.main), origin: Origin = { id: null, text: (await main?.file.text()) ?? '', loose, files: noChanges };
    return { ...sceneOf(name, title, facts, origin, ''), part: async () => ({ blob: await zipOf(loose.files), fileName: 'scene.zip' }) };
  }
  return {
    name, title, facts, image: null, page: '',
    ask: async (options, signal) => request(`v1/render?${query(options)}`, { method: 'POST', signal, ...bundle.body() }),
    part: async () => ({ blob: only?.file ?? new Blob([]), fileName: only?.path ?? '' }),
  };
}

/** Null: files of an earlier visit, which the page does not have any more. */
export async function openSource(name: SourceName): Promise<Opened | null> {
  if (name.startsWith('draft:')) return openDraft(name);
  if (name.startsWith('file:')) return openFiles(name);
  const facts = await getScene(name), origin: Origin = { id: name, text: null, loose: null, files: noChanges };
  return sceneOf(name, titleOf(name, facts.title, facts.valid ? null : await getSource(name)), facts, origin, pageOf(name));
}
