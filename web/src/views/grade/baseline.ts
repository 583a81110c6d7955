// What the panel of the rubric holds beside the class: marks before the rubric was changed, and texts that are not applied.
import { signal } from '@preact/signals';
import { marks } from '../../grade/grading.ts';
import type { RubricCheck } from '../../grade/rubric.ts';

export const baseline = signal<ReadonlyMap<string, number> | null>(null);
/** Texts that are not applied, as they have problems, by task. */
export const drafts = signal<Readonly<Record<string, { text: string; check: RubricCheck }>>>({});

export const takeBaseline = (): void => void (baseline.value = new Map(marks.value.filter(({ graded }) => graded).map((one) => [one.submission.id, one.points])));

export function forgetRubricPanel(): void {
  [baseline.value, drafts.value] = [null, {}];
}
