// The state of one scene on show, and what changes it. Views read the signals; every change of
// the view asks the frame loop for pictures.
import { batch, computed, signal } from '@preact/signals';
import {
  findingsOf, findingsOfFacts, getScene, getSource, Problem, validate, type Finding, type ModelPlaces, type Options, type SceneFacts,
} from '../api.ts';
import { FrameLoop, type Shown } from '../frames/loop.ts';
import { FrameRate, takeWireTime, type Latency } from '../frames/timing.ts';
import { orbitOf, walkOf, walkTarget, type LookAt, type Orbit, type Walk } from '../maths/camera.ts';
import { formatView, replaceAddress, scenePlace, type ViewLink } from '../router.ts';
import type { Loose } from './bundle.ts';
import { SceneClock } from './clock.ts';
import { hashText, loadDraft, saveDraft, type Draft } from './drafts.ts';
import { retryAfterS, sceneFaultOf, stateOf, wholeFindings, type Fault } from './state.ts';
import { cameraOptions, qualityOptions, sizeOptions, type Quality, type StageSize } from './picture_options.ts';
import { bodyOf, decodeFrame, fetchPicture, newSession, type Frame, type Origin } from './frame.ts';

export interface Hud {
  width: number;
  height: number;
  bytes: number;
  moving: boolean;
  fps: number;
  latency: Latency;
  stats: Frame['stats'];
}

const hudEveryMs = 200;

export type Canvas = { draw(bitmap: ImageBitmap, seq: number): void; size(): StageSize };

export class Viewer {
  readonly facts = signal<SceneFacts | null>(null);
  readonly original = signal<string | null>(null);
  readonly text = signal<string | null>(null); // of the editor; null: not loaded
  readonly orbit = signal<Orbit | null>(null); // null: the scene's own camera
  readonly walk = signal<Walk | null>(null);
  readonly options = signal<Record<string, string>>({});
  readonly quality = signal<Quality>('standard');
  readonly lightMode = signal(false);
  readonly turning = signal(false);
  readonly findings = signal<Finding[]>([]);
  readonly notice = signal('');
  readonly hud = signal<Hud | null>(null);
  readonly still = signal<Blob | null>(null); // the last full picture
  readonly pictured = signal(false);
  readonly fault = signal<Fault | null>(null); // of the last request; null: it gave a picture
  readonly state = computed(() => stateOf(this.fault.value, this.pictured.value, this.findings.value));
  readonly picked = signal<{ number: number; line: number } | null>(null); // the model last clicked
  readonly reveal = signal<{ line: number; column: number } | null>(null); // a place the editor goes to
  readonly edited = computed(() => this.text.value !== null && this.text.value !== this.original.value);
  readonly clock: SceneClock;
  places: ModelPlaces | null = null; // of the stored document
  home: LookAt | null = null;
  canvas: Canvas | null = null;

  private readonly session = newSession();
  private readonly rate = new FrameRate();
  private readonly loop: FrameLoop<Frame>;
  private linkTimer: ReturnType<typeof setTimeout> | undefined;
  private draftTimer: ReturnType<typeof setTimeout> | undefined;
  private typeTimer: ReturnType<typeof setTimeout> | undefined;
  private latest: Frame | null = null;
  private toldAt = 0; // when the overlay was last told
  private asked = ''; // the size of the last picture that was asked for
  private closed = false;
  private attempts = 0; // at a server that does not answer
  private openTimer: ReturnType<typeof setTimeout> | undefined;
  private known: { text: string; facts: (SceneFacts & Partial<ModelPlaces>) | null; findings: readonly Finding[] } | null = null; // of the edited document

