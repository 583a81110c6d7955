// Any two of stored scenes, edits of this browser, files and images, compared.
import { useEffect, useLayoutEffect, useMemo, useState } from 'preact/hooks';
import { findingsOf, listScenes, sentence } from '../api.ts';
import { causesOf, measure, sentences, type Cause } from '../compare/causes.ts';
import { Pair, modes, type Mode, type Side } from '../compare/pair.ts';
import { draftNames, fileSource, isLinkable, openSource } from '../compare/source.ts';
import { chooseFiles } from '../files.ts';
import { compareAddress, formatView, nextLine, parseView, replaceAddress } from '../router.ts';
import type { NamedFile } from '../scene/bundle.ts';
import { msg, t } from '../words.ts';
import { CompareStage } from './compare_stage.tsx';
import { Icon } from './icons.tsx';
import { copy, dropHere, pressable, Section } from './ui.tsx';

const modeWords: Record<Mode, string> = { side: msg('Side by side'), slider: msg('Slider'), blink: msg('In turn'), difference: msg('Difference') };
const textOf = (fault: unknown): string => findingsOf(fault).map((one) => sentence(one)).join(' ');
/** Not in another tab or window. */
const opensHere = (event: MouseEvent): boolean => !(event.ctrlKey || event.metaKey || event.shiftKey || event.altKey);
const isMode = (text: string | null): text is Mode => modes.some((mode) => mode === text);

/** What is chosen for one side: a scene by its name, edits of this browser, or files. */
function Choose({ label, name, scenes, onName }: { label: string; name: string; scenes: readonly string[]; onName: (name: string) => void }) {
  const [typed, setTyped] = useState(name);
  useEffect(() => setTyped(name), [name]);
  const list = `choices-${label}`, take = (files: readonly NamedFile[]): void => {
    if (files.length > 0) onName(fileSource(files));
  };
  return (
    <form class="choose" {...dropHere(take)} onSubmit={(event) => {
      event.preventDefault();
      onName(typed.trim());
    }}>
      <label>
        <span>{label}</span>
        <input type="text" list={list} value={typed} placeholder={t('name of a scene, or drop files here')} spellcheck={false} autocomplete="off"
          onInput={(event) => setTyped(event.currentTarget.value)} onChange={(event) => onName(event.currentTarget.value.trim())} />
      </label>
      <datalist id={list}>
        {draftNames().map((one) => <option key={one} value={one}>{t('your edits of {name}', { name: one.slice('draft:'.length) })}</option>)}
        {scenes.map((one) => <option key={one} value={one} />)}
      </datalist>
      <button type="button" class="button small" onClick={() => void chooseFiles(false).then(take)}><Icon name="upload" />{t('Files…')}</button>
    </form>
  );
}

function useSide(side: Side, name: string, pair: Pair): string {
  const [problem, setProblem] = useState('');
  useLayoutEffect(() => {
    let isOld = false;
    side.take(null);
    setProblem('');
    if (name === '') return;
    openSource(name).then((opened) => {
      if (isOld) return;
      side.take(opened);
      if (!opened) setProblem(t('This browser does not have these files any more. Choose them again.'));
      pair.settle();
    }, (fault: unknown) => {
      if (!isOld) setProblem(textOf(fault));
    });
    return () => {
      isOld = true;
    };
  }, [side, name]);
  return problem;
}

const pngOf = async (bitmap: ImageBitmap): Promise<Blob> => {
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  canvas.getContext('2d', { alpha: false })?.drawImage(bitmap, 0, 0);
  return canvas.convertToBlob({ type: 'image/png' });
};

/** What the service finds; asked for by a button, since it costs seconds. */
function Findings({ pair }: { pair: Pair }) {
  const [lines, setLines] = useState<string[]>([]);
  const [causes, setCauses] = useState<Cause[] | null>(null);
  const [problem, setProblem] = useState('');
  const [busy, setBusy] = useState(false);
  const first = pair.first.opened.value, second = pair.second.opened.value;
  useEffect(() => {
    setLines([]);
    setCauses(null);
    setProblem('');
  }, [first, second]);
  const both = pair.both;
  if (!first || !second) return null;
  const isReady = both !== null && !pair.busy && !both.first.moving && !both.second.moving, areScenes = first.facts !== null && second.facts !== null;
  const find = async (): Promise<void> => {
    if (!both) return;
    setBusy(true);
    setProblem('');
    try {
      // Both are read at once: an image that is replaced meanwhile is closed.
      const [a, b] = await Promise.all([pngOf(both.first.bitmap), pngOf(both.second.bitmap)]);
      setLines(sentences(await measure(a, b)));
      setCauses(areScenes ? await causesOf(first, second) : null);
    } catch (fault) {
      setProblem(textOf(fault));
    }
    setBusy(false);
  };
  return (
    <Section title={t('Findings')}>
      <button type="button" class="button" {...pressable(isReady && !busy, () => void find())}>{busy ? t('Comparing…') : t('Compare what is on show')}</button>
      <div role="status" class="compare-words">
        {problem && <p class="problem">{problem}</p>}
        {lines.map((line) => <p key={line}>{line}</p>)}
        {causes?.length === 0 && <p>{t('The scenes have the same models, transforms, materials, lights and camera.')}</p>}
      </div>
      {causes !== null && causes.length > 0 && (
        <>
          <p>{t('In the second scene, compared with the first:')}</p>
          <ol class="findings causes">
            {causes.map((cause, index) => (
              <li key={index} class={cause.seen ? 'error' : 'warning'}>
                {cause.line && second.page ? <a href={second.page} onClick={(event) => (nextLine.value = opensHere(event) ? (cause.line ?? null) : null)}>{cause.message}</a> : cause.message}
                {!cause.seen && <small>{t('It cannot be seen.')}</small>}
              </li>
            ))}
          </ol>
        </>
      )}
    </Section>
  );
}

