// Which picture is asked for when, and which is shown: the newest wins, always.
import { Adaptation, type Pace } from './adapt.ts';
import type { Line } from './line.ts';
import { splitLatency, type Latency, type WireTime } from './timing.ts';

export interface Ask {
  seq: number;
  pace: Pace | null; // null: the full picture
}

/** What came back. `undefined` is a frame the server dropped for a newer one. */
export interface Answer<Picture> {
  picture: Picture;
  serverTiming: string | null;
  wire?: WireTime | null; // how it came, where that is known
}

export interface Shown<Picture> {
  picture: Picture;
  seq: number;
  moving: boolean;
  latency: Latency;
}

export interface LoopHooks<Picture> {
  /** Asks the server; throws what `failed` understands, AbortError when the signal says so. */
  ask(ask: Ask, signal: AbortSignal): Promise<Answer<Picture> | undefined>;
  show(shown: Shown<Picture>): void;
  /** A newer frame was shown before this one arrived. */
  discard(picture: Picture): void;
  /** Returns after how many ms to ask again, or null to leave it. */
  failed(fault: unknown): number | null;
  now(): number;
  /** Whether the full picture waits for the first small one, which shows how it is best sent. */
  waitsForLine?: boolean;
  /** The full picture of the last change is on show and nothing is on its way or due; or no longer so. */
  rested?(isAtRest: boolean): void;
}

/** After the last input, until the full picture is asked for. */
export const restDelayMs = 140;

export class FrameLoop<Picture> {
  private readonly adaptation = new Adaptation();
  private seq = 0;
  private shownSeq = 0;
  private generation = 0; // of the scene: what an older one answers is void
  private moving = 0; // requests under way
  private rest: AbortController | null = null;
  private wantsFrame = false;
  private wantsRest = false;
  private restWaits = false; // for an answer that shows the line
  private restTimer: ReturnType<typeof setTimeout> | undefined;
  private retryTimer: ReturnType<typeof setTimeout> | undefined;
  private held = false; // while something plays there is no rest
  private isFullShown = false;
  private wasAtRest = false;

  constructor(private readonly hooks: LoopHooks<Picture>) {}

  get pace(): Pace {
    return this.adaptation.pace;
  }

  get line(): Line {
    return this.adaptation.line;
  }

  get idle(): boolean {
    return this.moving === 0 && !this.rest && !this.wantsFrame && !this.wantsRest;
  }

  private tellRest(): void {
    const isDue = this.restTimer !== undefined || this.retryTimer !== undefined || this.restWaits;
    const isAtRest = this.isFullShown && this.idle && !isDue && !this.held;
    if (isAtRest !== this.wasAtRest) this.hooks.rested?.(isAtRest);
    this.wasAtRest = isAtRest;
  }

  /** Something moved: a small frame soon, the full picture when it has come to rest. */
  move(): void {
    this.wantsFrame = true;
    this.wantsRest = false;
    this.rest?.abort();
    this.rest = null;
    this.isFullShown = false;
    this.planRest(!this.held);
    this.pump();
    this.tellRest();
  }

  /** Whether the full picture is due a while from now. What failed before is not asked for any more. */
  private planRest(isDue: boolean): void {
    this.retryAfter(null);
    clearTimeout(this.restTimer);
    this.restTimer = isDue ? setTimeout(() => this.rested(), restDelayMs) : undefined;
    this.restWaits = false;
  }

  private rested(): void {
    this.restTimer = undefined;
    if (this.hooks.waitsForLine && !this.line.isKnown && this.moving > 0) this.restWaits = true;
    else this.settle();
  }

  /** The full picture, now. */
  settle(): void {
    this.planRest(false);
    this.wantsFrame = false;
    this.wantsRest = true;
    this.rest?.abort();
    this.rest = null;
    this.isFullShown = false;
    this.pump();
    this.tellRest();
  }

  /** While held (playing), movements are not followed by a full picture. */
  hold(held: boolean): void {
    this.held = held;
    if (held) this.planRest(false);
    this.tellRest();
  }

  /** Another scene: nothing that is under way may be shown. */
  restart(): void {
    this.stop();
    this.generation += 1;
    this.shownSeq = this.seq;
  }

  stop(): void {
    this.planRest(false);
    this.wantsFrame = this.wantsRest = this.isFullShown = false;
    this.rest?.abort();
    this.rest = null;
    this.generation += 1;
    this.moving = 0;
    this.tellRest();
  }

  private retryAfter(ms: number | null): void {
    clearTimeout(this.retryTimer);
    this.retryTimer = ms === null ? undefined : setTimeout(() => {
      this.retryTimer = undefined;
      this.settle();
    }, ms);
  }

  private pump(): void {
    if (this.wantsRest) {
      this.wantsRest = false;
      this.rest = new AbortController();
      void this.request(null, this.rest);
    } else if (this.wantsFrame && this.moving < this.adaptation.pace.inFlight) {
      this.wantsFrame = false;
      void this.request(this.adaptation.pace, new AbortController());
    }
  }

  private async request(pace: Pace | null, controller: AbortController): Promise<void> {
    const seq = ++this.seq, generation = this.generation;
    const start = this.hooks.now();
    if (pace) this.moving += 1;
    try {
      const answer = await this.hooks.ask({ seq, pace }, controller.signal);
      if (answer) {
        const latency = splitLatency(this.hooks.now() - start, answer.serverTiming, answer.wire?.wireMs);
        if (answer.wire) this.adaptation.measure(answer.wire, latency, pace !== null);
        if (generation !== this.generation || seq <= this.shownSeq) this.hooks.discard(answer.picture);
        else {
          this.shownSeq = seq;
          this.isFullShown = pace === null;
          if (pace) this.adaptation.add(latency);
          this.hooks.show({ picture: answer.picture, seq, moving: pace !== null, latency });
        }
      }
    } catch (fault) {
      if (generation === this.generation && !controller.signal.aborted) {
        this.retryAfter(this.hooks.failed(fault));
      }
    } finally {
      if (generation === this.generation) {
        if (pace) this.moving -= 1;
        if (this.rest === controller) this.rest = null;
        if (this.restWaits && this.moving === 0) this.settle();
        this.pump();
        this.tellRest();
      }
    }
  }
}
