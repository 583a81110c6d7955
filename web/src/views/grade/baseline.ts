// Marks before the rubric was changed, to compare with.
import { signal } from '@preact/signals';
import { marks } from '../../grade/grading.ts';

export const baseline = signal<ReadonlyMap<string, number> | null>(null);

export const takeBaseline = (): void => void (baseline.value = new Map(marks.value.filter(({ graded }) => graded).map((one) => [one.submission.id, one.points])));
