// All that is known of a submission, and the marks that a person gives it.
import { useEffect, useRef } from 'preact/hooks';
import { overrides, removeSubmission, rubrics, setOverride, tasks, taskNames } from '../../grade/grading.ts';
import type { StudentMark, TaskMark } from '../../grade/marks.ts';
import { isStudent } from '../../grade/names.ts';
import { resultKey, type Cause, type CriterionGrade, type Diagnostic, type Submission } from '../../grade/types.ts';
import { t } from '../../words.ts';
import { Tool } from '../ui.tsx';
import { Images } from './images.tsx';
import { chosen, displayName, shown, step, taskAt } from './list_state.ts';
import { showSource, SourceView } from './source_view.tsx';
import { mark } from './table.tsx';

/** A place of the document: a click opens it there. */
function Line({ submission, file, line }: { submission: Submission; file?: string | undefined; line?: number | undefined }) {
  if (!line) return null;
  return <button type="button" class="link line" onClick={() => void showSource(submission, file, line)}>{t('line {line}', { line })}</button>;
}

const shownPlaces = 12;

function Lines({ submission, places }: { submission: Submission; places: readonly { file?: string; line?: number }[] }) {
  const lines = places.filter(({ line }) => line);
  return <>{lines.slice(0, shownPlaces).map((one, i) => <Line key={i} submission={submission} file={one.file} line={one.line} />)}
    {lines.length > shownPlaces && <span class="note"> {t('and {count} more', { count: lines.length - shownPlaces })}</span>}</>;
}

const Excerpt = ({ text }: { text: string | undefined }) => (text
  ? <pre tabIndex={0}>{text.split('\n').filter(Boolean).map((line, i) => (/^\d+ > /.test(line) ? <b key={i}>{line}</b> : `${line}\n`))}</pre> : null);

function cost(cause: Cause): string {
  if (cause.points > 0) return `−${mark(cause.points)}`;
  return cause.seen === false ? t('costs nothing: it cannot be seen') : cause.code.endsWith('.missing') ? t('earns nothing') : t('costs nothing');
}

function Causes({ submission, causes }: { submission: Submission; causes: readonly Cause[] }) {
  if (causes.length === 0) return null;
  return (
    <section aria-label={t('Causes')}><h3>{t('Causes')}</h3>
      <ul class="causes">
        {causes.map((cause, i) => (
          <li key={i}>{cause.message} <span class={cause.points > 0 ? 'bad' : 'note'}>{cost(cause)}</span> <Lines submission={submission} places={cause.places} />
            <Excerpt text={cause.excerpt} /></li>
        ))}
      </ul>
    </section>
  );
}

function Diagnostics({ submission, all }: { submission: Submission; all: readonly Diagnostic[] }) {
  if (all.length === 0) return null;
  const merged = new Map<string, Diagnostic[]>();
  for (const one of all) merged.set(one.severity + one.message, [...(merged.get(one.severity + one.message) ?? []), one]);
  return (
    <section aria-label={t('The document')}><h3>{t('The document')}</h3>
      <ul class="causes">
        {[...merged.values()].map((same, i) => {
          const [first] = same as [Diagnostic];
          return <li key={i}><span class={first.severity === 'error' ? 'bad' : 'note'}>{first.severity === 'error' ? t('error') : first.severity === 'warning' ? t('warning') : t('note')}:</span> {first.message} <Lines submission={submission} places={same} />
            <Excerpt text={first.excerpt} /></li>;
        })}
      </ul>
    </section>
  );
}

interface Marked {
  mark: number | null;
  comment: string;
}

/** What a person marked of a part: the row of overrides.csv. */
function marked(submission: Submission, task: string, criterion: string): Marked {
  const rows = overrides.value.filter((one) => isStudent(one.student, submission) && one.task.toLowerCase() === task.toLowerCase() && one.criterion === criterion.toLowerCase());
  return rows.at(-1) ?? { mark: null, comment: '' };
}

function MarkField({ submission, task, criterion, most, program, label }: {
  submission: Submission; task: string; criterion: string; most: number; program: string; label: string;
}) {
  const now = marked(submission, task, criterion);
  const set = (part: Partial<Marked>): void => setOverride({ ...now, ...part, task, criterion: criterion.toLowerCase() }, submission);
  return (
    <>
      <input type="number" min="0" max={most} step="any" class="mark-field" value={now.mark ?? ''} placeholder={program} aria-label={t('Mark for {part}', { part: label })}
        onChange={(event) => {
          const text = event.currentTarget.value, value = Number(text);
          if (text === '') set({ mark: null });
          else if (value >= 0) set({ mark: Math.min(value, most) });
          event.currentTarget.value = text === '' || !(value >= 0) ? '' : String(Math.min(value, most));
        }} />
      <input type="text" class="comment-field" maxLength={2000} value={now.comment} placeholder={t('Comment')} aria-label={t('Comment on {part}', { part: label })}
        onChange={(event) => set({ comment: event.currentTarget.value })} />
    </>
  );
}

const states: Record<string, () => string> = {
  met: () => t('met'), 'partly met': () => t('partly met'), 'not met': () => t('not met'), open: () => t('to be marked'), marked: () => t('marked'),
};

