import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { curesOf } from '../../../web/derive/cures.ts';
import { schemaOf } from '../../../web/derive/schema.ts';
import { bundleOf, mainScene, stripCommonFolder } from '../../../web/src/scene/bundle.ts';
import { lapTime } from '../../../web/src/scene/clock.ts';

test('every code of the catalogue has its cure', () => {
  const catalogue = readFileSync('api/errors.md', 'utf8');
  const cures = curesOf(catalogue);
  const codes = [...catalogue.matchAll(/^### (\S+)/gm)].map((match) => match[1] as string);
  assert.ok(codes.length > 60);
  // What was merely decided needs none.
  for (const code of codes.filter((one) => !cures[one])) assert.match(catalogue, new RegExp(`### ${code}\n\n\\*Info`));
  assert.equal(cures['xml.ampersand'], 'Write &amp;.');
});

test('completion knows the elements, their children, attributes and words', () => {
  const { elements } = schemaOf(readFileSync('api/scene.xsd', 'utf8'), readFileSync('docs/scene-language.md', 'utf8'));
  const of = (name: string) => elements.find((element) => element.name === name);
  assert.ok(of('world')?.top && of('scene')?.top);
  assert.ok(of('group')?.children.includes('transform'));
  assert.ok(of('model')?.children.includes('color') && !of('model')?.children.includes('colour'));
  const light = of('light')?.attributes ?? [];
  assert.equal(light[0]?.name, 'type');
  assert.ok(light.find((one) => one.name === 'type')?.values?.includes('directional'));
  assert.ok(light.some((one) => one.name === 'posX') && !light.some((one) => one.name === 'positionX'));
  assert.match(light.find((one) => one.name === 'cutoff')?.help ?? '', /half the cone/);
});

test('the scene of a folder, and the paths beside it', () => {
  assert.deepEqual(stripCommonFolder(['a/b/s.xml', 'a/b/t/x.png']), ['s.xml', 't/x.png']);
  assert.deepEqual(stripCommonFolder(['s.xml']), ['s.xml']);
  assert.equal(mainScene(['parts/a.xml', 'z.xml', 'scene.xml']), 'scene.xml');
  assert.equal(mainScene(['parts/a.xml', 'z.xml']), 'z.xml');
  assert.equal(mainScene(['a.png']), null);
});

test('bundles: litter is left out, a mesh gets a scene, too much is told', async () => {
  const file = (path: string, size = 1) => ({ path, file: new File([new Uint8Array(size)], path) });
  const bundle = bundleOf([file('f/s.xml'), file('f/t/x.png'), file('f/.DS_Store'), file('f/__MACOSX/y')]);
  assert.ok('body' in bundle);
  const { body } = bundle.body();
  assert.deepEqual([...(body as FormData)].map(([name, value]) => [name, (value as File).name]), [['scene', 's.xml'], ['file', 't/x.png']]);
  const mesh = bundleOf([file('hare.ply')]);
  assert.ok('body' in mesh);
  const scene = (mesh.body().body as FormData).get('scene') as File;
  assert.match(await scene.text(), /<model file="hare.ply"\/>/);
  const both = bundleOf([file('m/a&b.stl'), file('m/c.3DB'), file('m/notes.txt')]);
  assert.ok('body' in both);
  const together = await ((both.body().body as FormData).get('scene') as File).text();
  assert.match(together, /<title>a&amp;b.stl and 1 more<\/title>/);
  assert.deepEqual(together.match(/<model file="[^"]*"/g), ['<model file="a&amp;b.stl"', '<model file="c.3DB"']);
  assert.ok('message' in bundleOf([file('x.pdf')]));
  assert.ok('message' in bundleOf([file('s.xml', 17 * 1024 * 1024)]));
});

test('time runs in laps', () => {
  assert.equal(lapTime(12, 0, 10), 2);
  assert.equal(lapTime(-1, 0, 10), 9);
  assert.equal(lapTime(5, 5, 10), 5);
});
