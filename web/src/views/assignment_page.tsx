// A student's check of a scene against an assignment: a band of points, requirements, places.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { checkSubmission, getAssignment, messagesOf, type Answer, type Assignment, type Thing } from '../assignment/check.ts';
import { chooseFiles, filesOf } from '../files.ts';
import { subjectsOf, type Subject } from '../grade/submissions.ts';
import type { NamedFile } from '../scene/bundle.ts';
import { language, plural, t, timeText } from '../words.ts';
import { Icon } from './icons.tsx';

const assignment = signal<Assignment | null | undefined>(undefined); // undefined: not known yet
const code = signal('');
const subject = signal<Subject | null>(null);
const answer = signal<Answer | null>(null);
const problems = signal<string[]>([]);
const checking = signal(false);
const over = signal(false);

async function load(id: string): Promise<void> {
  [assignment.value, answer.value, subject.value, problems.value] = [undefined, null, null, []];
  try {
    assignment.value = await getAssignment(id, language.value);
  } catch (fault) {
    problems.value = messagesOf(fault, t('The server does not answer.'));
  }
}

function take(files: readonly NamedFile[]): void {
  const subjects = subjectsOf(files);
  problems.value = subjects.length === 1 ? [] : [t('There is no single scene among these files.')];
  subject.value = subjects.length === 1 ? (subjects[0] ?? null) : null;
}

async function check(id: string): Promise<void> {
  if (!subject.value) return;
  [checking.value, answer.value, problems.value] = [true, null, []];
  try {
    answer.value = await checkSubmission(id, code.value.trim(), subject.value, language.value);
  } catch (fault) {
    problems.value = messagesOf(fault, t('The server does not answer.'));
  }
  checking.value = false;
}

function Times({ of }: { of: Assignment }) {
  if (!of.open && of.opens && Date.parse(of.opens) > Date.now()) return <p class="when">{t('Opens {time}', { time: timeText(of.opens) })}</p>;
  if (!of.open && of.closes) return <p class="when">{t('Closed since {time}', { time: timeText(of.closes) })}</p>;
  return of.closes ? <p class="when">{t('Open until {time}', { time: timeText(of.closes) })}</p> : null;
}

function Drop() {
  const pick = (folder: boolean): void => void chooseFiles(folder).then(take);
  return (
    <section class={over.value ? 'drop-box over' : 'drop-box'} aria-labelledby="scene-title"
      onDragOver={(event) => {
        event.preventDefault();
        over.value = true;
      }}
      onDragLeave={() => (over.value = false)}
      onDrop={(event) => {
        event.preventDefault();
        over.value = false;
        if (event.dataTransfer) void filesOf(event.dataTransfer).then(take);
      }}>
      <h2 id="scene-title">{t('Your scene')}</h2>
      <p>{t('Drop an .xml file, a zip, or a folder here.')}</p>
      {subject.value && <p class="taken"><b>{subject.value.fileName}</b></p>}
      <div class="buttons">
        <button type="button" class="button small" onClick={() => pick(false)}><Icon name="upload" />{t('Choose files')}</button>
        <button type="button" class="button small" onClick={() => pick(true)}>{t('Choose a folder')}</button>
      </div>
    </section>
  );
}

const place = ({ file, line }: { file?: string; line?: number }): string =>
  [file && file !== subject.value?.fileName ? file : '', line ? t('line {line}', { line }) : ''].filter((one) => one).join(', ');

function Things({ things }: { things: readonly Thing[] }) {
  if (things.length === 0) return null;
  return (
    <ul>
      {things.map((thing, index) => (
        <li key={index}>{thing.who}{thing.message ? ` ${thing.message}` : ''}{place(thing) && <span class="place">{place(thing)}</span>}</li>
      ))}
    </ul>
  );
}

function Requirements({ all }: { all: NonNullable<Answer['requirements']> }) {
  const words = { met: t('met'), 'partly met': t('partly met'), 'not met': t('not met') };
  return (
    <section aria-labelledby="requirements-title">
      <h3 id="requirements-title">{t('Requirements')}</h3>
      <ol class="requirements">
        {all.map((one) => (
          <li key={one.id} class={one.state.replace(' ', '-')}>
            <p><span class="state">{words[one.state]}</span> {one.text} <span class="soft">({one.reason})</span></p>
            <Things things={one.state === 'met' ? one.matches : one.misses} />
          </li>
        ))}
      </ol>
    </section>
  );
}

