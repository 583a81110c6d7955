// The state of one scene on show, and what changes it. Views read the signals; every change of
// the view asks the frame loop for pictures.
import { batch, computed, signal } from '@preact/signals';
import {
  findingsOf, findingsOfFacts, getScene, Problem, validate, type Finding, type ModelPlaces, type Options, type SceneFacts,
} from '../api.ts';
import { FrameLoop, type Shown } from '../frames/loop.ts';
import { FrameRate, takeWireTime, type Latency } from '../frames/timing.ts';
import { orbitOf, walkOf, walkTarget, type LookAt, type Orbit, type Walk } from '../maths/camera.ts';
import { formatView, replaceAddress, scenePlace, type ViewLink } from '../router.ts';
import type { Loose } from './bundle.ts';
import { frameSeconds, SceneClock } from './clock.ts';
import type { Draft } from './drafts.ts';
import { EditedScene, type Editing } from './edited_scene.ts';
import type { Key } from './motion.ts';
import { missingOf, type FileChanges } from './scene_files.ts';
import { retryAfterS, sceneFaultOf, stateOf, wholeFindings, type Fault } from './state.ts';
import { cameraOptions, qualityOptions, sizeOptions, type Quality, type StageSize } from './picture_options.ts';
import { bodyOf, decodeFrame, fetchPicture, newSession, type Frame, type Origin } from './frame.ts';
import { titleIn, titleOf } from './title.ts';
import { t } from '../words.ts';

export interface Hud {
  width: number;
  height: number;
  bytes: number;
  moving: boolean;
  fps: number;
  latency: Latency;
  stats: Frame['stats'];
}

/** `select`: without handles. */
export type SceneTool = 'select' | 'move' | 'turn' | 'scale' | 'measure';

const hudEveryMs = 200;

export type Canvas = { draw(bitmap: ImageBitmap, seq: number): void; size(): StageSize };

export class Viewer extends EditedScene {
  readonly facts = signal<SceneFacts | null>(null);
  readonly options = signal<Record<string, string>>({});
  readonly quality = signal<Quality>('standard');
  readonly lightMode = signal(false);
  readonly turning = signal(false);
  readonly findings = signal<Finding[]>([]);
  readonly hud = signal<Hud | null>(null);
  readonly still = signal<Blob | null>(null); // the last full picture
  readonly pictured = signal(false);
  readonly fault = signal<Fault | null>(null); // of the last request; null: it gave a picture
  readonly state = computed(() => stateOf(this.fault.value, this.pictured.value, this.findings.value));
  /** The image on show is the full one of the scene and the view as they are now. */
  readonly atRest = computed(() => this.loopRests.value && !this.redrawIsDue.value);
  readonly frame = signal<{ camera: LookAt | null; moving: boolean } | null>(null); // of the image on show
  readonly tool = signal<SceneTool>('move'); // what the image is handled with
  readonly reveal = signal<{ line: number; column: number } | null>(null); // a place the editor goes to
  readonly title = computed(() => {
    const facts = this.facts.value, isUnread = facts?.valid === false;
    if (this.id === null) return facts?.title || titleIn(this.original.value ?? '') || (this.loose?.main ?? t('Your scene'));
    if (facts === null) return this.id.startsWith('~') ? t('Scene') : titleOf(this.id, '', null);
    return titleOf(this.id, facts.title, isUnread ? this.original.value : null);
  });
  readonly missing = computed(() => missingOf(this.findings.value)); // files that the document names
  readonly keys = signal<readonly Key[]>([]); // of its animation
  readonly clock: SceneClock;
  places: ModelPlaces | null = null; // of the stored document
  home: LookAt | null = null;
  canvas: Canvas | null = null;

  private readonly loopRests = signal(false);
  private readonly redrawIsDue = signal(false); // in a while, after typing
  private readonly session = newSession();
  private readonly rate = new FrameRate();
  private readonly loop: FrameLoop<Frame>;
  private linkTimer: ReturnType<typeof setTimeout> | undefined;
  private typeTimer: ReturnType<typeof setTimeout> | undefined;
  private latest: Frame | null = null;
  private toldAt = 0; // when the overlay was last told
  private asked = ''; // the size of the last picture that was asked for
  private closed = false;
  private stored: SceneFacts | null = null; // of the scene without edits
  private busyNotice = '';
  private attempts = 0; // at a server that does not answer
  private openTimer: ReturnType<typeof setTimeout> | undefined;
  private known: { text: string; files: FileChanges; facts: (SceneFacts & Partial<ModelPlaces>) | null; findings: readonly Finding[] } | null = null; // of the edited document

