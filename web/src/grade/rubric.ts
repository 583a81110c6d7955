// Rubrics as the service reads them: what is left out is the default's.
import { t } from '../words.ts';
import { checkBySchema, lineOf, type SchemaProblem } from './schema_check.ts';
import type { GradeTables } from './tables.ts';

export interface Criterion {
  measure: string;
  weight: number;
  tolerance?: number;
  limit?: number;
  perFinding?: number;
}

export interface Requirement {
  id: string;
  text: string;
  points: number;
  [key: string]: unknown;
}

/** A rubric with every key that marks are made of. */
export interface Rubric {
  title: string;
  points: number;
  weight: number;
  passMark: number;
  strictness: number;
  criteria: Criterion[];
  requirements: Requirement[];
  manual: { id: string; text: string; points: number }[];
  penalties: { warning: number; most: number; codes: Record<string, number> };
  [key: string]: unknown;
}

export type RubricDocument = Record<string, unknown>;

export const requiredPoints = (rubric: Pick<Rubric, 'requirements' | 'manual'>): number =>
  [...rubric.requirements, ...rubric.manual].reduce((sum, one) => sum + one.points, 0);

/** The points that the comparison with a reference shares; 0: no reference is needed. */
export function comparedPoints(rubric: Rubric): number {
  const left = rubric.points - requiredPoints(rubric);
  return Math.abs(left) < 1e-6 ? 0 : left;
}

type Loose = Record<string, unknown>;
const objectOf = (value: unknown): Loose => (typeof value === 'object' && value !== null && !Array.isArray(value) ? (value as Loose) : {});
const listOf = (value: unknown): Loose[] => (Array.isArray(value) ? value.map(objectOf) : []);
const withoutNulls = (object: Loose): Loose => Object.fromEntries(Object.entries(object).filter(([, value]) => value !== null));

/** The document with all that it leaves out; as grade/rubric/rubric.cpp reads it. */
export function resolved(document: RubricDocument, tables: GradeTables): Rubric {
  const usual = structuredClone(tables.defaultRubric), given = withoutNulls(document);
  const merged = { ...usual, title: 'Rubric', ...given } as Rubric;
  merged['picture'] = { ...objectOf(usual['picture']), ...withoutNulls(objectOf(given['picture'])) };
  const penalties = objectOf(given['penalties']), usualPenalties = objectOf(usual['penalties']);
  merged.penalties = { ...usualPenalties, ...withoutNulls(penalties) } as Rubric['penalties'];
  merged.criteria = listOf(merged.criteria).map((one) => {
    const measure = tables.gradeMeasures.find(({ name }) => name === one['measure']);
    const { weight = 1, tolerance, limit, perFinding } = measure ?? {};
    const defaults = { weight, ...(tolerance === undefined ? { perFinding } : { tolerance, limit }) };
    return { ...defaults, ...withoutNulls(one) } as unknown as Criterion;
  });
  merged.requirements = listOf(merged.requirements).map((one) => ({ points: 1, ...withoutNulls(one) }) as Requirement);
  merged.manual = listOf(merged.manual).map((one) => ({ points: 1, ...withoutNulls(one) }) as Rubric['manual'][number]);
  const sum = requiredPoints(merged);
  if (sum > 0 && !('points' in given) && !('criteria' in given)) merged.points = sum;
  return merged;
}

export interface RubricCheck {
  document: RubricDocument | null; // null: it is no JSON
  problems: (SchemaProblem & { line: number })[];
}

/** Rules that stand between values, which a schema has no words for. */
function relations(rubric: Rubric, tables: GradeTables): SchemaProblem[] {
  const out: SchemaProblem[] = [], seen = new Set<string>(tables.gradeMeasures.map(({ name }) => name)), measures = new Set<string>();
  rubric.criteria.forEach(({ measure, tolerance, limit }, i) => {
    if (measures.has(measure)) out.push({ pointer: `/criteria/${i}/measure`, message: t('is duplicated: "{name}"', { name: measure }) });
    measures.add(measure);
    if (tolerance !== undefined && limit !== undefined && tolerance >= limit)
      out.push({ pointer: `/criteria/${i}/tolerance`, message: t('is not below the limit, {limit}', { limit }) });
  });
  for (const key of ['requirements', 'manual'] as const)
    rubric[key].forEach(({ id }, i) => {
      if (seen.has(id)) out.push({ pointer: `/${key}/${i}/id`, message: t('is duplicated: "{name}"', { name: id }) });
      seen.add(id);
    });
  if (rubric.criteria.reduce((sum, one) => sum + one.weight, 0) <= 0) out.push({ pointer: '/criteria', message: t('has no weight above 0') });
  if (comparedPoints(rubric) < 0)
    out.push({ pointer: '/points', message: t('is {points}; requirements and parts marked by hand have {sum} together', { points: rubric.points, sum: requiredPoints(rubric) }) });
  return out;
}

/** The line of a fault of JSON.parse: Firefox writes the line, Chromium the line or the index; without either the last line. */
export function lineOfFault(text: string, message: string): number {
  const line = /\bline (\d+)/.exec(message)?.[1], index = /\bposition (\d+)/.exec(message)?.[1];
  return line ? Number(line) : text.slice(0, index ? Number(index) : text.length).split('\n').length;
}

/** Reads a rubric's text, and says what is wrong and in which line. */
export function checkRubric(text: string, tables: GradeTables): RubricCheck {
  let document: unknown;
  try {
    document = JSON.parse(text);
  } catch (fault) {
    const message = (fault as Error).message;
    return { document: null, problems: [{ pointer: '', line: lineOfFault(text, message), message: t('is no JSON: {reason}', { reason: message }) }] };
  }
  let problems = checkBySchema(document, tables.rubric);
  if (problems.length === 0) problems = relations(resolved(document as RubricDocument, tables), tables);
  return { document: document as RubricDocument, problems: problems.map((one) => ({ ...one, line: lineOf(text, one.pointer) })) };
}

export const rubricText = (document: RubricDocument): string => `${JSON.stringify(document, null, 2)}\n`;
