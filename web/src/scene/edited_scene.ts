// A scene as it is edited: its XML, its files and the camera, with one history, kept in this browser as a draft.
import { batch, computed, signal } from '@preact/signals';
import { getFiles, getSource, type FileList } from '../api.ts';
import { keep, kept } from '../kept.ts';
import type { Orbit, Walk } from '../maths/camera.ts';
import type { Loose } from './bundle.ts';
import { hashText, loadDraft, saveDraft, type Draft } from './drafts.ts';
import type { Origin } from './frame.ts';
import { History, type Moment, type WrittenHistory } from './history.ts';
import { isChanged, noChanges, type FileChanges } from './scene_files.ts';

/** By `typing` (drawn when it pauses), by `dragging` a slider (drawn as a movement), or by one step that is `done`. */
export type Editing = 'typing' | 'dragging' | 'done';

/** What is too large for the draft's text, beside it. */
interface KeptDraft {
  base: string;
  files: FileChanges;
  history: WrittenHistory;
}

const restoredNotice = 'Your edits of this scene were restored.';
const draftDelayMs = 200;

export abstract class EditedScene {
  readonly original = signal<string | null>(null);
  readonly text = signal<string | null>(null); // of the editor; null: not loaded
  readonly files = signal<FileChanges>(noChanges);
  readonly came = signal<FileList | null>(null); // the files that the scene came with; null: not asked for
  readonly orbit = signal<Orbit | null>(null); // null: the scene's own camera
  readonly walk = signal<Walk | null>(null);
  readonly notice = signal('');
  readonly edited = computed(() => (this.text.value !== null && this.text.value !== this.original.value) || isChanged(this.files.value));
  readonly canUndo = signal(false);
  readonly canRedo = signal(false);

  private readonly history = new History();
  private draftTimer: ReturnType<typeof setTimeout> | undefined;
  private besides: Promise<KeptDraft | null> = Promise.resolve(null);

  /** `loose`: a document and files of this browser, which the server does not keep. `isRemembered`: with drafts. */
  constructor(readonly id: string | null, readonly loose: Loose | null, private readonly isRemembered: boolean) {}

  /** Something is to be drawn anew. */
  protected abstract redraw(how: Editing): void;

  origin(): Origin {
    return { id: this.id, text: this.id === null || this.edited.value ? this.text.value : null, loose: this.loose, files: this.files.value };
  }

  /** The draft of an earlier visit; its files and history come with `restore`. */
  protected beginDraft(): Draft | null {
    if (this.loose || !this.isRemembered) return null;
    this.besides = kept<KeptDraft>(this.keptKey);
    return loadDraft(this.id);
  }

  protected async restore(draft: Draft | null): Promise<void> {
    const beside = await this.besides;
    if (beside && isChanged(beside.files)) this.files.value = beside.files;
    if (draft || isChanged(this.files.value)) await this.loadText();
    if (draft) this.text.value = draft.text;
    const base = hashText(this.original.value ?? '');
    if (beside && beside.base === base) {
      this.history.read(beside.history);
      this.tellHistory();
    }
    if (this.edited.value && this.id !== null)
      this.notice.value = !draft || base === draft.base ? restoredNotice : 'Your edits were restored; the scene on the server has changed since.';
  }

  async loadText(): Promise<void> {
    if (this.id === null || this.original.value !== null) return;
    const source = await getSource(this.id);
    batch(() => {
      this.original.value = source;
      this.text.value ??= source;
    });
  }

  /** The files that the scene came with, its document apart. */
  async loadFiles(): Promise<FileList> {
    if (this.came.value) return this.came.value;
    const own = this.loose;
    const list = this.id !== null ? await getFiles(this.id)
      : { main: own?.main ?? 'scene.xml', files: (own?.files ?? []).map(({ path, file }) => ({ path, bytes: file.size })) };
    const came = { main: list.main, files: list.files.filter((one) => one.path !== list.main) };
    this.came.value = came;
    return came;
  }

  edit(text: string, how: Editing): void {
    if (text === this.text.value) return;
    this.record(how === 'done' ? '' : how);
    this.text.value = text;
    this.keepSoon();
    this.redraw(how);
  }

  /** Document and files change in one step. */
  async changeFiles(change: (text: string, files: FileChanges) => { text: string; changes: FileChanges }): Promise<void> {
    await this.loadText();
    const { text, changes } = change(this.text.value ?? '', this.files.value);
    this.record('');
    batch(() => {
      this.files.value = changes;
      this.text.value = text;
    });
    this.flushDraft();
    this.redraw('done');
  }

  private moment(): Moment {
    return { text: this.text.value, files: this.files.value, orbit: this.orbit.value, walk: this.walk.value };
  }

  /** To be called before a change. */
  protected record(kind: string): void {
    this.history.record(kind, this.moment(), performance.now());
    this.tellHistory();
  }

  private tellHistory(): void {
    batch(() => {
      this.canUndo.value = this.history.canUndo;
      this.canRedo.value = this.history.canRedo;
    });
  }

  undo(): void {
    this.goTo(this.history.undo(this.moment()));
  }

  redo(): void {
    this.goTo(this.history.redo(this.moment()));
  }

  private goTo(moment: Moment | null): void {
    if (!moment) return;
    batch(() => {
      this.text.value = moment.text ?? this.original.value;
      this.files.value = moment.files;
      this.orbit.value = moment.orbit;
      this.walk.value = moment.walk;
      if (!this.edited.value) this.notice.value = '';
    });
    this.tellHistory();
    this.keepSoon();
    this.redraw('done');
  }

  /** Back to what is stored: one step, which can be undone. */
  discardEdits(): void {
    this.record('');
    batch(() => {
      this.text.value = this.original.value;
      this.files.value = noChanges;
      this.notice.value = '';
    });
    this.flushDraft();
    this.redraw('done');
  }

  /** The edits live on elsewhere. */
  forgetDraft(): void {
    batch(() => {
      this.text.value = this.original.value;
      this.files.value = noChanges;
    });
    this.history.read({ texts: [], past: [], future: [] });
    this.flushDraft();
  }

  private keepSoon(): void {
    clearTimeout(this.draftTimer);
    this.draftTimer = setTimeout(() => this.flushDraft(), draftDelayMs);
  }

  flushDraft(): void {
    clearTimeout(this.draftTimer);
    const text = this.text.value;
    if (text === null || !this.isRemembered) return;
    const base = hashText(this.original.value ?? ''), history = this.history.write();
    const isSaved = saveDraft(this.id, this.edited.value ? { text, base } : null);
    const refuse = (): void => void (this.notice.value = 'This browser keeps no edits: copy the XML before you leave.');
    if (!isSaved) refuse();
    if (this.loose) return;
    const isWorth = isChanged(this.files.value) || history.texts.length > 1;
    const beside: KeptDraft = { base, files: this.files.value, history };
    void keep(this.keptKey, isWorth ? beside : null).then((done) => {
      if (!done && isChanged(this.files.value)) refuse();
    });
  }

  private get keptKey(): string {
    return `draft.${this.id ?? '*'}`;
  }
}
