// The files of the scene: what it has and what it misses; they are added, replaced, renamed, removed and saved here.
import { useEffect, useMemo, useState } from 'preact/hooks';
import { findingsOf, sentence } from '../api.ts';
import { chooseFiles } from '../files.ts';
import type { NamedFile } from '../scene/bundle.ts';
import { callOf, everything, fileOf, meshAs, meshForms, meshNames } from '../scene/exports.ts';
import { renameInText, timesNamed } from '../scene/file_names.ts';
import { baseName, listFiles, pathFor, withFile, withoutFile, type ListedFile } from '../scene/scene_files.ts';
import { addFiles, chooseFor } from '../scene/take_files.ts';
import type { Viewer } from '../scene/viewer.ts';
import { Icon } from './icons.tsx';
import { saveBlob } from './save.ts';
import { dropHere, say, Section, Tool } from './ui.tsx';
import { msg, t } from '../words.ts';

const sizeText = (bytes: number): string =>
  bytes < 1024 ? t('{count} bytes', { count: bytes }) : bytes < 1048576 ? `${(bytes / 1024).toFixed(0)} kB` : `${(bytes / 1048576).toFixed(1)} MB`;
const stateText = { kept: '', added: msg('added here'), replaced: msg('replaced here') } as const;

const attempt = (act: () => Promise<unknown>): void =>
  void act().catch((fault: unknown) => say(findingsOf(fault).map((one) => sentence(one)).join(' ')));

function Row({ viewer, file, came }: { viewer: Viewer; file: ListedFile; came: boolean }) {
  const [name, setName] = useState<string | null>(null);
  const text = viewer.text.value, uses = text === null ? null : timesNamed(text, file.path);
  const replace = async (): Promise<void> => {
    const [first] = await chooseFiles(false);
    if (first) await viewer.changeFiles((old, files) => ({ text: old, changes: withFile(files, file.path, first.file) }));
  };
  const rename = async (to: string): Promise<void> => {
    setName(null);
    const path = pathFor(to.trim());
    if (path === '' || path === file.path) return;
    const list = await viewer.loadFiles();
    if (path === list.main || listFiles(list.files, viewer.files.value).some((one) => one.path === path)) return say(t('There is a file “{path}” already.', { path }));
    const content = await fileOf(viewer, file.path);
    if (!content) return say(t('“{path}” cannot be read any more.', { path: file.path }));
    await viewer.changeFiles((old, files) =>
      ({ text: renameInText(old, file.path, path), changes: withFile(withoutFile(files, file.path, came), path, content) }));
  };
  const save = async (): Promise<void> => {
    const content = await fileOf(viewer, file.path);
    if (content) saveBlob(content, baseName(file.path));
  };
  if (name !== null)
    return (
      <li class="file-row">
        <form onSubmit={(event) => {
          event.preventDefault();
          attempt(() => rename(name));
        }}>
          <input type="text" aria-label={t('New name of {path}', { path: file.path })} value={name} spellcheck={false} ref={(input) => input?.focus()}
            onInput={(event) => setName(event.currentTarget.value)}
            onKeyDown={(event) => event.key === 'Escape' && setName(null)} />
          <button type="submit" class="button small">{t('Rename')}</button>
        </form>
      </li>
    );
  return (
    <li class="file-row" {...dropHere((files) => {
      const [first] = files;
      if (first) attempt(() => viewer.changeFiles((old, changes) => ({ text: old, changes: withFile(changes, file.path, first.file) })));
    })}>
      <span class="file-name">{file.path}</span>
      <span class="note">{[sizeText(file.bytes), uses === 0 ? t('not named in the XML') : '', t(stateText[file.state])].filter(Boolean).join(' · ')}</span>
      <span class="tools">
        <Tool icon="download" label={t('Download {path}', { path: file.path })} onClick={() => attempt(save)} />
        <Tool icon="upload" label={t('Replace {path}', { path: file.path })} onClick={() => attempt(replace)} />
        <Tool icon="rename" label={t('Rename {path}', { path: file.path })} onClick={() => setName(file.path)} />
        <Tool icon="close" label={t('Remove {path}', { path: file.path })}
          onClick={() => attempt(() => viewer.changeFiles((old, files) => ({ text: old, changes: withoutFile(files, file.path, came) })))} />
      </span>
    </li>
  );
}

