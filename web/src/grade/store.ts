// What the browser keeps of a class, so that a reload loses nothing: files, results, images, the teacher's marks.
// Where it keeps nothing, all is held in memory, and the page says so.
import { signal } from '@preact/signals';
import { forgetBelow, kept, keptBelow, tryKeep, type Kept } from '../kept.ts';
import type { GroupMember, Override, Result, Submission, ViewImages } from './types.ts';

const root = 'grade/';

/** The class without its files. */
export interface KeptClass {
  tasks: { name: string; reference: { name: string; fileName: string } | null; rubric: { name: string; text: string } | null }[];
  submissions: Submission[];
  overrides: Override[];
  groups: GroupMember[];
  missing: 'placeholder' | 'error';
}

/** Whether all of the class would survive a reload. */
export const storageState = signal<Kept>('kept');

async function put(key: string, value: unknown): Promise<boolean> {
  const state = await tryKeep(root + key, value);
  if (state !== 'kept') storageState.value = state;
  return state === 'kept';
}

export const keepClass = (value: KeptClass): Promise<boolean> => put('class', value);
export const keptClass = (): Promise<KeptClass | null> => kept<KeptClass>(`${root}class`);

/** Files and images by their keys; those that the browser does not keep stay in memory. */
class Files<T> {
  private readonly held = new Map<string, T>();
  constructor(private readonly folder: string) {}
  async set(key: string, value: T): Promise<void> {
    if (await put(`${this.folder}/${key}`, value)) this.held.delete(key);
    else this.held.set(key, value);
  }
  async get(key: string): Promise<T | null> {
    return this.held.get(key) ?? kept<T>(`${root}${this.folder}/${key}`);
  }
  async delete(key: string): Promise<void> {
    this.held.delete(key);
    await put(`${this.folder}/${key}`, null);
  }
  clear(): void {
    this.held.clear();
  }
}

export const submissionFiles = new Files<Blob>('file');
export const referenceFiles = new Files<Blob>('reference');
export const viewImages = new Files<ViewImages[]>('images');
export const expectedImages = new Files<(Blob | null)[]>('expected');

export const keepResult = (key: string, value: Result | null): Promise<boolean> => put(`result/${key}`, value);
export const keptResults = (): Promise<Map<string, Result>> => keptBelow<Result>(`${root}result/`);

/** Forgets the class; false where the browser refuses. */
export async function forgetClass(): Promise<boolean> {
  for (const files of [submissionFiles, referenceFiles, viewImages, expectedImages]) files.clear();
  const isForgotten = await forgetBelow(root);
  storageState.value = 'kept';
  return isForgotten;
}
