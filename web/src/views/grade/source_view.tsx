// A submission's document beside what is wrong with it, read-only, at a line.
import { signal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { sourceOf } from '../../grade/source.ts';
import { submissionFiles } from '../../grade/store.ts';
import type { Submission } from '../../grade/types.ts';
import { t } from '../../words.ts';
import { Tool } from '../ui.tsx';

interface Open {
  submission: string;
  path: string;
  lines: string[];
  line: number;
  from: number;
  problem: string;
}

const around = 200; // lines before and after the one that is meant

export const openSource = signal<Open | null>(null);

/** Shows the document that a place names, at its line. */
export async function showSource(submission: Submission, file: string | undefined, line: number): Promise<void> {
  const empty = { submission: submission.id, path: file ?? submission.fileName, lines: [], line, from: 0 };
  try {
    const blob = await submissionFiles.get(submission.id);
    if (!blob) throw new Error(t('The browser no longer has this file. Add it again.'));
    const { path, text } = await sourceOf(blob, submission.fileName, file ?? submission.fileName);
    openSource.value = { ...empty, path, lines: text.split(/\r\n|\r|\n/), from: Math.max(0, line - 1 - around), problem: '' };
  } catch (fault) {
    openSource.value = { ...empty, problem: (fault as Error).message };
  }
}

export function SourceView({ submission }: { submission: Submission }) {
  const open = openSource.value, box = useRef<HTMLDivElement>(null), here = useRef<HTMLLIElement>(null);
  const isHere = open?.submission === submission.id;
  useEffect(() => {
    if (!isHere || !box.current) return;
    const row = here.current;
    if (row) box.current.scrollTop = row.offsetTop - box.current.clientHeight / 2;
    box.current.focus({ preventScroll: true });
    box.current.scrollIntoView({ block: 'nearest' });
  }, [open]);
  if (!open || !isHere) return null;
  const end = Math.min(open.lines.length, open.line + around), move = (from: number): void => void (openSource.value = { ...open, from: Math.max(0, from) });
  return (
    <section class="source" aria-label={t('Document {path}', { path: open.path })}>
      <div class="source-head"><b>{open.path}</b><span class="space" />
        <Tool icon="close" label={t('Close the document')} onClick={() => (openSource.value = null)} /></div>
      {open.problem ? <p class="problem">{open.problem}</p> : (
        <div class="lines" ref={box} tabIndex={0} role="region" aria-label={t('Line {line} of {path}', { line: open.line, path: open.path })}>
          {open.from > 0 && <button type="button" class="link" onClick={() => move(open.from - around)}>{t('Earlier lines')}</button>}
          <ol start={open.from + 1}>
            {open.lines.slice(open.from, Math.max(end, open.from + 2 * around)).map((text, i) => {
              const at = open.from + i + 1, isMeant = at === open.line;
              return <li key={at} value={at} {...(isMeant ? { ref: here, class: 'here', 'aria-current': 'true' as const } : {})}><code>{text || ' '}</code></li>;
            })}
          </ol>
        </div>
      )}
    </section>
  );
}
