// Checks a document by a JSON schema: the keywords that the rubric's schema has.
import { t } from '../words.ts';

export interface Schema {
  type?: string | string[];
  enum?: (string | number | null)[];
  description?: string;
  default?: unknown;
  minimum?: number;
  maximum?: number;
  minLength?: number;
  maxLength?: number;
  minItems?: number;
  maxItems?: number;
  uniqueItems?: boolean;
  required?: string[];
  additionalProperties?: boolean | Schema;
  properties?: Record<string, Schema>;
  items?: Schema;
}

/** What is wrong at a JSON pointer (RFC 6901). */
export interface SchemaProblem {
  pointer: string;
  message: string;
}

const typeOf = (value: unknown): string =>
  value === null ? 'null' : Array.isArray(value) ? 'array' : Number.isInteger(value) ? 'integer' : typeof value;

const shown = (value: unknown): string => {
  const text = typeof value === 'string' ? value : JSON.stringify(value);
  return text.length > 40 ? `${text.slice(0, 40)}…` : text;
};
const escaped = (key: string): string => key.replaceAll('~', '~0').replaceAll('/', '~1');

function rangeText({ minimum, maximum }: Schema, kind: string): string {
  if (minimum !== undefined && maximum !== undefined) return t('{kind} from {least} to {most}', { kind, least: minimum, most: maximum });
  return kind;
}

/** What a value must be, in words: "a number from 0 to 1000". */
function expectation(schema: Schema): string {
  if (schema.enum) return t('one of {words}', { words: schema.enum.map((one) => (one === null ? 'null' : String(one))).join(', ') });
  const words = [schema.type ?? []].flat().map((type) => ({
    number: rangeText(schema, t('a number')), integer: rangeText(schema, t('a whole number')), string: t('a text'), boolean: t('true or false'),
    object: t('an object'), array: t('a list'), null: 'null',
  })[type] ?? type);
  return words.join(` ${t('or')} `);
}

const maxProblems = 50;

function check(value: unknown, schema: Schema, pointer: string, out: SchemaProblem[]): void {
  if (out.length >= maxProblems) return;
  const problem = (message: string, at = pointer): void => void out.push({ pointer: at, message });
  const wrong = (): void => problem(t('is "{value}"; expected {expected}', { value: shown(value), expected: expectation(schema) }));
  if (schema.enum) {
    if (!schema.enum.includes(value as string)) wrong();
    return;
  }
  const types = [schema.type ?? []].flat(), type = typeOf(value);
  if (types.length > 0 && !types.includes(type) && !(type === 'integer' && types.includes('number'))) return wrong();
  if (typeof value === 'number') {
    if (value < (schema.minimum ?? -Infinity) || value > (schema.maximum ?? Infinity)) wrong();
  } else if (typeof value === 'string') {
    if (value.length < (schema.minLength ?? 0)) problem(t('is empty; write a text'));
    if (value.length > (schema.maxLength ?? Infinity)) problem(t('is longer than {most} letters', { most: schema.maxLength ?? 0 }));
  } else if (Array.isArray(value)) {
    const { minItems = 0, maxItems = Infinity, items } = schema;
    if (value.length < minItems || value.length > maxItems) problem(t('has {count} entries; expected {least} to {most}', { count: value.length, least: minItems, most: maxItems }));
    if (schema.uniqueItems && new Set(value.map((one) => JSON.stringify(one))).size < value.length) problem(t('has a duplicated entry'));
    if (items) value.slice(0, maxItems).forEach((one, i) => check(one, items, `${pointer}/${i}`, out));
  } else if (type === 'object') {
    const known = schema.properties ?? {}, { additionalProperties: others } = schema;
    for (const key of schema.required ?? []) if (!Object.hasOwn(value as object, key)) problem(t('needs "{key}"', { key }));
    for (const [key, inner] of Object.entries(value as object)) {
      const rule = Object.hasOwn(known, key) ? known[key] : others, at = `${pointer}/${escaped(key)}`;
      if (rule === false) problem(t('is no key of a rubric; expected one of {words}', { words: Object.keys(known).filter((one) => one !== '$schema').join(', ') }), at);
      else if (typeof rule === 'object') check(inner, rule, at, out);
    }
  }
}

/** All that is wrong with the document, at most 50 problems. */
export function checkBySchema(value: unknown, schema: Schema): SchemaProblem[] {
  const out: SchemaProblem[] = [];
  check(value, schema, '', out);
  return out;
}

/** The schema of the value at a JSON pointer; undefined where there is none. */
export function schemaAt(schema: Schema, pointer: string): Schema | undefined {
  let at: Schema | undefined = schema;
  for (const key of pointer.split('/').slice(1)) at = at?.items && /^\d+$/.test(key) ? at.items : at?.properties?.[key];
  return at;
}

/** The line (from 1) of the value at a JSON pointer in a document that can be read. */
export function lineOf(text: string, pointer: string): number {
  const path = pointer.split('/').slice(1).map((key) => key.replaceAll('~1', '/').replaceAll('~0', '~'));
  let at = 0;
  const token = /\s*("(?:[^"\\]|\\.)*"|[{}[\],:]|[^\s{}[\],:"]+)/y;
  const next = (): string => {
    token.lastIndex = at;
    const found = token.exec(text);
    at = found ? token.lastIndex : text.length;
    return found?.[1] ?? '';
  };
  const peek = (): string => {
    const before = at, found = next();
    at = before;
    return found;
  };
  const skip = (): void => {
    let depth = 0;
    do {
      const found = next();
      if (found === '') return;
      depth += found === '{' || found === '[' ? 1 : found === '}' || found === ']' ? -1 : 0;
    } while (depth > 0);
  };
  for (const wanted of path) {
    const open = next();
    let isFound = false;
    for (let i = 0; !isFound; ++i) {
      const first = peek();
      if (first === '' || first === '}' || first === ']') break;
      if (first === ',') {
        next();
        --i;
        continue;
      }
      if (open === '{') {
        const key = JSON.parse(next()) as string;
        next();
        isFound = key === wanted;
      } else isFound = String(i) === wanted;
      if (!isFound) skip();
    }
    if (!isFound) break;
  }
  const found = peek();
  return text.slice(0, text.indexOf(found || '\n', at)).split('\n').length;
}
