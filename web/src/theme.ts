// Light or dark: as the system says, until one is chosen.
import { effect, signal } from '@preact/signals';
import { recall, remember } from './storage.ts';

const system = matchMedia('(prefers-color-scheme: dark)');
const stored = recall('theme');

export const dark = signal(stored ? stored === 'dark' : system.matches);
system.addEventListener('change', () => {
  if (!recall('theme')) dark.value = system.matches;
});

effect(() => {
  document.documentElement.dataset['theme'] = dark.value ? 'dark' : 'light';
});

export function toggleTheme(): void {
  dark.value = !dark.value;
  remember('theme', dark.value ? 'dark' : 'light');
}
