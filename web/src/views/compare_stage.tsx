// The two images: side by side, under a slider, in turn, or their difference; one camera moves both.
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { difference } from '../compare/difference.ts';
import type { Mode, Pair, Side } from '../compare/pair.ts';
import { panOrbit, turnOrbit, zoomOrbit } from '../maths/camera.ts';
import { clamp } from '../maths/vec.ts';
import { number, t } from '../words.ts';

const blinkMs = 700; // under three changes a second
const gain = 4; // of the difference

function Picture({ side, label, shown, clip }: { side: Side; label: string; shown: boolean; clip: number }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const image = side.image.value, opened = side.opened.value;
  useLayoutEffect(() => {
    const surface = canvas.current;
    if (!surface || !image || image.bitmap.width === 0) return; // closed: a newer one is on its way
    surface.width = image.bitmap.width;
    surface.height = image.bitmap.height;
    surface.getContext('2d', { alpha: false })?.drawImage(image.bitmap, 0, 0);
    surface.dataset['count'] = String(image.count);
    surface.dataset['rest'] = String(!image.moving);
  }, [image]);
  return (
    <figure class={shown ? 'compared' : 'compared out'} style={clip > 0 ? { clipPath: `inset(0 0 0 ${clip}%)` } : { clipPath: 'none' }}>
      <canvas ref={canvas} role="img" aria-label={label} width={16} height={9} hidden={!image} />
      <figcaption>{label}</figcaption>
      {side.problem.value && <p class="problem" role="alert">{side.problem.value}</p>}
      {opened && !image && !side.problem.value && <p class="note">{t('Drawing…')}</p>}
    </figure>
  );
}

function Difference({ pair }: { pair: Pair }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [share, setShare] = useState<number | null>(null);
  const both = pair.both, first = both?.first, second = both?.second;
  useLayoutEffect(() => {
    const surface = canvas.current;
    if (!surface || !first?.bitmap.width || !second?.bitmap.width) return; // until both are of one view the last difference stays
    const { width, height } = first.bitmap;
    const pixelsOf = (bitmap: ImageBitmap): ImageData => {
      const context = new OffscreenCanvas(width, height).getContext('2d', { alpha: false, willReadFrequently: true }) as OffscreenCanvasRenderingContext2D;
      context.drawImage(bitmap, 0, 0, width, height); // an image of another size is stretched to the first
      return context.getImageData(0, 0, width, height);
    };
    const out = new ImageData(width, height);
    setShare(difference(pixelsOf(first.bitmap).data, pixelsOf(second.bitmap).data, out.data, gain));
    surface.width = width;
    surface.height = height;
    surface.getContext('2d')?.putImageData(out, 0, 0);
    surface.dataset['rest'] = String(!first.moving && !second.moving);
  }, [first, second]);
  return (
    <figure class="compared">
      <canvas ref={canvas} role="img" aria-label={t('Difference of the images')} width={16} height={9} class="difference" />
      <figcaption>{t('Difference, {gain} times as bright', { gain })}{share !== null && `: ${t('{share} of the pixels', { share: number(share, { style: 'percent', maximumFractionDigits: 2 }) })}`}</figcaption>
    </figure>
  );
}

