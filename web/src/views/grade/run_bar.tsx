// The run over the class: its start, progress, cancel and what stopped it; and the files it is saved as.
import { signal } from '@preact/signals';
import { cancel, groups, isReady, marks, overrides, pending, regrade, results, rubrics, run, running, staleCount, stopped, submissions, tasks, total } from '../../grade/grading.ts';
import { isDone } from '../../grade/marks.ts';
import { classReport, reportFileNames, reportNames, writeReport, type ReportName } from '../../grade/report_files.ts';
import { storageState } from '../../grade/store.ts';
import { msg, plural, t } from '../../words.ts';
import { Icon } from '../icons.tsx';
import { saveBlob } from '../save.ts';
import { pressable, say } from '../ui.tsx';

const summaries: Record<ReportName, string> = {
  moodle: msg('Moodle’s grading worksheet'), criteria: msg('a column for each task and criterion'), html: msg('a page with all images, for reading'),
  feedback: msg('a page for each student, for Moodle'), json: msg('everything but the images, for programs'), junit: msg('JUnit’s XML, for CI services'),
  overrides: msg('marks and comments by hand'),
};
const writing = signal('');

async function save(name: ReportName): Promise<void> {
  const file = reportFileNames[name];
  writing.value = t('Writing {file}…', { file });
  try {
    const progress = (done: number): void => void (writing.value = t('Writing {file}: {done} of {all}', { file, done, all: marks.value.length }));
    saveBlob(await writeReport(name, classReport(marks.value, groups.value), overrides.value, progress), file);
  } catch (fault) {
    say(t('{file} was not written: {reason}', { file, reason: (fault as Error).message }));
  }
  writing.value = '';
}

function Exports() {
  if (!marks.value.some(isDone)) return null;
  return (
    <details class="exports" onKeyDown={(event) => {
      if (event.key !== 'Escape') return;
      event.currentTarget.open = false;
      event.currentTarget.querySelector('summary')?.focus();
    }}>
      <summary class="button"><Icon name="download" />{t('Save as')}</summary>
      <ul>
        {reportNames.map((name) => (
          <li key={name}><button type="button" class="plain" onClick={(event) => {
            (event.currentTarget.closest('details') as HTMLDetailsElement).open = false;
            void save(name);
          }}><b>{reportFileNames[name]}</b> <small class="note">{t(summaries[name])}</small></button></li>
        ))}
      </ul>
    </details>
  );
}

function Storage() {
  if (storageState.value === 'kept') return null;
  return (
    <p class="warning" role="status">{storageState.value === 'full'
      ? t('The browser has no more room: what is not kept is lost by a reload. Save the marks as files, or forget other classes.')
      : t('The browser keeps nothing of this page (a private window?): a reload loses the class. Save the marks as files.')}</p>
  );
}

export function RunBar() {
  const now = running.value, left = pending.value.length, count = results.value.size, lacks = tasks.value.some((task, i) => rubrics.value[i] && !isReady(task, rubrics.value[i]));
  if (tasks.value.length === 0 || submissions.value.length === 0) return <Storage />;
  return (
    <>
      <div class="go">
        {now ? (
          <>
            <progress value={now.done} max={now.all} aria-label={t('Progress')} />
            <span role="status">{t('Grading {done} of {all}…', { done: now.done, all: now.all })}</span>
            <button type="button" class="button" onClick={cancel}>{t('Cancel')}</button>
          </>
        ) : (
          <>
            <button type="button" class="button primary" {...pressable(left > 0 && !lacks, () => void run())}>
              {count === 0 ? t('Grade') : left > 0 ? t('Go on: {count} left', { count: left }) : t('All is graded')}</button>
            <Exports />
            {count > 0 && <button type="button" class="link" onClick={() => {
              regrade();
              void run();
            }}>{t('Grade all again')}</button>}
            <span class="note" role="status">{writing.value || (count > 0 ? plural(total.value - left, '{count} graded.', '{count} graded.') : '')}</span>
          </>
        )}
      </div>
      {stopped.value && <p class="problem" role="alert">{stopped.value}</p>}
      {!now && staleCount.value > 0 && (
        <p class="warning" role="status">{plural(staleCount.value, '{count} grade is by an earlier rubric: the new one asks the service to render again.', '{count} grades are by an earlier rubric: the new one asks the service to render again.')}
          {' '}<button type="button" class="link" onClick={() => void run()}>{t('Grade these again')}</button></p>
      )}
      <Storage />
    </>
  );
}
