// The rubric of a task: as a form and as JSON, with its effect on the marks while it is changed.
import { signal } from '@preact/signals';
import { useRef } from 'preact/hooks';
import { chooseFiles } from '../../files.ts';
import { marks, rubrics, setRubric, staleCount, tables, tasks } from '../../grade/grading.ts';
import { checkRubric, comparedPoints, rubricText, type Criterion, type Rubric, type RubricCheck, type RubricDocument } from '../../grade/rubric.ts';
import type { GradeTables } from '../../grade/tables.ts';
import { number, plural, t } from '../../words.ts';
import { Icon } from '../icons.tsx';
import { saveBlob } from '../save.ts';
import { baseline, drafts, takeBaseline } from './baseline.ts';
import { taskAt } from './list_state.ts';
import { Members } from './schema_form.tsx';
import { takeSubmissions } from './take.ts';

const mode = signal<'form' | 'json'>('form');

function apply(at: number, text: string): void {
  const task = tasks.value[at], all = tables.value;
  if (!task || !all) return;
  const check = checkRubric(text, all), { [task.name]: _, ...rest } = drafts.value;
  drafts.value = check.problems.length > 0 ? { ...rest, [task.name]: { text, check } } : rest;
  if (check.problems.length === 0) setRubric(at, { name: task.rubric?.name ?? 'rubric.json', text });
}

/** How the marks moved since the panel was opened. */
function Effect() {
  const before = baseline.value, now = marks.value.filter(({ graded }) => graded);
  if (!before || before.size === 0) return null;
  const known = now.filter(({ submission }) => before.has(submission.id)), mean = (all: number[]): number => all.reduce((sum, one) => sum + one, 0) / all.length;
  const changed = known.filter((one) => Math.abs(one.points - (before.get(one.submission.id) ?? 0)) >= 0.005).length;
  if (known.length === 0) return null;
  const text = (value: number): string => number(value, { maximumFractionDigits: 2 });
  return (
    <p class="effect" role="status">
      {changed === 0 ? t('No mark changes.') : `${plural(changed, '{count} mark changes', '{count} marks change')}: ${t('mean {now}, before {before}', { now: text(mean(known.map(({ points }) => points))), before: text(mean(known.map(({ submission }) => before.get(submission.id) ?? 0))) })}. `}
      {staleCount.value > 0 && <span class="bad">{plural(staleCount.value, '{count} must be rendered again.', '{count} must be rendered again.')} </span>}
      {changed > 0 && <button type="button" class="link" onClick={takeBaseline}>{t('Compare with these from now on')}</button>}
    </p>
  );
}

interface EditProps {
  document: RubricDocument;
  rubric: Rubric;
  all: GradeTables;
  set: (document: RubricDocument) => void;
}

function CriterionRow({ one, share, summary, set, remove }: {
  one: Criterion; share: number; summary: string; set: (part: Partial<Criterion>) => void; remove: (() => void) | null;
}) {
  const field = (key: 'weight' | 'tolerance' | 'limit' | 'perFinding', most: number) => (one[key] === undefined ? null : (
    <label class="field"><span>{key}</span><input type="number" min="0" max={most} step="any" value={one[key]} aria-label={`${one.measure} ${key}`} onInput={(event) => {
      const value = Number(event.currentTarget.value);
      if (event.currentTarget.value !== '' && Number.isFinite(value)) set({ [key]: value });
    }} /></label>
  ));
  return (
    <li><div class="criterion"><b>{one.measure}</b><span class="figure note">{number(100 * share, { maximumFractionDigits: 1 })} %</span></div>
      <p class="note">{summary}</p>
      <div class="numbers">{field('weight', 1000)}{field('tolerance', 1)}{field('limit', 1)}{field('perFinding', 1)}
        {remove && <button type="button" class="link" onClick={remove}>{t('Remove {name}', { name: one.measure })}</button>}</div></li>
  );
}

function Criteria({ document, rubric, all, set }: EditProps) {
  const weights = rubric.criteria.reduce((sum, one) => sum + one.weight, 0), rest = all.gradeMeasures.filter(({ name }) => !rubric.criteria.some(({ measure }) => measure === name));
  const write = (criteria: readonly Criterion[]): void => set({ ...document, criteria });
  const change = (at: number, part: Partial<Criterion>): void => write(rubric.criteria.map((one, i) => (i === at ? { ...one, ...part } : one)));
  return (
    <details class="entry" open><summary><code>criteria</code> <small class="note">{t('the comparison with the reference; weights are shares of {points} points', { points: comparedPoints(rubric) })}</small></summary>
      <ul class="criteria">
        {rubric.criteria.map((one, i) => (
          <CriterionRow key={one.measure} one={one} share={weights > 0 ? one.weight / weights : 0} summary={all.gradeMeasures.find(({ name }) => name === one.measure)?.summary ?? ''}
            set={(part) => change(i, part)} remove={rubric.criteria.length > 1 ? () => write(rubric.criteria.filter((_, j) => j !== i)) : null} />
        ))}
      </ul>
      {rest.length > 0 && (
        <label class="field"><span>{t('Add a measure')}</span>
          <select value="" onChange={(event) => {
            const measure = event.currentTarget.value, added = all.gradeMeasures.find(({ name }) => name === measure);
            if (added) write([...rubric.criteria, { measure, weight: added.weight } as Criterion]);
          }}><option value="" />{rest.map(({ name }) => <option key={name} value={name}>{name}</option>)}</select></label>
      )}
    </details>
  );
}

