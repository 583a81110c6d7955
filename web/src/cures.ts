// The fixes of the error catalogue. The server embeds api/errors.md as a module, which is loaded for the
// first finding.
import { signal } from '@preact/signals';
import { curesOf } from '../derive/cures.ts';

const cures = signal<Record<string, string>>({});
let isRequested = false;

export function setCatalogue(catalogue: string): void {
  isRequested = true;
  cures.value = curesOf(catalogue);
}

export function cureOf(code: string): string {
  if (!isRequested) {
    isRequested = true;
    import('document:errors').then((module) => setCatalogue(module.default), () => { isRequested = false; });
  }
  return cures.value[code] ?? '';
}
