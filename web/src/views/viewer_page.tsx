// A scene: its picture, the tools for it, and a panel beside it.
import { signal } from '@preact/signals';
import { lazyView } from './lazy.tsx';
import { useEffect, useMemo, useRef } from 'preact/hooks';
import { scenePath, type Finding } from '../api.ts';
import { loadDraft } from '../scene/drafts.ts';
import { nextLine, parseView } from '../router.ts';
import { local, takesParts } from '../upload.ts';
import { Viewer } from '../scene/viewer.ts';
import { areParts } from '../scene/scene_files.ts';
import { newScene } from '../scene/template.ts';
import { recall, remember } from '../storage.ts';
import { GonePage } from './gone.tsx';
import { focusStage, Stage } from './stage.tsx';
import { FindingsDrawer, HiddenNote, Notice, SpokenState, StageState } from './stage_state.tsx';
import { showHelp } from './sharing.ts';
import { redo, undo } from './steps.ts';
import { TimeBar } from './time_bar.tsx';
import { Toolbar } from './toolbar.tsx';
import { Tool } from './ui.tsx';
import { ViewPanel } from './view_panel.tsx';
import { language, msg, t } from '../words.ts';

export type PanelName = 'none' | 'view' | 'tree' | 'inspect' | 'files' | 'xml';
export const panel = signal<PanelName>('none');

/** Once it was opened the editor stays, with its place and selection. */
const hadEditor = signal(false);

const tabs: [PanelName, string][] = [['view', msg('View')], ['tree', msg('Tree')], ['inspect', msg('Inspect')], ['files', msg('Files')], ['xml', 'XML']];

export function openPanel(name: PanelName): void {
  panel.value = name;
  if (name === 'xml') hadEditor.value = true;
  remember('panel', name);
}

/** The focus goes back to what opened it; that of a mouse to the image, whose keys are then at hand. */
function closePanel(): void {
  const byKeys = document.activeElement?.matches(':focus-visible') ?? false;
  openPanel('none');
  if (byKeys) document.getElementById('panel-tool')?.focus();
  else focusStage();
}

/** A panel that was open is open again, where there is room for it. */
function firstPanel(id: string | null): PanelName {
  const kept = recall('panel');
  const known = tabs.find(([name]) => name === kept)?.[0];
  return id === null ? 'xml' : known && matchMedia('(min-width: 60rem)').matches ? known : 'none';
}

function Panel({ viewer }: { viewer: Viewer }) {
  const keys = (event: KeyboardEvent): void => {
    const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    if (!step) return;
    const at = tabs.findIndex(([name]) => name === panel.value);
    const next = tabs[(at + step + tabs.length) % tabs.length];
    if (!next) return;
    openPanel(next[0]);
    document.getElementById(`tab-${next[0]}`)?.focus();
  };
  return (
    <aside class={`panel of-${panel.value}`} aria-label={t('Settings and source')} hidden={panel.value === 'none'}>
      <div class="panel-head">
        <div class="tabs" role="tablist" aria-label={t('Panel')} onKeyDown={keys}>
          {tabs.map(([name, text]) => (
            <button key={name} type="button" role="tab" id={`tab-${name}`} aria-controls={`panel-${name}`}
              aria-selected={panel.value === name} tabIndex={panel.value === name ? 0 : -1} onClick={() => openPanel(name)}>
              {t(text)}{name === 'files' && viewer.missing.value.length > 0 && <span class="count" title={t('missing')}>{viewer.missing.value.length}</span>}
            </button>
          ))}
        </div>
        <Tool icon="close" label={t('Close the panel')} onClick={closePanel} />
      </div>
      {tabs.map(([name]) => (
        <div key={name} class="panel-body" id={`panel-${name}`} role="tabpanel" aria-labelledby={`tab-${name}`} hidden={panel.value !== name}>
          {name === 'view' && panel.value === name && <ViewPanel viewer={viewer} />}
          {name === 'tree' && panel.value === name && <TreePanel viewer={viewer} />}
          {name === 'inspect' && panel.value === name && <Inspector viewer={viewer} />}
          {name === 'files' && panel.value === name && <FilesPanel viewer={viewer} />}
          {name === 'xml' && hadEditor.value && <Editor viewer={viewer} />}
        </div>
      ))}
    </aside>
  );
}

const SelectionLayer = lazyView(() => import('./selection_layer.tsx').then((module) => module.SelectionLayer));
const TreePanel = lazyView(() => import('./tree_panel.tsx').then((module) => module.TreePanel));
const Inspector = lazyView(() => import('./inspector.tsx').then((module) => module.Inspector));
const FilesPanel = lazyView(() => import('./files_panel.tsx').then((module) => module.FilesPanel));
const Editor = lazyView(() => import('./editor.tsx').then((module) => module.Editor));

