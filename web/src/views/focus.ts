// Where the keyboard is when what it was on goes away, and what a screen reader reads out.
import { signal } from '@preact/signals';

/** What a screen reader reads out next; not on show. */
export const spoken = signal('');

/** Reads it out, also where it is the same text as before. */
export function announce(text: string): void {
  spoken.value = '';
  setTimeout(() => (spoken.value = text), 50);
}

const focusable = 'a[href], button:not(:disabled), input:not(:disabled), select, textarea, summary, [tabindex="0"]';

/** The first thing beside what went away; what was around it, from the inside to the page, is known. Else the image, else the page itself. */
function placeBeside(around: readonly Element[]): HTMLElement | null {
  for (const one of around) {
    if (one.id === 'main' || one.id === 'app') break;
    const beside = one.isConnected ? [...one.querySelectorAll<HTMLElement>(focusable)].find((found) => found.getClientRects().length > 0) : undefined;
    if (beside) return beside;
  }
  const page = document.querySelector<HTMLElement>('.stage') ?? document.getElementById('main');
  if (page && !page.hasAttribute('tabindex')) page.tabIndex = -1;
  return page;
}

/** Keeps the focus on the page: an element that is removed while it has it would leave it nowhere. Returns how to stop. */
export function keepFocus(): () => void {
  let last: Element | null = null, around: Element[] = [];
  const follow = (event: FocusEvent): void => {
    last = event.target as Element;
    around = [];
    for (let at = last.parentElement; at; at = at.parentElement) around.push(at);
  };
  let waiting = false;
  const restore = (): void => {
    waiting = false;
    if (!last || document.activeElement !== document.body) return;
    // What is still there was moved. Nothing beside it: the page is still on its way.
    (last.isConnected ? (last as HTMLElement) : placeBeside(around))?.focus({ preventScroll: true });
  };
  // After the event that changes the page: it may be about to move the focus itself.
  const watch = new MutationObserver(() => {
    if (waiting || !last || document.activeElement !== document.body) return;
    waiting = true;
    setTimeout(restore, 0);
  });
  const title = new MutationObserver(() => announce(document.title));
  const forget = (): void => void (last = null); // a press beside everything
  // Tab may lead out of the page: nothing calls it back.
  let byTab = false;
  const key = (event: KeyboardEvent): void => void (byTab = event.key === 'Tab');
  const leave = (event: FocusEvent): void => {
    if (byTab && event.relatedTarget === null) last = null;
  };
  addEventListener('keydown', key, true);
  addEventListener('focusout', leave);
  addEventListener('focusin', follow);
  addEventListener('pointerdown', forget, true);
  watch.observe(document.body, { childList: true, subtree: true });
  title.observe(document.head, { childList: true, subtree: true, characterData: true });
  return () => {
    removeEventListener('focusin', follow);
    removeEventListener('pointerdown', forget, true);
    removeEventListener('keydown', key, true);
    removeEventListener('focusout', leave);
    watch.disconnect();
    title.disconnect();
  };
}
