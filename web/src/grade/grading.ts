// The class that is graded: its tasks, submissions, results and marks, and the run over them.
import { batch, computed, effect, signal, untracked } from '@preact/signals';
import { findingsOf, patient, Problem, query, request, sentence } from '../api.ts';
import { t } from '../words.ts';
import { isStudent } from './names.ts';
import { studentMark, type StudentMark, type TaskMark } from './marks.ts';
import { comparedPoints, resolved, type Rubric, type RubricDocument } from './rubric.ts';
import { rescored } from './score.ts';
import * as store from './store.ts';
import { byName, type Handed } from './submissions.ts';
import { gradeTables, type GradeTables } from './tables.ts';
import { resultKey, type Grade, type GroupMember, type Override, type Result, type Submission, type Task, type View, type ViewImages } from './types.ts';

const atOnce = 2;

export const tables = signal<GradeTables | null>(null);
export const tasks = signal<readonly Task[]>([]);
export const submissions = signal<readonly Submission[]>([]);
export const overrides = signal<readonly Override[]>([]);
export const groups = signal<readonly GroupMember[]>([]);
export const missing = signal<'placeholder' | 'error'>('placeholder');
export const results = signal<ReadonlyMap<string, Result>>(new Map());
export const inFlight = signal<ReadonlySet<string>>(new Set());
/** Why the run stopped before its end. */
export const stopped = signal('');
export const restoring = signal(true);
const withExpected = new Map<string, string>(); // task -> the rubric whose reference images are here

/** The names of the tasks as reports have them: none where there is one task. */
export const taskNames = computed(() => tasks.value.map(({ name }) => (tasks.value.length > 1 ? name : '')));

const documents = new Map<string, Rubric>();
function rubricOf(text: string, all: GradeTables): Rubric {
  let rubric = documents.get(text);
  if (!rubric) documents.set(text, (rubric = text ? resolved(JSON.parse(text) as RubricDocument, all) : ({ ...all.defaultRubric } as Rubric)));
  return rubric;
}

/** The rubrics of the tasks, with all that they leave out. */
export const rubrics = computed(() => (tables.value ? tasks.value.map((task) => rubricOf(task.rubric?.text ?? '', tables.value as GradeTables)) : []));

const graded = new WeakMap<Result, { rubric: Rubric; grade: Grade | null }>();

/** The grade of a result by the task's rubric of now; null: the service must grade again. */
function gradeBy(result: Result, rubric: Rubric, all: GradeTables): Grade | null {
  const known = graded.get(result);
  if (known?.rubric === rubric) return known.grade;
  const grade = result.grade ? rescored(result.grade, rubricOf(result.rubric, all), rubric, all) : null;
  graded.set(result, { rubric, grade });
  return grade;
}

/** Whether all is there to grade by: a reference, unless the rubric leaves no points to it. */
export const isReady = (task: Task, rubric: Rubric): boolean => task.reference !== null || comparedPoints(rubric) <= 0;

function taskMark(submission: Submission, at: number): TaskMark {
  const task = tasks.value[at] as Task, key = resultKey(task.name, submission.id), result = results.value.get(key), name = taskNames.value[at] ?? '';
  const flying = inFlight.value.has(key);
  if (!result) return { task: name, state: flying ? 'grading' : 'waiting' };
  if (result.failure) return { task: name, state: flying ? 'grading' : 'done', failure: result.failure };
  const grade = gradeBy(result, rubrics.value[at] as Rubric, tables.value as GradeTables), old = result.grade as Grade;
  return { task: name, state: flying ? 'grading' : grade ? 'done' : 'stale', grade: grade ?? old };
}

/** All submissions with their marks, in the order of the class. */
export const marks = computed((): StudentMark[] =>
  (rubrics.value.length === 0 ? [] : submissions.value.map((one) => studentMark(one, tasks.value.map((_, i) => taskMark(one, i)), rubrics.value, overrides.value))));

/** What the service has to grade yet: those without a result, and those whose rubric asks for other renders. */
export const pending = computed(() => submissions.value.flatMap((submission) => tasks.value.flatMap((_, at) => {
  const mark = taskMark(submission, at);
  return mark.state === 'waiting' || mark.state === 'stale' ? [{ submission, at }] : [];
})));
export const staleCount = computed(() => marks.value.reduce((sum, one) => sum + one.tasks.filter(({ state }) => state === 'stale').length, 0));
export const total = computed(() => submissions.value.length * tasks.value.length);
export const running = signal<{ done: number; all: number } | null>(null);

effect(() => {
  const value: store.KeptClass = {
    tasks: tasks.value.map(({ name, reference, rubric }) => ({ name, reference: reference && { name: reference.name, fileName: reference.fileName }, rubric })),
    submissions: [...submissions.value], overrides: [...overrides.value], groups: [...groups.value], missing: missing.value,
  };
  if (!untracked(() => restoring.value)) void store.keepClass(value);
});

