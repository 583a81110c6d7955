// Mouse, touch, wheel and keyboard on the picture, turned into changes of the view.
import { panOrbit, slideOrbit, stepWalk, turnOrbit, turnWalk, zoomOrbit } from './maths/camera.ts';
import { clamp } from './maths/vec.ts';
import type { Viewer } from './scene/viewer.ts';

const turnStep = 5; // degrees a press
const slideStep = 0.06; // of the distance

export interface Actions {
  /** A press without a drag, in pixels of the stage. */
  pick(x: number, y: number): void;
  light(alpha: number, beta: number): void;
}

/** What a key does, or undefined when it means nothing here. */
export function keyAction(key: string, viewer: Viewer, actions: Actions): (() => void) | undefined {
  const k = key.length === 1 ? key.toLowerCase() : key;
  const common: Record<string, () => void> = {
    r: () => viewer.reset(),
    ' ': () => viewer.clock.toggle(),
    l: () => (viewer.lightMode.value = !viewer.lightMode.value),
    o: () => viewer.setQuality(viewer.quality.value === 'fast' ? 'standard' : 'fast'),
    p: () => viewer.setQuality(viewer.quality.value === 'reference' ? 'standard' : 'reference'),
    m: () => viewer.toggleWalk(),
    t: () => viewer.toggleTurntable(),
    1: () => (viewer.tool.value = 'select'), 2: () => (viewer.tool.value = 'move'), 3: () => (viewer.tool.value = 'turn'), 4: () => (viewer.tool.value = 'scale'),
    5: () => (viewer.tool.value = 'measure'),
    Escape: () => (viewer.selected.value = null),
    ',': () => viewer.stepTime(-1),
    '.': () => viewer.stepTime(1),
    b: () => viewer.toKey(-1),
    n: () => viewer.toKey(1),
  };
  const light: Record<string, () => void> = {
    a: () => actions.light(0, turnStep), z: () => actions.light(0, -turnStep),
    x: () => actions.light(turnStep, 0), c: () => actions.light(-turnStep, 0),
  };
  const turn = (azimuth: number, elevation: number) => () => viewer.changeOrbit((one) => turnOrbit(one, azimuth, elevation));
  const slide = (forward: number, right: number) => () => viewer.changeOrbit((one) => slideOrbit(one, forward * slideStep, right * slideStep));
  const zoom = (factor: number) => () => viewer.changeOrbit((one) => zoomOrbit(one, factor));
  const orbit: Record<string, () => void> = {
    ArrowLeft: turn(-turnStep, 0), ArrowRight: turn(turnStep, 0), ArrowUp: turn(0, turnStep), ArrowDown: turn(0, -turnStep),
    w: slide(1, 0), s: slide(-1, 0), a: slide(0, -1), d: slide(0, 1),
    '+': zoom(0.9), '=': zoom(0.9), '-': zoom(1 / 0.9), _: zoom(1 / 0.9),
  };
  const look = (left: number, up: number) => () => viewer.changeWalk((one) => turnWalk(one, left, up));
  const step = (forward: number, right: number) => () =>
    viewer.changeWalk((one) => stepWalk(one, forward * viewer.stride, right * viewer.stride));
  // As in the engines of 2017: the up arrow turns down.
  const walk: Record<string, () => void> = {
    ArrowLeft: look(turnStep, 0), ArrowRight: look(-turnStep, 0), ArrowUp: look(0, -turnStep), ArrowDown: look(0, turnStep),
    w: step(1, 0), s: step(-1, 0), a: step(0, -1), d: step(0, 1),
    '+': step(3, 0), '=': step(3, 0), '-': step(-3, 0),
  };
  const layers = [viewer.lightMode.value ? light : {}, viewer.walk.value ? walk : orbit, common];
  return layers.map((layer) => layer[k]).find((action) => action !== undefined);
}

interface Finger {
  x: number;
  y: number;
}

