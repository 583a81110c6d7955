// A scene as it is edited: its XML, its files and the camera, with one history, kept in this browser as a draft.
import { batch, computed, signal } from '@preact/signals';
import { getFiles, getSource, type FileList } from '../api.ts';
import { keep, kept } from '../kept.ts';
import type { Orbit, Walk } from '../maths/camera.ts';
import type { Loose } from './bundle.ts';
import { hashText, loadDraft, saveDraft, type Draft } from './drafts.ts';
import type { Origin } from './frame.ts';
import { History, type Moment, type WrittenHistory } from './history.ts';
import { isMarked, mover, moveMarks, noMarks, type Marks } from './marks.ts';
import { isChanged, noChanges, type FileChanges } from './scene_files.ts';
import { t } from '../words.ts';

/** By `typing` (drawn when it pauses), by `dragging` a slider (drawn as a movement), or by one step that is `done`. */
export type Editing = 'typing' | 'dragging' | 'done';

/** What is too large for the draft's text, beside it. */
interface KeptDraft {
  base: string;
  files: FileChanges;
  marks?: Marks; // drafts of earlier pages have none
  history: WrittenHistory;
}

const draftDelayMs = 200;
const unixLines = (text: string): string => text.replace(/\r\n?/g, '\n');

export abstract class EditedScene {
  readonly original = signal<string | null>(null);
  readonly text = signal<string | null>(null); // of the editor; null: not loaded
  readonly files = signal<FileChanges>(noChanges);
  readonly marks = signal<Marks>(noMarks);
  readonly selected = signal<number | null>(null); // the index of the element's "<" in the text
  readonly came = signal<FileList | null>(null); // the files that the scene came with; null: not asked for
  readonly orbit = signal<Orbit | null>(null); // null: the scene's own camera
  readonly walk = signal<Walk | null>(null);
  readonly notice = signal('');
  readonly edited = computed(() => (this.text.value !== null && this.text.value !== this.original.value) || isChanged(this.files.value));
  readonly canUndo = signal(false);
  readonly canRedo = signal(false);

  private lineEnd = '\n'; // of the document as it came
  private readonly history = new History();
  private draftTimer: ReturnType<typeof setTimeout> | undefined;
  private hide: ((text: string, hidden: readonly number[]) => string) | null = null;
  private shown = { text: '', marks: noMarks, result: '' }; // the last text without what is hidden
  private besides: Promise<KeptDraft | null> = Promise.resolve(null);

  /** `loose`: a document and files of this browser, which the server does not keep. `isRemembered`: with drafts. */
  constructor(readonly id: string | null, readonly loose: Loose | null, private readonly isRemembered: boolean) {}

  /** Something is to be drawn anew. */
  protected abstract redraw(how: Editing): void;

  /** What images are drawn of: without what is hidden. */
  origin(): Origin {
    const document = this.document(), text = this.text.value, marks = this.marks.value;
    if (marks.hidden.length === 0 || text === null || !this.hide) return document;
    if (this.shown.text !== text || this.shown.marks !== marks) this.shown = { text, marks, result: this.hide(text, marks.hidden) };
    return { ...document, text: this.shown.result };
  }

  /** The whole document as it is edited. */
  document(): Origin {
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
    const marks = beside?.marks ?? noMarks;
    if (draft || isChanged(this.files.value) || isMarked(marks)) await this.loadText();
    if (draft) this.text.value = unixLines(draft.text);
    const base = hashText(this.original.value ?? '');
    if (beside && beside.base === base) {
      this.history.read(beside.history);
      this.tellHistory();
      await this.setMarks(marks);
    }
    if (this.edited.value && this.id !== null)
      this.notice.value = !draft || base === draft.base ? t('Your edits of this scene were restored.') : t('Your edits were restored; the scene on the server has changed since.');
  }

  async loadText(): Promise<void> {
    if (this.id === null || this.original.value !== null) return;
    this.takeText(await getSource(this.id));
  }

  /** A document as it came. It is edited with "\n" alone, which the editor has at the end of a line. */
  protected takeText(source: string): void {
    const text = unixLines(source);
    this.lineEnd = source.includes('\r\n') && !/[^\r]\n/.test(source) ? '\r\n' : '\n';
    batch(() => {
      this.original.value = text;
      this.text.value ??= text;
    });
  }

  /** The document to be saved, with the line ends that it came with. */
  written(): string {
    return (this.text.value ?? '').replaceAll('\n', this.lineEnd);
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
    this.setText(text);
    this.keepSoon();
    this.redraw(how);
  }

  /** Marks and selection stay with their elements. */
  private setText(text: string | null): void {
    const marks = this.marks.value, at = this.selected.value;
    batch(() => {
      if (isMarked(marks) || at !== null) {
        const move = mover(this.text.value ?? '', text ?? '');
        this.marks.value = moveMarks(marks, move);
        this.selected.value = at === null ? null : move(at);
      }
      this.text.value = text;
    });
  }

  private async setMarks(marks: Marks): Promise<void> {
    if (marks.hidden.length > 0) this.hide ??= (await import('./hide.ts')).withoutElements;
    this.marks.value = marks;
  }

  /** Hides, shows, locks or unlocks: one step. */
  async mark(marks: Marks): Promise<void> {
    await this.loadText();
    this.record('');
    await this.setMarks(marks);
    this.keepSoon();
    this.redraw('done');
  }

  /** Until `endGesture` all changes are one step. */
  beginGesture(): void {
    this.history.beginGesture();
  }

  endGesture(): void {
    this.history.endGesture(this.moment());
    this.tellHistory();
  }

  /** Document and files change in one step. */
  async changeFiles(change: (text: string, files: FileChanges) => { text: string; changes: FileChanges }): Promise<void> {
    await this.loadText();
    const { text, changes } = change(this.text.value ?? '', this.files.value);
    this.record('');
    batch(() => {
      this.files.value = changes;
      this.setText(text);
    });
    this.flushDraft();
    this.redraw('done');
  }

  private moment(): Moment {
    return { text: this.text.value, files: this.files.value, marks: this.marks.value, orbit: this.orbit.value, walk: this.walk.value };
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
      this.setText(moment.text ?? this.original.value);
      this.files.value = moment.files;
      this.orbit.value = moment.orbit;
      this.walk.value = moment.walk;
      if (!this.edited.value) this.notice.value = '';
    });
    this.tellHistory();
    this.keepSoon();
    void this.setMarks(moment.marks).then(() => this.redraw('done'));
  }

  /** Back to what is stored: one step, which can be undone. */
  discardEdits(): void {
    this.record('');
    batch(() => {
      this.setText(this.original.value);
      this.files.value = noChanges;
      this.notice.value = '';
    });
    this.flushDraft();
    this.redraw('done');
  }

  /** The edits live on elsewhere. */
  forgetDraft(): void {
    batch(() => {
      this.setText(this.original.value);
      this.files.value = noChanges;
      this.marks.value = noMarks;
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
    const refuse = (): void => void (this.notice.value = t('This browser keeps no edits: copy the XML before you leave.'));
    if (!isSaved) refuse();
    if (this.loose) return;
    const marks = this.marks.value, isWorth = isChanged(this.files.value) || isMarked(marks) || history.texts.length > 1;
    const beside: KeptDraft = { base, files: this.files.value, marks, history };
    void keep(this.keptKey, isWorth ? beside : null).then((done) => {
      if (!done && isChanged(this.files.value)) refuse();
    });
  }

  private get keptKey(): string {
    return `draft.${this.id ?? '*'}`;
  }
}
