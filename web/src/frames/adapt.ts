// How small the frames of a movement are: as large as can be drawn in time.
import { median, type Latency } from './timing.ts';

export interface Pace {
  scale: number; // of the full picture's width and height
  format: 'jpeg' | 'webp';
  quality: number;
  inFlight: number; // requests under way at once
}

/** Never the full size: a frame of a movement stays cheaper than the picture at rest. */
const ladder = [0.75, 0.6, 0.5, 0.4, 0.32, 0.25] as const;
const slowMs = 38; // work and transfer of one frame for 25 frames a second, with a margin
const fastMs = 18;
const window = 4;

/**
 * Steps down when the frames of a step are slow by their median, up when they are fast with room
 * for the larger one. The round trip itself is not the frames' fault: it is taken from the fastest
 * frames, and met by more requests under way.
 */
export class Adaptation {
  private step = 2;
  private recent: Latency[] = [];
  private roundTrip = Number.POSITIVE_INFINITY;
  private patience = window;

  get pace(): Pace {
    const far = Number.isFinite(this.roundTrip) ? this.roundTrip : 0;
    return {
      scale: ladder[this.step] as number,
      // WebP takes the server longer and the wire shorter.
      format: far > 60 ? 'webp' : 'jpeg',
      quality: far > 60 ? 60 : 80,
      inFlight: Math.min(4, 2 + Math.floor(far / 50)),
    };
  }

  /** A frame of a movement arrived. */
  add(latency: Latency): void {
    this.roundTrip = Math.min(latency.network, this.roundTrip * 1.02);
    this.recent.push(latency);
    if (this.recent.length < this.patience) return;
    const work = median(this.recent.map((one) => one.total - this.roundTrip));
    this.recent = [];
    this.patience = window;
    if (work > slowMs && this.step < ladder.length - 1) this.step += work > 2 * slowMs ? 2 : 1;
    else if (work < fastMs && this.step > 0) {
      this.step -= 1;
      this.patience = 3 * window; // a step up is held for a while: no flicker between two sizes
    }
    this.step = Math.min(this.step, ladder.length - 1);
  }
}