/** `unknown`: names that no shape has. */
function Meshes({ text, own, unknown }: { text: string; own: ReadonlySet<string>; unknown: readonly string[] }) {
  const names = useMemo(() => meshNames(text).filter((name) => callOf(name) && !own.has(pathFor(name)) && !unknown.includes(name)), [text, own, unknown]);
  if (names.length === 0) return null;
  return (
    <Section title={t('Generated meshes ({count})', { count: names.length })}>
      <ul class="files">
        {names.slice(0, 100).map((name) => (
          <li key={name} class="file-row">
            <span class="file-name">{name}</span>
            <span class="tools">
              {meshForms.map((form) => (
                <button key={form} type="button" class="button small" aria-label={t('Download {name} as {format}', { name, format: form.toUpperCase() })}
                  onClick={() => attempt(async () => saveBlob(await meshAs(name, form), `${baseName(name).replace(/\.[^.]+$/, '')}.${form}`))}>{form.toUpperCase()}</button>
              ))}
            </span>
          </li>
        ))}
      </ul>
    </Section>
  );
}

export function FilesPanel({ viewer }: { viewer: Viewer }) {
  const [problem, setProblem] = useState('');
  useEffect(() => {
    Promise.all([viewer.loadText(), viewer.loadFiles()]).catch((fault: unknown) => setProblem(findingsOf(fault).map((one) => sentence(one)).join(' ')));
  }, [viewer]);
  const came = viewer.came.value, text = viewer.text.value, changes = viewer.files.value, missing = viewer.missing.value;
  const files = came ? listFiles(came.files, changes) : [];
  const own = useMemo(() => new Set(files.map((one) => one.path)), [came, changes]);
  if (problem) return <p class="problem" role="alert">{problem}</p>;
  if (!came || text === null) return <p class="note">{t('Loading…')}</p>;
  const title = viewer.title.value, glb = viewer.edited.value ? undefined : viewer.facts.value?.links.model;
  const add = (given: readonly NamedFile[]): void => attempt(() => addFiles(viewer, given));
  return (
    <div class="sections" {...dropHere(add)}>
      {missing.length > 0 && (
        <Section title={t('Missing ({count})', { count: missing.length })}>
          <ul class="files">
            {missing.map((one) => (
              <li key={one.name} class="file-row missing" {...dropHere((given) => given[0] && attempt(() => addFiles(viewer, given.slice(0, 1), one)))}>
                <span class="file-name">{one.name}</span>
                <span class="note">{one.finding.line ? t('named in line {line}; drop it here', { line: one.finding.line }) : t('named in the scene; drop it here')}</span>
                <button type="button" class="button small" aria-label={t('Add the file {name}', { name: one.name })} onClick={() => attempt(() => chooseFor(viewer, one))}>
                  <Icon name="upload" />{t('Add the file')}
                </button>
              </li>
            ))}
          </ul>
        </Section>
      )}
      <Section title={t('Files ({count})', { count: files.length + 1 })}>
        <ul class="files">
          <li class="file-row">
            <span class="file-name">{came.main}</span>
            <span class="note">{t('the scene’s XML')}</span>
            <span class="tools">
              <Tool icon="download" label={t('Download the scene’s XML')} onClick={() => saveBlob(new Blob([text], { type: 'application/xml' }), baseName(came.main))} />
            </span>
          </li>
          {files.map((file) => <Row key={file.path} viewer={viewer} file={file} came={came.files.some((one) => one.path === file.path)} />)}
        </ul>
        <div class="buttons">
          <button type="button" class="button small" onClick={() => void chooseFiles(false).then(add)}><Icon name="plus" />{t('Add files')}</button>
          <button type="button" class="button small" onClick={() => attempt(async () => saveBlob(await everything(viewer), `${title.replaceAll(/[^\w.-]+/g, '-')}.zip`))}>
            <Icon name="download" />{t('All as zip')}
          </button>
          {glb && <a class="button small" href={`${glb}?format=glb`} download><Icon name="download" />{t('As GLB')}</a>}
        </div>
        <p class="note">{t('Drop files here to add them.')} {changes.added.length + changes.removed.length > 0 && t('Changes are kept in this browser until the scene is stored.')}</p>
      </Section>
      <Meshes text={text} own={own} unknown={missing.map(({ name }) => name)} />
    </div>
  );
}
