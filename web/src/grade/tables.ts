// The grader's tables, which the service has as api/schema.json: measures, kinds of causes, the rubric's schema.
import type { Schema } from './schema_check.ts';

export interface Measure {
  name: string;
  summary: string;
  weight: number;
  pictures?: boolean; // of images that no scene is known of, too; of image measures alone
  tolerance?: number;
  limit?: number;
  perFinding?: number;
}

export interface Kind {
  code: string;
  criterion: string;
  least: number; // hundredths of the points
  most: number;
}

export interface GradeTables {
  gradeMeasures: Measure[];
  gradeKinds: Kind[];
  gradeFormats: { name: string; file: string; of: 'class' | 'submission'; summary: string }[];
  rubric: Schema;
  defaultRubric: Record<string, unknown>;
}

let loading: Promise<GradeTables> | null = null;

export function gradeTables(): Promise<GradeTables> {
  loading ??= import('document:schema').then((module) => JSON.parse(module.default) as GradeTables);
  loading.catch(() => (loading = null));
  return loading;
}
