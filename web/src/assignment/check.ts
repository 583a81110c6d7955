// An assignment as a student's page uses it (api/openapi.yaml).
import { findingsOf, Problem, problemOf, type Finding } from '../api.ts';
import type { Subject } from '../grade/submissions.ts';
import type { Language } from '../words.ts';

export interface Assignment {
  id: string;
  title: string;
  open: boolean;
  opens: string | null;
  closes: string | null;
  shows: string[];
  bands: number;
  mask: boolean;
  tries: number;
}

export interface Thing {
  who: string;
  message?: string;
  file?: string;
  line?: number;
}

export interface Answer {
  points: { band: number; bands: number; fromPercent: number; toPercent: number };
  tries: { left: number; next: string | null };
  requirements?: { id: string; text: string; state: 'met' | 'partly met' | 'not met'; reason: string; matches: Thing[]; misses: Thing[] }[];
  findings?: { criterion: string; message: string; file?: string; line?: number }[];
  mask?: { columns: number; rows: number; cells: string };
  image?: string;
  diagnostics?: Finding[];
}

const pathOf = (id: string): string => `v1/assignments/${encodeURIComponent(id)}`;

async function answerOf<T>(url: string, init: RequestInit): Promise<T> {
  // The token of a teacher in this browser is not sent: the page shows what students see.
  const response = await fetch(url, init);
  if (!response.ok) throw await problemOf(response);
  return (await response.json()) as T;
}

/** Null where there is no such assignment. */
export async function getAssignment(id: string, language: Language): Promise<Assignment | null> {
  try {
    return await answerOf(pathOf(id), { headers: { 'Accept-Language': language } });
  } catch (fault) {
    if (fault instanceof Problem && fault.status === 404) return null;
    throw fault;
  }
}

export function checkSubmission(id: string, code: string, subject: Subject, language: Language): Promise<Answer> {
  const form = new FormData();
  form.append('submission', subject.file, subject.fileName);
  return answerOf(`${pathOf(id)}/check`, {
    method: 'POST', body: form, headers: { Authorization: `Bearer ${code}`, 'Accept-Language': language },
  });
}

/** What went wrong, in the student's language. */
export const messagesOf = (fault: unknown, noAnswer: string): string[] =>
  fault instanceof TypeError ? [noAnswer] : findingsOf(fault).map((one) => one.message);
