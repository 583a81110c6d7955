// Larger things that this browser keeps, by name: files of drafts, their history, grades. A browser that allows no
// storage keeps nothing.
let opened: Promise<IDBDatabase> | null = null;

function open(): Promise<IDBDatabase> {
  opened ??= new Promise<IDBDatabase>((done, failed) => {
    const request = indexedDB.open('farol', 1);
    request.onupgradeneeded = () => request.result.createObjectStore('kept');
    request.onsuccess = () => done(request.result);
    request.onerror = () => failed(request.error ?? new Error('no storage'));
  });
  opened.catch(() => (opened = null));
  return opened;
}

async function run<T>(mode: IDBTransactionMode, act: (store: IDBObjectStore) => IDBRequest<T>): Promise<T> {
  const transaction = (await open()).transaction('kept', mode), request = act(transaction.objectStore('kept'));
  return new Promise((done, failed) => {
    transaction.oncomplete = () => done(request.result);
    transaction.onerror = transaction.onabort = () => failed(transaction.error ?? new Error('no storage'));
  });
}

/** False when there is no room or no storage. */
export async function keep(key: string, value: unknown): Promise<boolean> {
  try {
    await run<unknown>('readwrite', (store) => (value === null ? store.delete(key) : store.put(value, key)) as IDBRequest<unknown>);
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
