// One picture as it came from the server.
import type { Finding, Options } from '../api.ts';
import { formOf, type Loose } from './bundle.ts';
import { isChanged, type FileChanges } from './scene_files.ts';
import { Problem, query, request } from '../api.ts';
import type { LookAt } from '../maths/camera.ts';

export interface Stats {
  instances?: number;
  culled?: number;
  triangles?: number;
  drawCalls?: number;
  textures?: number;
  lights?: number;
  [name: string]: number | undefined;
}

export interface Frame {
  bitmap: ImageBitmap;
  blob: Blob;
  options: Options;
  stats: Stats;
  camera: LookAt | null;
  findings: Finding[];
}

function headerJson<T>(response: Response, name: string, otherwise: T): T {
  const text = response.headers.get(name);
  if (!text) return otherwise;
  try {
    return JSON.parse(text) as T;
  } catch {
    return otherwise;
  }
}

/** Where a scene's pictures come from. */
export interface Origin {
  id: string | null; // of the stored scene; null: the text alone
  text: string | null; // the edited document; null: as it is stored
  loose: Loose | null; // files of this browser that the document names
  files: FileChanges;
}

/** The body that sends the document. Of a stored scene's files only those that changed are sent. */
export function bodyOf({ id, text, loose, files }: Origin): RequestInit {
  if (loose) return { body: formOf(loose, text ?? '', files) };
  if (!isChanged(files)) return { body: text ?? '', headers: { 'Content-Type': 'application/xml' } };
  const main = 'scene.xml', form = formOf({ main, files: [{ path: main, file: new Blob([]) }] }, text ?? '', files);
  if (id !== null && files.removed.length > 0) form.append('without', files.removed.join('\n'));
  return { body: form };
}

/** The frames of one viewer are a session, numbered from 1: newer ones drop older ones that still wait. */
export const newSession = (): string => crypto.getRandomValues(new Uint32Array(2)).join('-');

export function pictureUrl(origin: Origin, options: Options): string {
  if (origin.text === null && origin.id !== null)
    return `v1/scenes/${origin.id.split('/').map(encodeURIComponent).join('/')}/image?${query(options)}`;
  return `v1/render?${query(origin.id === null ? options : { base: origin.id, ...options })}`;
}

/** The answer, or undefined when a newer frame of this session took its place. */
export async function fetchPicture(origin: Origin, options: Options, signal?: AbortSignal): Promise<Response | undefined> {
  const init: RequestInit = signal ? { signal } : {};
  if (origin.text !== null || origin.id === null)
    Object.assign(init, { method: 'POST' }, bodyOf(origin));
  try {
    const response = await request(pictureUrl(origin, options), init);
    return response.status === 204 ? undefined : response;
  } catch (fault) {
    if (fault instanceof Problem && fault.superseded) return undefined; // of an older server
    throw fault;
  }
}

export async function decodeFrame(response: Response, options: Options): Promise<Frame> {
  const blob = await response.blob();
  return {
    bitmap: await createImageBitmap(blob),
    blob,
    options,
    stats: headerJson<Stats>(response, 'X-Farol-Stats', {}),
    camera: headerJson<LookAt | null>(response, 'X-Farol-Camera', null),
    findings: headerJson<Finding[]>(response, 'X-Farol-Diagnostics', []),
  };
}
