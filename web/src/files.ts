// Files from dialogs and drops, with their paths.
import { isLitter, type NamedFile } from './scene/bundle.ts';

/** The file dialog: files, or a folder with all that is in it. */
export function chooseFiles(folder: boolean): Promise<NamedFile[]> {
  const input = document.createElement('input');
  input.type = 'file';
  if (folder) input.webkitdirectory = true;
  else input.multiple = true;
  return new Promise((done) => {
    input.addEventListener('change', () =>
      done([...(input.files ?? [])].map((file) => ({ path: file.webkitRelativePath || file.name, file }))));
    input.click();
  });
}

const maxListed = 50_000;

async function walk(entry: FileSystemEntry, out: NamedFile[]): Promise<void> {
  const path = entry.fullPath.replace(/^\//, '');
  if (out.length >= maxListed || isLitter(path)) return;
  if (entry.isFile) {
    const file = await new Promise<File>((done, failed) => (entry as FileSystemFileEntry).file(done, failed));
    out.push({ path, file });
    return;
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  for (;;) {
    // A reader gives at most a hundred entries at a time.
    const some = await new Promise<FileSystemEntry[]>((done, failed) => reader.readEntries(done, failed));
    if (some.length === 0) return;
    for (const one of some) await walk(one, out);
  }
}

export async function filesOf(transfer: DataTransfer): Promise<NamedFile[]> {
  // Entries must be taken before the first await: the list is emptied after the event.
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.() ?? null);
  const plain = [...transfer.files].map((file) => ({ path: file.name, file }));
  if (!entries.some((entry) => entry?.isDirectory)) return plain;
  const out: NamedFile[] = [];
  for (const entry of entries) if (entry) await walk(entry, out);
  return out;
}
