// Takes what is dropped or chosen: references, submissions, rubrics and the teacher's tables.
import { signal } from '@preact/signals';
import { addSubmissions, groups, overrides, setRubric, setTasks, submissions, tables, tasks } from '../../grade/grading.ts';
import { readGroups, readOverrides } from '../../grade/report_tables.ts';
import { checkRubric } from '../../grade/rubric.ts';
import { stemOf, submissionsOf, tasksOf } from '../../grade/submissions.ts';
import { exampleClass } from '../../grade/example.ts';
import { isLitter, type NamedFile } from '../../scene/bundle.ts';
import { t } from '../../words.ts';
import { say } from '../ui.tsx';

/** What is wrong with what was dropped. */
export const dropProblems = signal<string[]>([]);
export const reading = signal('');

const maxTableBytes = 8 * 1024 * 1024;
const isAtTop = ({ path }: NamedFile, all: readonly NamedFile[]): boolean => path.split('/').length <= Math.min(...all.map((one) => one.path.split('/').length));

async function textOf({ file, path }: NamedFile): Promise<string> {
  if (file.size > maxTableBytes) throw new Error(t('{name} is larger than 8 MiB', { name: path }));
  return file.text();
}

/** Takes a rubric: of the task of its name, else of all tasks; without a task it is one, that needs no reference. */
async function takeRubric(one: NamedFile): Promise<void> {
  const text = await textOf(one), name = one.path.replace(/^.*\//, '');
  const check = tables.value && checkRubric(text, tables.value);
  if (check && check.problems.length > 0) {
    const { line, pointer, message } = check.problems[0] as (typeof check.problems)[number];
    throw new Error(t('{name}, line {line}: {pointer} {message}', { name, line, pointer, message }));
  }
  const rubric = { name, text };
  if (tasks.value.length === 0) return setTasks([{ name: stemOf(name), reference: null, rubric }], false);
  const at = tasks.value.findIndex((task) => task.name.toLowerCase() === stemOf(name).toLowerCase());
  for (const i of at >= 0 ? [at] : tasks.value.keys()) setRubric(i, rubric);
}

/** Takes tables and rubrics out of the files, and returns the others. */
async function takeTables(files: readonly NamedFile[]): Promise<NamedFile[]> {
  const rest: NamedFile[] = [], rubrics: NamedFile[] = [];
  for (const one of files) {
    const name = one.path.replace(/^.*\//, '').toLowerCase();
    if (name === 'overrides.csv') overrides.value = readOverrides(await textOf(one), one.path);
    else if (name === 'groups.csv') groups.value = readGroups(await textOf(one), one.path);
    else if (name.endsWith('.json') && isAtTop(one, files)) rubrics.push(one);
    else rest.push(one);
  }
  // rubric.json is of all tasks, and those of a task's name stand over it.
  rubrics.sort((a, b) => Number(/rubric\.json$/i.test(b.path)) - Number(/rubric\.json$/i.test(a.path)));
  for (const one of rubrics) await takeRubric(one);
  return rest;
}

async function take(files: readonly NamedFile[], act: (files: NamedFile[]) => Promise<string | null>): Promise<void> {
  dropProblems.value = [];
  reading.value = t('Reading the files…');
  try {
    const kept = files.filter(({ path }) => !isLitter(path)), rest = await takeTables(kept);
    const problem = rest.length > 0 || kept.length === 0 ? await act(rest) : null;
    if (problem) dropProblems.value = [problem];
  } catch (fault) {
    dropProblems.value = [(fault as Error).message];
  }
  reading.value = '';
}

export const takeReference = (files: readonly NamedFile[], isAdded = false): Promise<void> => take(files, async (rest) => {
  const found = tasksOf(rest);
  if (found.length === 0) return t('There is no scene or image among these files.');
  await setTasks(found, isAdded);
  return null;
});

export const takeSubmissions = (files: readonly NamedFile[]): Promise<void> => take(files, async (rest) => {
  const found = await submissionsOf(rest, tasks.value.map(({ name }) => name));
  if (found.length === 0) return t('There is no scene, archive or image among these files.');
  await addSubmissions(found);
  return null;
});

/** Makes the class to try. */
export async function takeExample(): Promise<void> {
  dropProblems.value = [];
  reading.value = t('Making the example…');
  try {
    const made = await exampleClass();
    if (!made) dropProblems.value = [t('This service has no scenes to make an example of.')];
    else {
      await setTasks(made.tasks, false);
      await addSubmissions(made.submissions);
      say(t('{count} submissions made.', { count: submissions.value.length }));
    }
  } catch (fault) {
    dropProblems.value = [(fault as Error).message];
  }
  reading.value = '';
}
