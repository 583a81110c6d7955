// Files that are dropped on a scene on show, or chosen for it.
import { chooseFiles } from '../files.ts';
import type { NamedFile } from './bundle.ts';
import { withRepair } from './file_names.ts';
import { missingFor, pathFor, withFile, type Missing } from './scene_files.ts';
import type { Viewer } from './viewer.ts';
import { t } from '../words.ts';

const maxFileBytes = 16 * 1024 * 1024; // the service takes no larger bodies unless it is set to

/** Adds files: each in the place of one that is missing and bears its name, or of `missing`, else under its own path. */
export async function addFiles(viewer: Viewer, files: readonly NamedFile[], missing?: Missing): Promise<void> {
  const tooLarge = files.find(({ file }) => file.size > maxFileBytes);
  if (tooLarge) throw new Error(t('“{path}” has {size} MB; the server takes 16 MB', { path: tooLarge.path, size: (tooLarge.file.size / 1048576).toFixed(1) }));
  const all = viewer.missing.value;
  await viewer.changeFiles((text, changes) => files.reduce((now, { path, file }) => {
    const place = missing ?? missingFor(all, file);
    return place ? withRepair(now.text, now.changes, place, file) : { text: now.text, changes: withFile(now.changes, pathFor(path), file) };
  }, { text, changes }));
}

export async function chooseFor(viewer: Viewer, missing: Missing): Promise<void> {
  const [first] = await chooseFiles(false);
  if (first) await addFiles(viewer, [first], missing);
}
