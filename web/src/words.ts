// The page's words in the reader's language. The English text is the key; web/languages/*.json has the
// translations, each of which is loaded when it is first needed.
import { batch, effect, signal } from '@preact/signals';
import { recall, remember } from './storage.ts';

/** Each language by its own name. */
export const languages = { en: 'English', pt: 'Português', es: 'Español', cs: 'Čeština' } as const;
export type Language = keyof typeof languages;

/** A translation; of a text with a count, one for each plural category of the language. */
export type Catalogue = Readonly<Record<string, string | Readonly<Partial<Record<Intl.LDMLPluralRule, string>>>>>;

type Names<Text extends string> = Text extends `${string}{${infer Name}}${infer Rest}` ? Name | Names<Rest> : never;
type Values<Text extends string> = string extends Text ? [values?: Record<string, string | number>]
  : [Names<Text>] extends [never] ? [] : [values: Record<Names<Text>, string | number>];

const loaders: Record<Exclude<Language, 'en'>, () => Promise<{ default: Catalogue }>> = {
  pt: () => import('../languages/pt.json', { with: { type: 'json' } }),
  es: () => import('../languages/es.json', { with: { type: 'json' } }),
  cs: () => import('../languages/cs.json', { with: { type: 'json' } }),
};

const isLanguage = (text: string): text is Language => Object.hasOwn(languages, text);

/** The language chosen here before, else the first of the browser's that is known. */
export function preferredLanguage(stored: string | null, browser: readonly string[]): Language {
  if (stored !== null && isLanguage(stored)) return stored;
  return browser.map((tag) => tag.toLowerCase().split('-')[0] as string).find(isLanguage) ?? 'en';
}

const catalogue = signal<Catalogue>({});
export const language = signal<Language>('en');

let latest = 0; // number of the last choice: an earlier one whose translation comes later is void

/** Returns false where another language was chosen meanwhile. */
async function use(chosen: Language): Promise<boolean> {
  const number = ++latest, loaded = chosen === 'en' ? {} : (await loaders[chosen]()).default;
  if (number !== latest) return false;
  batch(() => {
    catalogue.value = loaded;
    language.value = chosen;
  });
  return true;
}

/** Of the first view: in English where the translation does not come. The document has the language from then on. */
export async function firstWords(): Promise<void> {
  effect(() => {
    document.documentElement.lang = language.value;
  });
  await use(preferredLanguage(recall('language'), navigator.languages)).catch((fault: unknown) => console.warn(fault));
}

/** Rejects where the server does not send the translation. */
export async function chooseLanguage(value: string): Promise<void> {
  if (!isLanguage(value)) return;
  if (await use(value)) remember('language', value);
}

const fill = (text: string, values: Record<string, string | number> = {}): string =>
  text.replace(/\{(\w+)\}/g, (whole, name: string) => String(values[name] ?? whole));

/** Marks a literal that t() translates later. */
export const msg = <Text extends string>(text: Text): Text => text;

/** The text in the reader's language, with values in place of its {names}. */
export function t<Text extends string>(text: Text, ...[values]: Values<Text>): string {
  const translated = catalogue.value[text];
  return fill(typeof translated === 'string' ? translated : text, values);
}

/** A text with {count}: `one` in English for a count of 1, else `other`, which is the key of the translations. */
export function plural<Text extends string>(count: number, one: string, other: Text, values: Record<string, string | number> = {}): string {
  const category = new Intl.PluralRules(language.value).select(count), translated = catalogue.value[other];
  const text = typeof translated === 'object' ? (translated[category] ?? translated.other) : translated;
  return fill(text ?? (category === 'one' ? one : other), { ...values, count: number(count) });
}

/** A number as the reader's language writes it. */
export const number = (value: number, options: Intl.NumberFormatOptions = {}): string => value.toLocaleString(language.value, options);

/** A time in the reader's zone and language. */
export const timeText = (time: string): string =>
  new Date(time).toLocaleString(language.value, { dateStyle: 'medium', timeStyle: 'short' });