  constructor(readonly id: string | null, private readonly loose: Loose | null = null) {
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
        else options['format'] = 'png';
        const response = await fetchPicture(this.origin(), { ...options, session: this.session, seq }, signal);
        if (!response) return undefined;
        const picture = await decodeFrame(response, options);
        return { picture, serverTiming: response.headers.get('Server-Timing'), wireMs: takeWireTime(response.url) };
      },
      show: (shown) => this.show(shown),
      discard: (frame) => frame.bitmap.close(),
      failed: (fault) => this.failed(fault),
      now: () => performance.now(),
    });
  }

  /** Reads the facts, restores edits and view, and asks for the first picture. */
  async open(link: ViewLink, template: string): Promise<void> {
    const draft = this.loose ? null : loadDraft(this.id);
    batch(() => {
      this.orbit.value = link.orbit;
      this.walk.value = link.walk;
      this.options.value = link.options;
      this.clock.seek(link.time ?? 0);
    });
    if (this.id === null) {
      this.original.value = template;
      this.text.value = draft?.text ?? template;
    }
    await this.begin(draft);
  }

  /** Reads the facts of a stored scene, and asks for the first picture. */
  private async begin(draft: Draft | null): Promise<void> {
    try {
      if (this.id !== null) await this.readFacts(this.id, draft);
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

  private async readFacts(id: string, draft: Draft | null): Promise<void> {
    const facts = await getScene(id);
    if (this.closed) return;
    this.facts.value = facts;
    this.home ??= facts.camera ?? null;
    this.clock.range(facts.animated ?? false, facts.playFrom ?? 0, facts.loopSeconds ?? 60);
    this.findings.value = findingsOfFacts(facts);
    if (!draft && facts.valid) return;
    await this.loadText();
    if (draft) this.restore(draft.text, draft.base);
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

  async loadText(): Promise<void> {
    if (this.id === null || this.original.value !== null) return;
    const source = await getSource(this.id);
    batch(() => {
      this.original.value = source;
      this.text.value ??= source;
    });
  }

  private restore(text: string, base: string): void {
    this.text.value = text;
    if (this.edited.value)
      this.notice.value = base === hashText(this.original.value ?? '')
        ? 'Your edits of this scene were restored.'
        : 'Your edits were restored; the scene on the server has changed since.';
  }

  /**
   * The document was changed: by `typing` (drawn when it pauses), by `dragging` a slider (drawn as a
   * movement) or by one step that is `done`.
   */
  edit(text: string, how: 'typing' | 'dragging' | 'done'): void {
    if (text === this.text.value) return;
    this.text.value = text;
    clearTimeout(this.draftTimer);
    clearTimeout(this.typeTimer);
    this.draftTimer = setTimeout(() => this.flushDraft(), 200);
    if (how === 'dragging') this.loop.move();
    else this.typeTimer = setTimeout(() => this.loop.settle(), how === 'typing' ? 220 : 0);
  }

  discardEdits(): void {
    this.text.value = this.original.value;
    this.known = null;
    this.flushDraft();
    this.notice.value = '';
    if (this.id !== null)
      void getScene(this.id).then((facts) => {
        if (this.edited.value) return;
        this.facts.value = facts;
        this.home = facts.camera ?? this.home;
      }, () => undefined); // the picture tells what is wrong
    this.loop.settle();
  }

  flushDraft(): void {
    clearTimeout(this.draftTimer);
    const text = this.text.value;
    if (text === null) return;
    const kept = saveDraft(this.id, this.edited.value ? { text, base: hashText(this.original.value ?? '') } : null);
    if (!kept) this.notice.value = 'This browser keeps no edits: copy the XML before you leave.';
  }

  /** What the service knows of the document as it is edited now; null where it cannot be read. */
  async validated(): Promise<(SceneFacts & Partial<ModelPlaces>) | null> {
    const origin = this.origin(), { text } = origin;
    if (text === null) return this.facts.value;
    if (this.known?.text === text) return this.known.facts;
    try {
      const facts = await validate(bodyOf(origin), this.id);
      this.known = { text, facts, findings: facts.diagnostics };
      return facts;
    } catch (fault) {
      if (fault instanceof Problem && !fault.busy) this.known = { text, facts: null, findings: fault.findings };
      return null;
    }
  }

  /** All that is known to be wrong with the document on show. */
  private documentFindings(): readonly Finding[] {
    const { text } = this.origin();
    if (text !== null) return this.known?.text === text ? this.known.findings : [];
    return this.facts.value ? findingsOfFacts(this.facts.value) : [];
  }

  /** After an edit: the animation, the camera and the counts may be others. */
  private async refresh(): Promise<void> {
    const { text } = this.origin();
    if (text === null || this.known?.text === text) return;
    const facts = await this.validated();
    if (this.origin().text !== text) return;
    if (this.latest) this.setFindings(wholeFindings(this.documentFindings(), this.latest.findings));
    if (!facts) return;
    batch(() => {
      const links = this.facts.value?.links ?? { self: '', source: '', image: '', thumbnail: '' };
      this.facts.value = { ...facts, id: this.id ?? '', links };
      this.home = facts.camera ?? this.home;
      this.clock.range(facts.animated ?? false, facts.playFrom ?? 0, facts.loopSeconds ?? 60);
    });
  }

  /** The edits live on elsewhere. */
  forgetDraft(): void {
    clearTimeout(this.draftTimer);
    this.text.value = this.original.value;
    this.flushDraft();
  }

  report(fault: unknown): void {
    this.findings.value = findingsOf(fault);
  }

  /** Whether a finding is about the document, not about a file that it includes. */
  isOfDocument(finding: Finding): boolean {
    const name = this.loose?.main ?? `${(this.id ?? 'scene').replace(/^.*\//, '')}.xml`;
    return !finding.file || finding.file === name || (!this.loose && /(^|\/)scene\.xml$/.test(finding.file));
  }

  origin(): Origin {
    return { id: this.id, text: this.id === null || this.edited.value ? this.text.value : null, loose: this.loose };
  }

  /** What the full picture is asked with: all but format. */
  pictureOptions(): Options {
    const out: Options = { missing: 'placeholder', ...this.sizeOptions(), ...qualityOptions[this.quality.value], ...this.options.value };
    if (this.clock.time.value > 0) out['time'] = Number(this.clock.time.value.toFixed(3));
    return { ...out, ...cameraOptions(this.walk.value, this.orbit.value, this.home) };
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
      this.setFindings(wholeFindings(this.documentFindings(), picture.findings));
    });
    if (picture.camera && !this.home) this.home = picture.camera;
    this.latest?.bitmap.close();
    this.latest = picture;
    if (!moving) void this.refresh();
  }

  private failed(fault: unknown): number | null {
    if (fault instanceof Problem && fault.busy) {
      const wait = Math.max(0.3, fault.retryAfterS ?? 1);
      this.notice.value = `The server is busy; trying again in ${Math.ceil(wait)} s.`;
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
      void this.begin(loadDraft(this.id));
    } else this.loop.settle();
  }

  private setFindings(found: Finding[]): void {
    if (this.notice.value.startsWith('The server is busy')) this.notice.value = '';
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

  changeOrbit(change: (orbit: Orbit) => Orbit): void {
    const from = this.orbit.value ?? (this.home && orbitOf(this.home));
    if (!from) return;
    this.orbit.value = change(from);
    this.moved();
  }

  changeWalk(change: (walk: Walk) => Walk): void {
    if (!this.walk.value) return;
    this.walk.value = change(this.walk.value);
    this.moved();
  }

  /** Walking begins where the camera is, and orbiting again where the walk ended up looking. */
  toggleWalk(): void {
    const orbit = this.orbit.value ?? (this.home && orbitOf(this.home));
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
    this.linkTimer = setTimeout(() => replaceAddress(this.link()), 200);
  }
}
