// What the table shows: order, filters and the chosen submission, kept over a reload.
import { computed, effect, signal } from '@preact/signals';
import { marks } from '../../grade/grading.ts';
import { isByHand, isDone, type StudentMark, type TaskMark } from '../../grade/marks.ts';
import { recall, remember } from '../../storage.ts';

export const states = ['passed', 'failed', 'not graded', 'waiting', 'by hand'] as const;
export type State = (typeof states)[number];

export interface ListState {
  key: string; // name, mark, result, cause, or the number of a task
  up: boolean;
  words: string;
  state: State | '';
  cause: string;
  least: string; // per cent of the mark
  most: string;
}

const usual: ListState = { key: 'name', up: true, words: '', state: '', cause: '', least: '', most: '' };

function recalled(): ListState {
  try {
    return { ...usual, ...(JSON.parse(recall('grade.list') ?? '{}') as Partial<ListState>) };
  } catch {
    return usual;
  }
}

export const list = signal<ListState>(recalled());
export const chosenId = signal<string | null>(recall('grade.chosen'));
export const taskAt = signal(0);
effect(() => void remember('grade.list', JSON.stringify(list.value)));
effect(() => void remember('grade.chosen', chosenId.value));

export const isFiltered = computed(() => Boolean(list.value.words || list.value.state || list.value.cause || list.value.least || list.value.most));
export const clearFilters = (): void => void (list.value = { ...usual, key: list.value.key, up: list.value.up });

export function sortBy(key: string): void {
  const { key: before, up } = list.value;
  // A mark is sorted from the best, and turned by a second click, as all others are.
  list.value = { ...list.value, key, up: before === key ? !up : key === 'name' || key === 'cause' || key === 'result' };
}

export const displayName = ({ submission }: StudentMark): string => submission.name || submission.id;

export function stateOf(mark: StudentMark): Exclude<State, 'by hand'> {
  if (!isDone(mark)) return 'waiting';
  return !mark.graded ? 'not graded' : mark.passed ? 'passed' : 'failed';
}

/** Why a task lost what it lost: a failure, a cause that costs, what is missing, or a criterion. */
function causeOf({ grade, failure }: TaskMark): string {
  if (failure || !grade) return failure?.message ?? '';
  if (grade.refused) return grade.reason?.message ?? '';
  const costly = grade.findings.filter(({ points }) => points > 0).sort((a, b) => b.points - a.points)[0];
  const cause = costly ?? grade.findings.find(({ code }) => code.endsWith('.missing'));
  if (cause) return cause.message;
  const error = grade.penalty > 0 ? grade.diagnostics.find(({ severity }) => severity === 'error') ?? grade.diagnostics[0] : undefined;
  if (error) return error.message;
  const lost = grade.criteria.filter((one) => one.points < one.most).sort((a, b) => (b.most - b.points) - (a.most - a.points));
  return lost[0]?.reason ?? '';
}

/** Why most was lost, of the task that lost most. */
export function firstCause({ tasks }: StudentMark): string {
  const share = ({ grade, failure }: TaskMark): number => (failure || grade?.refused ? -1 : grade ? grade.points / grade.most : 1);
  return [...tasks].sort((a, b) => share(a) - share(b)).map(causeOf).find((text) => text !== '') ?? '';
}

const codesOf = ({ tasks }: StudentMark): string[] => tasks.flatMap(({ grade, failure }) => [
  ...(failure ? [failure.code] : []), ...(grade?.reason ? [grade.reason.code] : []), ...(grade?.findings ?? []).filter(({ points, code }) => points > 0 || code.endsWith('.missing')).map(({ code }) => code),
  ...(grade?.diagnostics ?? []).filter(({ severity }) => severity === 'error').map(({ code }) => code),
]);

/** The codes of causes and how many submissions have them, the most frequent first. */
export const causeCounts = computed(() => {
  const counts = new Map<string, number>();
  for (const mark of marks.value) for (const code of new Set(codesOf(mark))) counts.set(code, (counts.get(code) ?? 0) + 1);
  return [...counts].sort(([a, n], [b, m]) => m - n || a.localeCompare(b));
});

const textOf = (mark: StudentMark): string => [mark.submission.id, mark.submission.name, mark.submission.identifier, stateOf(mark), firstCause(mark), ...mark.comments,
  ...mark.tasks.flatMap(({ grade }) => (grade?.findings ?? []).map(({ message, code }) => `${message} ${code}`))].join(' ').toLowerCase();

function fits(mark: StudentMark, { words, state, cause, least, most }: ListState): boolean {
  if (state === 'by hand' ? !isByHand(mark) : state !== '' && stateOf(mark) !== state) return false;
  if (cause !== '' && !codesOf(mark).includes(cause)) return false;
  if (least !== '' || most !== '') {
    if (!mark.graded) return false;
    const percent = 100 * mark.points / mark.most;
    if ((least !== '' && percent < Number(least)) || (most !== '' && percent > Number(most))) return false;
  }
  const text = words === '' ? '' : textOf(mark);
  return words.toLowerCase().split(/\s+/).filter(Boolean).every((word) => text.includes(word));
}

function valueOf(mark: StudentMark, key: string): string | number {
  if (key === 'mark') return mark.graded ? mark.points : -1;
  if (key === 'result') return stateOf(mark);
  if (key === 'cause') return firstCause(mark).toLowerCase();
  if (key === 'name') return displayName(mark).toLowerCase();
  const grade = mark.tasks[Number(key)]?.grade;
  return grade && !grade.refused ? grade.points / grade.most : -1;
}

/** The submissions that the table shows, in its order. */
export const shown = computed(() => {
  const { key, up } = list.value;
  return marks.value.filter((mark) => fits(mark, list.value)).map((mark) => ({ mark, value: valueOf(mark, key) })).sort((a, b) => {
    const order = typeof a.value === 'string' ? a.value.localeCompare(String(b.value)) : a.value - Number(b.value);
    return (up ? order : -order) || a.mark.submission.id.localeCompare(b.mark.submission.id);
  }).map(({ mark }) => mark);
});

export const chosen = computed(() => marks.value.find(({ submission }) => submission.id === chosenId.value) ?? null);

/** Chooses the submission that is so many rows further. */
export function step(by: number): void {
  const all = shown.value, at = all.findIndex(({ submission }) => submission.id === chosenId.value);
  const next = all[Math.min(all.length - 1, Math.max(0, at < 0 ? 0 : at + by))];
  if (next) chosenId.value = next.submission.id;
}
