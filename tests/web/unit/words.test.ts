import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { test } from 'node:test';
import type TypeScript from 'typescript';

// The compiler is no part of the bundled test: it is read from the packages.
const ts = createRequire(join(process.cwd(), 'build/web/package.json'))('typescript') as typeof TypeScript;

interface Use {
  text: string;
  isPlural: boolean;
  place: string;
}

const filesBelow = (folder: string): string[] => readdirSync(folder, { withFileTypes: true }).flatMap((entry) => (entry.isDirectory()
  ? filesBelow(join(folder, entry.name)) : [join(folder, entry.name)]));

const sources = filesBelow('web/src').filter((path) => /\.tsx?$/.test(path))
  .map((path) => ts.createSourceFile(path, readFileSync(path, 'utf8'), ts.ScriptTarget.ES2021, true));

const placeOf = (node: TypeScript.Node): string => {
  const file = node.getSourceFile();
  return `${file.fileName}:${file.getLineAndCharacterOfPosition(node.getStart()).line + 1}`;
};

function visit(node: TypeScript.Node, act: (node: TypeScript.Node) => void): void {
  act(node);
  node.forEachChild((child) => visit(child, act));
}

/** The literals given to t(), msg() and plural(): both texts of the latter are in `uses`, the key last. */
function usesIn(file: TypeScript.SourceFile): Use[] {
  const uses: Use[] = [];
  visit(file, (node) => {
    if (!ts.isCallExpression(node) || !ts.isIdentifier(node.expression)) return;
    const name = node.expression.text, at = name === 'plural' ? 2 : name === 't' || name === 'msg' ? 0 : -1;
    if (at < 0) return;
    const literal = node.arguments[at];
    if (!literal) assert.fail(`${placeOf(node)}: ${name}() without a text`);
    if (ts.isStringLiteralLike(literal)) uses.push({ text: literal.text, isPlural: name === 'plural', place: placeOf(node) });
    // A text that is chosen at run time is marked by msg() where it is written.
    else if (name !== 't') assert.fail(`${placeOf(node)}: ${name}() takes a literal`);
    else assert.ok(!ts.isTemplateExpression(literal) && !ts.isBinaryExpression(literal) && !ts.isConditionalExpression(literal),
      `${placeOf(node)}: t() takes a literal or the name of a text; give values as {names}`);
  });
  return uses;
}

const uses = sources.flatMap(usesIn);
const languages = readdirSync('web/languages').map((name) => name.replace(/\.json$/, ''));
const catalogueOf = (language: string) =>
  JSON.parse(readFileSync(`web/languages/${language}.json`, 'utf8')) as Record<string, string | Record<string, string>>;
const namesIn = (text: string): string => [...text.matchAll(/\{(\w+)\}/g)].map((match) => match[1]).sort().join();

test('the page has its words in Portuguese, Spanish and Czech', () => {
  assert.deepEqual(languages.sort(), ['cs', 'es', 'pt']);
  assert.ok(uses.length > 8);
});

for (const language of languages)
  test(`every text of the page is translated with its names, and no translation is unused: ${language}`, () => {
    const catalogue = catalogueOf(language), keys = Object.keys(catalogue), known = new Set(uses.map((use) => use.text));
    for (const { text, isPlural, place } of uses) {
      const translated = catalogue[text];
      if (translated === undefined) assert.fail(`${place}: no translation of "${text}" in web/languages/${language}.json`);
      assert.equal(typeof translated === 'object', isPlural, `${place}: "${text}" ${isPlural ? 'needs a text for each plural' : 'has no count'}`);
      const forms = typeof translated === 'string' ? [translated] : Object.values(translated);
      for (const form of forms) {
        assert.ok(form.trim(), `${place}: empty translation of "${text}"`);
        // "One check left" need not repeat its number.
        const names = namesIn(form);
        if (!isPlural || names.includes('count')) assert.equal(names, namesIn(text), `${place}: names of "${form}"`);
      }
      if (typeof translated === 'object') {
        const { pluralCategories } = new Intl.PluralRules(language).resolvedOptions();
        for (const form of Object.keys(translated)) assert.ok((pluralCategories as string[]).includes(form), `"${text}": ${language} has no plural "${form}"`);
        assert.ok(translated['other'], `"${text}" has no "other"`);
      }
    }
    assert.deepEqual(keys.filter((key) => !known.has(key)), [], `unused in web/languages/${language}.json`);
    assert.deepEqual(keys, [...keys].sort(), `keys of web/languages/${language}.json are sorted`);
  });

