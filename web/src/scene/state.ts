// What is on show and why, as one word: each looks different at a glance.
import { findingsOf, Problem, type Finding } from '../api.ts';

/** `incomplete`: drawn, with placeholders for what has an error. */
export type SceneState = 'loading' | 'drawn' | 'warned' | 'incomplete' | 'failed' | 'gone' | 'offline';

/** Why the last request gave no picture. */
export interface Fault {
  kind: 'gone' | 'offline' | 'failed';
  findings: readonly Finding[];
}

/** A gateway that does not reach the service answers with one of these. */
const gatewayStatuses = [502, 504];

export function sceneFaultOf(thrown: unknown): Fault {
  const findings = findingsOf(thrown);
  if (thrown instanceof TypeError || (thrown instanceof Problem && gatewayStatuses.includes(thrown.status))) return { kind: 'offline', findings };
  return { kind: thrown instanceof Problem && thrown.status === 404 ? 'gone' : 'failed', findings };
}

/** How many of each; infos are no findings that need an answer. */
export function countFindings(findings: readonly Finding[]): { errors: number; warnings: number } {
  const of = (severity: Finding['severity']): number => findings.filter((one) => one.severity === severity).length;
  return { errors: of('error'), warnings: of('warning') };
}

export function stateOf(fault: Fault | null, pictured: boolean, findings: readonly Finding[]): SceneState {
  if (fault) return fault.kind;
  if (!pictured) return 'loading';
  const { errors, warnings } = countFindings(findings);
  return errors > 0 ? 'incomplete' : warnings > 0 ? 'warned' : 'drawn';
}

/** Seconds until a server that does not answer is asked again: 1, 2, 4, 8, then every 15. */
export const retryAfterS = (attempt: number): number => Math.min(15, 2 ** Math.min(attempt, 4));

// Not by their messages: those of an image are in English, those of a document in the reader's language.
const keyOf = ({ code, file, line, column }: Finding): string => JSON.stringify([code, file, line, column]);

/**
 * All findings of a picture. Its header holds the first ones only; the document's list has all of them, unless it
 * is of another version: then none of its findings came with the picture.
 */
export function wholeFindings(document: readonly Finding[], picture: readonly Finding[]): Finding[] {
  const sent = new Set(picture.map(keyOf)), known = new Set(document.map(keyOf));
  if (!document.some((one) => one.severity !== 'info' && sent.has(keyOf(one)))) return [...picture];
  return [...document, ...picture.filter((one) => !known.has(keyOf(one)))];
}
