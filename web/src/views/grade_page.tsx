// Marks the submissions of a class: what differs from a reference in words, where it is seen, and what a person says.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { marks, restore, restoring, rubrics, submissions, tasks } from '../grade/grading.ts';
import { t } from '../words.ts';
import { takeBaseline } from './grade/baseline.ts';
import { Detail } from './grade/detail.tsx';
import { chosen, shown, step } from './grade/list_state.ts';
import { RubricPanel } from './grade/rubric_panel.tsx';
import { RunBar } from './grade/run_bar.tsx';
import { Forget, Setup } from './grade/setup.tsx';
import { Filters, Table } from './grade/table.tsx';

const panel = signal<'details' | 'rubric'>('details');
const failed = signal('');

/** Up and down go to the next submission, from the sliders too: left and right move those. */
function onKey(event: KeyboardEvent): void {
  const target = event.target as HTMLElement, isField = target.matches('input:not([type=range]):not([type=checkbox]), textarea, select');
  if (isField) {
    if (event.key === 'Escape' && target.id === 'filter') target.blur();
    return;
  }
  if (event.ctrlKey || event.metaKey || event.altKey || target.closest('.lines, .exports[open], [role=tablist]')) return;
  if (event.key === '/') {
    event.preventDefault();
    document.getElementById('filter')?.focus();
    return;
  }
  const by = { ArrowDown: 1, j: 1, ArrowUp: -1, k: -1 }[event.key];
  if (by === undefined || shown.value.length === 0) return;
  event.preventDefault();
  step(by);
}

function Panels() {
  const tab = (name: 'details' | 'rubric', text: string) => (
    <button type="button" role="tab" id={`tab-${name}`} aria-controls={`panel-${name}`} aria-selected={panel.value === name} tabIndex={panel.value === name ? 0 : -1}
      onClick={() => {
        if (name === 'rubric' && panel.value !== 'rubric') takeBaseline();
        panel.value = name;
      }}>{text}</button>
  );
  return (
    <div class="panels">
      <div class="panel-tabs" role="tablist" aria-label={t('Panels')} onKeyDown={(event) => {
        if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
        if (panel.value === 'details') takeBaseline();
        panel.value = panel.value === 'details' ? 'rubric' : 'details';
        document.getElementById(`tab-${panel.value}`)?.focus();
      }}>
        {tab('details', t('Details'))}{tab('rubric', t('Rubric'))}
      </div>
      <div key={panel.value} role="tabpanel" id={`panel-${panel.value}`} aria-labelledby={`tab-${panel.value}`}>
        {panel.value === 'details' ? <Detail /> : <RubricPanel />}
      </div>
    </div>
  );
}

export function GradePage() {
  useEffect(() => {
    document.title = `${t('Grade')} · Farol`;
    restore().catch(() => (failed.value = t('The server did not send its tables. Load the page again.')));
    window.addEventListener('keydown', onKey);
    return () => window.removeEventListener('keydown', onKey);
  }, []);
  const hasClass = marks.value.length > 0, hasTasks = tasks.value.length > 0 && rubrics.value.length > 0;
  return (
    <main class={hasClass ? 'grade with-class' : 'grade'} id="main">
      <div class="lead">
        <h1>{t('Grade')}</h1>
        <p>{t('Compares scenes with a reference: the images, the geometry and the XML. The service stores nothing; the class stays in this browser.')} <Forget /></p>
      </div>
      {failed.value && <p class="problem" role="alert">{failed.value}</p>}
      {restoring.value ? <p class="note" role="status">{failed.value ? '' : t('Loading…')}</p> : (
        <>
          {hasClass ? <details class="setup" open={!chosen.value && marks.value.every(({ graded }) => !graded)}><summary>{t('Reference and submissions')}</summary><Setup /></details> : <Setup />}
          <RunBar />
          {(hasClass || (hasTasks && submissions.value.length === 0)) && (
            <>
              {hasClass && <Filters />}
              <div class={hasClass ? 'class' : 'class alone'}>{hasClass && <Table />}<Panels /></div>
            </>
          )}
        </>
      )}
    </main>
  );
}