/** Loads the tables and the class of before. */
export async function restore(): Promise<void> {
  if (!restoring.value) return;
  tables.value = await gradeTables();
  const before = await store.keptClass();
  if (before) {
    const all = await store.keptResults();
    const loaded = await Promise.all(before.tasks.map(async ({ name, reference, rubric }): Promise<Task> => {
      const file = reference && (await store.referenceFiles.get(name));
      return { name, rubric, reference: reference && file ? { ...reference, file } : null };
    }));
    batch(() => {
      [tasks.value, submissions.value, overrides.value, groups.value] = [loaded, before.submissions, before.overrides, before.groups];
      [missing.value, results.value] = [before.missing, all];
    });
  }
  restoring.value = false;
}

function setResult(key: string, result: Result | null): void {
  const all = new Map(results.value);
  if (result) all.set(key, result);
  else all.delete(key);
  results.value = all;
  void store.keepResult(key, result);
}

const dropResults = (isGone: (key: string) => boolean): void => {
  for (const key of [...results.value.keys()].filter(isGone)) {
    setResult(key, null);
    void store.viewImages.delete(key);
  }
};

/** Adds submissions; one that was there before is graded anew. */
export async function addSubmissions(all: readonly Handed[]): Promise<void> {
  const fresh = new Set(all.map(({ id }) => id));
  for (const { id, file } of all) await store.submissionFiles.set(id, file);
  dropResults((key) => fresh.has(key.slice(key.indexOf('\n') + 1)));
  submissions.value = [...submissions.value.filter(({ id }) => !fresh.has(id)), ...all.map(({ file: _, ...one }) => one)]
    .sort((a, b) => byName(a.id, b.id));
}

/** The reference of a task, and the images of it, are kept no longer. */
async function forgetFiles(task: string): Promise<void> {
  withExpected.delete(task);
  await Promise.all([store.referenceFiles.delete(task), store.expectedImages.delete(task)]);
}

/** Replaces the tasks, or adds to them; a task's rubric stays where its name is the same. */
export async function setTasks(all: readonly Task[], isAdded: boolean): Promise<void> {
  const names = new Set(all.map(({ name }) => name)), before = tasks.value;
  if (!isAdded) for (const { name } of before) if (!names.has(name)) void forgetFiles(name);
  const fresh = all.map((task) => ({ ...task, rubric: task.rubric ?? before.find(({ name }) => name === task.name)?.rubric ?? (all.length === 1 && before.length === 1 && !isAdded ? (before[0]?.rubric ?? null) : null) }));
  for (const { name, reference } of fresh) {
    await forgetFiles(name);
    if (reference) await store.referenceFiles.set(name, reference.file);
  }
  // Among several tasks the name of each says which scene of an archive is meant.
  const isOther = isAdded && before.length === 1;
  dropResults((key) => isOther || !isAdded || names.has(key.slice(0, key.indexOf('\n'))));
  tasks.value = isAdded ? [...before.filter(({ name }) => !names.has(name)), ...fresh].sort((a, b) => byName(a.name, b.name)) : fresh;
}

export function setRubric(at: number, rubric: Task['rubric']): void {
  tasks.value = tasks.value.map((task, i) => (i === at ? { ...task, rubric } : task));
}

export function removeTask(name: string): void {
  dropResults((key) => tasks.value.length === 2 || key.startsWith(`${name}\n`));
  tasks.value = tasks.value.filter((task) => task.name !== name);
  void forgetFiles(name);
}

/** The marks of a person for a submission: a mark or a comment, or neither to take it back. */
export function setOverride(row: Omit<Override, 'student'>, submission: Submission): void {
  const isSame = (one: Override): boolean =>
    isStudent(one.student, submission) && one.task.toLowerCase() === row.task.toLowerCase() && one.criterion === row.criterion;
  const rest = overrides.value.filter((one) => !isSame(one));
  overrides.value = row.mark === null && row.comment.trim() === '' ? rest : [...rest, { ...row, student: submission.id }];
}

/** Takes a submission out of the class; a person's marks of it stay in overrides.csv. */
export function removeSubmission(id: string): void {
  dropResults((key) => key.slice(key.indexOf('\n') + 1) === id);
  submissions.value = submissions.value.filter((one) => one.id !== id);
  void store.submissionFiles.delete(id);
}

/** Grades all anew. */
export function regrade(): void {
  dropResults(() => true);
}

export async function forget(): Promise<boolean> {
  cancel();
  restoring.value = true; // nothing of this is kept
  withExpected.clear();
  batch(() => {
    [tasks.value, submissions.value, overrides.value, groups.value] = [[], [], [], []];
    [results.value, stopped.value, missing.value] = [new Map(), '', 'placeholder'];
  });
  const isForgotten = await store.forgetClass();
  restoring.value = false;
  return isForgotten;
}