/** Names, units and codes are the same in all languages. */
const untranslated = /^([a-z]+\.[a-z]+|Farol|API|XML|PNG|curl|MiB|MB|kB|px|ms|CSV|JSON|HTML|[^A-Za-z]|[A-Za-z](?![A-Za-z]))*$/;
const shownAttributes = ['title', 'label', 'hint', 'placeholder', 'alt', 'aria-label', 'aria-valuetext'];

/** Texts of a view that are shown as they are written. */
function bareTexts(file: TypeScript.SourceFile): string[] {
  const out: string[] = [];
  const note = (node: TypeScript.Node, text: string): void => {
    if (!untranslated.test(text.trim())) out.push(`${placeOf(node)}: ${text.trim()}`);
  };
  /** The literals that an expression can be: not those that are given to a call or compared. */
  const noteValues = (node: TypeScript.Expression | undefined): void => {
    if (!node) return;
    if (ts.isStringLiteralLike(node)) note(node, node.text);
    else if (ts.isTemplateExpression(node)) note(node, [node.head.text, ...node.templateSpans.map(({ literal }) => literal.text)].join(' '));
    else if (ts.isConditionalExpression(node)) [node.whenTrue, node.whenFalse].forEach(noteValues);
    else if (ts.isParenthesizedExpression(node)) noteValues(node.expression);
    else if (ts.isBinaryExpression(node) && ['&&', '||', '??', '+'].includes(node.operatorToken.getText())) [node.left, node.right].forEach(noteValues);
  };
  visit(file, (node) => {
    if (ts.isJsxText(node)) {
      const element = node.parent;
      if (!ts.isJsxElement(element) || element.openingElement.tagName.getText() !== 'code') note(node, node.text);
    }
    else if (ts.isJsxExpression(node) && !ts.isJsxAttribute(node.parent)) noteValues(node.expression);
    else if (ts.isJsxAttribute(node) && shownAttributes.includes(node.name.getText()))
      noteValues(node.initializer && ts.isJsxExpression(node.initializer) ? node.initializer.expression : (node.initializer as TypeScript.Expression | undefined));
    else if (ts.isCallExpression(node) && ts.isIdentifier(node.expression) && ['say', 'copy', 'confirm', 'prompt'].includes(node.expression.text)) node.arguments.forEach(noteValues);
    else if (ts.isNewExpression(node) && node.expression.getText() === 'Error') node.arguments?.forEach(noteValues); // findingsOf() shows it
  });
  return out;
}

test('no view shows a text that is not translated', () => {
  const sample = ts.createSourceFile('sample.tsx', "const a = <p title='Two words' class='x'>{b ? 'Yes' : t('No')} Hello {`${c} s`} 12 px <code>key</code></p>; say(d || 'Done'); throw new Error('It failed');", ts.ScriptTarget.ES2021, true, ts.ScriptKind.TSX);
  assert.deepEqual(bareTexts(sample).map((text) => text.replace(/^.*: /, '')), ['Two words', 'Yes', 'Hello', 'Done', 'It failed']);
  assert.deepEqual(sources.flatMap(bareTexts), []);
});

test('a thing has one name in a language, on the page and in the messages of the service', () => {
  // The Spanish file, and what is done with it in Portuguese.
  for (const [language, other] of [['es', /fichero/i], ['pt', /\b(junt(ar|e|a)|acrescent\w+)\b/i]] as const)
    for (const folder of ['web/languages', 'core/languages'])
      for (const [key, value] of Object.entries(JSON.parse(readFileSync(`${folder}/${language}.json`, 'utf8')) as Record<string, unknown>))
        assert.doesNotMatch(JSON.stringify(value), other, `${folder}/${language}.json: ${key}`);
});
