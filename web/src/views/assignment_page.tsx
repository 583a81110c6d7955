// A student's check of a scene against an assignment: a band of points, requirements, places.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { checkSubmission, getAssignment, messagesOf, type Answer, type Assignment, type Thing } from '../assignment/check.ts';
import { textsOf, type Texts } from '../assignment/texts.ts';
import { chooseFiles, filesOf } from '../files.ts';
import { subjectsOf, type Subject } from '../grade/submissions.ts';
import type { NamedFile } from '../scene/bundle.ts';
import { language, timeText } from '../words.ts';
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
    problems.value = messagesOf(fault, textsOf(language.value).noAnswer);
  }
}

function take(files: readonly NamedFile[]): void {
  const subjects = subjectsOf(files);
  problems.value = subjects.length === 1 ? [] : [textsOf(language.value).noScene];
  subject.value = subjects.length === 1 ? (subjects[0] ?? null) : null;
}

async function check(id: string): Promise<void> {
  if (!subject.value) return;
  [checking.value, answer.value, problems.value] = [true, null, []];
  try {
    answer.value = await checkSubmission(id, code.value.trim(), subject.value, language.value);
  } catch (fault) {
    problems.value = messagesOf(fault, textsOf(language.value).noAnswer);
  }
  checking.value = false;
}

function Times({ of, texts }: { of: Assignment; texts: Texts }) {
  if (!of.open && of.opens && Date.parse(of.opens) > Date.now()) return <p class="when">{texts.opens(timeText(of.opens))}</p>;
  if (!of.open && of.closes) return <p class="when">{texts.closed(timeText(of.closes))}</p>;
  return of.closes ? <p class="when">{texts.closes(timeText(of.closes))}</p> : null;
}

function Drop({ texts }: { texts: Texts }) {
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
      <h2 id="scene-title">{texts.scene}</h2>
      <p>{texts.drop}</p>
      {subject.value && <p class="taken"><b>{subject.value.fileName}</b></p>}
      <div class="buttons">
        <button type="button" class="button small" onClick={() => pick(false)}><Icon name="upload" />{texts.chooseFiles}</button>
        <button type="button" class="button small" onClick={() => pick(true)}>{texts.chooseFolder}</button>
      </div>
    </section>
  );
}

const place = ({ file, line }: { file?: string; line?: number }, texts: Texts): string =>
  [file && file !== subject.value?.fileName ? file : '', line ? texts.line(line) : ''].filter((one) => one).join(', ');

function Things({ things, texts }: { things: readonly Thing[]; texts: Texts }) {
  if (things.length === 0) return null;
  return (
    <ul>
      {things.map((thing, index) => (
        <li key={index}>{thing.who}{thing.message ? ` ${thing.message}` : ''}{place(thing, texts) && <span class="place">{place(thing, texts)}</span>}</li>
      ))}
    </ul>
  );
}

