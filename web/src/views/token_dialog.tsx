// Asks for the token that the server wants.
import { useEffect, useRef } from 'preact/hooks';
import { question } from '../token.ts';
import { t } from '../words.ts';

export function TokenDialog() {
  const dialog = useRef<HTMLDialogElement>(null), field = useRef<HTMLInputElement>(null);
  const now = question.value;
  useEffect(() => {
    if (!now || !dialog.current) return;
    dialog.current.showModal();
    field.current?.focus();
  }, [now]);
  if (!now) return null;
  return (
    <dialog ref={dialog} class="token" aria-labelledby="token-title" onClose={() => now.answer(null)}>
      <form onSubmit={(event) => {
        event.preventDefault();
        const typed = field.current?.value.trim() ?? '';
        now.answer(typed);
        dialog.current?.close();
      }}>
        <h2 id="token-title">{t('This server wants a token')}</h2>
        <p id="token-why">{now.sentence}</p>
        <label class="field">
          <span>{t('Token')}</span>
          <input ref={field} type="password" autocomplete="off" spellcheck={false} aria-describedby="token-why" required />
        </label>
        <p class="note">{t('It is kept while this tab is open, and sent to this server alone.')}</p>
        <div class="buttons">
          <button type="submit" class="button primary">{t('Go on')}</button>
          <button type="button" class="button" onClick={() => dialog.current?.close()}>{t('Cancel')}</button>
        </div>
      </form>
    </dialog>
  );
}
