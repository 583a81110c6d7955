// Small parts that several views share.
import { signal } from '@preact/signals';
import { useEffect, useState } from 'preact/hooks';
import type { ComponentChildren } from 'preact';
import type { Finding } from '../api.ts';
import { animationFormats, sentence } from '../api.ts';
import { cureOf } from '../cures.ts';
import { filesOf } from '../files.ts';
import type { NamedFile } from '../scene/bundle.ts';
import { dropping } from '../upload.ts';
import { t } from '../words.ts';
import { Icon, type IconName } from './icons.tsx';

const toast = signal('');
let toastTimer: ReturnType<typeof setTimeout> | undefined;

/** A short word that something was done. */
export function say(text: string): void {
  toast.value = text;
  clearTimeout(toastTimer);
  toastTimer = setTimeout(() => (toast.value = ''), 4000);
}

export const Toast = () => (
  <div class={toast.value ? 'toast shown' : 'toast'} role="status">{toast.value}</div>
);

/** Copies and says so in the words `done`, or shows what could not be copied. */
export async function copy(text: string, done: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    say(done);
  } catch {
    // Without https the browser gives no clipboard: a prompt can be copied from.
    window.prompt(t('Copy this:'), text);
  }
}

/** For a button that cannot be pressed just now, and keeps the focus. */
export const pressable = (isOn: boolean, act: () => void) => ({ onClick: () => isOn && act(), ...(isOn ? {} : { 'aria-disabled': true }) });

interface ToolProps {
  icon: IconName;
  label: string; // its name, which `shows` makes visible: beside the icon, or below it where there is room
  shows?: 'beside' | 'below';
  hint?: string; // longer, for the tooltip
  keys?: string;
  pressed?: boolean;
  disabled?: boolean;
  id?: string;
  tabIndex?: 0 | -1;
  onClick: () => void;
}

export const Tool = ({ icon, label, shows, hint, keys, pressed, disabled, id, tabIndex, onClick }: ToolProps) => (
  <button
    type="button" class={shows === 'beside' ? 'tool worded' : 'tool'} aria-label={label} {...pressable(!disabled, onClick)} {...(id ? { id } : {})}
    {...(tabIndex === undefined ? {} : { tabIndex })}
    title={keys ? `${hint ?? label} (${keys})` : (hint ?? label)} {...(pressed === undefined ? {} : { 'aria-pressed': pressed })}
  >
    <Icon name={icon} />{shows && <span {...(shows === 'below' ? { class: 'short' } : {})}>{label}</span>}
  </button>
);

const arrows: Record<string, number> = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1, Home: -Infinity, End: Infinity };

/** Moves the focus among the buttons of a toolbar: by arrows, round at its ends, and to its first and last. */
export function toolbarKeys(event: KeyboardEvent): void {
  const step = arrows[event.key];
  if (step === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
  const tools = [...(event.currentTarget as Element).querySelectorAll('button')].filter((one) => one.getClientRects().length > 0 && !one.closest('dialog')), at = tools.indexOf(event.target as HTMLButtonElement);
  if (at < 0) return;
  event.preventDefault();
  const next = step === -Infinity ? 0 : step === Infinity ? tools.length - 1 : (at + step + tools.length) % tools.length;
  tools[next]?.focus();
}

export const Check = ({ label, checked, onChange }: { label: string; checked: boolean; onChange: (on: boolean) => void }) => (
  <label class="check">
    <input type="checkbox" checked={checked} onChange={(event) => onChange(event.currentTarget.checked)} />
    <span>{label}</span>
  </label>
);

export const Choice = ({ label, value, choices, onChange }: {
  label: string; value: string; choices: readonly (readonly [string, string])[]; onChange: (value: string) => void;
}) => (
  <label class="field">
    <span>{label}</span>
    <select value={value} onChange={(event) => onChange(event.currentTarget.value)}>
      {choices.map(([key, text]) => <option key={key} value={key} selected={key === value}>{text}</option>)}
    </select>
  </label>
);

export const Section = ({ title, children }: { title: string; children: ComponentChildren }) => (
  <section class="section"><h3>{title}</h3>{children}</section>
);

/** The formats of animations that the service can write; none until it answered. */
export function useAnimationFormats(): readonly string[] {
  const [names, setNames] = useState<readonly string[]>([]);
  useEffect(() => {
    let isGone = false;
    void animationFormats().then((all) => isGone || setNames(all));
    return () => void (isGone = true);
  }, []);
  return names;
}

/** What makes an element a place where files can be dropped. */
export const dropHere = (take: (files: readonly NamedFile[]) => void) => ({
  onDragOver(event: DragEvent) {
    if (![...(event.dataTransfer?.types ?? [])].includes('Files')) return;
    event.preventDefault();
    event.stopPropagation();
    dropping.value = false;
    (event.currentTarget as HTMLElement).dataset['over'] = '';
  },
  onDragLeave(event: DragEvent) {
    delete (event.currentTarget as HTMLElement).dataset['over'];
  },
  onDrop(event: DragEvent) {
    event.preventDefault();
    event.stopPropagation();
    delete (event.currentTarget as HTMLElement).dataset['over'];
    if (event.dataTransfer) void filesOf(event.dataTransfer).then(take);
  },
});

/** `repair` answers a finding: what its button says, and what it does with the files that are chosen or dropped on it. */
export interface Repair {
  label: string;
  choose: () => void;
  take: (files: readonly NamedFile[]) => void;
}

export function Findings({ findings, onPick, repair }: {
  findings: readonly Finding[]; onPick?: (finding: Finding) => void; repair?: (finding: Finding) => Repair | null;
}) {
  const notable = findings.filter((one) => one.severity !== 'info');
  if (notable.length === 0) return null;
  return (
    <ol class="findings" aria-label={t('Findings')}>
      {notable.map((finding, index) => [finding, index, repair?.(finding)] as const).map(([finding, index, answer]) => (
        <li key={index} class={finding.severity} {...(answer ? dropHere(answer.take) : {})}>
          {finding.line && onPick
            ? <button type="button" class="plain" onClick={() => onPick(finding)}>{sentence(finding)}</button>
            : sentence(finding)}
          {cureOf(finding.code) && <small>{cureOf(finding.code)}</small>}
          {answer && <button type="button" class="button small" onClick={answer.choose}><Icon name="upload" />{answer.label}</button>}
        </li>
      ))}
    </ol>
  );
}
