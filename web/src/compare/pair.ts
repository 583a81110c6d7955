// Two sources seen by one camera: which images are asked for and shown.
import { batch, signal, type Signal } from '@preact/signals';
import { findingsOf, Problem, sentence, type Options } from '../api.ts';
import { FrameLoop } from '../frames/loop.ts';
import { takeWireTime } from '../frames/timing.ts';
import { orbitOf, type LookAt, type Orbit } from '../maths/camera.ts';
import { formatVec } from '../maths/vec.ts';
import { cameraOptions, sizeOptions, type StageSize } from '../scene/picture_options.ts';
import { decodeFrame, newSession, type Frame } from '../scene/frame.ts';
import type { Opened } from './source.ts';

export type Mode = 'side' | 'slider' | 'blink' | 'difference';
export const modes: readonly Mode[] = ['side', 'slider', 'blink', 'difference'];

export interface SideImage {
  bitmap: ImageBitmap;
  moving: boolean;
  count: number;
  view: string; // what it was asked for with: equal where both show one view
}

export class Side {
  readonly opened = signal<Opened | null>(null);
  readonly image = signal<SideImage | null>(null);
  readonly problem = signal('');
  readonly busy = signal(false); // a newer image at rest is on its way
  private readonly loop: FrameLoop<Frame & { view: string }>;
  private readonly session = newSession();
  private shown: ImageBitmap | null = null;
  private count = 0;

  constructor(options: () => Options, private readonly view: () => string) {
    this.loop = new FrameLoop<Frame & { view: string }>({
      ask: async ({ seq, pace }, abort) => {
        const view = this.view();
        const asked: Options = { ...options(), session: this.session, seq };
        if (pace) Object.assign(asked, { scale: pace.scale, aa: 1, error: 1, format: pace.format, quality: pace.quality });
        else asked['format'] = 'png';
        const response = await this.opened.peek()?.ask(asked, abort);
        if (!response) return undefined;
        return { picture: { ...(await decodeFrame(response, asked)), view }, serverTiming: response.headers.get('Server-Timing'), wire: takeWireTime(response.url) };
      },
      show: ({ picture, moving }) => this.show(picture.bitmap, moving, picture.view),
      discard: (frame) => frame.bitmap.close(),
      failed: (fault) => {
        if (fault instanceof Problem && fault.busy) return Math.max(0.3, fault.retryAfterS ?? 1) * 1000;
        batch(() => {
          this.busy.value = false;
          this.problem.value = findingsOf(fault).map((one) => sentence(one)).join(' ');
        });
        return null;
      },
      now: () => performance.now(),
    });
  }

  private show(bitmap: ImageBitmap, moving: boolean, view: string): void {
    const before = this.shown;
    this.shown = bitmap;
    batch(() => {
      this.problem.value = '';
      if (!moving) this.busy.value = false;
      this.image.value = { bitmap, moving, view, count: ++this.count };
    });
    before?.close();
  }

  take(opened: Opened | null): void {
    this.loop.restart();
    batch(() => {
      this.busy.value = false;
      this.opened.value = opened;
      this.problem.value = '';
      this.image.value = opened?.image ? { bitmap: opened.image.bitmap, moving: false, view: '', count: ++this.count } : null;
    });
    this.shown?.close();
    this.shown = null;
  }

  moved(): void {
    if (!this.opened.peek()?.facts) return;
    this.busy.value = true;
    this.loop.move();
  }

  settle(): void {
    if (!this.opened.peek()?.facts) return;
    this.busy.value = true;
    this.loop.settle();
  }

  close(): void {
    this.loop.stop();
    this.shown?.close();
    this.shown = null;
  }
}

/** Own cameras: each scene by its own, so that a difference of the cameras shows, too. */
export type Cameras = 'same' | 'own';

export class Pair {
  readonly first: Side;
  readonly second: Side;
  readonly orbit = signal<Orbit | null>(null);
  readonly time = signal(0);
  readonly cameras: Signal<Cameras> = signal('same');
  size: () => StageSize = () => ({ width: 512, height: 512, ratio: 1 });

  constructor() {
    this.first = new Side(() => this.options(this.first), () => this.view);
    this.second = new Side(() => this.options(this.second), () => this.view);
  }

  /** The camera both begin with: that of the first scene. */
  get home(): LookAt | null {
    return this.first.opened.peek()?.facts?.camera ?? this.second.opened.peek()?.facts?.camera ?? null;
  }

  get busy(): boolean {
    return this.first.busy.value || this.second.busy.value;
  }

  private get view(): string {
    const { width, height, ratio } = this.size();
    return JSON.stringify([width, height, ratio, this.orbit.peek(), this.time.peek(), this.cameras.peek()]);
  }

  /** Both images of one view; null while one of them is still of another. An image file has the one view that it has. */
  get both(): { first: SideImage; second: SideImage } | null {
    const first = this.first.image.value, second = this.second.image.value;
    if (!first || !second) return null;
    return first.view === second.view || first.view === '' || second.view === '' ? { first, second } : null;
  }

  /** An image gives the size; else it is that of its place on the page. */
  private get imageSize(): { width: number; height: number } | null {
    const image = this.first.opened.peek()?.image ?? this.second.opened.peek()?.image;
    return image ? { width: image.bitmap.width, height: image.bitmap.height } : null;
  }

  private options(side: Side): Options {
    const facts = side.opened.peek()?.facts ?? null, image = this.imageSize, own = facts?.camera ?? null;
    const home = this.cameras.peek() === 'same' && !image ? this.home : own;
    const size = image && image.width <= 4096 && image.height <= 4096 ? { ...image } : sizeOptions(this.size(), home, facts);
    const out: Options = { missing: 'placeholder', ...size };
    if (this.time.peek() > 0) out['time'] = Number(this.time.peek().toFixed(3));
    const orbit = this.orbit.peek();
    if (orbit) return { ...out, ...(home ? { fov: home.fov, ...pick(out, 'fov') } : {}), ...cameraOptions(null, orbit, home) };
    if (!home || home === own) return out;
    return { ...out, eye: formatVec(home.eye, 9), target: formatVec(home.target, 9), up: formatVec(home.up, 9), fov: home.fov, ...pick(out, 'fov') };
  }

  changeOrbit(change: (orbit: Orbit) => Orbit): void {
    const from = this.orbit.peek() ?? (this.home && orbitOf(this.home));
    if (!from) return;
    this.orbit.value = change(from);
    this.first.moved();
    this.second.moved();
  }

  settle(): void {
    this.first.settle();
    this.second.settle();
  }

  close(): void {
    this.first.close();
    this.second.close();
  }
}

const pick = (options: Options, name: string): Options => (options[name] === undefined ? {} : { [name]: options[name] });