function CriterionRow({ submission, task, one }: { submission: Submission; task: string; one: CriterionGrade }) {
  const share = one.most > 0 ? 100 * one.points / one.most : 0;
  return (
    <li>
      <div class="criterion"><b>{one.measure}</b>
        {one.kind !== 'manual' && <span class="bar" aria-hidden="true"><i style={{ width: `${share}%` }} /></span>}
        <span class="figure">{one.state === 'open' ? '–' : mark(one.points)} / {mark(one.most)}</span></div>
      <p class="note">{one.text && <>{one.text} <strong class={one.state === 'met' || one.state === 'marked' ? 'good' : one.state === 'open' ? 'note' : 'bad'}>{states[one.state ?? '']?.()}</strong> </>}
        {one.reason} <Lines submission={submission} places={one.state === 'met' ? (one.matches ?? []) : (one.misses ?? [])} /></p>
      <div class="by-person"><MarkField submission={submission} task={task} criterion={one.measure} most={one.most} program={mark(one.points)} label={one.measure} /></div>
    </li>
  );
}

function TaskDetail({ submission, task, at }: { submission: Submission; task: TaskMark; at: number }) {
  const { grade, failure, state } = task, rubric = rubrics.value[at], key = resultKey(tasks.value[at]?.name ?? '', submission.id);
  if (!grade && !failure) return <p class="note">{state === 'grading' ? t('grading…') : t('waiting')}</p>;
  const isRight = grade && !grade.refused && grade.findings.length === 0 && grade.diagnostics.length === 0 && grade.points === grade.most;
  return (
    <>
      {state === 'stale' && <p class="warning">{t('By an earlier rubric: the new one asks the service to render again.')}</p>}
      {failure && <p class="bad">{failure.message}{failure.code ? ` [${failure.code}]` : ''}</p>}
      {grade?.refused && <p class="bad">{t('Not graded: {reason}', { reason: grade.reason?.message ?? '' })}</p>}
      {grade?.similarity !== undefined && <p>{t('The image shows {share} % of the reference.', { share: mark(100 * grade.similarity) })}</p>}
      {isRight && <p class="good">{t('Nothing was found that differs.')}</p>}
      {grade && <Images key={key} task={tasks.value[at]?.name ?? ''} resultKey={key} grade={grade} />}
      {grade && <Causes submission={submission} causes={grade.findings} />}
      {grade && grade.unexplained.points > 0 && <p class="bad">{t('Unexplained: the images still differ when all of this is corrected (−{points}).', { points: mark(grade.unexplained.points) })}</p>}
      {grade && <Diagnostics submission={submission} all={grade.diagnostics} />}
      <SourceView submission={submission} />
      <section aria-label={t('Points')}><h3>{t('Points')}</h3>
        <ul class="criteria">
          {grade?.criteria.map((one) => <CriterionRow key={one.measure} submission={submission} task={task.task} one={one} />)}
          {tasks.value.length > 1 && rubric && (
            <li><div class="criterion"><b>{t('All of {task}', { task: task.task })}</b><span class="figure">{mark(grade?.points ?? 0)} / {mark(rubric.points)}</span></div>
              <div class="by-person"><MarkField submission={submission} task={task.task} criterion="" most={rubric.points} program={mark(grade?.points ?? 0)} label={task.task} /></div></li>
          )}
        </ul>
        {grade && grade.penalty > 0 && <p class="bad">{t('Diagnostics cost {points} points.', { points: mark(grade.penalty) })}</p>}
      </section>
    </>
  );
}

function Total({ one }: { one: StudentMark }) {
  return (
    <section class="total" aria-label={t('The whole mark')}>
      <h3>{t('The whole mark')}</h3>
      <div class="by-person"><MarkField submission={one.submission} task="" criterion="" most={one.most} program={mark(one.points)} label={t('the submission')} /></div>
    </section>
  );
}

export function Detail() {
  const one = chosen.value, names = taskNames.value, at = Math.min(taskAt.value, names.length - 1), box = useRef<HTMLElement>(null);
  useEffect(() => void (box.current && (box.current.scrollTop = 0)), [one?.submission.id]);
  if (!one) return <section id="detail" aria-label={t('Details')}><p class="note">{t('Choose a submission: click it, or use the arrow keys; / goes to the filter.')}</p></section>;
  const task = one.tasks[at], place = shown.value.findIndex(({ submission }) => submission.id === one.submission.id) + 1;
  return (
    <section id="detail" aria-label={t('Details')} ref={box}>
      <header class="detail-head">
        <div><h2>{displayName(one)}</h2><p class="note">{[one.submission.identifier, one.submission.id].filter(Boolean).join(' · ')}</p></div>
        <strong class={one.passed ? 'good' : 'bad'}>{one.graded ? t('{points} of {most} points', { points: mark(one.points), most: mark(one.most) }) : t('no mark')}</strong>
        <div class="steps"><Tool icon="up" label={t('Previous submission')} keys="K" disabled={place <= 1} onClick={() => step(-1)} />
          <Tool icon="down" label={t('Next submission')} keys="J" disabled={place === shown.value.length} onClick={() => step(1)} /></div>
      </header>
      {names.length > 1 && (
        <div class="choices" role="group" aria-label={t('Task')}>
          {names.map((name, i) => <button key={name} type="button" aria-pressed={i === at} onClick={() => (taskAt.value = i)}>{name}</button>)}
        </div>
      )}
      {task && <TaskDetail key={`${one.submission.id} ${at}`} submission={one.submission} task={task} at={at} />}
      <Total one={one} />
      <p><button type="button" class="link" onClick={() => removeSubmission(one.submission.id)}>{t('Remove this submission')}</button></p>
    </section>
  );
}
