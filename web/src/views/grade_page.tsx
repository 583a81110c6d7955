// Marks submissions against a reference: points, what differs in words, and where it is seen.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { csvOf, Grading, type Grade, type Row } from '../grade/grading.ts';
import { studentOf, subjectsOf } from '../grade/submissions.ts';
import type { NamedFile } from '../scene/bundle.ts';
import { chooseFiles, filesOf } from '../files.ts';
import { Icon } from './icons.tsx';
import { saveBlob } from './save.ts';
import { Findings, say } from './ui.tsx';
import { sentence } from '../api.ts';

const grading = new Grading();
const open = signal<string | null>(null);
const over = signal<'reference' | 'submissions' | null>(null);

function takeReference(files: readonly NamedFile[]): void {
  const subjects = subjectsOf(files);
  if (subjects.length !== 1) return say(subjects.length === 0 ? 'There is no scene or picture among these files.' : 'A reference is one scene or one picture.');
  grading.reference.value = subjects[0] ?? null;
}

function takeSubmissions(files: readonly NamedFile[]): void {
  const rubric = files.length === 1 && /\.json$/i.test(files[0]?.path ?? '') ? files[0] : undefined;
  if (rubric) {
    grading.rubric.value = { name: rubric.path, file: rubric.file };
    return;
  }
  const subjects = subjectsOf(files);
  if (subjects.length === 0) return say('There is no scene or picture among these files.');
  grading.add(subjects);
}

function Drop({ kind, title, text, take, children }: {
  kind: 'reference' | 'submissions'; title: string; text: string; take: (files: readonly NamedFile[]) => void; children: preact.ComponentChildren;
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

const points = (value: number): string => String(Number(value.toFixed(1)));

/** What was measured: measures that the rubric leaves out are not there. */
function shares({ difference, flip, ssim }: Grade['views'][number]): string {
  return [
    `${(100 * difference).toFixed(1)} % differs`, flip && `FLIP ${flip.mean.toFixed(3)}`, ssim !== undefined && `SSIM ${ssim.toFixed(3)}`,
  ].filter(Boolean).join(', ');
}

function Details({ grade }: { grade: Grade }) {
  return (
    <div class="details">
      {grade.findings.length > 0 && (
        <ol class="grade-findings">
          {grade.findings.map((finding, i) => (
            <li key={i}>
              <p><b>{finding.message}</b>{finding.points > 0 && <span class="cost">−{points(finding.points)}</span>}</p>
              {finding.line && <p class="place">{finding.file ? `${finding.file}, ` : ''}line {finding.line}</p>}
              {finding.excerpt && <pre tabIndex={0}>{finding.excerpt}</pre>}
            </li>
          ))}
        </ol>
      )}
      {grade.findings.length === 0 && <p class="note">Nothing was found that differs.</p>}
      <div class="views">
        {grade.views.filter((view) => view.picture ?? view.heat).map((view) => (
          <figure key={`${view.name}${view.time}`}>
            <div>
              {view.picture && <img src={view.picture} alt={`The submission, ${view.name}`} loading="lazy" />}
              {view.heat && <img src={view.heat} alt={`Where it differs, ${view.name}`} loading="lazy" />}
            </div>
            <figcaption>{view.name}{view.time ? `, ${view.time} s` : ''}: {shares(view)}</figcaption>
          </figure>
        ))}
      </div>
      <table class="criteria">
        <thead><tr><th scope="col">Criterion</th><th scope="col">Points</th><th scope="col">Why</th></tr></thead>
        <tbody>
          {grade.criteria.map((one) => (
            <tr key={one.measure}><th scope="row">{one.measure}</th><td>{points(one.points)} / {points(one.most)}</td><td>{one.reason}</td></tr>
          ))}
        </tbody>
      </table>
      <Findings findings={grade.diagnostics} />
    </div>
  );
}

function RowView({ row }: { row: Row }) {
  const { subject, state, grade, problem } = row, on = open.value === subject.name;
  const student = studentOf(subject.name), fault = grade?.diagnostics.find((one) => one.severity === 'error');
  const lost = grade?.criteria.filter((one) => one.points < one.most).sort((a, b) => b.most - b.points - a.most + a.points)[0];
  const first = grade?.refused ? `It could not be read. ${fault ? sentence(fault) : ''}`
    : (grade?.findings.find((one) => one.points > 0)?.message ?? lost?.reason ?? (grade ? 'As the reference.' : ''));
  return (
    <li class={`row ${grade ? (grade.passed ? 'passed' : 'missed') : state}`}>
      <button type="button" aria-expanded={on} disabled={!grade} onClick={() => (open.value = on ? null : subject.name)}>
        <b>{student.name}{student.identifier && <span class="who">{student.identifier}</span>}</b>
        <span class="what">{state === 'grading' ? 'Grading…' : state === 'failed' ? problem : state === 'waiting' ? 'Waiting' : first}</span>
        {grade && (
          <span class="score">
            <meter min={0} max={grade.most} value={grade.points} aria-label={`Points of ${student.name}`} />
            <strong>{points(grade.points)}</strong> of {points(grade.most)}
          </span>
        )}
      </button>
      {on && grade && <Details grade={grade} />}
    </li>
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
      <ol class="rows" aria-label="Grades">{rows.value.map((row) => <RowView key={row.subject.name} row={row} />)}</ol>
    </main>
  );
}
