// A class as the page grades it, and grades as the service answers them (api/openapi.yaml, Grade).
import type { Finding } from '../api.ts';

export interface Place {
  who: string;
  message?: string;
  file?: string;
  line?: number;
  column?: number;
  excerpt?: string;
}

export interface Cause {
  code: string;
  criterion: string;
  message: string;
  points: number;
  seen: boolean;
  spoils: number;
  file?: string;
  line?: number;
  column?: number;
  excerpt?: string;
  places: Place[];
}

export interface CriterionGrade {
  measure: string;
  kind?: 'requirement' | 'manual';
  text?: string;
  state?: 'met' | 'partly met' | 'not met' | 'open' | 'marked';
  points: number;
  most: number;
  measured?: number;
  reason: string;
  found?: number;
  needed?: number;
  matches?: Place[];
  misses?: Place[];
}

export type Diagnostic = Finding & { excerpt?: string };

export interface View {
  name: string;
  time: number;
  width: number;
  height: number;
  difference?: number;
  flip?: { mean: number; p95: number };
  ssim?: number;
  coverage?: number;
  depth?: number;
  normals?: number;
}

export interface Grade {
  state: 'graded' | 'not graded';
  reason?: { code: string; message: string };
  similarity?: number;
  points: number;
  most: number;
  passed: boolean;
  refused: boolean;
  present: number;
  visible: boolean;
  penalty: number;
  unexplained: { points: number; share: number };
  criteria: CriterionGrade[];
  findings: Cause[];
  diagnostics: Diagnostic[];
  views: View[];
  overrides?: { criterion?: string; mark?: number; comment?: string }[];
}

/** The images of one view; what the submission shares with the reference, or has not, is null. */
export interface ViewImages {
  picture: Blob | null;
  heat: Blob | null;
}

export interface Failure {
  code: string;
  message: string;
}

/** What the service answered for one task of one submission, and the rubric that it graded by. */
export interface Result {
  grade?: Grade;
  failure?: Failure;
  rubric: string;
}

/** What is handed in by a student: a scene, an image or an archive, as one file. */
export interface Submission {
  id: string;
  name: string; // the student's; empty where the file's name has none
  identifier: string; // "Participant 17", or empty
  fileName: string;
  bytes: number;
}

/** One exercise of the class: a reference, if its rubric needs one, and a rubric. */
export interface Task {
  name: string; // empty where there is one
  reference: { name: string; fileName: string; file: Blob } | null;
  rubric: { name: string; text: string } | null; // JSON; null: the default
}

/** A row of overrides.csv. */
export interface Override {
  student: string;
  task: string;
  criterion: string;
  mark: number | null;
  comment: string;
}

/** A row of groups.csv. */
export interface GroupMember {
  submission: string;
  name: string;
  identifier: string;
}

export const resultKey = (task: string, submission: string): string => `${task}\n${submission}`;
