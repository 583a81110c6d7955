// The tables of `farol grade` (grade/report/report.cpp): grades.csv, criteria.csv, overrides.csv, groups.csv, junit.xml.
import { t } from '../words.ts';
import { forCsv, readCsv } from './csv.ts';
import type { StudentMark, TaskMark } from './marks.ts';
import { membersOf } from './names.ts';
import type { Diagnostic, GroupMember, Override } from './types.ts';

/** A class as its reports are made of it. */
export interface ClassReport {
  title: string;
  tasks: readonly string[];
  groups: readonly GroupMember[];
  marks: readonly StudentMark[];
}

const listedLines = 6;
const points = (value: number): string => value.toFixed(2);
const hasMark = ({ grade }: TaskMark): boolean => grade !== undefined && !grade.refused;

function withLines(text: string, lines: readonly number[]): string {
  if (lines.length === 0) return text;
  if (lines.length === 1) return t('{text} (line {line})', { text, line: lines[0] as number });
  const listed = lines.slice(0, listedLines).join(', '), more = lines.length - listedLines;
  return more > 0 ? t('{text} (lines {lines} and {more} more)', { text, lines: listed, more }) : t('{text} (lines {lines})', { text, lines: listed });
}

/** An error at several places once, with its lines. */
function errorLines(diagnostics: readonly Diagnostic[], isCharged: boolean): string[] {
  const found = new Map<string, number[]>();
  for (const { severity, message, line } of diagnostics) {
    if (severity !== 'error' && !isCharged) continue;
    const lines = found.get(message) ?? [];
    found.set(message, line ? [...lines, line] : lines);
  }
  return [...found].map(([text, lines]) => withLines(text, lines));
}

/** The text for a student: comments, each loss, then each finding. */
export function feedbackOf({ comments, tasks }: StudentMark): string {
  const out = [...comments];
  for (const { task, grade, failure } of tasks) {
    const line = (text: string): void => void out.push((task ? `${task}: ` : '') + text);
    if (failure) line(failure.message);
    if (!grade) continue;
    for (const { criterion, comment } of grade.overrides ?? []) if (comment) line((criterion ? `${criterion}: ` : '') + comment);
    if (grade.reason && grade.diagnostics.length === 0) line(t('not graded: {reason}', { reason: grade.reason.message }));
    for (const { message, points: cost, code } of grade.findings)
      if (cost > 0) line(`${message} (-${points(cost)})`);
      else if (code.endsWith('.missing')) line(message);
    if (grade.unexplained.points > 0)
      line(t('unexplained: the pictures differ for a reason that was not found (-{points})', { points: points(grade.unexplained.points) }));
    for (const text of errorLines(grade.diagnostics, grade.penalty > 0)) line(text);
    for (const one of grade.criteria) if (one.measured !== undefined && one.points < one.most && !grade.refused) line(one.reason);
  }
  return out.join('\n');
}

const identity = ({ name, identifier }: { name: string; identifier: string }): string =>
  `${forCsv(identifier && !/^participant /i.test(identifier) ? `Participant ${identifier}` : identifier)},${forCsv(name)}`;

/** Moodle's offline grading worksheet, which wants even the empty column. */
export function gradesCsv({ marks, groups }: ClassReport): string {
  const lines = marks.flatMap((mark) => {
    const comments = forCsv(feedbackOf(mark));
    return membersOf(groups, mark.submission).map((member) => [
      identity(member), mark.graded ? points(mark.points) : '', points(mark.most), '', mark.graded ? (mark.passed ? 'yes' : 'no') : '',
      forCsv(mark.submission.id), comments,
    ].join(','));
  });
  return ['Identifier,Full name,Grade,Maximum Grade,Last modified (grade),Passed,Submission,Feedback comments', ...lines, ''].join('\r\n');
}