export function ComparePage({ first, second, view }: { first: string; second: string; view: URLSearchParams }) {
  const pair = useMemo(() => new Pair(), []);
  const [names, setNames] = useState<[string, string]>([first, second]);
  const [mode, setMode] = useState<Mode>(() => (isMode(view.get('show')) ? (view.get('show') as Mode) : 'side'));
  const [scenes, setScenes] = useState<string[]>([]);
  useEffect(() => {
    document.title = `${t('Compare')} · Farol`;
    const { orbit, time } = parseView(view);
    pair.orbit.value = orbit;
    pair.time.value = time ?? 0;
    listScenes(1, '').then((page) => setScenes(page.scenes.map(({ id }) => id)), () => undefined); // a help only
    return () => pair.close();
  }, [pair]);
  useEffect(() => setNames([first, second]), [first, second]);
  const problems = [useSide(pair.first, names[0], pair), useSide(pair.second, names[1], pair)];
  const options = formatView({ orbit: pair.orbit.value, walk: null, time: pair.time.value, options: mode === 'side' ? {} : { show: mode } });
  const address = compareAddress(names[0], names[1], options), opened = [pair.first.opened.value, pair.second.opened.value];
  useEffect(() => {
    const timer = setTimeout(() => replaceAddress(address), 200);
    return () => clearTimeout(timer);
  }, [address]);
  const animated = opened.find((one) => one?.facts?.animated)?.facts, hasImage = opened.some((one) => one?.image), isBoth = opened.every((one) => one !== null);
  const choose = (index: 0 | 1) => (name: string) => setNames(index === 0 ? [name, names[1]] : [names[0], name]);
  const areLinkable = names.every(isLinkable);
  return (
    <main class="compare-page" id="main">
      <div class="compare-head">
        <h1>{t('Compare')}</h1>
        <Choose label={t('First')} name={names[0]} scenes={scenes} onName={choose(0)} />
        <button type="button" class="tool" aria-label={t('Exchange the two')} title={t('Exchange the two')} onClick={() => setNames([names[1], names[0]])}><Icon name="swap" /></button>
        <Choose label={t('Second')} name={names[1]} scenes={scenes} onName={choose(1)} />
      </div>
      {problems.map((problem, index) => problem && <p key={index} class="problem" role="alert">{index === 0 ? t('First') : t('Second')}: {problem}</p>)}
      {!isBoth && problems.every((one) => one === '') && <p class="note">{t('Choose two: scenes of this server, your edits, files of a scene, or an image to come close to.')}</p>}
      {isBoth && (
        <>
          <div class="compare-tools">
            <div class="quality" role="group" aria-label={t('How they are shown')}>
              {modes.map((one) => <button key={one} type="button" aria-pressed={mode === one} onClick={() => setMode(one)}>{t(modeWords[one])}</button>)}
            </div>
            {!hasImage && (
              <label class="check">
                <input type="checkbox" checked={pair.cameras.value === 'own'} onChange={(event) => {
                  pair.cameras.value = event.currentTarget.checked ? 'own' : 'same';
                  pair.settle();
                }} />
                <span>{t('Each by its own camera')}</span>
              </label>
            )}
            {animated && (
              <label class="compare-time">
                <span>{t('Time')}</span>
                <input type="range" min={animated.playFrom ?? 0} max={(animated.playFrom ?? 0) + (animated.loopSeconds ?? 60)} step={0.01} value={pair.time.value}
                  aria-valuetext={`${pair.time.value.toFixed(1)} s`} onInput={(event) => {
                    pair.time.value = Number(event.currentTarget.value);
                    pair.first.moved();
                    pair.second.moved();
                  }} />
                <output>{pair.time.value.toFixed(1)} s</output>
              </label>
            )}
            <button type="button" class="button small" disabled={!areLinkable} onClick={() => void copy(location.href.replace(/#.*$/, '') + address, t('Link copied.'))}>{t('Copy a link')}</button>
          </div>
          {!areLinkable && <p class="note">{t('Edits and files are in this browser only: store them as a scene to link to this comparison.')}</p>}
          {hasImage && <p class="note">{t('An image keeps its view: the scene is drawn in its size by its own camera, until you move it.')}</p>}
          <div class="compare-body">
            <CompareStage pair={pair} mode={mode} />
            <Findings pair={pair} />
          </div>
        </>
      )}
    </main>
  );
}

