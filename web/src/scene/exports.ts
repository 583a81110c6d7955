// What a scene gives to take along: everything in a zip, and meshes in other forms.
import { request, query, scenePath } from '../api.ts';
import { listFiles } from './scene_files.ts';
import type { Viewer } from './viewer.ts';
import { spellings } from './language.ts';
import { attributeOf, parseXml, walkXml } from './xml.ts';
import { t } from '../words.ts';
import { zipOf } from '../zip.ts';

/** A file of the scene as it is now; null: it has none of that path. */
export async function fileOf(viewer: Viewer, path: string): Promise<Blob | null> {
  const local = viewer.files.value.added.find((one) => one.path === path) ?? viewer.loose?.files.find((one) => one.path === path);
  if (local) return local.file;
  if (viewer.id === null) return null;
  return (await request(`${scenePath(viewer.id)}/file?${query({ path })}`)).blob();
}

/** The document as it is edited, and all its files. */
export async function everything(viewer: Viewer): Promise<Blob> {
  await viewer.loadText();
  const { main, files } = await viewer.loadFiles();
  const out = [{ path: main, file: new Blob([viewer.written()]) }];
  for (const { path } of listFiles(files, viewer.files.value)) {
    const file = await fileOf(viewer, path);
    if (file) out.push({ path, file });
  }
  return zipOf(out);
}

/** The meshes that the document names, each once. */
export function meshNames(text: string): string[] {
  const out = new Set<string>();
  for (const element of walkXml(parseXml(text))) {
    const name = element.name.toLowerCase() === 'model' ? attributeOf(element, spellings('model', 'file'))?.value.trim() : undefined;
    if (name) out.add(name);
  }
  return [...out].sort();
}

export const meshForms = ['obj', 'ply', 'stl', '3d'] as const;
export type MeshForm = (typeof meshForms)[number];

/** The shape and arguments that a name says: "sphere_1_16_8.3d" is sphere 1 16 8. Null: it is no such name. */
export function callOf(name: string): { shape: string; args: string } | null {
  const [shape = '', ...args] = name.replace(/^.*[/\\]/, '').replace(/\.[a-z0-9]+$/i, '').split('_');
  return /^[a-z]+$/i.test(shape) && args.length > 0 && args.every((one) => one !== '' && Number.isFinite(Number(one))) ? { shape: shape.toLowerCase(), args: args.join(',') } : null;
}

/** A binary STL file of the triangles of an OBJ file. */
export function stlOf(obj: string): Blob {
  const points: number[][] = [], triangles: number[][][] = [];
  for (const line of obj.split('\n')) {
    const [kind, ...words] = line.trim().split(/\s+/);
    if (kind === 'v') points.push(words.slice(0, 3).map(Number));
    if (kind !== 'f') continue;
    const corners = words.map((word) => points[Number(word.split('/')[0]) - 1]).filter((one) => one !== undefined);
    for (let i = 2; i < corners.length; ++i) triangles.push([corners[0], corners[i - 1], corners[i]] as number[][]);
  }
  const out = new DataView(new ArrayBuffer(84 + 50 * triangles.length));
  out.setUint32(80, triangles.length, true);
  triangles.forEach(([a, b, c], i) => {
    const [u, v] = [b, c].map((corner) => corner?.map((x, k) => x - (a?.[k] ?? 0)) ?? []) as [number[], number[]];
    const normal = [0, 1, 2].map((k) => (u[(k + 1) % 3] ?? 0) * (v[(k + 2) % 3] ?? 0) - (u[(k + 2) % 3] ?? 0) * (v[(k + 1) % 3] ?? 0));
    const length = Math.hypot(...normal) || 1;
    [normal.map((x) => x / length), a, b, c].flat().forEach((x, k) => out.setFloat32(84 + 50 * i + 4 * k, x ?? 0, true));
  });
  return new Blob([out.buffer], { type: 'model/stl' });
}

/** A generated mesh. The service knows no STL: it is made from OBJ here. */
export async function meshAs(name: string, form: MeshForm): Promise<Blob> {
  const call = callOf(name);
  if (!call) throw new Error(t('“{name}” is the name of no shape', { name }));
  const response = await request(`v1/primitives/${call.shape}?${query({ args: call.args, format: form === 'stl' ? 'obj' : form })}`);
  return form === 'stl' ? stlOf(await response.text()) : response.blob();
}
