// The options that the service knows for images, from its own tables (api/schema.json), loaded when first needed.
import { signal } from '@preact/signals';

let isRequested = false;

const optionNames = signal<ReadonlySet<string>>(new Set());

/** Whether images can be asked for with that option; false until the tables are here. */
export const hasOption = (name: string): boolean => optionNames.value.has(name);

export function loadOptions(): void {
  if (isRequested) return;
  isRequested = true;
  import('document:schema').then(({ default: text }) => {
    optionNames.value = new Set((JSON.parse(text) as { options: { name: string }[] }).options.map(({ name }) => name));
  }, () => { isRequested = false; });
}
