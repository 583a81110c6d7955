// Where references and submissions are dropped, and what is there of them.
import type { ComponentChildren } from 'preact';
import { chooseFiles } from '../../files.ts';
import { forget, groups, isReady, missing, overrides, regrade, removeTask, results, rubrics, submissions, tasks } from '../../grade/grading.ts';
import type { NamedFile } from '../../scene/bundle.ts';
import { plural, t } from '../../words.ts';
import { Icon } from '../icons.tsx';
import { Check, dropHere, say, Tool } from '../ui.tsx';
import { forgetRubricPanel } from './baseline.ts';
import { dropProblems, reading, takeExample, takeReference, takeSubmissions } from './take.ts';

function Drop({ kind, title, text, take, children }: {
  kind: string; title: string; text: string; take: (files: readonly NamedFile[]) => Promise<void>; children?: ComponentChildren;
}) {
  const pick = (folder: boolean): void => void chooseFiles(folder).then(take);
  return (
    <section class="drop-box" aria-labelledby={`${kind}-title`} {...dropHere((files) => void take(files))}>
      <h2 id={`${kind}-title`}>{title}</h2>
      <p>{text}</p>
      {children}
      <div class="buttons">
        <button type="button" class="button small" onClick={() => pick(false)} aria-label={t('{title}: choose files', { title })}><Icon name="upload" />{t('Choose files')}</button>
        <button type="button" class="button small" onClick={() => pick(true)} aria-label={t('{title}: choose a folder', { title })}>{t('Choose a folder')}</button>
      </div>
    </section>
  );
}

function Tasks() {
  if (tasks.value.length === 0) return null;
  return (
    <ul class="taken">
      {tasks.value.map((task, at) => {
        const rubric = rubrics.value[at];
        return (
          <li key={task.name}><b>{task.name}</b> {task.rubric && <span class="note">{t('rubric {name}', { name: task.rubric.name })}</span>}
            {rubric && !isReady(task, rubric) && <span class="bad"> {t('needs a reference')}</span>}
            {!task.reference && rubric && isReady(task, rubric) && <span class="note"> {t('graded without a reference')}</span>}
            {tasks.value.length > 1 && <Tool icon="close" label={t('Remove {name}', { name: task.name })} onClick={() => removeTask(task.name)} />}</li>
        );
      })}
    </ul>
  );
}

/** The button that was pressed is gone: the next step has the focus. */
const focusGrade = (): void => void requestAnimationFrame(() => document.querySelector<HTMLElement>('.go .primary')?.focus());

export function Setup() {
  const hasTasks = tasks.value.length > 0, count = submissions.value.length;
  return (
    <>
      <div class="drops">
        <Drop kind="reference" title={t('Reference')} take={(files) => takeReference(files)}
          text={t('A scene, a zip or folder of it and its files, or an image; or a folder with one for each task.')}>
          <Tasks />
          {hasTasks && <button type="button" class="link" onClick={() => void chooseFiles(false).then((files) => takeReference(files, true))}>{t('Add a task')}</button>}
        </Drop>
        <Drop kind="submissions" title={t('Submissions')} take={takeSubmissions}
          text={t('Moodle’s zip of the class, or scenes, archives and images, or a folder with one for each student. Rubrics (.json), overrides.csv and groups.csv may lie beside them.')}>
          {count > 0 && <p class="taken"><b>{plural(count, '{count} submission', '{count} submissions')}</b>
            {groups.value.length > 0 && <span class="note"> {plural(groups.value.length, '{count} row of groups.csv', '{count} rows of groups.csv')}</span>}
            {overrides.value.length > 0 && <span class="note"> {plural(overrides.value.length, '{count} mark or comment by hand', '{count} marks or comments by hand')}</span>}</p>}
          <Check label={t('A missing or damaged file gives no points')} checked={missing.value === 'error'} onChange={(on) => {
            missing.value = on ? 'error' : 'placeholder';
            regrade();
          }} />
        </Drop>
      </div>
      {reading.value && <p role="status" class="note">{reading.value}</p>}
      {dropProblems.value.length > 0 && <div role="alert" class="problem">{dropProblems.value.map((text) => <p key={text}>{text}</p>)}</div>}
      {!hasTasks && count === 0 && !reading.value && (
        <p class="try"><button type="button" class="button" onClick={() => void takeExample().then(focusGrade)}>{t('Try an example class')}</button>
          <span class="note">{t('Seven students, two tasks, some mistakes: nothing to prepare.')}</span></p>
      )}
    </>
  );
}

/** A clear way to forget everything. */
export function Forget() {
  if (tasks.value.length + submissions.value.length + results.value.size === 0) return null;
  const act = async (): Promise<void> => {
    if (!window.confirm(t('Forget the class: submissions, marks and comments? What was saved as a file stays.'))) return;
    forgetRubricPanel();
    say((await forget()) ? t('The class is forgotten.') : t('The browser refused to forget: clear the data of this site in its settings.'));
  };
  return <button type="button" class="link" onClick={() => void act()}>{t('Forget this class')}</button>;
}