export function CompareStage({ pair, mode }: { pair: Pair; mode: Mode }) {
  const stage = useRef<HTMLDivElement>(null), drag = useRef<{ id: number; x: number; y: number; pans: boolean } | null>(null);
  const [slider, setSlider] = useState(50);
  const [isSecond, setSecond] = useState(false);
  const [isBlinking, setBlinking] = useState(!matchMedia('(prefers-reduced-motion: reduce)').matches);
  useLayoutEffect(() => {
    pair.size = () => {
      const box = stage.current?.querySelector('.compared')?.getBoundingClientRect();
      return { width: box?.width || 512, height: box?.height || 512, ratio: window.devicePixelRatio || 1 };
    };
    const observer = new ResizeObserver(() => pair.settle());
    if (stage.current) observer.observe(stage.current);
    return () => observer.disconnect();
  }, [pair]);
  useLayoutEffect(() => pair.settle(), [pair, mode]);
  useEffect(() => {
    if (mode !== 'blink' || !isBlinking) return;
    const timer = setInterval(() => setSecond((before) => !before), blinkMs);
    return () => clearInterval(timer);
  }, [mode, isBlinking]);
  useEffect(() => {
    const box = stage.current;
    const zoom = (event: WheelEvent): void => {
      event.preventDefault();
      pair.changeOrbit((orbit) => zoomOrbit(orbit, Math.exp(clamp(event.deltaY * (event.deltaMode === 1 ? 16 : 1), -240, 240) * 0.0015)));
    };
    box?.addEventListener('wheel', zoom, { passive: false });
    return () => box?.removeEventListener('wheel', zoom);
  }, [pair]);
  const turn = (azimuth: number, elevation: number): void => pair.changeOrbit((orbit) => turnOrbit(orbit, azimuth, elevation));
  const press = (event: KeyboardEvent): void => {
    if (event.target !== stage.current || event.ctrlKey || event.metaKey || event.altKey) return;
    const actions: Record<string, () => void> = {
      ArrowLeft: () => turn(-5, 0), ArrowRight: () => turn(5, 0), ArrowUp: () => turn(0, 5), ArrowDown: () => turn(0, -5),
      '+': () => pair.changeOrbit((orbit) => zoomOrbit(orbit, 0.9)), '-': () => pair.changeOrbit((orbit) => zoomOrbit(orbit, 1 / 0.9)),
      r: () => {
        pair.orbit.value = null;
        pair.settle();
      },
      ' ': () => setSecond(!isSecond),
    };
    const act = actions[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  };
  const move = (event: PointerEvent): void => {
    const held = drag.current;
    if (held?.id !== event.pointerId) return;
    const [dx, dy] = [event.clientX - held.x, event.clientY - held.y], height = Math.max(200, stage.current?.clientHeight ?? 0);
    drag.current = { ...held, x: event.clientX, y: event.clientY };
    if (held.pans) pair.changeOrbit((orbit) => panOrbit(orbit, dx, dy, pair.home?.fov ?? 60, height));
    else turn((-dx * 180) / height, (dy * 180) / height);
  };
  const end = (event: PointerEvent): void => {
    if (drag.current?.id === event.pointerId) drag.current = null;
  };
  const labels = [t('First: {title}', { title: pair.first.opened.value?.title ?? '' }), t('Second: {title}', { title: pair.second.opened.value?.title ?? '' })] as const;
  const isStacked = mode === 'slider' || mode === 'blink';
  return (
    <div class="compare-view">
      <div ref={stage} class={`compare-stage of-${mode}`} tabIndex={0} role="application" aria-busy={pair.busy} aria-label={t('Both images. Drag or arrow keys orbit, plus and minus zoom, R resets')}
        onKeyDown={press} onContextMenu={(event) => event.preventDefault()} onPointerMove={move} onPointerUp={end} onPointerCancel={end}
        onPointerDown={(event) => {
          if (drag.current) return;
          event.currentTarget.setPointerCapture(event.pointerId);
          drag.current = { id: event.pointerId, x: event.clientX, y: event.clientY, pans: event.button !== 0 || event.shiftKey };
        }}>
        {mode === 'difference' ? <Difference pair={pair} /> : (
          <>
            <Picture side={pair.first} label={labels[0]} shown={mode !== 'blink' || !isSecond} clip={0} />
            <Picture side={pair.second} label={labels[1]} shown={mode !== 'blink' || isSecond} clip={mode === 'slider' ? slider : 0} />
          </>
        )}
        {mode === 'slider' && <span class="slider-line" style={{ left: `${slider}%` }} aria-hidden="true" />}
      </div>
      {isStacked && (
        <div class="compare-foot">
          {mode === 'slider' && <input type="range" min={0} max={100} step={0.5} value={slider} aria-label={t('Where the second image begins')} onInput={(event) => setSlider(Number(event.currentTarget.value))} />}
          {mode === 'blink' && (
            <>
              <button type="button" class="button small" onClick={() => setBlinking(!isBlinking)}>{isBlinking ? t('Stop blinking') : t('Blink')}</button>
              <button type="button" class="button small" onClick={() => setSecond(!isSecond)}>{isSecond ? t('Show the first') : t('Show the second')}</button>
            </>
          )}
        </div>
      )}
    </div>
  );
}
