// Marks of submissions: the service's grades by the rubrics of now, and over them what a person marked.
import { overridesOf } from './names.ts';
import type { Rubric } from './rubric.ts';
import { rounded } from './score.ts';
import type { CriterionGrade, Failure, Grade, Override, Submission } from './types.ts';

/** One task of one submission, as reports hold it. */
export interface TaskMark {
  task: string;
  grade?: Grade;
  failure?: Failure;
  state: 'waiting' | 'grading' | 'stale' | 'done'; // stale: by an earlier rubric or reference
}

/** One submission, as reports hold it. */
export interface StudentMark {
  submission: Submission;
  points: number;
  most: number;
  passed: boolean;
  graded: boolean; // false: no task has a mark
  overridden: boolean;
  comments: string[];
  tasks: TaskMark[];
}

const sameWord = (a: string, b: string): boolean => a.toLowerCase() === b.toLowerCase();

function ungraded({ code, message }: Failure, most: number): Grade {
  return {
    state: 'graded', points: 0, most, passed: false, refused: true, visible: false, present: 0, penalty: 0, unexplained: { points: 0, share: 0 },
    reason: { code, message }, criteria: [], findings: [], diagnostics: [], views: [],
  };
}

/** What a person marked of a task stands over the program's: grade/report/overrides.cpp. */
export function overriddenTask(mark: TaskMark, who: Submission, overrides: readonly Override[], { points: most, passMark }: Pick<Rubric, 'points' | 'passMark'>): TaskMark {
  const rows = overridesOf(overrides, who).filter(({ task, criterion }) => (task !== '' || criterion !== '') && (task === '' || sameWord(task, mark.task)));
  if (rows.length === 0 || (!mark.grade && !mark.failure)) return mark;
  const grade: Grade = structuredClone(mark.grade ?? ungraded(mark.failure as Failure, most));
  let whole: number | null = null, points = grade.points;
  grade.overrides = [];
  for (const { criterion, mark: given, comment } of rows) {
    grade.overrides.push({ ...(criterion ? { criterion } : {}), ...(given === null ? {} : { mark: given }), ...(comment ? { comment } : {}) });
    if (given === null) continue;
    if (criterion === '') {
      whole = Math.min(given, most);
      continue;
    }
    for (const one of grade.criteria as CriterionGrade[]) {
      if (!sameWord(one.measure, criterion)) continue;
      const now = Math.min(given, one.most);
      points += now - one.points;
      one.points = now;
      if (one.kind === 'manual') {
        one.state = 'marked';
        one.reason = comment;
      }
    }
  }
  points = rounded(whole ?? Math.min(most, Math.max(0, points)));
  if (whole !== null) {
    grade.refused = false;
    grade.state = 'graded';
  }
  return { task: mark.task, state: mark.state, grade: { ...grade, points, passed: !grade.refused && points >= most * passMark / 100 } };
}

/** The mark of a submission: of its tasks by their weights, in the first rubric's points. */
export function studentMark(who: Submission, tasks: readonly TaskMark[], rubrics: readonly Rubric[], overrides: readonly Override[]): StudentMark {
  const main = rubrics[0] as Rubric, marked = tasks.map((one, i) => overriddenTask(one, who, overrides, rubrics[i] as Rubric));
  let share = 0, weights = 0, graded = false;
  marked.forEach(({ grade }, i) => {
    const rubric = rubrics[i] as Rubric;
    weights += rubric.weight;
    if (!grade) return;
    share += rubric.weight * grade.points / rubric.points;
    graded = graded || !grade.refused;
  });
  const out: StudentMark = {
    submission: who, points: weights > 0 ? rounded(main.points * share / weights) : 0, most: main.points, passed: false, graded,
    overridden: false, comments: [], tasks: marked,
  };
  out.passed = graded && out.points >= main.points * main.passMark / 100;
  for (const { task, criterion, mark, comment } of overridesOf(overrides, who)) {
    if (task !== '' || criterion !== '') continue;
    if (mark !== null) {
      out.points = Math.min(mark, out.most);
      out.graded = out.overridden = true;
      out.passed = out.points >= out.most * main.passMark / 100;
    }
    if (comment) out.comments.push(comment);
  }
  return out;
}

/** Whether all tasks of the submission have a result. */
export const isDone = ({ tasks }: StudentMark): boolean => tasks.every(({ grade, failure }) => grade || failure);
/** Whether a person marked any of it. */
export const isByHand = ({ overridden, tasks }: StudentMark): boolean => overridden || tasks.some(({ grade }) => grade?.overrides);
