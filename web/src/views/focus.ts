// Where the keyboard is when what it was on goes away, and what a screen reader reads out.
import { signal } from '@preact/signals';

/** What a screen reader reads out next; not on show. */
export const spoken = signal('');

/** Reads it out, also where it is the same text as before. */
export function announce(text: string): void {
  spoken.value = '';
  setTimeout(() => (spoken.value = text), 50);
}

/** A place that stays: the open panel's tab for what was in the panel, else the image, else the page itself. */
function placeFor(wasInPanel: boolean): HTMLElement | null {
  const tab = wasInPanel ? document.querySelector<HTMLElement>('.panel:not([hidden]) [role=tab][aria-selected=true]') : null;
  const place = tab ?? document.querySelector<HTMLElement>('.stage') ?? document.getElementById('main');
  if (place && !place.hasAttribute('tabindex')) place.tabIndex = -1;
  return place;
}

/** Keeps the focus on the page: an element that is removed while it has it would leave it nowhere. Returns how to stop. */
export function keepFocus(): () => void {
  let last: Element | null = null, wasInPanel = false;
  const follow = (event: FocusEvent): void => {
    last = event.target as Element;
    wasInPanel = last.closest('.panel') !== null;
  };
  const watch = new MutationObserver(() => {
    if (!last || last.isConnected || document.activeElement !== document.body) return;
    placeFor(wasInPanel)?.focus({ preventScroll: true }); // none yet: the page is still on its way
  });
  const title = new MutationObserver(() => announce(document.title));
  addEventListener('focusin', follow);
  watch.observe(document.body, { childList: true, subtree: true });
  title.observe(document.head, { childList: true, subtree: true, characterData: true });
  return () => {
    removeEventListener('focusin', follow);
    watch.disconnect();
    title.disconnect();
  };
}
