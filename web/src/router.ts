// The address after the #: what is on show, so that it can be shared.
//   #/                 the gallery          #/scene/ID?az=..&el=..   a scene and how it is seen
//   #/new              a scene of one's own #/grade                  marks a class
//   #/assignments/ID   a student's check of a scene
//   #/compare/A/B?..   two scenes side by side; each may be left out
// Anything else is `lost`: a link that was cut off or mistyped.
import { signal } from '@preact/signals';
import { formatVec, parseVec } from './maths/vec.ts';
import type { Orbit, Walk } from './maths/camera.ts';

export type Place =
  | { page: 'gallery' }
  | { page: 'grade' }
  | { page: 'assignment'; id: string }
  | { page: 'new' }
  | { page: 'compare'; first: string; second: string; view: URLSearchParams }
  | { page: 'lost' }
  | { page: 'scene'; id: string; view: URLSearchParams };

/** What a link says of the view: all of it may be missing. */
export interface ViewLink {
  orbit: Orbit | null;
  walk: Walk | null;
  time: number | null;
  options: Record<string, string>;
}

/** Picture options that travel in a link. */
export const linkedOptions = [
  'shading', 'aa', 'filter', 'error', 'axes', 'curves', 'focus', 'debug', 'background', 'layer', 'viewer', 'specular', 'entity', 'transparency', 'shadows',
] as const;

export function parsePlace(hash: string): Place {
  const [path = '', text = ''] = hash.replace(/^#/, '').split(/\?(.*)/s);
  if (path === '/grade') return { page: 'grade' };
  if (path === '/new') return { page: 'new' };
  const pair = /^\/compare(?:\/([^/]*))?(?:\/([^/]*))?$/.exec(path);
  if (pair) return comparePlace(pair[1] ?? '', pair[2] ?? '', new URLSearchParams(text));
  const assignment = /^\/assignments\/([a-z0-9-]{1,40})$/.exec(path);
  if (assignment) return { page: 'assignment', id: assignment[1] as string };
  if (path === '' || path === '/') return { page: 'gallery' };
  const scene = /^\/scene\/(.+)$/.exec(path);
  if (!scene) return { page: 'lost' };
  try {
    return { page: 'scene', id: decodeURIComponent(scene[1] as string), view: new URLSearchParams(text) };
  } catch {
    return { page: 'lost' }; // a broken %-escape names nothing
  }
}

function comparePlace(first: string, second: string, view: URLSearchParams): Place {
  try {
    return { page: 'compare', first: decodeURIComponent(first), second: decodeURIComponent(second), view };
  } catch {
    return { page: 'lost' };
  }
}

export const compareAddress = (first: string, second: string, view = ''): string =>
  `#/compare/${encodeURIComponent(first)}/${encodeURIComponent(second)}${view ? `?${view}` : ''}`;

const numberOf = (view: URLSearchParams, name: string): number | null => {
  const text = view.get(name);
  const value = Number(text);
  return text === null || text.trim() === '' || !Number.isFinite(value) ? null : value;
};

export function parseView(view: URLSearchParams): ViewLink {
  const azimuth = numberOf(view, 'az'), elevation = numberOf(view, 'el'), distance = numberOf(view, 'd');
  const target = parseVec(view.get('at')), eye = parseVec(view.get('eye'));
  const yaw = numberOf(view, 'yaw'), pitch = numberOf(view, 'pitch');
  const options: Record<string, string> = {};
  for (const name of linkedOptions) {
    const value = view.get(name);
    if (value !== null) options[name] = value;
  }
  return {
    orbit: azimuth !== null && elevation !== null && distance !== null && distance > 0 && target
      ? { azimuth, elevation, distance, target } : null,
    walk: eye && yaw !== null && pitch !== null ? { eye, yaw, pitch } : null,
    time: numberOf(view, 't'),
    options,
  };
}

/** As exact as pictures are asked for (`orbitOptions`): who follows a link sees the same pixels. */
export function formatView(view: ViewLink): string {
  const out = new URLSearchParams();
  if (view.walk) {
    out.set('eye', formatVec(view.walk.eye));
    out.set('yaw', String(Number(view.walk.yaw.toFixed(4))));
    out.set('pitch', String(Number(view.walk.pitch.toFixed(4))));
  } else if (view.orbit) {
    out.set('az', String(Number(view.orbit.azimuth.toFixed(4))));
    out.set('el', String(Number(view.orbit.elevation.toFixed(4))));
    out.set('d', String(Number(view.orbit.distance.toPrecision(8))));
    out.set('at', formatVec(view.orbit.target, 8));
  }
  if (view.time) out.set('t', String(Number(view.time.toFixed(3))));
  for (const [name, value] of Object.entries(view.options)) out.set(name, value);
  return out.toString().replaceAll('%2C', ',');
}

export const scenePlace = (id: string, view = ''): string =>
  `#/scene/${id.split('/').map(encodeURIComponent).join('/')}${view ? `?${view}` : ''}`;

export const place = signal<Place>(parsePlace(location.hash));
addEventListener('hashchange', () => {
  place.value = parsePlace(location.hash);
});

/** The line that the editor of the next scene opens at. */
export const nextLine = signal<number | null>(null);

/** Changes the address without a new entry in the history, and without opening anything. */
export function replaceAddress(hash: string): void {
  if (location.hash !== hash) history.replaceState(null, '', hash);
}

/** The words that the gallery looks for. */
export const searchWords = signal('');

/** Makes the gallery look for a scene by the last part of its name. */
export function findScene(id: string): void {
  searchWords.value = id.replace(/^.*\//, '').replaceAll(/[-_.]+/g, ' ');
}
