// The time of an animated scene.
import type { Viewer } from '../scene/viewer.ts';
import { Tool } from './ui.tsx';

const speeds = [0.1, 0.25, 0.5, 1, 2, 4, 8];

export function TimeBar({ viewer }: { viewer: Viewer }) {
  const { clock } = viewer;
  if (!clock.animated.value) return null;
  const from = clock.from.value, to = from + clock.lap.value;
  const seek = (seconds: number): void => {
    clock.seek(seconds);
    viewer.moved();
  };
  return (
    <div class="time-bar" role="group" aria-label="Animation">
      <Tool icon={clock.playing.value ? 'pause' : 'play'} label={clock.playing.value ? 'Pause' : 'Play'} keys="Space" onClick={() => clock.toggle()} />
      <input type="range" aria-label="Time in seconds" min={from} max={to} step={0.01} value={clock.time.value}
        onInput={(event) => seek(Number(event.currentTarget.value))} />
      <output>{clock.time.value.toFixed(1)} s</output>
      <label class="speed">
        <span class="hidden">Speed</span>
        <select value={String(clock.speed.value)} onChange={(event) => (clock.speed.value = Number(event.currentTarget.value))}>
          {speeds.map((speed) => <option key={speed} value={String(speed)} selected={speed === clock.speed.value}>{speed}×</option>)}
        </select>
      </label>
    </div>
  );
}
