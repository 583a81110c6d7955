// The service as the page uses it (api/openapi.yaml).
import type { LookAt, Orbit } from './maths/camera.ts';
import { askForToken, token } from './token.ts';
import { language, t } from './words.ts';

export type Severity = 'info' | 'warning' | 'error';

export interface Finding {
  code: string;
  severity: Severity;
  message: string;
  file?: string;
  line?: number;
  column?: number;
  field?: string;
}

export interface SceneFacts {
  id: string;
  valid: boolean;
  title: string;
  description: string;
  width?: number;
  height?: number;
  animated?: boolean;
  playFrom?: number;
  loopSeconds?: number;
  camera?: LookAt;
  counts?: { models: number; lights: number; textures: number; triangles: number; textureBytes: number };
  diagnostics: Finding[];
  problem?: { code: string; message: string }; // why it cannot be rendered
  links: { self: string; source: string; image: string; thumbnail: string; turntable?: string; model?: string };
  upload?: boolean;
  expires?: string | null;
}

/** A stored scene's document and the files beside it. */
export interface FileList {
  main: string;
  files: { path: string; bytes: number }[];
}

/** Where the models of a layer=id picture stand: number n is the element copies[n - 1]. */
export interface ModelPlaces {
  models: { model: string; file: string; line: number; column: number; id?: string; name?: string }[];
  copies: number[];
}

export interface ScenePage {
  scenes: SceneFacts[];
  page: number;
  pages: number;
  total: number;
}

export type Options = Record<string, string | number>;

/** An answer that is not a success: its findings are sentences with a place. */
export class Problem extends Error {
  constructor(
    readonly status: number,
    readonly code: string,
    readonly findings: Finding[],
    readonly retryAfterS: number | null,
  ) {
    super(findings[0]?.message ?? t('The server answered {status}.', { status }));
  }
  get superseded(): boolean {
    return this.code === 'busy.superseded';
  }
  get busy(): boolean {
    return this.status === 503 || this.status === 429;
  }
}

export async function problemOf(response: Response): Promise<Problem> {
  const retry = Number(response.headers.get('Retry-After') ?? Number.NaN);
  const retryAfterS = Number.isFinite(retry) ? retry : null;
  try {
    const body = (await response.json()) as { code?: string; detail?: string; errors?: Finding[] };
    const detail = body.detail ?? t('The server answered {status}.', { status: response.status });
    const findings = body.errors?.length
      ? body.errors
      : [{ code: body.code ?? '', severity: 'error' as const, message: detail }];
    return new Problem(response.status, body.code ?? '', findings, retryAfterS);
  } catch {
    const message = t('The server answered {status}.', { status: `${response.status} ${response.statusText}`.trim() });
    return new Problem(response.status, '', [{ code: '', severity: 'error', message }], retryAfterS);
  }
}

/** With the reader's language, and the token, where there is one, for what changes something. */
function withHeaders(init: RequestInit | undefined): RequestInit {
  const headers = new Headers(init?.headers), known = token();
  headers.set('Accept-Language', language.value);
  if (known !== null && (init?.method ?? 'GET') !== 'GET') headers.set('Authorization', `Bearer ${known}`);
  return { ...init, headers };
}

/** The answer; throws a Problem unless it is a success. A token that is wanted is asked for. */
export async function request(url: string, init?: RequestInit): Promise<Response> {
  for (;;) {
    const sent = token();
    const response = await fetch(url, withHeaders(init));
    if (response.ok) return response;
    const problem = await problemOf(response);
    if (response.status !== 401) throw problem;
    // Another request may have been given the token while this one was under way.
    if (token() !== sent) continue;
    const why = sent === null ? t('Storing and deleting need the token it was started with.') : sentence(problem.findings[0] as Finding);
    if (!(await askForToken(why))) throw problem;
  }
}

/** Asks a busy server again when it says so, a few times. */
export async function patient<T>(ask: () => Promise<T>): Promise<T> {
  for (let attempt = 1; ; ++attempt) {
    try {
      return await ask();
    } catch (fault) {
      if (!(fault instanceof Problem && fault.busy) || attempt > 4) throw fault;
      await new Promise((done) => setTimeout(done, (fault.retryAfterS ?? 1) * 1000 * attempt));
    }
  }
}

