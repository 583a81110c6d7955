// Styles of one part of the page reach no other part: the bundle has them all in one file.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';

const folder = 'web/src/style';
/** The selectors of a file, each for itself. */
const selectorsOf = (name: string): string[] =>
  [...readFileSync(`${folder}/${name}`, 'utf8').replace(/\/\*[\s\S]*?\*\//g, '').matchAll(/(?:^|[{}])\s*([^{}@]+?)\s*(?=\{)/g)]
    .flatMap(([, selectors = '']) => selectors.split(/,(?![^(]*\))/)).map((one) => one.trim()).filter((one) => !/^(from|to|\d+%)$/.test(one));
const firstClass = (selector: string): string => /^(?::root\S*\s+)?(\S+)/.exec(selector)?.[1] ?? '';

test('rules of the grade page and of assignments are for those pages alone', () => {
  for (const [name, root] of [['grade.css', '.grade'], ['assignment.css', '.assignment']] as const) {
    const selectors = selectorsOf(name);
    assert.ok(selectors.length > 20);
    assert.deepEqual(selectors.filter((one) => !firstClass(one).startsWith(root)), [], name);
  }
});

test('no two files style a class by its name alone', () => {
  const owners = new Map<string, Set<string>>();
  for (const name of readdirSync(folder)) {
    if (name === 'touch.css') continue; // sizes under a finger, for all parts
    for (const selector of selectorsOf(name)) {
      const own = /^\.([\w-]+)(?![\w-])[^\s>+~]*$/.exec(selector)?.[1]; // without a part of the page around it
      if (own) owners.set(own, (owners.get(own) ?? new Set()).add(name));
    }
  }
  const shared = [...owners].filter(([, files]) => files.size > 1).map(([name, files]) => `${name}: ${[...files].join(' ')}`);
  assert.deepEqual(shared, []);
});
