// The scenes one can open.
import { signal } from '@preact/signals';
import { useEffect, useRef, useState } from 'preact/hooks';
import { faultOf, findingsOf, listScenes, sentence, type SceneFacts } from '../api.ts';
import { scenePlace, searchWords as words } from '../router.ts';
import { titleOf } from '../scene/title.ts';
import { thumbnail } from '../thumbnails.ts';
import { pickFiles } from '../upload.ts';
import { Icon } from './icons.tsx';
import { pressable } from './ui.tsx';
import { language, plural, t } from '../words.ts';

interface Listing {
  words: string;
  scenes: SceneFacts[];
  pages: number;
  page: number;
  total: number;
}

const listing = signal<Listing | null>(null);
const problem = signal('');
const loading = signal(false);
let request = 0;

async function load(page: number): Promise<void> {
  const number = ++request, text = words.value.trim();
  loading.value = true;
  try {
    const answer = await listScenes(page, text);
    if (number !== request) return;
    const before = page > 1 && listing.value ? listing.value.scenes : [];
    const scenes = [...before, ...answer.scenes];
    listing.value = { words: text, scenes, pages: answer.pages, page, total: answer.total };
    problem.value = '';
  } catch (fault) {
    if (number === request) problem.value = t('The scenes cannot be listed. {why}', { why: findingsOf(fault).map((one) => sentence(one)).join(' ') });
  } finally {
    if (number === request) loading.value = false;
  }
}

function Thumbnail({ scene }: { scene: SceneFacts }) {
  const frame = useRef<HTMLDivElement>(null);
  const [picture, setPicture] = useState('');
  const [failed, setFailed] = useState(false);
  useEffect(() => {
    if (!scene.valid) return;
    const abort = new AbortController();
    const observer = new IntersectionObserver((entries) => {
      if (!entries.some((entry) => entry.isIntersecting)) return;
      observer.disconnect();
      thumbnail(scene.links.thumbnail, abort.signal).then(setPicture, () => setFailed(!abort.signal.aborted));
    }, { rootMargin: '200px' });
    observer.observe(frame.current as HTMLDivElement);
    return () => {
      observer.disconnect();
      abort.abort();
    };
  }, [scene.links.thumbnail]);
  if (!scene.valid || failed) return <div class="thumbnail none">{scene.valid ? t('no image') : t('cannot be read')}</div>;
  return (
    <div class="thumbnail" ref={frame}>
      {picture && <img width={320} height={240} alt="" decoding="async" src={picture} onLoad={(event) => event.currentTarget.classList.add('loaded')} />}
    </div>
  );
}

function facts(scene: SceneFacts): string[] {
  const { counts } = scene;
  if (!counts) return [];
  return [
    plural(counts.models, '{count} model', '{count} models'), plural(counts.triangles, '{count} triangle', '{count} triangles'),
  ];
}

function Card({ scene }: { scene: SceneFacts }) {
  const fault = scene.valid ? undefined : faultOf(scene);
  return (
    <li class={scene.valid ? 'card' : 'card broken'}>
      <a href={scenePlace(scene.id)}>
        <div class="frame">
          <Thumbnail scene={scene} />
          {scene.animated && <span class="badge"><Icon name="play" />{t('animated')}</span>}
        </div>
        <div class="words">
          <h2>{titleOf(scene.id, scene.title, null)}</h2>
          <p class="description">{scene.valid ? scene.description : fault ? sentence(fault) : t('This scene cannot be read.')}</p>
          {scene.valid && <p class="facts">{facts(scene).map((text) => <span key={text}>{text}</span>)}</p>}
        </div>
      </a>
    </li>
  );
}

export function Gallery() {
  const timer = useRef<ReturnType<typeof setTimeout>>();
  useEffect(() => {
    document.title = `${t('Scenes')} · Farol`;
    void load(1);
  }, [language.value]);
  const shown = listing.value;
  const type = (text: string): void => {
    words.value = text;
    clearTimeout(timer.current);
    timer.current = setTimeout(() => void load(1), 150);
  };
  return (
    <main class="gallery" id="main">
      <div class="lead">
        <div>
          <h1>{t('Scenes')}</h1>
          <p>{t('Every pixel is drawn on the server. Open one, or drop your own anywhere on this page.')}</p>
        </div>
        <div class="find">
          <label class="search">
            <Icon name="search" />
            <input type="search" placeholder={t('Search scenes')} aria-label={t('Search scenes')} value={words.value}
              onInput={(event) => type(event.currentTarget.value)} />
          </label>
          <button type="button" class="button" onClick={() => pickFiles(false)}><Icon name="upload" />{t('Open files')}</button>
          <button type="button" class="button" onClick={() => pickFiles(true)}>{t('Open a folder')}</button>
        </div>
      </div>
      {problem.value && <p class="problem" role="alert">{problem.value}</p>}
      <ul class="cards" aria-busy={loading.value}>
        {shown
          ? shown.scenes.map((scene) => <Card key={scene.id} scene={scene} />)
          : !problem.value && Array.from({ length: 8 }, (_, i) => <li key={i} class="card ghost" aria-hidden="true"><div class="frame" /><div class="words" /></li>)}
      </ul>
      <p class="note" role="status">
        {shown?.words && shown.scenes.length > 0 && <span class="hidden">{plural(shown.total, '{count} scene', '{count} scenes')}</span>}
        {shown && shown.scenes.length === 0 && (shown.words
          ? t('No scene matches “{words}”.', { words: shown.words })
          : t('This server has no scenes. Start it with --scenes FOLDER, or drop one of your own here.'))}
      </p>
      {shown && shown.page < shown.pages && (
        <button type="button" class="button more" {...pressable(!loading.value, () => void load(shown.page + 1))}>
          {t('More scenes ({count} of {total})', { count: shown.scenes.length, total: shown.total })}
        </button>
      )}
    </main>
  );
}