function Form(props: EditProps) {
  const { document, rubric, all, set } = props, onChange = (value: unknown): void => set(value as RubricDocument);
  const part = (only: readonly string[]) => <Members name="" path="" schema={all.rubric} value={document} usual={rubric} onChange={onChange} only={only} />;
  const general = ['title', 'points', 'passMark', 'strictness', ...(tasks.value.length > 1 ? ['weight'] : [])];
  return (
    <>
      {part(general)}
      <Criteria {...props} />
      <details class="entry" open={rubric.requirements.length + rubric.manual.length > 0}><summary>{t('Requirements and parts marked by hand')}</summary>{part(['requirements', 'manual', 'define'])}</details>
      <details class="entry"><summary>{t('Penalties')}</summary>{part(['penalties'])}</details>
      <details class="entry"><summary>{t('Cameras, times and images')} <small class="note">{t('a change is rendered again')}</small></summary>{part(['views', 'times', 'picture', 'lend', 'images', 'reveal'])}</details>
    </>
  );
}

function JsonText({ text, check, at }: { text: string; check: RubricCheck | null; at: number }) {
  const area = useRef<HTMLTextAreaElement>(null);
  const goTo = (line: number): void => {
    const box = area.current;
    if (!box) return;
    const from = text.split('\n').slice(0, line - 1).join('\n').length + (line > 1 ? 1 : 0), end = text.indexOf('\n', from);
    box.focus();
    box.setSelectionRange(from, end < 0 ? text.length : end);
    box.scrollTop = Math.max(0, (line - 4) * Number.parseFloat(getComputedStyle(box).lineHeight));
  };
  return (
    <>
      <textarea ref={area} class="json" spellcheck={false} aria-label={t('Rubric as JSON')} aria-invalid={Boolean(check)} value={text} rows={24} onInput={(event) => apply(at, event.currentTarget.value)} />
      {check && <Problems check={check} goTo={goTo} />}
    </>
  );
}

function Problems({ check, goTo }: { check: RubricCheck; goTo?: (line: number) => void }) {
  return (
    <div class="problem" role="status"><p>{t('Not applied:')}</p><ul>
      {check.problems.map(({ pointer, message, line }, i) => <li key={i}>{goTo ? <button type="button" class="link" onClick={() => goTo(line)}>{t('line {line}', { line })}</button> : null} <code>{pointer}</code> {message}</li>)}
    </ul></div>
  );
}

export function RubricPanel() {
  const at = Math.min(taskAt.value, tasks.value.length - 1), task = tasks.value[at], rubric = rubrics.value[at], all = tables.value;
  if (!task || !rubric || !all) return <p class="note">{t('Choose a reference first.')}</p>;
  const draft = drafts.value[task.name], text = draft?.text ?? task.rubric?.text ?? rubricText(all.defaultRubric);
  const document = (draft ? draft.check.document : (JSON.parse(task.rubric?.text ?? '{}') as RubricDocument)), set = (value: RubricDocument): void => apply(at, rubricText(value));
  const forget = (): void => {
    const { [task.name]: _, ...rest } = drafts.value;
    drafts.value = rest;
    setRubric(at, null);
  };
  return (
    <section id="rubric" aria-label={t('Rubric')}>
      {tasks.value.length > 1 && (
        <div class="choices" role="group" aria-label={t('Task')}>
          {tasks.value.map(({ name }, i) => <button key={name} type="button" aria-pressed={i === at} onClick={() => (taskAt.value = i)}>{name}</button>)}
        </div>
      )}
      <div class="choices">
        {(['form', 'json'] as const).map((one) => <button key={one} type="button" aria-pressed={mode.value === one} onClick={() => (mode.value = one)}>{one === 'form' ? t('Form') : 'JSON'}</button>)}
        <span class="space" />
        <button type="button" onClick={() => void chooseFiles(false).then(takeSubmissions)}><Icon name="upload" />{t('Open a rubric')}</button>
        <button type="button" onClick={() => saveBlob(new Blob([text], { type: 'application/json' }), task.rubric?.name ?? 'rubric.json')}><Icon name="download" />{t('Save the rubric')}</button>
        {(task.rubric || draft) && <button type="button" onClick={forget}>{t('Back to the default')}</button>}
      </div>
      <Effect />
      {mode.value === 'json' ? <JsonText text={text} check={draft?.check ?? null} at={at} />
        : document === null ? <p class="problem">{t('This is no JSON: correct it there.')}</p>
        : <>{draft && <Problems check={draft.check} />}<Form document={document} rubric={draft && draft.check.document ? { ...rubric } : rubric} all={all} set={set} /></>}
    </section>
  );
}
