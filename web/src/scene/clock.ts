// The time of an animation: one lap of a range, played at a speed.
import { signal } from '@preact/signals';

/** A step of one frame. */
export const frameSeconds = 1 / 25;

export class SceneClock {
  readonly time = signal(0);
  readonly playing = signal(false);
  readonly speed = signal(1);
  readonly animated = signal(false);
  readonly from = signal(0);
  readonly lap = signal(60);
  private last = 0;

  /** `moved` is told of every step, `stopped` when playing ends. */
  constructor(private readonly moved: () => void, private readonly stopped: () => void) {}

  range(animated: boolean, from: number, lap: number): void {
    this.animated.value = animated;
    this.from.value = from;
    this.lap.value = lap > 0 ? lap : 60;
  }

  seek(seconds: number): void {
    this.time.value = Math.max(0, seconds);
  }

  /** Within the lap. */
  step(seconds: number): void {
    this.seek(lapTime(this.time.value + seconds, this.from.value, this.lap.value));
  }

  toggle(): void {
    if (this.playing.value) this.stop();
    else if (this.animated.value) {
      this.playing.value = true;
      this.last = performance.now();
      requestAnimationFrame(this.tick);
    }
  }

  stop(): void {
    if (!this.playing.value) return;
    this.playing.value = false;
    this.stopped();
  }

  private readonly tick = (now: number): void => {
    if (!this.playing.value) return;
    // After a pause of the page the animation goes on, it does not jump.
    const passed = Math.min(0.25, Math.max(0, (now - this.last) / 1000));
    this.last = now;
    this.time.value = lapTime(this.time.value + passed * this.speed.value, this.from.value, this.lap.value);
    this.moved();
    requestAnimationFrame(this.tick);
  };
}

/** The time within the lap that begins at `from`. */
export function lapTime(time: number, from: number, lap: number): number {
  return from + ((((time - from) % lap) + lap) % lap);
}