interface Place {
  message: string;
  file?: string;
  line?: number;
}

/** A list with places; `none` where it is empty. */
function Places({ id, title, none, all }: { id: string; title: string; none: string; all: readonly Place[] }) {
  return (
    <section aria-labelledby={id}>
      <h3 id={id}>{title}</h3>
      {all.length === 0 ? <p class="soft">{none}</p> : (
        <ul>
          {all.map((one, index) => (
            <li key={index}>{one.message}{place(one) && <span class="place">{place(one)}</span>}</li>
          ))}
        </ul>
      )}
    </section>
  );
}

function Mask({ mask }: { mask: NonNullable<Answer['mask']> }) {
  const { columns, rows, cells } = mask;
  return (
    <figure>
      <svg class="mask" viewBox={`0 0 ${columns} ${rows}`} role="img" aria-label={t('Grid of the image: filled cells differ')}>
        {[...cells].map((cell, at) => (
          <rect key={at} x={at % columns} y={Math.floor(at / columns)} width="1" height="1" class={cell === '1' ? 'on' : ''} />
        ))}
      </svg>
      <figcaption>{t('Parts of the image that differ')}</figcaption>
    </figure>
  );
}

function Result({ of }: { of: Answer }) {
  const { band, bands, fromPercent, toPercent } = of.points;
  const time = of.tries.next && of.tries.left > 0 && Date.parse(of.tries.next) > Date.now() ? `, ${t('next one from {time}', { time: timeText(of.tries.next) })}` : '';
  return (
    <section class="result" aria-labelledby="result-title">
      <h2 id="result-title">{t('Result')}</h2>
      <p class="points"><b>{t('{from} to {to} % of the points', { from: fromPercent, to: toPercent })}</b> <span class="soft">{plural(of.tries.left, '1 check left', '{count} checks left')}{time}</span></p>
      <svg class="bands" viewBox={`0 0 ${bands * 10} 4`} preserveAspectRatio="none" aria-hidden="true">
        {Array.from({ length: bands }, (_, at) => <rect key={at} x={at * 10 + 0.3} y="0" width="9.4" height="4" class={at <= band ? 'on' : ''} />)}
      </svg>
      {of.requirements && of.requirements.length > 0 && <Requirements all={of.requirements} />}
      {of.findings && <Places id="differs-title" title={t('Where it differs')} none={t('No place was found.')} all={of.findings} />}
      {of.diagnostics && <Places id="document-title" title={t('Your document')} none={t('No errors or warnings.')} all={of.diagnostics} />}
      <div class="pictures">
        {of.image && <figure><img src={of.image} alt={t('Image of your scene')} /><figcaption>{t('Your image')}</figcaption></figure>}
        {of.mask && <Mask mask={of.mask} />}
      </div>
    </section>
  );
}

export function AssignmentPage({ id }: { id: string }) {
  const of = assignment.value;
  useEffect(() => void load(id), [id]);
  useEffect(() => {
    document.title = `${of?.title ?? id} · Farol`;
  }, [of, id]);
  const isReady = subject.value !== null && code.value.trim() !== '' && !checking.value;
  return (
    <main class="grade assignment" id="main">
      <div class="lead">
        <div class="titles"><h1>{of?.title ?? id}</h1>{of && <Times of={of} />}</div>
      </div>
      {of === null && <p class="problem" role="alert">{t('There is no such assignment.')}</p>}
      {of && (
        <>
          <p class="soft">{t('Check your scene before you hand it in. The check shows how far you are, and where to look.')}</p>
          <form onSubmit={(event) => {
            event.preventDefault();
            if (isReady) void check(id);
          }}>
            <Drop />
            <label class="field code">
              <span>{t('Your code')}</span>
              <input type="text" value={code.value} autocomplete="off" autocapitalize="none" spellcheck={false} aria-describedby="code-hint"
                onInput={(event) => (code.value = event.currentTarget.value)} />
              <small id="code-hint">{t('Your teacher gave it to you.')}</small>
            </label>
            <div class="go">
              <button type="submit" class="button primary" disabled={!isReady}>{t('Check')}</button>
              <span class="note" role="status">{checking.value ? t('Checking… this takes some seconds.') : ''}</span>
            </div>
          </form>
        </>
      )}
      {problems.value.length > 0 && <div class="problem" role="alert">{problems.value.map((text, index) => <p key={index}>{text}</p>)}</div>}
      {answer.value && <Result of={answer.value} />}
    </main>
  );
}
