// Larger things that this browser keeps, by name: files of drafts, their history, grades. A browser that allows no
// storage keeps nothing.
let opened: Promise<IDBDatabase> | null = null;

function open(): Promise<IDBDatabase> {
  opened ??= new Promise<IDBDatabase>((done, failed) => {
    const request = indexedDB.open('farol', 1);
    request.onupgradeneeded = () => request.result.createObjectStore('kept');
    request.onsuccess = () => done(request.result);
    request.onerror = () => failed(request.error ?? new Error('storage.none'));
  });
  opened.catch(() => (opened = null));
  return opened;
}

async function run<T>(mode: IDBTransactionMode, act: (store: IDBObjectStore) => IDBRequest<T>): Promise<T> {
  const transaction = (await open()).transaction('kept', mode), request = act(transaction.objectStore('kept'));
  return new Promise((done, failed) => {
    transaction.oncomplete = () => done(request.result);
    transaction.onerror = transaction.onabort = () => failed(transaction.error ?? new Error('storage.none'));
  });
}

/** Why something was not kept: there is no room, or the browser allows no storage. */
export type Kept = 'kept' | 'full' | 'refused';

export async function tryKeep(key: string, value: unknown): Promise<Kept> {
  try {
    await run<unknown>('readwrite', (store) => (value === null ? store.delete(key) : store.put(value, key)) as IDBRequest<unknown>);
    return 'kept';
  } catch (fault) {
    return (fault as Error | null)?.name === 'QuotaExceededError' ? 'full' : 'refused';
  }
}

/** False when there is no room or no storage. */
export const keep = async (key: string, value: unknown): Promise<boolean> => (await tryKeep(key, value)) === 'kept';

const below = (prefix: string): IDBKeyRange => IDBKeyRange.bound(prefix, `${prefix}\uffff`);

/** All that is kept under keys with the prefix; none where the browser allows no storage. */
export async function keptBelow<T>(prefix: string): Promise<Map<string, T>> {
  try {
    const keys = await run('readonly', (store) => store.getAllKeys(below(prefix)));
    const values = await run<T[]>('readonly', (store) => store.getAll(below(prefix)) as IDBRequest<T[]>);
    return new Map(keys.map((key, i) => [String(key).slice(prefix.length), values[i] as T]));
  } catch {
    return new Map();
  }
}

/** Removes all that is kept under keys with the prefix; false where the browser refuses. */
export async function forgetBelow(prefix: string): Promise<boolean> {
  try {
    await run<unknown>('readwrite', (store) => store.delete(below(prefix)) as IDBRequest<unknown>);
    return true;
  } catch {
    return false;
  }
}

export async function kept<T>(key: string): Promise<T | null> {
  try {
    return ((await run<unknown>('readonly', (store) => store.get(key) as IDBRequest<unknown>)) as T | undefined) ?? null;
  } catch {
    return null;
  }
}