  constructor(id: string | null, loose: Loose | null = null, { isRemembered = true } = {}) {
    super(id, loose, isRemembered);
    this.clock = new SceneClock(() => this.moved(), () => {
      this.loop.hold(this.turning.value);
      this.loop.settle();
      this.keepLink();
    });
    this.loop = new FrameLoop<Frame>({
      ask: async ({ seq, pace }, signal) => {
        const options = this.pictureOptions();
        this.asked = `${options['width']} ${options['height']}`;
        if (pace) Object.assign(options, { scale: pace.scale, aa: 1, error: 1, format: pace.format, quality: pace.quality });
        else Object.assign(options, this.restForm());
        const response = await fetchPicture(this.origin(), { ...options, session: this.session, seq, superseded: 'empty' }, signal);
        if (!response) return undefined;
        const picture = await decodeFrame(response, options);
        return { picture, serverTiming: response.headers.get('Server-Timing'), wire: takeWireTime(response.url) };
      },
      show: (shown) => this.show(shown),
      discard: (frame) => frame.bitmap.close(),
      failed: (fault) => this.failed(fault),
      now: () => performance.now(),
      waitsForLine: true,
      rested: (isAtRest) => (this.loopRests.value = isAtRest),
    });
  }

  /** Reads the facts, restores edits and view, and asks for the first picture. */
  async open(link: ViewLink, template: string): Promise<void> {
    const draft = this.beginDraft();
    batch(() => {
      this.orbit.value = link.orbit;
      this.walk.value = link.walk;
      this.options.value = link.options;
      this.clock.seek(link.time ?? 0);
    });
    if (this.id === null) this.takeText(template);
    await this.begin(draft);
  }

  /** Reads the facts of a stored scene, and asks for the first picture. */
  private async begin(draft: Draft | null): Promise<void> {
    try {
      if (this.id !== null) await this.readFacts(this.id);
      await this.restore(draft);
    } catch (thrown) {
      if (this.closed) return;
      const fault = sceneFaultOf(thrown);
      batch(() => {
        this.fault.value = fault;
        this.findings.value = [...fault.findings];
      });
      if (fault.kind === 'offline') this.openTimer = setTimeout(() => void this.begin(draft), 1000 * retryAfterS(this.attempts++));
      return;
    }
    // The page takes its shape by what is known now; then a quick picture, and the full one.
    await new Promise((done) => setTimeout(done, 0));
    if (!this.closed) this.loop.move();
  }

  private async readFacts(id: string): Promise<void> {
    const facts = await getScene(id);
    if (this.closed) return;
    this.stored = facts;
    this.showFacts(facts);
    this.findings.value = findingsOfFacts(facts);
    if (!facts.valid) await this.loadText();
  }

  /** Findings come in the reader's language: they are asked for anew. */
  async languageChanged(): Promise<void> {
    this.known = null;
    if (this.id !== null && this.stored) await this.readFacts(this.id);
    this.loop.settle();
  }

  close(): void {
    this.closed = true;
    this.clock.stop();
    this.loop.stop();
    clearTimeout(this.linkTimer);
    clearTimeout(this.typeTimer);
    clearTimeout(this.openTimer);
    this.flushDraft();
  }

  protected redraw(how: Editing): void {
    clearTimeout(this.typeTimer);
    this.keepLink();
    this.redrawIsDue.value = how !== 'dragging';
    if (how === 'dragging') this.loop.move();
    else this.typeTimer = setTimeout(() => batch(() => {
      this.redrawIsDue.value = false;
      this.loop.settle();
    }), how === 'typing' ? 220 : 0);
  }

  /** What the service knows of the document as it is edited now; null where it cannot be read. */
  async validated(): Promise<(SceneFacts & Partial<ModelPlaces>) | null> {
    const origin = this.document(), { text, files } = origin;
    if (text === null) return this.facts.value;
    if (this.isKnown(origin)) return this.known?.facts ?? null;
    try {
      const facts = await validate(bodyOf(origin), this.id);
      this.known = { text, files, facts, findings: facts.diagnostics };
      return facts;
    } catch (fault) {
      if (fault instanceof Problem && !fault.busy) this.known = { text, files, facts: null, findings: fault.findings };
      return null;
    }
  }

  private isKnown({ text, files }: Origin): boolean {
    return this.known !== null && this.known.text === text && this.known.files === files;
  }

  /** All that is known to be wrong with the document on show. */
  private documentFindings(): readonly Finding[] {
    const origin = this.document();
    if (origin.text !== null) return this.isKnown(origin) ? (this.known?.findings ?? []) : [];
    return this.facts.value ? findingsOfFacts(this.facts.value) : [];
  }

  /** Where something is hidden, the image's findings are of less than the document. */
  private allFindings({ findings }: Frame): Finding[] {
    const known = this.documentFindings();
    return this.marks.value.hidden.length > 0 ? [...known] : wholeFindings(known, findings);
  }