const json = async <T>(url: string, init?: RequestInit): Promise<T> => (await (await request(url, init)).json()) as T;

export const scenePath = (id: string): string => `v1/scenes/${id.split('/').map(encodeURIComponent).join('/')}`;

export const query = (options: Options): string =>
  new URLSearchParams(Object.entries(options).map(([key, value]) => [key, String(value)])).toString();

export const listScenes = (page: number, words: string): Promise<ScenePage> =>
  patient(() => json(`v1/scenes?${query({ page, ...(words ? { q: words } : {}) })}`));

export const getScene = (id: string): Promise<SceneFacts> => patient(() => json(scenePath(id)));

export const getModels = (id: string): Promise<ModelPlaces> => json(`${scenePath(id)}/models`);

export const getFiles = (id: string): Promise<FileList> => patient(() => json(`${scenePath(id)}/files`));

export const getSource = async (id: string): Promise<string> => (await request(`${scenePath(id)}/source`)).text();

/** Removes an upload. */
export const deleteScene = async (id: string): Promise<void> => void (await request(scenePath(id), { method: 'DELETE' }));

/** Facts about a document that is sent, and the places of its models. */
export const validate = (body: RequestInit, base: string | null): Promise<SceneFacts & Partial<ModelPlaces>> =>
  json(`v1/validate?${query(base === null ? { models: 1 } : { models: 1, base })}`, { method: 'POST', ...body });

/** Of a service that lists none: what each can write. */
const usualAnimations: readonly string[] = ['apng', 'gif', 'animated-webp'];
let animations: Promise<readonly string[]> | undefined;

/** The formats of animations that this service can write. */
export function animationFormats(): Promise<readonly string[]> {
  animations ??= json<{ animations?: string[] }>('version').then((version) => version.animations ?? usualAnimations, () => {
    animations = undefined; // asked again the next time
    return usualAnimations;
  });
  return animations;
}

const asSentence = (text: string): string => {
  const ended = /[.?!]\s*$/.test(text) ? text.trimEnd() : `${text.trimEnd()}.`;
  return ended.charAt(0).toUpperCase() + ended.slice(1);
};

/** A finding as a sentence, with its place or without. */
export function sentence(finding: Finding, placed = true): string {
  const { line, column } = finding, text = asSentence(finding.message);
  if (!line || !placed) return text;
  return column ? t('Line {line}, column {column}: {text}', { line, column, text }) : t('Line {line}: {text}', { line, text });
}

/** Why a scene cannot be rendered: its finding, with a place, or the problem alone (a crash, a deadline). */
export function faultOf({ diagnostics, problem }: SceneFacts): Finding | undefined {
  const found = diagnostics.find((one) => one.severity === 'error' && (!problem || one.code === problem.code));
  return found ?? (problem && { ...problem, severity: 'error' });
}

/** All findings of a stored scene; first why it cannot be rendered, where it cannot. */
export function findingsOfFacts(facts: SceneFacts): Finding[] {
  const fault = facts.valid ? undefined : faultOf(facts);
  return fault ? [fault, ...facts.diagnostics.filter((one) => one !== fault)] : facts.diagnostics;
}

/** What went wrong, as findings, whatever was thrown. */
export function findingsOf(fault: unknown): Finding[] {
  if (fault instanceof Problem) return fault.findings;
  const message = fault instanceof TypeError ? t('The server does not answer') : String((fault as Error)?.message ?? fault);
  return [{ code: '', severity: 'error', message }];
}

export const orbitOptions = (orbit: Orbit): Options => ({
  azimuth: Number(orbit.azimuth.toFixed(4)),
  elevation: Number(orbit.elevation.toFixed(4)),
  distance: Number(orbit.distance.toPrecision(8)),
  target: orbit.target.map((x) => Number(x.toPrecision(8))).join(','),
});
