// What turns and goes round in a scene, and when each of it is where it began: the keys of the timeline.
import { spellings } from './language.ts';
import { attributeOf, parseXml, walkXml, type XmlElement } from './xml.ts';

export interface Mover {
  kind: 'turn' | 'lap';
  name: string; // of its group; empty: it has none
  seconds: number; // a turn or a lap
}

/** A moment at which movers are where they began; `count` of turns or laps until then. */
export interface Key {
  time: number;
  movers: { mover: Mover; count: number }[];
}

const maxKeys = 2000;
const isCalled = (element: XmlElement, name: string): boolean => spellings(name).some((one) => one.toLowerCase() === element.name.toLowerCase());

function groupName(element: XmlElement): string {
  for (let at: XmlElement | null = element; at; at = at.parent) {
    const name = isCalled(at, 'group') ? attributeOf(at, ['name'])?.value.trim() : undefined;
    if (name) return name;
  }
  return '';
}

/** Of the document alone, not of files that it includes; each kind, name and time once. */
export function moversOf(text: string): Mover[] {
  const out = new Map<string, Mover>();
  for (const element of walkXml(parseXml(text))) {
    const kind = isCalled(element, 'rotate') ? 'turn' : isCalled(element, 'translate') ? 'lap' : null;
    if (!kind) continue;
    const seconds = Math.abs(Number(attributeOf(element, spellings(kind === 'turn' ? 'rotate' : 'translate', 'time'))?.value ?? Number.NaN));
    if (!(seconds >= 0.001) || !Number.isFinite(seconds)) continue;
    if (kind === 'lap' && !element.children.some((child) => isCalled(child, 'point'))) continue;
    const mover: Mover = { kind, name: groupName(element), seconds };
    out.set(JSON.stringify(mover), mover);
  }
  return [...out.values()];
}

/** The keys from `from` for `lap` seconds, in order; none where there would be too many to see. */
export function keysOf(movers: readonly Mover[], from: number, lap: number): Key[] {
  const keys = new Map<number, Key>();
  if (movers.reduce((sum, { seconds }) => sum + lap / seconds, 0) > maxKeys) return [];
  for (const mover of movers)
    for (let count = Math.max(0, Math.ceil(from / mover.seconds - 1e-6)); count * mover.seconds <= from + lap + 1e-6; ++count) {
      const time = Number((count * mover.seconds).toFixed(3)), key = keys.get(time) ?? { time, movers: [] };
      key.movers.push({ mover, count });
      keys.set(time, key);
    }
  return [...keys.values()].sort((a, b) => a.time - b.time);
}