  /** After an edit: the animation, the camera and the counts may be others. */
  private async refresh(): Promise<void> {
    const origin = this.document();
    if (origin.text === null) {
      if (this.stored && this.facts.value !== this.stored) this.showFacts(this.stored); // an edit was taken back
      return;
    }
    if (this.isKnown(origin)) return;
    const facts = await this.validated();
    if (!this.isKnown(this.document())) return;
    if (this.latest) this.setFindings(this.allFindings(this.latest));
    if (!facts) return;
    const links = this.stored?.links ?? { self: '', source: '', image: '', thumbnail: '' };
    this.showFacts({ ...facts, id: this.id ?? '', links });
  }

  private showFacts(facts: SceneFacts): void {
    batch(() => {
      this.facts.value = facts;
      this.home = facts.camera ?? this.home;
      this.clock.range(facts.animated ?? false, facts.playFrom ?? 0, facts.loopSeconds ?? 60);
    });
  }

  report(fault: unknown): void {
    this.findings.value = findingsOf(fault);
  }

  /** Whether a finding is about the document, not about a file that it includes. */
  isOfDocument(finding: { file?: string }): boolean {
    const name = this.loose?.main ?? `${(this.id ?? 'scene').replace(/^.*\//, '')}.xml`;
    return !finding.file || finding.file === name || (!this.loose && /(^|\/)scene\.xml$/.test(finding.file));
  }

  /** What the full picture is asked with: all but format. */
  pictureOptions(): Options {
    const out: Options = { missing: 'placeholder', ...this.sizeOptions(), ...qualityOptions[this.quality.value], ...this.options.value };
    if (this.clock.time.value > 0) out['time'] = Number(this.clock.time.value.toFixed(3));
    // A scene without a camera is framed: hiding a part of it moves no camera.
    const held = this.marks.value.hidden.length > 0 && this.home ? orbitOf(this.home) : null;
    return { ...out, ...cameraOptions(this.walk.value, this.orbit.value ?? held, this.home) };
  }

  /** On a slow line the image at rest is small to send, unless the most exact one was asked for. */
  private restForm(): Options {
    return this.loop.line.isSlow && this.quality.value !== 'reference' ? { format: 'webp', quality: 85 } : { format: 'png' };
  }

  /** The image on show: asked for anew where it came otherwise. Null: there is none yet. */
  async imageAs(format: 'png' | 'webp'): Promise<Blob | null> {
    const still = this.still.value;
    if (!still || still.type === `image/${format}`) return still;
    const response = await fetchPicture(this.origin(), { ...this.pictureOptions(), format });
    return response ? response.blob() : null;
  }

  /** Of a round trip about the scene, which begins with this view. */
  turntableOptions(): Options {
    const { fov: _fitted, ...kept } = this.pictureOptions();
    return { ...kept, width: 480, height: 360 };
  }

  private sizeOptions(): Options {
    return sizeOptions(this.canvas?.size() ?? { width: 512, height: 512, ratio: 1 }, this.home, this.facts.value);
  }

  get fov(): number {
    return Number(this.sizeOptions()['fov'] ?? this.home?.fov ?? 60);
  }

  private show({ picture, seq, moving, latency }: Shown<Frame>): void {
    this.canvas?.draw(picture.bitmap, seq);
    const now = performance.now();
    if (moving) this.rate.add(now);
    else this.rate.clear();
    this.attempts = 0;
    batch(() => {
      this.pictured.value = true;
      this.fault.value = null;
      // Numbers that change with every frame cannot be read, and cost as much as the frame.
      if (!moving || now - this.toldAt >= hudEveryMs) {
        this.toldAt = now;
        this.hud.value = {
          width: picture.bitmap.width, height: picture.bitmap.height, bytes: picture.blob.size, moving,
          fps: this.rate.rate(now), latency, stats: picture.stats,
        };
      }
      if (!moving) this.still.value = picture.blob;
      this.frame.value = { camera: picture.camera, moving };
      this.setFindings(this.allFindings(picture));
    });
    if (picture.camera && !this.home) this.home = picture.camera;
    this.latest?.bitmap.close();
    this.latest = picture;
    if (moving) return;
    void this.refresh();
    // Sent small because the line seemed slow; it is not: then as it is.
    if (picture.options['format'] !== 'png' && this.restForm()['format'] === 'png') this.loop.settle();
  }

  private failed(fault: unknown): number | null {
    if (fault instanceof Problem && fault.busy) {
      const wait = Math.max(0.3, fault.retryAfterS ?? 1);
      this.notice.value = this.busyNotice = t('The server is busy; trying again in {seconds} s.', { seconds: Math.ceil(wait) });
      return wait * 1000;
    }
    this.clock.stop();
    const kept = sceneFaultOf(fault);
    this.fault.value = kept;
    if (kept.kind === 'offline') return 1000 * retryAfterS(this.attempts++);
    this.setFindings([...kept.findings]);
    return null;
  }

