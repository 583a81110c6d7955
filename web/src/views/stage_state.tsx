// What lies over the picture to say how it stands with the scene: each state of its own look.
import { signal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { findingsOf, sentence, type Finding } from '../api.ts';
import { countFindings, type SceneState } from '../scene/state.ts';
import type { Viewer } from '../scene/viewer.ts';
import { Icon } from './icons.tsx';
import { Findings, say, type Repair } from './ui.tsx';
import { msg, plural, t } from '../words.ts';

const drawerOpen = signal(false);

/** "2 errors, 1 warning" */
export function countsText(findings: readonly Finding[]): string {
  const { errors, warnings } = countFindings(findings);
  return [
    errors && plural(errors, '{count} error', '{count} errors'), warnings && plural(warnings, '{count} warning', '{count} warnings'),
  ].filter(Boolean).join(', ');
}

const attempt = (act: () => Promise<unknown>): void =>
  void act().catch((fault: unknown) => say(findingsOf(fault).map((one) => sentence(one)).join(' ')));

/** A missing file is added where its finding is: by the button, or dropped on it. */
const repairOf = (viewer: Viewer) => (finding: Finding): Repair | null => {
  const missing = viewer.missing.value.find((one) => one.finding === finding);
  if (!missing) return null;
  return {
    label: t('Add “{name}”', { name: missing.name }),
    choose: () => attempt(async () => (await import('../scene/take_files.ts')).chooseFor(viewer, missing)),
    take: (files) => attempt(async () => (await import('../scene/take_files.ts')).addFiles(viewer, files.slice(0, 1), missing)),
  };
};

/** The findings, over the lower edge of the picture: it keeps its size when there are some. */
export function FindingsDrawer({ viewer, onPick }: { viewer: Viewer; onPick: (finding: Finding) => void }) {
  const findings = viewer.findings.value, state = viewer.state.value, counts = countsText(findings);
  const broken = state === 'incomplete' && !viewer.edited.value;
  // A scene that opens with errors shows them; who edits has them in the editor, and is not covered by them.
  useEffect(() => {
    if (broken) drawerOpen.value = true;
  }, [viewer, broken]);
  useEffect(() => () => void (drawerOpen.value = false), [viewer]);
  if (!counts) return null;
  const { errors } = countFindings(findings), open = drawerOpen.value;
  return (
    <section class={`drawer ${errors > 0 ? 'error' : 'warning'}`} aria-label={t('Findings of the scene')}>
      <button type="button" class="drawer-tab" aria-expanded={open} aria-controls="drawer-body" onClick={() => (drawerOpen.value = !open)}>
        <Icon name={errors > 0 ? 'error' : 'warning'} /><span>{counts}</span><Icon name={open ? 'down' : 'up'} />
      </button>
      <div class="drawer-body" id="drawer-body" hidden={!open}><Findings findings={findings} onPick={onPick} repair={repairOf(viewer)} /></div>
    </section>
  );
}

const stateWords: Partial<Record<SceneState, string>> = {
  loading: msg('Drawing…'), incomplete: msg('Incomplete: placeholders stand for what has errors.'),
  offline: msg('The server does not answer. It is asked again every few seconds.'),
};

/** The same for a screen reader, in a place that stays: what comes with its words already in it is not read out. */
export function SpokenState({ viewer }: { viewer: Viewer }) {
  const state = viewer.state.value, stateText = stateWords[state], counts = countsText(viewer.findings.value), hadFindings = useRef(false);
  hadFindings.current ||= counts !== '';
  const words = state === 'failed' ? (viewer.pictured.value ? t('This cannot be drawn. The image is of the last version that could be.') : t('This scene cannot be drawn'))
    : stateText ? t(stateText) : '';
  return <p class="hidden" role="status">{[words, counts || (hadFindings.current && state === 'drawn' ? t('No errors or warnings.') : '')].filter(Boolean).join(' ')}</p>;
}

/** Speaks of what is wrong, and what can be done about it. */
export function StageState({ viewer, onPick }: { viewer: Viewer; onPick: (finding: Finding) => void }) {
  const state = viewer.state.value, pictured = viewer.pictured.value, findings = viewer.findings.value;
  const again = <button type="button" class="button small" onClick={() => viewer.askAgain()}>{t('Try now')}</button>;
  if (state === 'failed' && !pictured)
    return (
      <div class="state-card failed" role="alert">
        <Icon name="error" />
        <h2>{t('This scene cannot be drawn')}</h2>
        <Findings findings={findings.slice(0, 3)} onPick={onPick} />
        {findings.length > 3 && <p class="note">{t('And {count} more, in the list below.', { count: findings.length - 3 })}</p>}
      </div>
    );
  if (state === 'failed')
    return (
      <p class="state-note failed">
        <Icon name="error" /><span>{t('This cannot be drawn. The image is of the last version that could be.')}</span>
      </p>
    );
  if (state === 'offline')
    return (
      <div class={pictured ? 'state-note offline' : 'state-card offline'}>
        <Icon name="offline" /><span>{t('The server does not answer. It is asked again every few seconds.')}</span>{again}
      </div>
    );
  if (state === 'gone')
    return (
      <div class="state-note failed" role="alert">
        <Icon name="lost" /><span>{t('This scene is not on the server any more. The image is the last one that it sent.')}</span>
        <a class="button small" href="#/">{t('All scenes')}</a>
      </div>
    );
  if (state === 'incomplete')
    return (
      <p class="state-note incomplete">
        <Icon name="error" /><span>{t('Incomplete: placeholders stand for what has errors.')}</span>
      </p>
    );
  if (state === 'loading') return <p class="state-note loading"><span>{t('Drawing…')}</span></p>;
  return null;
}

/** What was done without being asked for, and how to take it back. */
export function Notice({ viewer }: { viewer: Viewer }) {
  return (
    <div class="notice-place" aria-live="polite">
      {viewer.notice.value && (
        <p class="state-note notice">
          <span>{viewer.notice.value}</span>
          {viewer.edited.value && <button type="button" class="link" onClick={() => viewer.discardEdits()}>{t('Discard the edits')}</button>}
        </p>
      )}
    </div>
  );
}

/** That the image shows less than the XML has, for as long as something is hidden. */
export function HiddenNote({ viewer }: { viewer: Viewer }) {
  const { hidden, locked } = viewer.marks.value;
  if (hidden.length === 0) return null;
  return (
    <p class="state-note hidden-note" role="status">
      <Icon name="hidden" /><span>{plural(hidden.length, '{count} part is hidden on this page only. The XML keeps it: links and stored scenes show it.',
        '{count} parts are hidden on this page only. The XML keeps them: links and stored scenes show them.')}</span>
      <button type="button" class="link" onClick={() => attempt(() => viewer.mark({ hidden: [], locked }))}>{t('Show all')}</button>
    </p>
  );
}
