// Reports of a class as files, of the same names and contents as those of `farol grade`.
import pageCss from 'report:page.css';
import pageHtml from 'report:page.html';
import pageJs from 'report:page.js';
import viewCss from 'report:view.css';
import viewJs from 'report:view.js';
import { language, type Language } from '../words.ts';
import { rubrics, tasks, taskNames } from './grading.ts';
import type { StudentMark } from './marks.ts';
import { membersOf } from './names.ts';
import { criteriaCsv, gradesCsv, junitXml, overridesCsv, type ClassReport } from './report_tables.ts';
import { expectedImages, viewImages } from './store.ts';
import { resultKey, type Override, type ViewImages } from './types.ts';
import { ZipWriter } from '../zip.ts';

/** A submission as report.json has it. */
function jsonOf({ submission, points, most, passed, graded, overridden, comments, tasks: all }: StudentMark) {
  return {
    id: submission.id, name: submission.name, ...(submission.identifier ? { identifier: submission.identifier } : {}), points, most, passed, graded,
    ...(overridden ? { overridden: true } : {}), ...(comments.length > 0 ? { comments } : {}),
    tasks: all.map(({ task, grade, failure }) => ({ ...(task ? { task } : {}), ...(failure ? { failure } : { grade: grade ?? null }) })),
  };
}

export const reportJson = ({ title, tasks: names, marks }: ClassReport): string =>
  `{"title":${JSON.stringify(title)},\n"rubric":${JSON.stringify(rubrics.value[0])},\n"tasks":${JSON.stringify(names)},\n"submissions":[\n` +
  `${marks.map((mark) => JSON.stringify(jsonOf(mark))).join(',\n')}\n]}\n`;

const loaders: Record<Exclude<Language, 'en'>, () => Promise<{ default: string }>> = {
  pt: () => import('report:words/pt'), es: () => import('report:words/es'), cs: () => import('report:words/cs'),
};

/** The words of view.js in the reader's language; none for English, which it has. */
const reportWords = async (chosen: Language): Promise<unknown> => (chosen === 'en' ? {} : JSON.parse((await loaders[chosen]()).default));

/** For text in a script element: nothing in it can end the element. */
const forScript = (value: unknown): string => JSON.stringify(value).replaceAll('<', '\\u003c');

async function dataUrl(image: Blob | null | undefined): Promise<string> {
  if (!image) return '';
  const bytes = new Uint8Array(await image.arrayBuffer());
  let text = '';
  for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return `data:${image.type || 'image/jpeg'};base64,${btoa(text)}`;
}

const urlsOf = (images: readonly (Blob | null | undefined)[]): Promise<string[]> => Promise.all(images.map(dataUrl));
const imageScript = async (id: string, images: readonly (Blob | null | undefined)[]): Promise<string> =>
  `<script type="application/json" class="pictures" id="${id}">${JSON.stringify(await urlsOf(images))}</script>\n`;
const flat = (all: readonly ViewImages[] | null): (Blob | null)[] => (all ?? []).flatMap(({ picture, heat }) => [picture, heat]);

/** The text before and after a mark. */
function around(text: string, mark: string): [string, string] {
  const at = text.indexOf(mark);
  return [text.slice(0, at), text.slice(at + mark.length)];
}

/** report.html: a page that works without a network. Submissions are written one after the other. */
export async function reportHtml(report: ClassReport): Promise<Blob> {
  const [head, afterStyle] = around(pageHtml, '/*STYLE*/'), [beforeData, afterData] = around(afterStyle, '<!--DATA-->'), [beforeScript, end] = around(afterData, '/*SCRIPT*/');
  const parts: BlobPart[] = [head, pageCss, viewCss, beforeData];
  const chosen = language.value, about = { title: report.title, tasks: report.tasks, language: chosen, words: await reportWords(chosen) };
  parts.push(`<script type="application/json" id="class">${forScript(about)}</script>\n`);
  for (const [at, { name }] of tasks.value.entries()) parts.push(new Blob([await imageScript(`r${at}`, (await expectedImages.get(name)) ?? [])]));
  for (const [i, mark] of report.marks.entries()) {
    parts.push(new Blob([`<script type="application/json" class="submission">${forScript(jsonOf(mark))}</script>\n`]));
    for (const [at, { name }] of tasks.value.entries())
      parts.push(new Blob([await imageScript(`p${i}-${at}`, flat(await viewImages.get(resultKey(name, mark.submission.id))))]));
  }
  parts.push(beforeScript, viewJs, pageJs, end);
  return new Blob(parts, { type: 'text/html' });
}

/** feedback.zip: a page for each student, under Moodle's name of the submission. */
export async function feedbackZip(report: ClassReport, progress: (done: number) => void): Promise<Blob> {
  const zip = new ZipWriter(), names = new Set<string>();
  for (const [i, mark] of report.marks.entries()) {
    const page = await reportHtml({ ...report, marks: [mark] });
    for (const { name, identifier } of membersOf(report.groups, mark.submission)) {
      const number = identifier.replace(/^participant /i, ''), folder = number ? `${name}_${number}_assignsubmission_file_` : mark.submission.id;
      if (!names.has(folder)) await zip.add(`${folder}/feedback.html`, page);
      names.add(folder);
    }
    progress(i + 1);
  }
  return zip.finish();
}

/** The names are those of `farol grade --format`, `--feedback` and of its tables. */
export const reportNames = ['moodle', 'criteria', 'html', 'feedback', 'json', 'junit', 'overrides'] as const;
export type ReportName = (typeof reportNames)[number];
export const reportFileNames: Record<ReportName, string> = {
  moodle: 'grades.csv', criteria: 'criteria.csv', html: 'report.html', feedback: 'feedback.zip', json: 'report.json', junit: 'junit.xml', overrides: 'overrides.csv',
};

export const classReport = (marks: readonly StudentMark[], groups: ClassReport['groups']): ClassReport =>
  ({ title: rubrics.value[0]?.title ?? '', tasks: taskNames.value, groups, marks });

export async function writeReport(name: ReportName, report: ClassReport, overrides: readonly Override[], progress: (done: number) => void): Promise<Blob> {
  const text = (content: string, type: string): Blob => new Blob([content], { type });
  switch (name) {
    case 'moodle': return text(gradesCsv(report), 'text/csv');
    case 'criteria': return text(criteriaCsv(report), 'text/csv');
    case 'overrides': return text(overridesCsv(overrides), 'text/csv');
    case 'json': return text(reportJson(report), 'application/json');
    case 'junit': return text(junitXml(report), 'application/xml');
    case 'html': return reportHtml(report);
    case 'feedback': return feedbackZip(report, progress);
  }
}
