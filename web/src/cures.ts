// The fixes of the error catalogue. The server embeds api/errors.md as a module, which is loaded for the
// first finding.
import { signal } from '@preact/signals';
import { curesOf } from '../derive/cures.ts';
import { language } from './words.ts';

const cures = signal<Record<string, string>>({});
let isRequested = false;

export function setCatalogue(catalogue: string): void {
  isRequested = true;
  cures.value = curesOf(catalogue);
}

/** Empty in other languages than the catalogue's: the sentence of the finding, which is translated, says how to fix it, too. */
export function cureOf(code: string): string {
  if (language.value !== 'en') return '';
  if (!isRequested) {
    isRequested = true;
    import('document:errors').then((module) => setCatalogue(module.default), () => { isRequested = false; });
  }
  return cures.value[code] ?? '';
}
