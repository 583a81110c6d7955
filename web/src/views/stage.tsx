// The picture, and what lies over it.
import { useEffect, useRef } from 'preact/hooks';
import { listen, type Actions } from '../input.ts';
import type { Viewer } from '../scene/viewer.ts';
import { announce } from './focus.ts';
import { HudView } from './hud.tsx';
import { lazyView } from './lazy.tsx';
import { viewWords } from './steps.ts';
import { t } from '../words.ts';

const LightNote = lazyView(() => import('./light_note.tsx').then((module) => module.LightNote));

export const focusStage = (): void => document.querySelector<HTMLElement>('.stage')?.focus({ preventScroll: true });

/** `preview`: the address of a small image of the scene, for as long as there is no other. */
export function Stage({ viewer, actions, preview }: { viewer: Viewer; actions: Actions; preview: string }) {
  const stage = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const box = stage.current as HTMLDivElement, surface = canvas.current as HTMLCanvasElement;
    const context = surface.getContext('2d', { alpha: false });
    viewer.canvas = {
      draw(bitmap, seq) {
        if (surface.width !== bitmap.width || surface.height !== bitmap.height) {
          surface.width = bitmap.width;
          surface.height = bitmap.height;
        }
        context?.drawImage(bitmap, 0, 0);
        surface.dataset['seq'] = String(seq);
      },
      size: () => ({ width: box.clientWidth, height: box.clientHeight, ratio: window.devicePixelRatio || 1 }),
    };
    const stop = listen(box, viewer, actions);
    // Whoever opens a scene can use its keys at once, unless something else was chosen meanwhile.
    if (document.activeElement === document.body) focusStage();
    const observer = new ResizeObserver(() => viewer.resized());
    observer.observe(box);
    return () => {
      stop();
      observer.disconnect();
      viewer.canvas = null;
    };
  }, [viewer]);
  // Who moves by keys may not see where to.
  const byKeys = useRef(false);
  useEffect(() => {
    if (byKeys.current) announce(viewWords(viewer));
    byKeys.current = false;
  }, [viewer.still.value]);
  const title = viewer.title.value;
  return (
    <div class="stage" ref={stage} tabIndex={0} role="application" onKeyDown={(event) => (byKeys.current ||= event.target === stage.current && event.key !== 'Tab')} aria-label={t('{title}. Drag or arrow keys orbit, right drag or two fingers pan, wheel or plus and minus zoom, W A S D move the focus, R resets, Space plays', { title })} aria-busy={viewer.state.value === 'loading'} data-rest={String(viewer.atRest.value)}>
      <canvas ref={canvas} role="img" aria-label={t('Image of {title}', { title })} class={viewer.pictured.value ? '' : 'blank'} width={16} height={9} />
      {preview && !viewer.pictured.value && <img class="preview" alt="" src={preview} onError={(event) => event.currentTarget.remove()} />}
      <HudView viewer={viewer} />
      {viewer.lightMode.value && <LightNote viewer={viewer} />}
    </div>
  );
}
