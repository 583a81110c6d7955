// The animation as a file: what it holds, how far it is, and how to stop it.
import { useEffect, useRef, useState } from 'preact/hooks';
import { findingsOf, sentence } from '../api.ts';
import { drawAnimation, endingOf, frameCount, framesLimit, isAsStored, isVideo, requestVideo, type AnimationPlan } from '../scene/animation.ts';
import type { Viewer } from '../scene/viewer.ts';
import { msg, number, t } from '../words.ts';
import { Icon } from './icons.tsx';
import { saveBlob } from './save.ts';
import { Choice, say, useAnimationFormats } from './ui.tsx';

const formats = [['apng', msg('animated PNG, exact')], ['webp', msg('animated WebP, small')]] as const;
const videos = [['mp4', msg('MP4, a film')], ['webm', msg('WebM, a film')]] as const;
const rates = [5, 10, 15, 20, 25, 30, 50];
const widths = [320, 480, 640, 960, 1280];

/** The most frames a second that keep the file at 300 frames. */
const usualRate = (seconds: number): number => rates.filter((rate) => rate <= 25 && seconds * rate <= 300).at(-1) ?? (rates[0] as number);

/** The server sends a film when it is done: how far it is cannot be known, how long it has taken can. */
function Waiting({ count }: { count: number }) {
  const [seconds, setSeconds] = useState(0);
  useEffect(() => {
    const timer = setInterval(() => setSeconds((before) => before + 1), 1000);
    return () => clearInterval(timer);
  }, []);
  return (
    <label class="export-progress">
      <span>{t('The server draws {frames} frames and sends the film when it is done. {seconds} s so far.', { frames: count, seconds })}</span><progress />
    </label>
  );
}

export function ExportDialog({ viewer, close }: { viewer: Viewer; close: () => void }) {
  const dialog = useRef<HTMLDialogElement>(null), running = useRef<AbortController | null>(null);
  const { clock } = viewer, seconds = clock.lap.value / clock.speed.value;
  const [format, setFormat] = useState<AnimationPlan['format']>('apng'), [fps, setFps] = useState(() => usualRate(seconds)), [width, setWidth] = useState(480);
  const [done, setDone] = useState<number | null>(null), [problem, setProblem] = useState('');
  useEffect(() => {
    clock.stop();
    dialog.current?.showModal();
    return () => running.current?.abort();
  }, []);
  const isRunning = done !== null, wasRunning = useRef(false);
  // The button that was pressed is gone.
  useEffect(() => {
    if (isRunning !== wasRunning.current) dialog.current?.querySelector<HTMLElement>(isRunning ? '.share-row .button' : '.button.primary')?.focus();
    wasRunning.current = isRunning;
  }, [isRunning]);
  // The service draws what it has stored; a scene whose motions have no common loop is not one lap.
  const names = useAnimationFormats(), films = videos.filter(([key]) => names.includes(key)), hasLoop = viewer.facts.value?.loopSeconds !== undefined;
  const canFilm = films.length > 0 && hasLoop && isAsStored(viewer), choices = canFilm ? [...formats, ...films] : formats;
  const stage = viewer.canvas?.size() ?? { width: 4, height: 3 };
  const height = Math.max(1, Math.round((width * stage.height) / stage.width));
  const plan: AnimationPlan = { format, width, height, fps, from: clock.from.value, seconds: clock.lap.value, speed: clock.speed.value };
  const count = frameCount(plan), limit = framesLimit(plan), isTooLong = count > limit;
  const stop = (): void => {
    running.current?.abort();
    running.current = null;
    setDone(null);
  };
  const start = async (): Promise<void> => {
    const control = new AbortController();
    running.current = control;
    setProblem('');
    setDone(0);
    try {
      const file = isVideo(plan) ? await requestVideo(viewer, plan, control.signal) : await drawAnimation(viewer, plan, setDone, control.signal);
      saveBlob(file, `${(viewer.id ?? 'scene').replaceAll('/', '-').slice(0, 60)}.${endingOf(plan)}`);
      say(t('Saved, {size} MB.', { size: number(file.size / 1e6, { maximumFractionDigits: 1 }) }));
      running.current = null;
      dialog.current?.close();
    } catch (fault) {
      if (control.signal.aborted) return;
      stop();
      setProblem(findingsOf(fault).map((one) => sentence(one)).join(' '));
    }
  };
  return (
    <dialog ref={dialog} class="share" aria-labelledby="export-title" onClose={() => {
      stop();
      close();
    }}>
      <h2 id="export-title">{t('Export the animation')}</h2>
      {!isRunning ? (
        <>
          <Choice label={t('Format')} value={format} choices={choices.map(([key, text]) => [key, t(text)] as const)}
            onChange={(value) => setFormat(choices.find(([key]) => key === value)?.[0] ?? 'apng')} />
          <Choice label={t('Frames a second')} value={String(fps)} choices={rates.map((rate) => [String(rate), String(rate)] as const)} onChange={(value) => setFps(Number(value))} />
          <Choice label={t('Width')} value={String(width)} choices={widths.map((one) => [String(one), `${one} px`] as const)} onChange={(value) => setWidth(Number(value))} />
          <p class={isTooLong ? 'problem' : 'note'} role="status">
            {t('One lap: {frames} frames of {width} × {height}, {seconds} s at the speed {speed}×.', {
              frames: count, width, height, seconds: number(seconds, { maximumFractionDigits: 2 }), speed: number(clock.speed.value),
            })}
            {isTooLong && ` ${t('That is too long: {most} frames at most. Choose fewer frames a second or a higher speed.', { most: limit })}`}
          </p>
          {films.length > 0 && !canFilm && <p class="note">{hasLoop ? t('MP4 and WebM are written by the server, of the scene as it is stored: store your edits first, and show what is hidden.')
            : t('MP4 and WebM are of a loop; the motions of this scene have none.')}</p>}
          {problem && <p class="problem" role="alert">{problem}</p>}
          <div class="share-row">
            <button type="button" class="button primary" disabled={isTooLong} onClick={() => void start()}><Icon name="download" />{t('Export')}</button>
            <button type="button" class="button" onClick={() => dialog.current?.close()}>{t('Close')}</button>
          </div>
        </>
      ) : (
        <>
          {isVideo(plan) ? <Waiting count={count} /> : (
            <label class="export-progress"><span>{t('Frame {done} of {all}', { done, all: count })}</span><progress value={done} max={count} /></label>
          )}
          <div class="share-row"><button type="button" class="button" onClick={stop}>{t('Cancel')}</button></div>
        </>
      )}
    </dialog>
  );
}