/** Listens on the stage; returns how to stop. */
export function listen(stage: HTMLElement, viewer: Viewer, actions: Actions): () => void {
  const fingers = new Map<number, Finger>();
  let travelled = 0, most = 0, pan = false;
  const abort = new AbortController();
  const on = <K extends keyof HTMLElementEventMap>(name: K, handle: (event: HTMLElementEventMap[K]) => void, passive = true): void =>
    stage.addEventListener(name, handle, { signal: abort.signal, passive });
  const height = (): number => Math.max(200, stage.clientHeight);

  on('pointerdown', (event) => {
    if ((event.target as Element).closest('button, a, input, select, dialog, details')) return;
    stage.setPointerCapture(event.pointerId);
    if (fingers.size === 0) [travelled, most, pan] = [0, 0, event.button === 1 || event.button === 2 || event.shiftKey];
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    most = Math.max(most, fingers.size);
    stage.dataset['dragging'] = pan ? 'pan' : 'orbit';
    stage.focus({ preventScroll: true });
  });
  on('pointermove', (event) => {
    const last = fingers.get(event.pointerId);
    if (!last) return;
    const before = [...fingers.values()].map((one) => ({ ...one }));
    const dx = event.clientX - last.x, dy = event.clientY - last.y;
    travelled += Math.abs(dx) + Math.abs(dy);
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (travelled < 3) return; // a press with a trembling hand is not a drag
    const [a, b] = [...fingers.values()];
    // In light mode a finger turns the light: a phone has no keys.
    if (viewer.lightMode.value && event.pointerType === 'touch' && !b) return actions.light((dx * 90) / height(), (-dy * 90) / height());
    if (a && b) {
      const [c, d] = before as [Finger, Finger];
      const grown = Math.hypot(a.x - b.x, a.y - b.y) / Math.max(1, Math.hypot(c.x - d.x, c.y - d.y));
      const mx = (a.x + b.x - c.x - d.x) / 2, my = (a.y + b.y - c.y - d.y) / 2;
      if (viewer.walk.value) viewer.changeWalk((one) => stepWalk(one, Math.log(grown) * viewer.stride * 20, -mx * viewer.stride * 0.1));
      else viewer.changeOrbit((one) => zoomOrbit(panOrbit(one, mx, my, viewer.fov, height()), 1 / clamp(grown, 0.5, 2)));
    } else if (viewer.walk.value) viewer.changeWalk((one) => turnWalk(one, (dx * 120) / height(), (dy * 120) / height()));
    else if (pan) viewer.changeOrbit((one) => panOrbit(one, dx, dy, viewer.fov, height()));
    else viewer.changeOrbit((one) => turnOrbit(one, (-dx * 180) / height(), (dy * 180) / height()));
  });
  const up = (event: PointerEvent): void => {
    if (!fingers.delete(event.pointerId)) return;
    if (fingers.size > 0) return;
    delete stage.dataset['dragging'];
    if (event.type === 'pointerup' && travelled < 3 && most === 1 && event.button === 0) {
      const box = stage.getBoundingClientRect();
      actions.pick(event.clientX - box.left, event.clientY - box.top);
    }
  };
  on('pointerup', up);
  on('pointercancel', up);
  on('contextmenu', (event) => event.preventDefault(), false);
  on('wheel', (event) => {
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1);
    // A pinch on a touchpad comes as a wheel with ctrl, in much smaller steps.
    const factor = Math.exp(clamp(pixels * (event.ctrlKey ? 6 : 1), -240, 240) * 0.0015);
    if (viewer.walk.value) viewer.changeWalk((one) => stepWalk(one, -Math.log(factor) * 10 * viewer.stride, 0));
    else viewer.changeOrbit((one) => zoomOrbit(one, factor));
  }, false);
  on('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target !== stage) return;
    const action = keyAction(event.key, viewer, actions);
    if (!action) return;
    event.preventDefault();
    action();
  }, false);
  return () => abort.abort();
}
