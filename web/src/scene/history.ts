// One history of everything that is changed on a scene: its XML, its files and the camera.
import type { Orbit, Walk } from '../maths/camera.ts';
import { noMarks, type Marks } from './marks.ts';
import type { FileChanges } from './scene_files.ts';

/** What can be gone back to. */
export interface Moment {
  text: string | null; // null: as it is stored
  files: FileChanges;
  marks: Marks;
  orbit: Orbit | null;
  walk: Walk | null;
}

/** Changes of one kind that follow each other sooner than this are one step. */
export const stepGapMs = 800;
const maxSteps = 200;
const maxTextLength = 1_000_000; // of all texts that are written out

/** As it is kept in the browser: every text once. */
export interface WrittenHistory {
  texts: (string | null)[];
  past: (Omit<Moment, 'text'> & { text: number })[];
  future: (Omit<Moment, 'text'> & { text: number })[];
}

export class History {
  private past: Moment[] = [];
  private future: Moment[] = []; // the next one last
  private last = { kind: '', at: Number.NEGATIVE_INFINITY };
  private gesture: 'none' | 'begun' | 'recorded' = 'none';
  private futureBefore: Moment[] = []; // the gesture

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** Before a change: how things are until then. A `kind` of '' is a step on its own. */
  record(kind: string, before: Moment, now: number): void {
    const goesOn = kind !== '' && kind === this.last.kind && now - this.last.at < stepGapMs;
    this.last = { kind, at: now };
    if (this.gesture === 'recorded' || (this.gesture === 'none' && goesOn)) return;
    if (this.gesture === 'begun') this.gesture = 'recorded';
    this.past.push(before);
    if (this.past.length > maxSteps) this.past.shift();
    this.future = [];
  }

  /** Until `endGesture` all changes are one step, whatever time passes between them. */
  beginGesture(): void {
    this.end();
    this.gesture = 'begun';
    this.futureBefore = this.future;
  }

  /** A gesture that changed nothing is no step. */
  endGesture(current: Moment): void {
    const before = this.past[this.past.length - 1];
    if (this.gesture === 'recorded' && before && before.text === current.text && before.orbit === current.orbit) {
      this.past.pop();
      this.future = this.futureBefore;
    }
    this.gesture = 'none';
    this.end();
  }

  /** Ends the step: the next change begins another one. */
  private end(): void {
    this.last = { kind: '', at: Number.NEGATIVE_INFINITY };
  }

  undo(current: Moment): Moment | null {
    const before = this.past.pop();
    if (!before) return null;
    this.end();
    this.future.push(current);
    return before;
  }

  redo(current: Moment): Moment | null {
    const after = this.future.pop();
    if (!after) return null;
    this.end();
    this.past.push(current);
    return after;
  }

  write(): WrittenHistory {
    const texts: (string | null)[] = [], known = new Map<string | null, number>();
    let room = maxTextLength;
    const put = (moment: Moment): WrittenHistory['past'][number] | null => {
      let index = known.get(moment.text);
      if (index === undefined) {
        room -= moment.text?.length ?? 0;
        if (room < 0) return null;
        index = texts.push(moment.text) - 1;
        known.set(moment.text, index);
      }
      return { ...moment, text: index };
    };
    // From the present on, so that the farthest are left out.
    const until = (moments: readonly Moment[]): WrittenHistory['past'] => {
      const out: WrittenHistory['past'] = [];
      for (const moment of [...moments].reverse()) {
        const one = put(moment);
        if (!one) break;
        out.unshift(one);
      }
      return out;
    };
    return { past: until(this.past), future: until(this.future), texts };
  }

  read({ texts, past, future }: WrittenHistory): void {
    const back = (moments: WrittenHistory['past']): Moment[] =>
      moments.map((one) => ({ ...one, marks: one.marks ?? noMarks, text: texts[one.text] ?? null }));
    this.past = back(past);
    this.future = back(future);
    this.end();
  }
}