export function ViewerPage({ id, view }: { id: string | null; view: URLSearchParams }) {
  const own = id === null ? local.peek() : null;
  const viewer = useMemo(() => {
    panel.value = firstPanel(id);
    hadEditor.value = panel.value === 'xml';
    return new Viewer(id, own?.loose);
  }, [id]);
  useEffect(() => {
    void viewer.open(parseView(view), own?.text ?? newScene);
    const line = nextLine.peek();
    if (line !== null) {
      nextLine.value = null;
      openPanel('xml');
      viewer.reveal.value = { line, column: 1 };
    }
    const keep = (): void => {
      viewer.flushDraft();
      viewer.flushLink();
    };
    addEventListener('pagehide', keep);
    const historyKeys = (event: KeyboardEvent): void => {
      const isInField = (event.composedPath()[0] as Element).matches('input, textarea, select, [contenteditable=true]');
      if (event.key === '?' && !isInField && !event.ctrlKey && !event.metaKey) return showHelp();
      const key = event.key.toLowerCase(), isRedo = key === 'y' || (key === 'z' && event.shiftKey);
      if (!(event.ctrlKey || event.metaKey) || event.altKey || (key !== 'z' && key !== 'y')) return;
      // Fields have a history of their own; the editor has none.
      const field = event.composedPath()[0] as Element;
      if (field.matches('input:not([type=range], [type=checkbox], [type=color]), textarea, select')) return;
      event.preventDefault();
      if (isRedo) redo(viewer);
      else undo(viewer);
    };
    addEventListener('keydown', historyKeys);
    takesParts.value = (files) => {
      if (!areParts(viewer.missing.value, files)) return false;
      void import('../scene/take_files.ts').then(({ addFiles }) => addFiles(viewer, files)).catch((fault: unknown) => viewer.report(fault));
      return true;
    };
    return () => {
      removeEventListener('pagehide', keep);
      removeEventListener('keydown', historyKeys);
      takesParts.value = null;
      viewer.close();
      if (own && local.peek() === own) local.value = null;
    };
  }, [viewer]);
  const spoken = useRef(language.value);
  useEffect(() => {
    if (language.value === spoken.current) return;
    spoken.current = language.value;
    viewer.languageChanged().catch((fault: unknown) => viewer.report(fault));
  }, [language.value]);
  // The thumbnail is of the scene as it is stored, by its own camera.
  const preview = useMemo(() => (id !== null && view.toString() === '' && loadDraft(id) === null ? `${scenePath(id)}/thumbnail` : ''), [viewer]);
  const facts = viewer.facts.value;
  const named = viewer.title.value, title = own && named === own.loose.main ? own.name : named; // a folder has another name than its scene
  useEffect(() => {
    document.title = `${title} · Farol`;
  }, [title]);
  const pick = async (x: number, y: number): Promise<void> => {
    if (viewer.tool.value === 'measure') {
      const { measureAt } = await import('../scene/measure.ts');
      return measureAt(viewer, x, y);
    }
    const { pickModel } = await import('../scene/pick.ts');
    await pickModel(viewer, x, y);
  };
  // The keys are the picture's: a click on a tool gives them back to it, the keyboard's own way stays as it is.
  const keysBack = (event: MouseEvent): void => {
    const at = event.target as Element;
    if (event.detail === 0 || at.closest('input, select, textarea, a, dialog, .drawer, .state-card') || !(getSelection()?.isCollapsed ?? true)) return;
    focusStage();
  };
  const light = async (alpha: number, beta: number): Promise<void> => {
    const { turnLight } = await import('../scene/camera_light.ts');
    await turnLight(viewer, alpha, beta);
  };
  const showFinding = (finding: Finding): void => {
    openPanel('xml');
    viewer.reveal.value = { line: finding.line ?? 1, column: finding.column ?? 1 };
  };
  if (id !== null && viewer.state.value === 'gone' && !viewer.pictured.value) return <GonePage id={id} />;
  return (
    <main class={panel.value === 'none' ? 'viewer' : 'viewer with-panel'} id="main">
      <div class="view" onClick={keysBack}>
        <div class="title">
          <h1>{title}</h1>
          {facts?.description && <p title={facts.description}>{facts.description}</p>}
        </div>
        <Toolbar viewer={viewer} />
        <div class={`stage-area is-${viewer.state.value}`}>
          <Stage viewer={viewer} preview={preview} actions={{ pick: (x, y) => void pick(x, y), light: (a, b) => void light(a, b) }} />
          <div class="selection-layer">{(viewer.selected.value !== null || viewer.tool.value === 'measure') && viewer.pictured.value && <SelectionLayer viewer={viewer} />}</div>
          <div class="stage-notes">
            <SpokenState viewer={viewer} />
            <StageState viewer={viewer} onPick={showFinding} />
            <Notice viewer={viewer} />
            <HiddenNote viewer={viewer} />
          </div>
          <FindingsDrawer viewer={viewer} onPick={showFinding} />
        </div>
        <TimeBar viewer={viewer} />
      </div>
      <Panel viewer={viewer} />
    </main>
  );
}
