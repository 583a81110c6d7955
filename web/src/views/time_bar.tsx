// The time of an animated scene: its lap with the moments at which something is where it began.
import { useEffect, useMemo, useState } from 'preact/hooks';
import type { Key } from '../scene/motion.ts';
import type { Viewer } from '../scene/viewer.ts';
import { number, plural, t } from '../words.ts';
import { lazyView } from './lazy.tsx';
import { Tool } from './ui.tsx';

const speeds = [0.1, 0.25, 0.5, 1, 2, 4, 8];

const ExportDialog = lazyView(() => import('./export_dialog.tsx').then((module) => module.ExportDialog));

/** "Moon: 3 turns" */
function nameOf({ time, movers }: Key): string {
  if (time === 0) return t('The beginning');
  const names = movers.slice(0, 4).map(({ mover, count }) => {
    const times = mover.kind === 'turn' ? plural(count, '{count} turn', '{count} turns') : plural(count, '{count} lap', '{count} laps');
    return mover.name ? `${mover.name}: ${times}` : times;
  });
  return names.join(' · ') + (movers.length > 4 ? ' …' : '');
}

/** The keys of the document, read when the first image is there: they can wait. */
function useKeys(viewer: Viewer, isWanted: boolean): void {
  const { clock } = viewer, ready = isWanted && clock.animated.value && viewer.still.value !== null, text = viewer.text.value;
  useEffect(() => {
    if (ready) viewer.loadText().catch((fault: unknown) => viewer.report(fault));
  }, [viewer, ready]);
  useEffect(() => {
    if (!ready || text === null) return;
    let isLatest = true;
    import('../scene/motion.ts').then(({ keysOf, moversOf }) => {
      if (isLatest) viewer.keys.value = keysOf(moversOf(text), clock.from.value, clock.lap.value);
    }).catch((fault: unknown) => viewer.report(fault));
    return () => void (isLatest = false);
  }, [viewer, ready, text, clock.from.value, clock.lap.value]);
}

function Keys({ viewer }: { viewer: Viewer }) {
  const { from, lap } = viewer.clock, keys = viewer.keys.value;
  const marks = useMemo(() => keys.map(({ time }) => {
    const x = ((1000 * (time - from.value)) / lap.value).toFixed(2);
    return `M${x} 0V10`;
  }).join(''), [keys, from.value, lap.value]);
  return <svg class="keys" viewBox="0 0 1000 10" preserveAspectRatio="none" aria-hidden="true"><path d={marks} /></svg>;
}

/** `isPlain`: without keys and export, for frames of other pages. */
export function TimeBar({ viewer, isPlain = false }: { viewer: Viewer; isPlain?: boolean }) {
  const { clock } = viewer, [exporting, setExporting] = useState(false);
  useKeys(viewer, !isPlain);
  if (!clock.animated.value) return null;
  const from = clock.from.value, to = from + clock.lap.value, keys = viewer.keys.value;
  const here = keys.find(({ time }) => Math.abs(time - clock.time.value) < 5e-4);
  const seconds = t('{time} s', { time: number(clock.time.value, { minimumFractionDigits: 1, maximumFractionDigits: 2 }) });
  const seek = (time: number): void => {
    clock.seek(time);
    viewer.moved();
  };
  return (
    <div class="time-bar" role="group" aria-label={t('Animation')}>
      <Tool icon={clock.playing.value ? 'pause' : 'play'} shows="below" label={clock.playing.value ? t('Pause') : t('Play')} keys={t('Space')} onClick={() => clock.toggle()} />
      {!isPlain && <Tool icon="earlier" shows="below" label={t('Frame back')} keys="," onClick={() => viewer.stepTime(-1)} />}
      {!isPlain && <Tool icon="later" shows="below" label={t('Frame on')} keys="." onClick={() => viewer.stepTime(1)} />}
      {keys.length > 0 && <Tool icon="keyBefore" shows="below" label={t('Previous key')} hint={t('Previous key: something is where it began')} keys="B" onClick={() => viewer.toKey(-1)} />}
      {keys.length > 0 && <Tool icon="keyAfter" shows="below" label={t('Next key')} hint={t('Next key: something is where it began')} keys="N" onClick={() => viewer.toKey(1)} />}
      <span class="track">
        <input type="range" aria-label={t('Time in seconds')} min={from} max={to} step={0.01} value={clock.time.value}
          aria-valuetext={here ? `${seconds}, ${nameOf(here)}` : seconds} onInput={(event) => seek(Number(event.currentTarget.value))} />
        {keys.length > 0 && <Keys viewer={viewer} />}
        {here && here.time > 0 && !clock.playing.value && <span class="key-name">{nameOf(here)}</span>}
      </span>
      <output>{seconds}</output>
      <label class="speed">
        <span class="hidden">{t('Speed')}</span>
        <select value={String(clock.speed.value)} onChange={(event) => (clock.speed.value = Number(event.currentTarget.value))}>
          {speeds.map((speed) => <option key={speed} value={String(speed)} selected={speed === clock.speed.value}>{number(speed)}×</option>)}
        </select>
      </label>
      {!isPlain && <Tool icon="film" shows="below" label={t('Export')} hint={t('Export the animation as a file')} onClick={() => setExporting(true)} />}
      {exporting && <ExportDialog viewer={viewer} close={() => setExporting(false)} />}
    </div>
  );
}
