// How small the frames of a movement are: as large as can be drawn in time.
import { Line, type Transfer } from './line.ts';
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
  readonly line = new Line();
  private frame = { bytes: 0, serverMs: 0 }; // of the last small frame
  private step = 2;
  private recent: Latency[] = [];
  private roundTrip = Number.POSITIVE_INFINITY;
  private patience = window;

  get pace(): Pace {
    const measured = this.line.isKnown, fastest = Number.isFinite(this.roundTrip) ? this.roundTrip : 0;
    const far = measured ? this.line.roundTripMs : fastest, isLong = far > 60 || this.line.isSlow;
    return {
      scale: ladder[this.step] as number,
      // WebP takes the server longer and the wire shorter.
      format: isLong ? 'webp' : 'jpeg',
      quality: isLong ? 60 : 80,
      inFlight: measured ? this.line.requestsFor(this.frame.bytes, this.frame.serverMs) : Math.min(4, 2 + Math.floor(far / 50)),
    };
  }

  /** An answer arrived, of a movement or not. */
  measure(transfer: Transfer, latency: Latency, moving: boolean): void {
    const serverMs = latency.queue + latency.prepare + latency.draw + latency.encode;
    this.line.add(transfer, serverMs);
    if (moving) this.frame = { bytes: transfer.bytes, serverMs };
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
