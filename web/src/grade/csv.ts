// The tables of `farol grade`: grade/report/csv.h.
import { t } from '../words.ts';

const formula = /^[=+\-@\t\n\uFF1D\uFF0B\uFF0D\uFF20]/;
const maxRows = 100_000;

/** A quoted field; text that a spreadsheet would read as a formula starts with an apostrophe. */
export function forCsv(text: string): string {
  const plain = text.replace(/[\u0000-\u0008\u000B-\u001F\u007F]/g, '');
  return `"${(formula.test(plain) ? `'${plain}` : plain).replaceAll('"', '""')}"`;
}

export interface CsvTable {
  /** A field of a row, trimmed; empty where the table has no such column. */
  at(row: number, column: string): string;
  lineOf(row: number): number;
  count: number;
  columns: string[];
}

/** Reads a spreadsheet's CSV, with commas or semicolons; throws Error with the line and the fix. */
export function readCsv(text: string, file: string, needed: readonly string[]): CsvTable {
  const all = text.replace(/^\uFEFF/, ''), head = all.split('\n', 1)[0] ?? '';
  const separator = head.split(';').length > head.split(',').length ? ';' : ',';
  const rows: { fields: string[]; line: number }[] = [];
  let columns: string[] = [], fields = [''], quoted = false, line = 1, begin = 1;
  const end = (): void => {
    if (fields.some((field) => field.trim() !== '')) {
      if (columns.length === 0) columns = fields.map((field) => field.trim().toLowerCase());
      else rows.push({ fields, line: begin });
    }
    if (rows.length > maxRows) throw new Error(t('{file}, line {line}: the table has more than {most} rows', { file, line, most: maxRows }));
    fields = [''];
    begin = line;
  };
  for (let i = 0; i < all.length; ++i) {
    const c = all[i] as string, last = fields.length - 1, field = fields[last] ?? '';
    if (c === '\n') ++line;
    if (quoted && c === '"' && all[i + 1] === '"') {
      fields[last] = field + c;
      ++i;
    } else if (c === '"' && (quoted || field.trim() === '')) quoted = !quoted;
    else if (!quoted && c === separator) fields.push('');
    else if (!quoted && c === '\n') end();
    else fields[last] = field + c;
  }
  end();
  const lacks = needed.filter((column) => !columns.includes(column));
  if (lacks.length > 0)
    throw new Error(t('{file}, line 1: there is no column "{missing}"; expected the columns {needed}', { file, missing: lacks.join('", "'), needed: needed.join(', ') }));
  return {
    columns, count: rows.length,
    lineOf: (row) => rows[row]?.line ?? 0,
    at(row, column) {
      const field = (rows[row]?.fields[columns.indexOf(column)] ?? '').trim();
      return field.startsWith("'") && formula.test(field.slice(1)) ? field.slice(1) : field;
    },
  };
}
