// Small parts that several views share.
import { signal } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import type { Finding } from '../api.ts';
import { sentence } from '../api.ts';
import { cureOf } from '../cures.ts';
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

/** Copies, or shows what could not be copied. */
export async function copy(text: string, what: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    say(`${what} copied.`);
  } catch {
    // Without https the browser gives no clipboard: a prompt can be copied from.
    window.prompt(`${what}:`, text);
  }
}

interface ToolProps {
  icon: IconName;
  label: string;
  keys?: string;
  pressed?: boolean;
  onClick: () => void;
  text?: string;
}

export const Tool = ({ icon, label, keys, pressed, onClick, text }: ToolProps) => (
  <button
    type="button" class={text ? 'tool worded' : 'tool'} aria-label={label} onClick={onClick}
    title={keys ? `${label} (${keys})` : label} {...(pressed === undefined ? {} : { 'aria-pressed': pressed })}
  >
    <Icon name={icon} />{text && <span>{text}</span>}
  </button>
);

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

export function Findings({ findings, onPick }: { findings: readonly Finding[]; onPick?: (finding: Finding) => void }) {
  const notable = findings.filter((one) => one.severity !== 'info');
  if (notable.length === 0) return null;
  return (
    <ol class="findings" aria-label="Findings">
      {notable.map((finding, index) => (
        <li key={index} class={finding.severity}>
          {finding.line && onPick
            ? <button type="button" class="plain" onClick={() => onPick(finding)}>{sentence(finding)}</button>
            : sentence(finding)}
          {cureOf(finding.code) && <small>{cureOf(finding.code)}</small>}
        </li>
      ))}
    </ol>
  );
}
