// Where an address leads nowhere: says so, and shows the way on.
import { useEffect } from 'preact/hooks';
import { findScene } from '../router.ts';
import { loadDraft } from '../scene/drafts.ts';
import { saveBlob } from './save.ts';
import { Icon } from './icons.tsx';
import { t } from '../words.ts';

/** `id` of a scene that is not there; without one the address itself means nothing. */
export function GonePage({ id }: { id?: string }) {
  useEffect(() => {
    document.title = `${t('Not found')} · Farol`;
  }, []);
  const draft = id === undefined ? null : loadDraft(id), isUpload = id?.startsWith('~') ?? false;
  return (
    <main class="gone" id="main">
      <Icon name="lost" />
      <h1>{id === undefined ? t('There is no such page') : isUpload ? t('This scene is not here any more') : t('There is no such scene')}</h1>
      <p>
        {id === undefined ? t('The address has a part that this page does not know. Perhaps it was cut off when it was copied.')
          : isUpload ? t('It was uploaded, and has since expired or been deleted; or its address was not copied whole.')
          : t('The server has no scene named “{id}”. It may have been renamed or removed, or the address has a mistake.', { id })}
      </p>
      {id !== undefined && isUpload && <p class="note">{t('If you have its files, drop them on this page again: the same files get the same address.')}</p>}
      {draft && (
        <p class="note">
          {t('Your edits of it are still in this browser.')}{' '}
          <button type="button" class="link" onClick={() => saveBlob(new Blob([draft.text], { type: 'application/xml' }), 'scene.xml')}>{t('Download their XML')}</button>
        </p>
      )}
      <div class="buttons">
        <a class="button primary" href="#/">{t('All scenes')}</a>
        {id !== undefined && !isUpload && <a class="button" href="#/" onClick={() => findScene(id)}>{t('Search for “{name}”', { name: id.replace(/^.*\//, '').slice(0, 40) })}</a>}
        <a class="button" href="#/new">{t('New scene')}</a>
      </div>
    </main>
  );
}
