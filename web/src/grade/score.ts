// Marks by a changed rubric from what was measured before: the arithmetic of grade/rubric/score.cpp on the shares
// that a grade holds. Where those do not decide, the result is null: the service must grade again.
import { t } from '../words.ts';
import { comparedPoints, type Criterion, type Rubric } from './rubric.ts';
import type { GradeTables, Kind } from './tables.ts';
import type { Cause, CriterionGrade, Grade } from './types.ts';

const topics = ['models', 'transforms', 'textures', 'materials', 'lights', 'camera', 'animation'] as const;
type Topic = (typeof topics)[number];
const ofObjects: readonly string[] = ['models', 'transforms', 'textures', 'materials'];
const freeShare = 0.02, leastUnexplained = 3, mostUnexplained = 45, mostFactor = 4, severalPlaces = 1.5;

export const rounded = (points: number): number => Math.round(points * 100) / 100;
const clamp = (value: number): number => Math.min(1, Math.max(0, value));

/** The same text for documents that differ in the order of keys. */
function canonical(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(canonical).join()}]`;
  if (typeof value !== 'object' || value === null) return JSON.stringify(value) ?? 'null';
  return `{${Object.entries(value).sort(([a], [b]) => (a < b ? -1 : 1)).map(([key, one]) => `${JSON.stringify(key)}:${canonical(one)}`).join()}}`;
}

/** What a rubric asks of the renders and of requirements; where it differs, the service must grade again. */
function basisOf(rubric: Rubric): string {
  const { title: _, points: _1, weight: _2, passMark: _3, strictness: _4, criteria: _5, penalties: _6, manual: _7, $schema: _8, ...rest } = rubric;
  return canonical({ ...rest, requirements: rubric.requirements.map(({ points: _9, ...one }) => one), compared: comparedPoints(rubric) > 0 });
}

/** What the reference has that no grade says: criteria without it have no points. */
interface Assumption {
  isScene: boolean;
  lights: number;
  camera: boolean;
  moves: boolean;
}

interface Score {
  criteria: { measure: string; points: number; most: number }[];
  causes: number[]; // points, by finding
  unexplained: number;
  sum: number;
}

function costOf(kind: Kind, { spoils, places }: Cause): number {
  const range = kind.most - kind.least, count = Math.max(1, places.length);
  const single = kind.least + range * Math.sqrt(clamp(spoils / count)), whole = kind.least + range * Math.sqrt(clamp(spoils));
  return count > 1 ? Math.max(whole, severalPlaces * single) : single;
}

const isTopic = (measure: string): measure is Topic => (topics as readonly string[]).includes(measure);

function applies(one: Criterion, { lights, camera, moves }: Assumption): boolean {
  if (one.weight <= 0) return false;
  return one.measure === 'lights' ? lights > 0 : one.measure === 'camera' ? camera : one.measure === 'animation' ? moves : true;
}

/** The points of a measured criterion; null where it was not measured. */
function judged(grade: Grade, rule: Criterion, most: number, strictness: number): number | null {
  const measured = grade.criteria.find(({ measure }) => measure === rule.measure)?.measured;
  if (measured === undefined || rule.tolerance === undefined || rule.limit === undefined) return null;
  return most * (1 - clamp(strictness * (measured - rule.tolerance) / (rule.limit - rule.tolerance))) * grade.present;
}

function scoreImages(grade: Grade, rubric: Rubric, tables: GradeTables): Score | null {
  const image = tables.gradeMeasures.filter(({ pictures }) => pictures);
  let rules = rubric.criteria.filter(({ measure, weight }) => weight > 0 && image.some(({ name }) => name === measure));
  if (rules.length === 0) rules = image.filter(({ weight }) => weight > 1).map((one) => ({ ...one, measure: one.name }));
  const weights = rules.reduce((sum, one) => sum + one.weight, 0), criteria = [];
  for (const rule of rules) {
    const most = comparedPoints(rubric) * rule.weight / weights, points = judged(grade, rule, most, rubric.strictness);
    if (points === null) return null;
    criteria.push({ measure: rule.measure, points, most });
  }
  return { criteria, causes: grade.findings.map(() => 0), unexplained: 0, sum: criteria.reduce((sum, one) => sum + one.points, 0) };
}

type ByTopic = Record<Topic, number>;
const none = (): ByTopic => ({ models: 0, transforms: 0, textures: 0, materials: 0, lights: 0, camera: 0, animation: 0 });

function scoreScene(grade: Grade, rubric: Rubric, tables: GradeTables, assumed: Assumption): Score | null {
  const rules = rubric.criteria.filter((one) => applies(one, assumed)), compared = comparedPoints(rubric);
  const usual = (tables.defaultRubric['criteria'] as Criterion[]).filter((one) => applies(one, assumed));
  const weights = rules.reduce((sum, one) => sum + one.weight, 0), usualWeights = usual.reduce((sum, one) => sum + one.weight, 0);
  const most = none(), left = none(), factor = none();
  for (const { measure, weight, perFinding = 0.5 } of rules) {
    if (!isTopic(measure)) continue;
    const share = weight / weights, usualShare = (usual.find((one) => one.measure === measure)?.weight ?? 0) / usualWeights;
    most[measure] = compared * share;
    left[measure] = most[measure] * grade.present;
    factor[measure] = Math.min(mostFactor, usualShare > 0 ? share / usualShare : 1) * perFinding / 0.5;
  }
  const hundredths = (value: number): number => value / 100 * compared * rubric.strictness;
  const takeFromObjects = (points: number): number => {
    const all = ofObjects.reduce((sum, topic) => sum + left[topic as Topic], 0);
    if (all <= 0 || points <= 0) return 0;
    const share = Math.min(1, points / all);
    for (const topic of ofObjects) left[topic as Topic] *= 1 - share;
    return share * all;
  };
  const take = (topic: Topic, cost: number): number => {
    const own = Math.min(cost, left[topic]);
    left[topic] -= own;
    return own;
  };
  const isUnclosed = grade.diagnostics.some(({ code, severity }) => code === 'xml.unclosed' && severity === 'error');
  const causes = grade.findings.map((cause) => {
    const kind = tables.gradeKinds.find(({ code }) => code === cause.code);
    if (!kind || !isTopic(kind.criterion) || !cause.seen || kind.most <= 0 || (isUnclosed && kind.code === 'group.parent')) return 0;
    const topic = kind.criterion, cost = hundredths(costOf(kind, cause) * factor[topic]);
    if (ofObjects.includes(topic)) {
      const own = take(topic, cost);
      return rounded(own + (factor[topic] > 0 ? takeFromObjects(cost - own) : 0));
    }
    const here = cost * grade.present;
    return rounded(take(topic, kind.code === 'light.missing' ? Math.max(here, most[topic] * grade.present / assumed.lights) : here));
  });
  const rest = grade.unexplained.share;
  const unexplained = rest > freeShare ? rounded(takeFromObjects(hundredths(leastUnexplained + (mostUnexplained - leastUnexplained) * Math.sqrt(Math.min(1, rest - freeShare))))) : 0;
  const criteria = [];
  for (const rule of rules) {
    const all = compared * rule.weight / weights, points = isTopic(rule.measure) ? left[rule.measure] : judged(grade, rule, all, rubric.strictness);
    if (points === null) return null;
    criteria.push({ measure: rule.measure, points, most: all });
  }
  return { criteria, causes, unexplained, sum: criteria.reduce((sum, one) => sum + one.points, 0) };
}

function scoreBy(grade: Grade, rubric: Rubric, tables: GradeTables, assumed: Assumption): Score | null {
  if (comparedPoints(rubric) <= 0) return { criteria: [], causes: grade.findings.map(() => 0), unexplained: 0, sum: 0 };
  return assumed.isScene ? scoreScene(grade, rubric, tables, assumed) : scoreImages(grade, rubric, tables);
}

/** The penalty of diagnostics and findings alone, without that of repairs. */
function penaltyOf(grade: Grade, rubric: Rubric, tables: GradeTables): number {
  const { warning, most, codes } = rubric.penalties;
  let sum = 0;
  for (const { code, severity } of grade.diagnostics) sum += codes[code] ?? (severity === 'info' ? 0 : warning);
  for (const { code, seen } of grade.findings) if (seen && tables.gradeKinds.some((kind) => kind.code === code)) sum += codes[code] ?? 0;
  return Math.min(sum, most);
}

/** Hundredths that a document with errors costs: chargeRepairs in grade/rubric/grader.cpp. */
function repairsOf({ diagnostics }: Grade): number {
  const errors = diagnostics.filter(({ severity }) => severity === 'error');
  if (errors.some(({ code }) => code.startsWith('xml.'))) return 40;
  return Math.min(18, 6 * errors.filter(({ code }) => code.startsWith('scene.')).length);
}

function newPenalty(grade: Grade, before: Rubric, now: Rubric, tables: GradeTables): number | null {
  // Notes of the reader are in no grade, and a code may be one's.
  const hasNotes = [before, now].some(({ penalties }) => Object.keys(penalties.codes).some((code) => !tables.gradeKinds.some((kind) => kind.code === code)));
  if (hasNotes) return canonical(before.penalties) === canonical(now.penalties) && before.points === now.points ? grade.penalty : null;
  const repairs = grade.penalty - penaltyOf(grade, before, tables) > 0.005 ? repairsOf(grade) : 0;
  return rounded(penaltyOf(grade, now, tables) + repairs / 100 * now.points);
}

function requirementPoints(grade: CriterionGrade, rule: Rubric['requirements'][number]): number {
  const found = grade.found ?? 0, needed = grade.needed ?? 0, atMost = rule['atMost'] as number | null | undefined;
  let share = needed > 0 ? Math.min(1, found / needed) : 0;
  if (!rule['each'] && atMost && found > atMost) share *= atMost / found;
  return share >= 1 || (rule['partial'] !== false && share > 0) ? rounded(rule.points * share) : 0;
}

function assumptionsOf(grade: Grade, before: Rubric): Assumption[] {
  const known = (topic: Topic): boolean[] => {
    const isAsked = before.criteria.some(({ measure, weight }) => measure === topic && weight > 0);
    return isAsked ? [grade.criteria.some(({ measure, kind }) => measure === topic && !kind)] : [false, true];
  };
  const isCounted = grade.findings.some(({ code }) => code === 'light.missing'), out: Assumption[] = [];
  for (const hasLights of known('lights'))
    for (const camera of known('camera'))
      for (const moves of known('animation'))
        for (let lights = hasLights ? 1 : 0; lights <= (hasLights && isCounted ? 16 : hasLights ? 1 : 0); ++lights)
          out.push({ isScene: true, lights, camera, moves });
  return [...out, { isScene: false, lights: 0, camera: false, moves: false }];
}

const near = (a: number, b: number, slack = 0.0151): boolean => Math.abs(a - b) <= slack;

/** Whether the score is the grade's own. */
function explains(score: Score, grade: Grade): boolean {
  const own = grade.criteria.filter(({ kind }) => !kind);
  return score.criteria.length === own.length && near(score.unexplained, grade.unexplained.points) &&
    score.criteria.every((one, i) => one.measure === own[i]?.measure && near(one.points, own[i].points) && near(one.most, own[i].most)) &&
    grade.findings.every(({ criterion, points }, i) => !isTopic(criterion) || near(points, score.causes[i] ?? 0));
}

/** The grade by the rubric `now`, of one that was made by `before`; null where the service must grade again. */
export function rescored(grade: Grade, before: Rubric, now: Rubric, tables: GradeTables): Grade | null {
  if (canonical(before) === canonical(now)) return grade;
  if (basisOf(before) !== basisOf(now)) return null;
  const manual = now.manual.map(({ id, text, points }): CriterionGrade =>
    ({ measure: id, kind: 'manual', text, state: 'open', points: 0, most: rounded(points), reason: t('A person marks this.') }));
  if (grade.refused) return { ...grade, most: now.points, criteria: [...grade.criteria.filter(({ kind }) => kind !== 'manual'), ...manual] };
  const penalty = newPenalty(grade, before, now, tables);
  const scores = assumptionsOf(grade, before).filter((one) => {
    const own = scoreBy(grade, before, tables, one);
    return own !== null && explains(own, grade);
  }).map((one) => scoreBy(grade, now, tables, one));
  const [score] = scores;
  if (!score || penalty === null || !scores.every((one) => one !== null && near(one.sum, score.sum, 0.004))) return null;
  const criteria: CriterionGrade[] = score.criteria.map(({ measure, points, most }) => {
    const old = grade.criteria.find((one) => one.measure === measure && !one.kind), changed = { points: rounded(points), most: rounded(most) };
    const reason = old?.measured === undefined || changed.points === old.points ? (old?.reason ?? '')
      : t('{share} % differs: {points} of {most} points.', { share: rounded(100 * old.measured), ...changed });
    return { ...(old?.measured === undefined ? {} : { measured: old.measured }), measure, ...changed, reason };
  });
  const required = new Map(now.requirements.map((rule) => {
    const old = grade.criteria.find(({ kind, measure }) => kind === 'requirement' && measure === rule.id);
    return [rule.id, old && { ...old, points: requirementPoints(old, rule), most: rounded(rule.points) }] as const;
  }));
  if ([...required.values()].some((one) => one === undefined)) return null;
  for (const one of required.values()) if (one) criteria.push(one);
  criteria.push(...manual);
  const findings = grade.findings.map((cause, i) => {
    const rule = required.get(cause.criterion);
    return { ...cause, points: rule ? rounded(rule.most - rule.points) : (score.causes[i] ?? 0) };
  });
  const sum = score.sum + [...required.values()].reduce((all, one) => all + (one?.points ?? 0), 0);
  const points = rounded(Math.max(0, sum - penalty));
  return {
    ...grade, points, most: now.points, passed: points >= now.points * now.passMark / 100, penalty, criteria, findings,
    unexplained: { ...grade.unexplained, points: score.unexplained },
  };
}
