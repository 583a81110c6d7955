// The keys, and a short tour of the page.
import { signal } from '@preact/signals';
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { helpKeys, tourSteps } from './help.ts';
import { helpShown } from './sharing.ts';
import { focusStage } from './stage.tsx';
import { Tool } from './ui.tsx';
import { t } from '../words.ts';

/** The step on show; null: no tour. */
const step = signal<number | null>(null);

function Tour() {
  const at = step.value ?? 0, last = tourSteps.length - 1, [selector, title, text] = tourSteps[at] ?? ['', '', ''];
  const box = useRef<HTMLDivElement>(null), [place, setPlace] = useState({ left: 0, top: 0 });
  useLayoutEffect(() => {
    const target = document.querySelector(selector)?.getBoundingClientRect(), own = box.current?.getBoundingClientRect();
    if (!target || !own) return;
    const below = target.bottom + own.height + 16 < innerHeight;
    setPlace({
      left: Math.max(8, Math.min(innerWidth - own.width - 8, target.left)),
      top: Math.max(8, below ? target.bottom + 8 : Math.min(innerHeight - own.height - 8, target.top + 8)),
    });
    document.querySelector(selector)?.setAttribute('data-tour', '');
    box.current?.querySelector<HTMLElement>('.primary')?.focus();
    return () => document.querySelector(selector)?.removeAttribute('data-tour');
  }, [at]);
  const end = (): void => {
    step.value = null;
    focusStage();
  };
  return (
    <div class="tour" ref={box} role="dialog" aria-labelledby="tour-title" aria-describedby="tour-text" style={{ left: `${place.left}px`, top: `${place.top}px` }}
      onKeyDown={(event) => event.key === 'Escape' && end()}>
      <h2 id="tour-title">{t(title)}</h2>
      <p id="tour-text">{t(text)}</p>
      <div class="buttons">
        <span class="note">{t('{step} of {steps}', { step: at + 1, steps: last + 1 })}</span>
        {at > 0 && <button type="button" class="button small" onClick={() => (step.value = at - 1)}>{t('Back')}</button>}
        <button type="button" class="button small primary" onClick={() => (at < last ? (step.value = at + 1) : end())}>{at < last ? t('Next') : t('Done')}</button>
        {at < last && <button type="button" class="link" onClick={end}>{t('End the tour')}</button>}
      </div>
    </div>
  );
}

function Keys() {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current?.showModal(), []);
  // The browser's event comes later, when the keys may have been asked for again.
  const close = (): void => {
    dialog.current?.close();
    helpShown.value = false;
  };
  const cancel = (event: Event): void => {
    event.preventDefault();
    close();
  };
  return (
    <dialog ref={dialog} class="help" aria-labelledby="help-title" onCancel={cancel} onClose={(event) => event.currentTarget.isConnected && close()}>
      <div class="help-head">
        <h2 id="help-title">{t('Keys')}</h2>
        <button type="button" class="button small" onClick={() => {
          close();
          step.value = 0;
        }}>{t('Short tour')}</button>
        <Tool icon="close" label={t('Close')} onClick={close} />
      </div>
      <dl>
        {helpKeys.map(([keys, text]) => (
          <div key={keys}><dt>{keys.split(' ').map((key) => <kbd key={key}>{key}</kbd>)}</dt><dd>{t(text)}</dd></div>
        ))}
      </dl>
    </dialog>
  );
}

export const Help = () => <>{helpShown.value && <Keys />}{step.value !== null && <Tour />}</>;
