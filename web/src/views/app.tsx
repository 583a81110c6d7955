// The frame of all pages: head, the page itself, and what may lie over it.
import { useEffect } from 'preact/hooks';
import { place } from '../router.ts';
import { dark, toggleTheme } from '../theme.ts';
import { dropping, local, openDropped, takesParts, uploading, uploadProblem } from '../upload.ts';
import { filesOf } from '../files.ts';
import { keepFocus, spoken } from './focus.ts';
import { lazyView } from './lazy.tsx';
import { Gallery } from './gallery.tsx';
import { GonePage } from './gone.tsx';
import { Mark } from './icons.tsx';
import { Findings, say, Toast, Tool } from './ui.tsx';
import { TokenDialog } from './token_dialog.tsx';
import { ViewerPage } from './viewer_page.tsx';
import { chooseLanguage, language, languages, t } from '../words.ts';

const AssignmentPage = lazyView(() => import('./assignment_page.tsx').then((module) => module.AssignmentPage));
const ComparePage = lazyView(() => import('./compare_page.tsx').then((module) => module.ComparePage));
const GradePage = lazyView(() => import('./grade_page.tsx').then((module) => module.GradePage));

function useDrops(): void {
  useEffect(() => {
    const abort = new AbortController();
    const on = <K extends keyof WindowEventMap>(name: K, handle: (event: WindowEventMap[K]) => void): void =>
      window.addEventListener(name, handle, { signal: abort.signal });
    const ofFiles = (event: DragEvent): boolean =>
      !['grade', 'assignment', 'compare'].includes(place.value.page) && [...(event.dataTransfer?.types ?? [])].includes('Files');
    on('dragover', (event) => {
      if (!ofFiles(event)) return;
      event.preventDefault();
      dropping.value = true;
    });
    on('dragleave', (event) => {
      if (!event.relatedTarget) dropping.value = false;
    });
    on('drop', (event) => {
      if (!ofFiles(event) || !event.dataTransfer) return;
      event.preventDefault();
      dropping.value = false;
      void filesOf(event.dataTransfer).then(openDropped);
    });
    return () => abort.abort();
  }, []);
}

function Head() {
  const page = place.value.page;
  const link = (name: string, href: string, text: string) => (
    <a href={href} {...(page === name ? { 'aria-current': 'page' as const } : {})}>{text}</a>
  );
  return (
    <header class="head">
      <a class="brand" href="#/" aria-label={t('Farol, all scenes')}><Mark /><span>Farol</span></a>
      <nav aria-label={t('Pages')}>
        {link('gallery', '#/', t('Scenes'))}
        {link('new', '#/new', t('New'))}
        {link('grade', '#/grade', t('Grade'))}
        {link('compare', '#/compare', t('Compare'))}
      </nav>
      <span class="space" />
      <a class="quiet" href="openapi.yaml">API</a>
      <span class="language">
        <b aria-hidden="true">{language.value}</b>
        <select aria-label={t('Language')} value={language.value} onChange={(event) =>
          void chooseLanguage(event.currentTarget.value).catch(() => say(t('The server did not send this language. Try again later.')))}>
          {Object.entries(languages).map(([key, name]) => <option key={key} value={key} lang={key} selected={key === language.value}>{name}</option>)}
        </select>
      </span>
      <Tool icon={dark.value ? 'sun' : 'moon'} shows="below" label={dark.value ? t('Light theme') : t('Dark theme')} onClick={toggleTheme} />
    </header>
  );
}

function UploadNote() {
  const problem = uploadProblem.value;
  return (
    <>
      {uploading.value && <div class="overlay" role="status"><p>{t('Sending “{name}”…', { name: uploading.value })}</p></div>}
      {dropping.value && <div class="overlay drop" aria-hidden="true"><p>{takesParts.value ? t('Drop a texture to add it to this scene; a scene, a folder or a zip to open it') : t('Drop a scene, a mesh, a folder or a zip to open it')}</p></div>}
      {problem && (
        <div class="note-box" role="alert">
          <div><h2>{problem.title}</h2><Findings findings={problem.findings} /></div>
          <Tool icon="close" label={t('Close')} onClick={() => (uploadProblem.value = null)} />
        </div>
      )}
    </>
  );
}

/** This is embed.html, which other pages may show in a frame. */
const isEmbedded = 'embed' in document.body.dataset;
const EmbedPage = lazyView(() => import('./embed_page.tsx').then((module) => module.EmbedPage));

export function App() {
  useDrops();
  useEffect(keepFocus, []);
  const where = place.value;
  const id = where.page === 'scene' ? where.id : null;
  if (isEmbedded) return where.page === 'scene' ? <EmbedPage key={where.id} id={where.id} view={where.view} /> : <GonePage />;
  return (
    <>
      <a class="skip" href="#main" onClick={(event) => {
        event.preventDefault();
        document.getElementById('main')?.querySelector<HTMLElement>('[tabindex], a, button, input')?.focus();
      }}>{t('Skip to the content')}</a>
      <Head />
      {where.page === 'gallery' && <Gallery />}
      {(where.page === 'scene' || where.page === 'new') && (
        <ViewerPage key={id ?? `new ${local.value?.count ?? 0}`} id={id} view={where.page === 'scene' ? where.view : new URLSearchParams()} />
      )}
      {where.page === 'compare' && <ComparePage first={where.first} second={where.second} view={where.view} />}
      {where.page === 'grade' && <GradePage />}
      {where.page === 'assignment' && <AssignmentPage id={where.id} />}
      {where.page === 'lost' && <GonePage />}
      <UploadNote />
      <TokenDialog />
      <Toast />
      <div class="hidden" id="spoken" role="status">{spoken.value}</div>
    </>
  );
}
