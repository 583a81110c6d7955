// What this browser remembers; a browser that allows no storage remembers nothing.
export function recall(key: string): string | null {
  try {
    return localStorage.getItem(`farol.${key}`);
  } catch {
    return null;
  }
}

/** False when there is no room or no storage. */
export function remember(key: string, value: string | null): boolean {
  try {
    if (value === null) localStorage.removeItem(`farol.${key}`);
    else localStorage.setItem(`farol.${key}`, value);
    return true;
  } catch {
    return false;
  }
}
