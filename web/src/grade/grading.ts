// Grades of many submissions against one reference, a few at a time.
import { signal } from '@preact/signals';
import { findingsOf, patient, request, sentence, type Finding } from '../api.ts';
import { studentOf, type Subject } from './submissions.ts';

export interface Grade {
  points: number;
  most: number;
  passed: boolean;
  refused: boolean;
  reason?: { code: string; message: string };
  similarity?: number;
  visible: boolean;
  penalty: number;
  criteria: { measure: string; points: number; most: number; measured?: number; reason: string }[];
  findings: { code: string; message: string; points: number; file?: string; line?: number; column?: number; excerpt?: string }[];
  diagnostics: Finding[];
  views: { name: string; time: number; width: number; height: number; picture?: string; heat?: string; difference: number; ssim?: number; flip?: { mean: number } }[];
}

export interface Row {
  subject: Subject;
  state: 'waiting' | 'grading' | 'done' | 'failed';
  grade?: Grade;
  problem?: string;
}

const atOnce = 2;

export class Grading {
  readonly reference = signal<Subject | null>(null);
  readonly rubric = signal<{ name: string; file: Blob } | null>(null);
  readonly rows = signal<Row[]>([]);
  readonly running = signal(false);

  add(subjects: readonly Subject[]): void {
    const names = new Set(subjects.map((one) => one.name));
    const kept = this.rows.value.filter((row) => !names.has(row.subject.name));
    this.rows.value = [...kept, ...subjects.map((subject): Row => ({ subject, state: 'waiting' }))];
  }

  clear(): void {
    this.rows.value = [];
  }

  async run(): Promise<void> {
    const reference = this.reference.value;
    if (!reference || this.running.value) return;
    this.running.value = true;
    this.rows.value = this.rows.value.map(({ subject }) => ({ subject, state: 'waiting' }));
    const queue = this.rows.value.map((row) => row.subject);
    const worker = async (): Promise<void> => {
      for (let next = queue.shift(); next; next = queue.shift()) await this.gradeOne(next, reference);
    };
    await Promise.all(Array.from({ length: atOnce }, worker));
    this.running.value = false;
  }

  private set(subject: Subject, row: Omit<Row, 'subject'>): void {
    this.rows.value = this.rows.value.map((one) => (one.subject === subject ? { subject, ...row } : one));
  }

  private async gradeOne(subject: Subject, reference: Subject): Promise<void> {
    this.set(subject, { state: 'grading' });
    const form = new FormData();
    form.append('submission', subject.file, subject.fileName);
    form.append('reference', reference.file, reference.fileName);
    if (this.rubric.value) form.append('rubric', this.rubric.value.file, this.rubric.value.name);
    try {
      const response = await patient(() => request('v1/grade', { method: 'POST', body: form }));
      this.set(subject, { state: 'done', grade: (await response.json()) as Grade });
    } catch (fault) {
      this.set(subject, { state: 'failed', problem: findingsOf(fault).map((one) => sentence(one)).join(' ') });
    }
  }
}

const cell = (text: string): string => {
  // A cell that begins like a formula is text to every spreadsheet.
  const safe = /^[=+\-@\t]/.test(text) ? `'${text}` : text;
  return /[",\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
};

/** The columns of the reports of `farol grade`: Moodle's, which wants even the empty one. */
export function csvOf(rows: readonly Row[]): string {
  const points = (value: number | undefined): string => value?.toFixed(2) ?? '';
  const lines = rows.map(({ subject, grade, problem }) => {
    const student = studentOf(subject.name);
    const feedback = grade ? [...grade.findings.filter((one) => one.points > 0), ...grade.diagnostics.filter((one) => one.severity === 'error'),
      ...(grade.reason && !grade.diagnostics.length ? [grade.reason] : [])].map((one) => one.message).join('; ') : (problem ?? '');
    // What is not graded has no mark: an empty cell, not 0.
    const graded = grade && !grade.refused ? grade : undefined;
    return [
      cell(student.identifier), cell(student.name), points(graded?.points), points(grade?.most), '', graded ? (graded.passed ? 'yes' : 'no') : '',
      cell(subject.name), cell(feedback),
    ].join(',');
  });
  return ['Identifier,Full name,Grade,Maximum Grade,Last modified (grade),Passed,Submission,Feedback comments', ...lines].join('\r\n').concat('\r\n');
}