const blobOf = (url: string): Blob => {
  const [head = '', base64 = ''] = url.split(',', 2);
  return new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: /:(.*?);/.exec(head)?.[1] ?? 'image/jpeg' });
};

type Answer = Omit<Grade, 'views'> & { views: (View & { picture?: string; heat?: string; expected?: string })[] };

/** Takes the images out of an answer, so that memory holds figures alone. */
function splitImages(answer: Answer): { grade: Grade; images: ViewImages[]; expected: (Blob | null)[] } {
  const images: ViewImages[] = [], expected: (Blob | null)[] = [];
  const views = answer.views.map(({ picture, heat, expected: reference, ...view }) => {
    images.push({ picture: picture ? blobOf(picture) : null, heat: heat ? blobOf(heat) : null });
    expected.push(reference ? blobOf(reference) : null);
    return view;
  });
  return { grade: { ...answer, views }, images, expected };
}

// Of these a rubric or a reference is the cause, and no submission can be graded.
const isOfTask = (problem: Problem, task: Task, submission: Submission): boolean =>
  /^rubric\.|^grade\.(no|needless)-reference$/.test(problem.code) ||
  (problem.status < 500 && problem.status !== 413 && problem.findings[0]?.file === task.reference?.fileName && submission.fileName !== task.reference?.fileName);

let abort: AbortController | null = null;

async function ask(submission: Submission, task: Task, signalOf: AbortSignal): Promise<void> {
  const key = resultKey(task.name, submission.id), rubric = task.rubric?.text ?? '';
  // Before anything is waited for: an edit of the rubric replaces the task meanwhile.
  const isCompared = comparedPoints(rubrics.value[tasks.value.indexOf(task)] as Rubric) > 0;
  const others = tasks.value.filter((one) => one !== task).map(({ name }) => name.replaceAll(',', ' ')).join();
  const file = await store.submissionFiles.get(submission.id);
  if (!file) return setResult(key, { rubric, failure: { code: 'grade.lost', message: t('The browser no longer has this file. Add it again.') } });
  const form = new FormData();
  form.append('submission', file, submission.fileName);
  if (task.reference && isCompared) form.append('reference', task.reference.file, task.reference.fileName);
  if (rubric) form.append('rubric', new Blob([rubric], { type: 'application/json' }), 'rubric.json');
  const url = `v1/grade?${query({
    pictures: withExpected.get(task.name) === rubric ? 1 : 2, missing: missing.value, ...(others ? { task: task.name, others } : {}),
  })}`;
  const response = await patient(() => request(url, { method: 'POST', body: form, signal: signalOf }));
  const { grade, images, expected } = splitImages((await response.json()) as Answer);
  if (expected.some((one) => one)) {
    withExpected.set(task.name, rubric);
    await store.expectedImages.set(task.name, expected);
  }
  if (!submissions.value.includes(submission) || !tasks.value.some((one) => one.name === task.name && one.reference === task.reference)) return; // gone meanwhile
  await store.viewImages.set(key, images);
  setResult(key, { grade, rubric });
}

async function gradeOne(submission: Submission, task: Task, stop: AbortController): Promise<void> {
  const key = resultKey(task.name, submission.id);
  inFlight.value = new Set([...inFlight.value, key]);
  try {
    await ask(submission, task, stop.signal);
  } catch (fault) {
    if (stop.signal.aborted) return;
    const message = findingsOf(fault).map((one) => sentence(one)).join(' ');
    if (fault instanceof Problem && !isOfTask(fault, task, submission)) setResult(key, { rubric: task.rubric?.text ?? '', failure: { code: fault.code, message } });
    else {
      stopped.value = fault instanceof Problem ? t('The task “{name}” cannot be graded: {reason}', { name: task.name, reason: message }) : message;
      stop.abort();
    }
  } finally {
    inFlight.value = new Set([...inFlight.value].filter((one) => one !== key));
  }
}

/** Grades what has no result yet; after a cancel it goes on where it stopped. */
export async function run(): Promise<void> {
  const queue = pending.value.filter(({ at }) => isReady(tasks.value[at] as Task, rubrics.value[at] as Rubric))
    .map(({ submission, at }) => ({ submission, name: tasks.value[at]?.name }));
  if (running.value || queue.length === 0) return;
  const stop = (abort = new AbortController()), all = queue.length;
  stopped.value = '';
  running.value = { done: 0, all };
  const worker = async (): Promise<void> => {
    for (let next = queue.shift(); next && !stop.signal.aborted; next = queue.shift()) {
      const task = tasks.value.find(({ name }) => name === next?.name);
      if (task) await gradeOne(next.submission, task, stop);
      if (!stop.signal.aborted) running.value = { done: all - queue.length - inFlight.value.size, all };
    }
  };
  await Promise.all(Array.from({ length: atOnce }, worker));
  running.value = null;
}

/** Ends the run; what is graded stays. */
export function cancel(): void {
  abort?.abort();
}
