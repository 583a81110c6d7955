// How handles snap; remembered in this browser.
import { signal } from '@preact/signals';
import { recall, remember } from '../storage.ts';
import type { Steps } from './handles.ts';

export interface Snapping {
  isOn: boolean;
  steps: Steps;
}

const usual: Snapping = { isOn: false, steps: { move: 0.5, turn: 15, scale: 0.25 } };
const limits: Record<keyof Steps, number> = { move: 1e6, turn: 180, scale: 1000 };

function read(): Snapping {
  try {
    const kept = JSON.parse(recall('snapping') ?? 'null') as Partial<Snapping> | null;
    const step = (name: keyof Steps): number => {
      const value = Number(kept?.steps?.[name]);
      return value > 0 && value <= limits[name] ? value : usual.steps[name];
    };
    return { isOn: kept?.isOn === true, steps: { move: step('move'), turn: step('turn'), scale: step('scale') } };
  } catch {
    return usual;
  }
}

export const snapping = signal<Snapping>(read());

export function setSnapping(next: Snapping): void {
  snapping.value = next;
  remember('snapping', JSON.stringify(next));
}

export function setStep(name: keyof Steps, value: number): void {
  if (value > 0 && value <= limits[name]) setSnapping({ ...snapping.value, steps: { ...snapping.value.steps, [name]: value } });
}

/** The steps that hold now; `inverted`: while Shift is pressed. */
export function stepsNow(inverted: boolean): Steps {
  const { isOn, steps } = snapping.value;
  return isOn !== inverted ? steps : { move: 0, turn: 0, scale: 0 };
}
