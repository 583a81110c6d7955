import { signal } from '@preact/signals';

/** Whether the dialog for sharing is open. */
export const sharing = signal(false);

/** Whether the keys are shown; `hadHelp`: they were asked for, and what shows them is loaded. */
export const helpShown = signal(false);
export const hadHelp = signal(false);

export function showHelp(): void {
  hadHelp.value = true;
  helpShown.value = true;
}
