// Numbers as a document writes them: a changed one keeps the decimals, and the other habits, of the one before.

export interface NumberStyle {
  decimals: number; // at least so many are written
  isBare: boolean; // .5 for 0.5
  suffix: string; // f, as in C
}

export const plainStyle: NumberStyle = { decimals: 0, isBare: false, suffix: '' };

/** The number that a text begins with, as the service reads it: a decimal comma is a point. */
export function parseNumber(text: string): number | undefined {
  const value = Number.parseFloat(text.trim().replace(',', '.'));
  return Number.isFinite(value) ? value : undefined;
}

export function styleOf(text: string): NumberStyle {
  const found = /^\s*[+-]?(\d*)(?:[.,](\d*))?(?:e[+-]?\d+)?(f?)\s*$/i.exec(text);
  if (!found) return plainStyle;
  const [, whole = '', decimals = '', suffix = ''] = found;
  return { decimals: decimals.length, isBare: whole === '' && decimals !== '', suffix };
}

/** `decimals`: how many are worth writing; zeros at the end are left out, down to those of the style. */
export function writeNumber(value: number, style: NumberStyle, decimals: number): string {
  const most = Math.min(12, Math.max(style.decimals, decimals)), fixed = value.toFixed(most);
  const [whole = '0', fraction = ''] = fixed.split('.');
  const kept = fraction.slice(0, style.decimals) + fraction.slice(style.decimals).replace(/0+$/, '');
  const isZero = !/[1-9]/.test(fixed), sign = whole.startsWith('-') && !isZero ? '-' : '', digits = whole.replace('-', '');
  return `${sign}${style.isBare && digits === '0' && kept !== '' ? '' : digits}${kept === '' ? '' : `.${kept}`}${style.suffix}`;
}

/** How many decimals a step needs: 0.25 has two. */
export function decimalsOf(step: number): number {
  for (let decimals = 0; decimals < 9; ++decimals) if (Math.abs(step - Number(step.toFixed(decimals))) < 1e-9 * Math.abs(step)) return decimals;
  return 9;
}