  /** Asks a server that did not answer once more, without waiting. */
  askAgain(): void {
    this.attempts = 0;
    if (this.facts.value === null && this.id !== null) {
      clearTimeout(this.openTimer);
      void this.begin(this.beginDraft());
    } else this.loop.settle();
  }

  private setFindings(found: Finding[]): void {
    if (this.notice.value === this.busyNotice) this.notice.value = '';
    if (JSON.stringify(found) !== JSON.stringify(this.findings.value)) this.findings.value = found;
  }

  /** The stage may have another size than the picture that was asked for. */
  resized(): void {
    const { width, height } = this.sizeOptions();
    if (this.asked !== '' && this.asked !== `${width} ${height}`) this.moved();
  }

  moved(): void {
    this.loop.hold(this.clock.playing.value || this.turning.value);
    this.loop.move();
    this.keepLink();
  }

  settle(): void {
    this.loop.settle();
    this.keepLink();
  }

  /** So many frames on, or back; playing ends. */
  stepTime(frames: number): void {
    if (!this.clock.animated.value) return;
    this.clock.stop();
    this.clock.step(frames * frameSeconds);
    this.moved();
  }

  /** To the next key, or the one before. */
  toKey(direction: 1 | -1): void {
    const now = this.clock.time.value, times = this.keys.value.map(({ time }) => time);
    const key = direction > 0 ? (times.find((time) => time > now + 5e-4) ?? times[0]) : (times.filter((time) => time < now - 5e-4).at(-1) ?? times.at(-1));
    if (key === undefined) return;
    this.clock.stop();
    this.clock.seek(key);
    this.moved();
  }

  changeOrbit(change: (orbit: Orbit) => Orbit): void {
    const from = this.orbit.value ?? (this.home && orbitOf(this.home));
    if (!from) return;
    if (!this.turning.value) this.record('camera');
    this.orbit.value = change(from);
    this.moved();
  }

  changeWalk(change: (walk: Walk) => Walk): void {
    if (!this.walk.value) return;
    this.record('camera');
    this.walk.value = change(this.walk.value);
    this.moved();
  }

  /** Walking begins where the camera is, and orbiting again where the walk ended up looking. */
  toggleWalk(): void {
    const orbit = this.orbit.value ?? (this.home && orbitOf(this.home));
    if (this.walk.value || this.home) this.record('');
    if (this.walk.value) {
      const { eye } = this.walk.value, distance = orbit?.distance ?? 5;
      const ahead = walkTarget(this.walk.value);
      const target = eye.map((x, i) => x + ((ahead[i] as number) - x) * distance) as unknown as Orbit['target'];
      this.orbit.value = orbitOf({ eye, target });
      this.walk.value = null;
    } else if (this.home) {
      this.walk.value = walkOf(this.currentCamera(this.home));
    }
    this.settle();
  }

  currentCamera(home: LookAt): LookAt {
    return this.latest?.camera && !this.latest.options['scale'] ? this.latest.camera : (this.latest?.camera ?? home);
  }

  get stride(): number {
    return (this.home ? orbitOf(this.home).distance : 5) / 25;
  }

  reset(): void {
    if (this.orbit.value || this.walk.value) this.record('');
    this.orbit.value = null;
    this.walk.value = null;
    this.settle();
  }

  setOption(name: string, value: string | null): void {
    const next = { ...this.options.value };
    if (value === null || value === '') delete next[name];
    else next[name] = value;
    this.options.value = next;
    this.settle();
  }

  setQuality(quality: Quality): void {
    this.quality.value = quality;
    this.settle();
  }

  toggleTurntable(): void {
    if (!this.turning.value) this.record('');
    this.turning.value = !this.turning.value;
    this.loop.hold(this.turning.value || this.clock.playing.value);
    if (!this.turning.value) return this.settle();
    let last = performance.now();
    const turn = (now: number): void => {
      if (!this.turning.value) return;
      const degrees = (Math.min(100, now - last) * 360) / 12000;
      last = now;
      this.changeOrbit((orbit) => ({ ...orbit, azimuth: ((orbit.azimuth + degrees + 540) % 360) - 180 }));
      requestAnimationFrame(turn);
    };
    requestAnimationFrame(turn);
  }

  link(): string {
    const view = { orbit: this.orbit.value, walk: this.walk.value, time: this.clock.time.value, options: this.options.value };
    return this.id === null ? '#/new' : scenePlace(this.id, formatView(view));
  }

  private keepLink(): void {
    clearTimeout(this.linkTimer);
    this.linkTimer = setTimeout(() => this.flushLink(), 200);
  }

  /** The address gets the view as it is now, where that was about to happen. */
  flushLink(): void {
    if (this.linkTimer === undefined) return;
    clearTimeout(this.linkTimer);
    this.linkTimer = undefined;
    replaceAddress(this.link());
  }
}
