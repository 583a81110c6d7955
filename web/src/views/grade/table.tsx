// The submissions of the class with their marks, sorted and filtered.
import { useEffect, useRef } from 'preact/hooks';
import { baseline } from './baseline.ts';
import { marks, taskNames } from '../../grade/grading.ts';
import { isByHand, type StudentMark, type TaskMark } from '../../grade/marks.ts';
import { msg, number, plural, t } from '../../words.ts';
import { Choice } from '../ui.tsx';
import { causeCounts, chosenId, clearFilters, displayName, firstCause, isFiltered, list, shown, sortBy, states, stateOf, type State } from './list_state.ts';

export const stateWords: Record<State, string> = {
  passed: msg('passed'), failed: msg('failed'), 'not graded': msg('not graded'), waiting: msg('waiting'), 'by hand': msg('changed by hand'),
};

export const mark = (value: number): string => number(value, { maximumFractionDigits: 2 });

/** "5 submissions, 3 passed, 1 not graded, median 61 of 100 points", of those that have a mark. */
function summary(all: readonly StudentMark[]): string {
  const graded = all.filter((one) => stateOf(one) !== 'waiting'), points = graded.filter((one) => one.graded).map((one) => one.points).sort((a, b) => a - b);
  const parts = [plural(all.length, '{count} submission', '{count} submissions')], middle = points.length >> 1;
  if (graded.length > 0) parts.push(plural(graded.filter((one) => one.passed).length, '{count} passed', '{count} passed'));
  const unread = graded.filter((one) => !one.graded).length;
  if (unread > 0) parts.push(plural(unread, '{count} not graded', '{count} not graded'));
  if (points.length > 0) {
    const median = points.length % 2 ? (points[middle] as number) : ((points[middle - 1] as number) + (points[middle] as number)) / 2;
    parts.push(t('median {median} of {most} points', { median: mark(median), most: mark(all[0]?.most ?? 0) }));
  }
  return parts.join(', ');
}

export function Filters() {
  const value = list.value, set = (part: Partial<typeof value>): void => void (list.value = { ...value, ...part });
  const bound = (key: 'least' | 'most', label: string) => (
    <label class="field"><span>{label}</span>
      <input type="number" min="0" max="100" step="any" value={value[key]} onInput={(event) => set({ [key]: event.currentTarget.value })} />
    </label>
  );
  return (
    <div class="filters" role="search" aria-label={t('Filters')}>
      <label class="field grow"><span>{t('Filter')}</span>
        <input id="filter" type="search" value={value.words} placeholder={t('name, cause, comment')} autocomplete="off" onInput={(event) => set({ words: event.currentTarget.value })} />
      </label>
      <Choice label={t('State')} value={value.state} onChange={(state) => set({ state: state as State | '' })}
        choices={[['', t('all')], ...states.map((state) => [state, t(stateWords[state])] as const)]} />
      <Choice label={t('Cause')} value={value.cause} onChange={(cause) => set({ cause })}
        choices={[['', t('all')], ...causeCounts.value.map(([code, count]) => [code, `${code} (${count})`] as const)]} />
      {bound('least', t('From %'))}
      {bound('most', t('To %'))}
      {isFiltered.value && <button type="button" class="link" onClick={clearFilters}>{t('Show all')}</button>}
    </div>
  );
}

function TaskCell({ task: { task, grade, failure, state } }: { task: TaskMark }) {
  const text = failure || grade?.refused ? '–' : grade ? mark(grade.points) : '';
  return <td data-task={task} class={state === 'stale' ? 'figure stale' : 'figure'}>{state === 'grading' ? '…' : text}{state === 'stale' && <span class="hidden"> {t('by an earlier rubric')}</span>}</td>;
}

/** How the mark differs from the one before the rubric was changed. */
function Change({ one }: { one: StudentMark }) {
  const before = baseline.value?.get(one.submission.id);
  if (before === undefined || !one.graded || Math.abs(one.points - before) < 0.005) return null;
  const by = one.points - before;
  return <small class={by > 0 ? 'good' : 'bad'}>{by > 0 ? '+' : '−'}{mark(Math.abs(by))}</small>;
}

function Row({ one, isFirst }: { one: StudentMark; isFirst: boolean }) {
  const state = stateOf(one), isChosen = one.submission.id === chosenId.value, button = useRef<HTMLButtonElement>(null);
  useEffect(() => {
    // The keyboard moves the choice: the row comes into sight, and the focus with it where the table had it.
    if (!isChosen) return;
    button.current?.closest('tr')?.scrollIntoView({ block: 'nearest' });
    if (document.activeElement?.closest('#list tbody')) button.current?.focus({ preventScroll: true });
  }, [isChosen]);
  const isStale = one.tasks.some((task) => task.state === 'stale'), isGrading = one.tasks.some((task) => task.state === 'grading');
  const cause = firstCause(one), tab = isChosen || (isFirst && chosenId.value === null) ? 0 : -1;
  return (
    <tr aria-current={isChosen ? 'true' : undefined} onClick={() => (chosenId.value = one.submission.id)}>
      <td><button ref={button} type="button" class="plain" tabIndex={tab}>{displayName(one)}</button>
        {one.submission.name && <div class="note">{one.submission.identifier}</div>}</td>
      <td class={isStale ? 'figure stale' : 'figure'}>{one.graded ? mark(one.points) : '–'} <Change one={one} /></td>
      {one.tasks.length > 1 && one.tasks.map((task) => <TaskCell key={task.task} task={task} />)}
      <td class={state === 'passed' ? 'good' : state === 'waiting' ? 'note' : 'bad'}>{isGrading ? t('grading…') : t(stateWords[state])}
        {isByHand(one) && <span class="by-hand" title={t('changed by hand')}><span aria-hidden="true"> ✎</span><span class="hidden"> {t('changed by hand')}</span></span>}</td>
      <td class="cause">{cause ? <span title={cause}>{cause}</span> : state === 'passed' && one.points === one.most && <span class="note">{t('as the reference')}</span>}</td>
    </tr>
  );
}

export function Table() {
  const { key, up } = list.value, names = taskNames.value;
  const heads: [string, string][] = [['name', t('Submission')], ['mark', t('Mark of {most}', { most: mark(marks.value[0]?.most ?? 0) })], ...(names.length > 1 ? names.map((name, at) => [String(at), name] as [string, string]) : []),
    ['result', t('Result')], ['cause', t('First cause')]];
  const first = shown.value[0];
  return (
    <section id="list" aria-label={t('Submissions')}>
      <p id="summary" role="status">{summary(marks.value)}{isFiltered.value ? ` · ${t('{count} shown', { count: shown.value.length })}` : ''}</p>
      <div class="scroll" tabIndex={-1}>
        <table>
          <thead><tr>{heads.map(([id, text]) => (
            <th key={id} scope="col" aria-sort={key !== id ? 'none' : up ? 'ascending' : 'descending'}><button type="button" onClick={() => sortBy(id)}>{text}</button></th>
          ))}</tr></thead>
          <tbody>{shown.value.map((one) => <Row key={one.submission.id} one={one} isFirst={one === first} />)}</tbody>
        </table>
      </div>
      {shown.value.length === 0 && <p class="note">{t('No submission matches.')}</p>}
    </section>
  );
}