/** A row a student, a column for each task and each criterion of it; empty where there is no mark. */
export function criteriaCsv({ marks, groups, tasks }: ClassReport): string {
  const measures = tasks.map((_, at) => {
    const known = new Set<string>();
    // By name in each grade, as they first appear.
    for (const mark of marks) for (const measure of (mark.tasks[at]?.grade?.criteria ?? []).map((one) => one.measure).sort()) known.add(measure);
    return [...known];
  });
  const head = ['Identifier,Full name,Submission,Grade,By hand', ...tasks.flatMap((task, at) => [
    ...(task ? [forCsv(task)] : []), ...(measures[at] ?? []).map((measure) => forCsv((task ? `${task}: ` : '') + measure)),
  ])].join(',');
  const lines = marks.flatMap((mark) => {
    const fields = tasks.flatMap((task, at) => {
      const one = mark.tasks[at] as TaskMark, isMarked = hasMark(one);
      return [...(task ? [isMarked ? points(one.grade?.points ?? 0) : ''] : []), ...(measures[at] ?? []).map((measure) => {
        const found = one.grade?.criteria.filter((entry) => entry.measure === measure).at(-1);
        return isMarked && found ? points(found.points) : '';
      })];
    });
    const byHand = mark.overridden || mark.tasks.some(({ grade }) => grade?.overrides);
    return membersOf(groups, mark.submission).map((member) =>
      [identity(member), forCsv(mark.submission.id), mark.graded ? points(mark.points) : '', byHand ? 'yes' : '', ...fields].join(','));
  });
  return [head, ...lines, ''].join('\r\n');
}

export const overridesCsv = (rows: readonly Override[]): string => ['student,task,criterion,mark,comment', ...rows.map(({ student, task, criterion, mark, comment }) =>
  [forCsv(student), forCsv(task), forCsv(criterion), mark ?? '', forCsv(comment)].join(',')), ''].join('\r\n');

/** Reads overrides.csv; throws Error with the line. */
export function readOverrides(text: string, file: string): Override[] {
  const table = readCsv(text, file, ['student', 'mark', 'comment']);
  return Array.from({ length: table.count }, (_, i) => {
    const written = table.at(i, 'mark'), mark = written === '' ? null : Number(written.replace(',', '.'));
    if (mark !== null && !(mark >= 0 && mark <= 1e6))
      throw new Error(t('{file}, line {line}: the mark is "{value}"; expected a number of 0 or more', { file, line: table.lineOf(i), value: written }));
    return { student: table.at(i, 'student'), task: table.at(i, 'task'), criterion: table.at(i, 'criterion').toLowerCase(), mark, comment: table.at(i, 'comment') };
  });
}

/** Reads groups.csv; throws Error with the line. */
export function readGroups(text: string, file: string): GroupMember[] {
  const table = readCsv(text, file, ['submission', 'full name', 'identifier']);
  return Array.from({ length: table.count }, (_, i) =>
    ({ submission: table.at(i, 'submission'), name: table.at(i, 'full name'), identifier: table.at(i, 'identifier').replace(/^participant /i, '') }));
}

/** Text of an attribute or an element: characters that XML has no place for are left out. */
const forMarkup = (text: string): string => text.replace(/[\u0000-\u0008\u000B-\u001F\uFFFE\uFFFF]/g, '')
  .replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;').replaceAll('\n', '&#10;').replaceAll('\t', '&#9;');

/** JUnit's XML, for CI services. */
export function junitXml(report: ClassReport): string {
  const all = report.marks.flatMap((mark) => mark.tasks.map((task) => ({ mark, task })));
  const isFailed = ({ grade }: TaskMark): boolean => grade !== undefined && !grade.refused && !grade.passed;
  const counts = `tests="${all.length}" failures="${all.filter(({ task }) => isFailed(task)).length}" errors="${all.filter(({ task }) => !hasMark(task)).length}"`;
  const cases = all.map(({ mark, task }) => {
    const { grade, failure } = task;
    const result = failure ? `<error type="${forMarkup(failure.code)}" message="${forMarkup(failure.message)}"/>`
      : grade?.refused ? `<error type="grade.refused" message="${forMarkup(feedbackOf(mark))}"/>`
      : isFailed(task) ? `<failure message="${points(grade?.points ?? 0)} of ${points(grade?.most ?? 0)} points">${forMarkup(feedbackOf(mark))}</failure>` : '';
    return `<testcase classname="${forMarkup(mark.submission.id)}" name="${forMarkup(task.task || 'grade')}">${result}` +
      `<system-out>${points(grade?.points ?? 0)} points</system-out></testcase>\n`;
  });
  return `<?xml version="1.0" encoding="UTF-8"?>\n<testsuites ${counts}>\n<testsuite name="${forMarkup(report.title)}" ${counts}>\n${cases.join('')}</testsuite>\n</testsuites>\n`;
}
