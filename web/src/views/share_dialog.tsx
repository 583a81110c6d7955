// Everything that leaves the page: links, a frame for other pages, images, a command. It shows what each holds.
import { useEffect, useRef, useState } from 'preact/hooks';
import { findingsOf, query, sentence } from '../api.ts';
import { scenePlace } from '../router.ts';
import { curlOf } from '../scene/curl.ts';
import { storeEdited } from '../scene/store_edited.ts';
import type { Viewer } from '../scene/viewer.ts';
import { Icon } from './icons.tsx';
import { saveBlob } from './save.ts';
import { sharing } from './sharing.ts';
import { Choice, copy, pressable, say, useAnimationFormats } from './ui.tsx';
import { language, msg, t } from '../words.ts';

const here = (): string => location.href.replace(/#.*$/, '');
const escapeAttribute = (text: string): string => text.replaceAll('&', '&amp;').replaceAll('"', '&quot;').replaceAll('<', '&lt;');

/** The frame's address: the view of the link, on the page that other pages may frame. */
export const embedCode = (base: string, link: string, title: string): string =>
  `<iframe src="${escapeAttribute(`${base.replace(/[^/]*$/, '')}embed${link}`)}" title="${escapeAttribute(title)}" width="640" height="480" style="border:0" loading="lazy"></iframe>`;

function Line({ label, text, done }: { label: string; text: string; done: string }) {
  return (
    <div class="share-line">
      <label><span>{label}</span><input type="text" readOnly value={text} onFocus={(event) => event.currentTarget.select()} /></label>
      <button type="button" class="button small" aria-label={t('Copy: {what}', { what: label })} onClick={() => void copy(text, done)}>{t('Copy')}</button>
    </div>
  );
}

const formats: readonly { name: string; label: string; ending: string }[] = [
  { name: 'apng', label: msg('animated PNG'), ending: 'png' }, { name: 'gif', label: msg('GIF'), ending: 'gif' },
  { name: 'animated-webp', label: msg('animated WebP'), ending: 'webp' }, { name: 'mp4', label: 'MP4', ending: 'mp4' }, { name: 'webm', label: 'WebM', ending: 'webm' },
];

function Animation({ viewer }: { viewer: Viewer }) {
  const [format, setFormat] = useState('apng'), names = useAnimationFormats();
  const turntable = viewer.facts.value?.links.turntable;
  if (!turntable || viewer.edited.value) return null;
  const known = formats.filter(({ name }) => names.includes(name)), ending = known.find(({ name }) => name === format)?.ending ?? 'png';
  return (
    <section class="section">
      <h3>{t('Animation')}</h3>
      <p class="note">{t('A round trip about the scene from this view, 48 frames of 480 × 360.')}</p>
      <div class="share-row">
        <Choice label={t('Format')} value={format} choices={known.map(({ name, label }) => [name, t(label)] as const)} onChange={setFormat} />
        <a class="button" href={`${turntable}?${query({ ...viewer.turntableOptions(), frames: 48, fps: 16, format })}`}
          download={`${(viewer.id ?? 'scene').replaceAll('/', '-')}-turntable.${ending}`}><Icon name="download" />{t('Download')}</a>
      </div>
    </section>
  );
}

/** Who wants a link to edits stores them first: the link of the scene would be without them. */
function Unstored({ viewer }: { viewer: Viewer }) {
  const [busy, setBusy] = useState(false), [why, setWhy] = useState('');
  const store = async (): Promise<void> => {
    setBusy(true);
    setWhy(await storeEdited(viewer));
    setBusy(false);
  };
  return (
    <div class="share-warning" role="note">
      <p>{viewer.id === null ? t('This scene is in this browser only: there is no link to it yet.')
        : t('Your edits are in this browser only. Links and frames show the scene as it is stored, without them.')}</p>
      <button type="button" class="button primary" {...pressable(!busy, () => void store())}>{busy ? t('Storing…') : viewer.id === null ? t('Store it and get a link') : t('Store them and get a link')}</button>
      {why && <p class="problem" role="alert">{t('Not stored. {why}', { why })}</p>}
    </div>
  );
}

export function ShareDialog({ viewer }: { viewer: Viewer }) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current?.showModal(), []);
  const { id } = viewer, facts = viewer.facts.value, title = viewer.title.value, unstored = id === null || viewer.edited.value;
  const until = facts?.expires && new Date(facts.expires).toLocaleDateString(language.value);
  const own = !facts?.upload ? '' : until ? t('It was uploaded and is kept until {date}; everyone who has its link sees it.', { date: until })
    : t('It was uploaded; everyone who has its link sees it.');
  const left = [
    viewer.quality.value !== 'standard' && t('the quality that is chosen'), viewer.lightMode.value && t('light mode'), t('the open panel'),
    viewer.edited.value && t('your edits'),
  ].filter(Boolean).join(', ');
  const saveImage = async (type: 'image/png' | 'image/webp'): Promise<void> => {
    try {
      const blob = await viewer.imageAs(type === 'image/png' ? 'png' : 'webp');
      if (blob) saveBlob(blob, `${(id ?? 'scene').replaceAll('/', '-').slice(0, 60)}.${type === 'image/png' ? 'png' : 'webp'}`);
      else say(t('There is no full image yet.'));
    } catch (fault) {
      say(findingsOf(fault).map((one) => sentence(one)).join(' '));
    }
  };
  return (
    <dialog ref={dialog} class="share" aria-labelledby="share-title" onClose={() => (sharing.value = false)}>
      <h2 id="share-title">{t('Share “{title}”', { title })}</h2>
      {unstored && <Unstored viewer={viewer} />}
      {id !== null && (
        <section class="section">
          <h3>{t('Links')}</h3>
          <Line label={t('This view')} text={here() + viewer.link()} done={t('Link copied.')} />
          <Line label={t('The scene')} text={here() + scenePlace(id)} done={t('Link copied.')} />
          <p class="note">{own} {t('The link of this view holds camera, time and display options. Not in it: {parts}.', { parts: left })}</p>
        </section>
      )}
      {id !== null && (
        <section class="section">
          <h3>{t('In another page')}</h3>
          <Line label={t('Frame')} text={embedCode(here(), viewer.link(), title)} done={t('Frame copied.')} />
          <p class="note">{t('The frame can be orbited. A page on another server shows it only if this server was started with --cors and its origin.')}</p>
        </section>
      )}
      <section class="section">
        <h3>{t('Image')}</h3>
        <div class="share-row">
          <button type="button" class="button" onClick={() => void saveImage('image/png')}><Icon name="download" />{t('PNG, exact')}</button>
          <button type="button" class="button" onClick={() => void saveImage('image/webp')}><Icon name="download" />{t('WebP, small')}</button>
        </div>
      </section>
      <Animation viewer={viewer} />
      <section class="section">
        <h3>{t('Command')}</h3>
        <Line label="curl" text={curlOf(viewer)} done={t('Command copied.')} />
        {viewer.edited.value && <p class="note">{t('It sends scene.xml from the folder it is run in: download the XML first.')}</p>}
      </section>
      <button type="button" class="button" onClick={() => dialog.current?.close()}>{t('Close')}</button>
    </dialog>
  );
}