function Requirements({ all, texts }: { all: NonNullable<Answer['requirements']>; texts: Texts }) {
  const words = { met: texts.met, 'partly met': texts.partly, 'not met': texts.unmet };
  return (
    <section aria-labelledby="requirements-title">
      <h3 id="requirements-title">{texts.requirements}</h3>
      <ol class="requirements">
        {all.map((one) => (
          <li key={one.id} class={one.state.replace(' ', '-')}>
            <p><span class="state">{words[one.state]}</span> {one.text} <span class="soft">({one.reason})</span></p>
            <Things things={one.state === 'met' ? one.matches : one.misses} texts={texts} />
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
function Places({ id, title, none, all, texts }: { id: string; title: string; none: string; all: readonly Place[]; texts: Texts }) {
  return (
    <section aria-labelledby={id}>
      <h3 id={id}>{title}</h3>
      {all.length === 0 ? <p class="soft">{none}</p> : (
        <ul>
          {all.map((one, index) => (
            <li key={index}>{one.message}{place(one, texts) && <span class="place">{place(one, texts)}</span>}</li>
          ))}
        </ul>
      )}
    </section>
  );
}

function Mask({ mask, texts }: { mask: NonNullable<Answer['mask']>; texts: Texts }) {
  const { columns, rows, cells } = mask;
  return (
    <figure>
      <svg class="mask" viewBox={`0 0 ${columns} ${rows}`} role="img" aria-label={texts.maskText}>
        {[...cells].map((cell, at) => (
          <rect key={at} x={at % columns} y={Math.floor(at / columns)} width="1" height="1" class={cell === '1' ? 'on' : ''} />
        ))}
      </svg>
      <figcaption>{texts.mask}</figcaption>
    </figure>
  );
}

function Result({ of, texts }: { of: Answer; texts: Texts }) {
  const { band, bands, fromPercent, toPercent } = of.points;
  const time = of.tries.next && of.tries.left > 0 && Date.parse(of.tries.next) > Date.now() ? `, ${texts.next(timeText(of.tries.next))}` : '';
  return (
    <section class="result" aria-labelledby="result-title">
      <h2 id="result-title">{texts.result}</h2>
      <p class="points"><b>{texts.points(fromPercent, toPercent)}</b> <span class="soft">{texts.tries(of.tries.left)}{time}</span></p>
      <svg class="bands" viewBox={`0 0 ${bands * 10} 4`} preserveAspectRatio="none" aria-hidden="true">
        {Array.from({ length: bands }, (_, at) => <rect key={at} x={at * 10 + 0.3} y="0" width="9.4" height="4" class={at <= band ? 'on' : ''} />)}
      </svg>
      {of.requirements && of.requirements.length > 0 && <Requirements all={of.requirements} texts={texts} />}
      {of.findings && <Places id="differs-title" title={texts.differs} none={texts.nothingDiffers} all={of.findings} texts={texts} />}
      {of.diagnostics && <Places id="document-title" title={texts.document} none={texts.nothingFound} all={of.diagnostics} texts={texts} />}
      <div class="pictures">
        {of.image && <figure><img src={of.image} alt={texts.imageText} /><figcaption>{texts.image}</figcaption></figure>}
        {of.mask && <Mask mask={of.mask} texts={texts} />}
      </div>
    </section>
  );
}

export function AssignmentPage({ id }: { id: string }) {
  const texts = textsOf(language.value), of = assignment.value;
  useEffect(() => void load(id), [id]);
  useEffect(() => {
    document.title = `${of?.title ?? id} · Farol`;
  }, [of, id]);
  const isReady = subject.value !== null && code.value.trim() !== '' && !checking.value;
  return (
    <main class="grade assignment" id="main">
      <div class="lead">
        <div class="titles"><h1>{of?.title ?? id}</h1>{of && <Times of={of} texts={texts} />}</div>
      </div>
      {of === null && <p class="problem" role="alert">{texts.missing}</p>}
      {of && (
        <>
          <p class="soft">{texts.about}</p>
          <form onSubmit={(event) => {
            event.preventDefault();
            if (isReady) void check(id);
          }}>
            <Drop texts={texts} />
            <label class="field code">
              <span>{texts.code}</span>
              <input type="text" value={code.value} autocomplete="off" autocapitalize="none" spellcheck={false} aria-describedby="code-hint"
                onInput={(event) => (code.value = event.currentTarget.value)} />
              <small id="code-hint">{texts.codeHint}</small>
            </label>
            <div class="go">
              <button type="submit" class="button primary" disabled={!isReady}>{texts.check}</button>
              <span class="note" role="status">{checking.value ? texts.checking : ''}</span>
            </div>
          </form>
        </>
      )}
      {problems.value.length > 0 && <div class="problem" role="alert">{problems.value.map((text, index) => <p key={index}>{text}</p>)}</div>}
      {answer.value && <Result of={answer.value} texts={texts} />}
    </main>
  );
}
