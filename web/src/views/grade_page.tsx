// Marks submissions against a reference: points, what differs in words, and where it is seen.
import { signal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { gradesView, type Graded, type GradesView } from '../../../grade/report/view.js';
import { csvOf, Grading, type Row } from '../grade/grading.ts';
import { studentOf, subjectsOf } from '../grade/submissions.ts';
import type { NamedFile } from '../scene/bundle.ts';
import { classOf } from '../grade/zip.ts';
import { chooseFiles, filesOf } from '../files.ts';
import { Icon } from './icons.tsx';
import { saveBlob } from './save.ts';
import { say } from './ui.tsx';

const grading = new Grading();
const over = signal<'reference' | 'submissions' | null>(null);

function takeReference(files: readonly NamedFile[]): void {
  const subjects = subjectsOf(files);
  if (subjects.length !== 1) return say(subjects.length === 0 ? 'There is no scene or picture among these files.' : 'A reference is one scene or one picture.');
  grading.reference.value = subjects[0] ?? null;
}

async function takeSubmissions(files: readonly NamedFile[]): Promise<void> {
  const rubric = files.length === 1 && /\.json$/i.test(files[0]?.path ?? '') ? files[0] : undefined;
  if (rubric) {
    grading.rubric.value = { name: rubric.path, file: rubric.file };
    return;
  }
  const [only] = files;
  const members = files.length === 1 && only && /\.zip$/i.test(only.path) ? await classOf(only.file) : null;
  const subjects = members ?? subjectsOf(files);
  if (subjects.length === 0) return say('There is no scene or picture among these files.');
  grading.add(subjects);
}

function Drop({ kind, title, text, take, children }: {
  kind: 'reference' | 'submissions'; title: string; text: string; take: (files: readonly NamedFile[]) => void | Promise<void>; children: preact.ComponentChildren;
}) {
  const pick = (folder: boolean): void => void chooseFiles(folder).then(take);
  return (
    <section class={over.value === kind ? 'drop-box over' : 'drop-box'} aria-labelledby={`${kind}-title`}
      onDragOver={(event) => {
        event.preventDefault();
        over.value = kind;
      }}
      onDragLeave={() => (over.value = null)}
      onDrop={(event) => {
        event.preventDefault();
        over.value = null;
        if (event.dataTransfer) void filesOf(event.dataTransfer).then(take);
      }}>
      <h2 id={`${kind}-title`}>{title}</h2>
      <p>{text}</p>
      {children}
      <div class="buttons">
        <button type="button" class="button small" onClick={() => pick(false)} aria-label={`${title}: choose files`}><Icon name="upload" />Choose files</button>
        <button type="button" class="button small" onClick={() => pick(true)} aria-label={`${title}: choose a folder`}>Choose a folder</button>
      </div>
    </section>
  );
}

const results = new WeakMap<Row, Graded>();

/** A row as the view of a report takes it; the same one as long as the row is. */
function gradedOf(row: Row): Graded {
  const known = results.get(row);
  if (known) return known;
  const { subject, state, grade, problem } = row, student = studentOf(subject.name);
  const made: Graded = {
    id: subject.name, name: student.identifier ? student.name : '', identifier: student.identifier,
    points: grade?.points ?? 0, most: grade?.most ?? 0, passed: grade?.passed ?? false, tasks: [],
    ...(state === 'waiting' ? { state: 'waiting' } : state === 'grading' ? { state: 'grading…' } : {}),
  };
  if (grade) made.tasks.push({ grade, references: () => [], pictures: () => grade.views.flatMap((view) => [view.picture ?? '', view.heat ?? '']) });
  else if (problem !== undefined) made.tasks.push({ failure: { code: '', message: problem } });
  results.set(row, made);
  return made;
}

/** The grades as the report of `farol grade` shows them. */
function Grades({ rows }: { rows: readonly Row[] }) {
  const head = useRef<HTMLDivElement>(null), body = useRef<HTMLDivElement>(null), view = useRef<GradesView | null>(null);
  useEffect(() => {
    view.current ??= gradesView({ head: head.current as HTMLElement, body: body.current as HTMLElement, keys: body.current as HTMLElement });
    view.current.show(rows.map(gradedOf));
  }, [rows]);
  return (
    <div class="report">
      <div class="grades-head" ref={head} />
      <div class="grades" ref={body} />
    </div>
  );
}

export function GradePage() {
  useEffect(() => {
    document.title = 'Grade · Farol';
  }, []);
  const { reference, rubric, rows, running } = grading;
  const done = rows.value.filter((row) => row.state === 'done' || row.state === 'failed').length;
  return (
    <main class="grade" id="main">
      <div class="lead">
        <h1>Grade</h1>
        <p>Compares scenes with a reference: the pictures, the geometry and the XML. Nothing is stored.</p>
      </div>
      <div class="drops">
        <Drop kind="reference" title="Reference" text="A scene, a zip or folder of it and its files, or a picture." take={takeReference}>
          {reference.value && <p class="taken"><b>{reference.value.name}</b></p>}
        </Drop>
        <Drop kind="submissions" title="Submissions" text="Scenes, zips, pictures, or a folder with one for each. A rubric (.json) may be added." take={takeSubmissions}>
          {rows.value.length > 0 && <p class="taken"><b>{rows.value.length} {rows.value.length === 1 ? 'submission' : 'submissions'}</b></p>}
          {rubric.value && <p class="taken">Rubric: <b>{rubric.value.name}</b></p>}
        </Drop>
      </div>
      <div class="go">
        <button type="button" class="button primary" disabled={!reference.value || rows.value.length === 0 || running.value} onClick={() => void grading.run()}>
          {running.value ? `Grading ${done} of ${rows.value.length}…` : 'Grade'}
        </button>
        {done > 0 && !running.value && (
          <button type="button" class="button" onClick={() => saveBlob(new Blob([csvOf(rows.value)], { type: 'text/csv' }), 'grades.csv')}>
            <Icon name="download" />CSV
          </button>
        )}
        {rows.value.length > 0 && !running.value && <button type="button" class="link" onClick={() => grading.clear()}>Remove all submissions</button>}
        <span class="note" role="status">{done > 0 && !running.value ? `${done} graded.` : ''}</span>
      </div>
      {rows.value.length > 0 && <Grades rows={rows.value} />}
    </main>
  );
}
