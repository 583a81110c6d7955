import assert from 'node:assert/strict';
import { File } from 'node:buffer'; // no global before Node.js 20
import { test } from 'node:test';
import { History, stepGapMs, type Moment } from '../../../web/src/scene/history.ts';
import { noMarks } from '../../../web/src/scene/marks.ts';
import { callOf, stlOf } from '../../../web/src/scene/exports.ts';
import { crc32 } from '../../../web/src/zip.ts';
import { renameInText, timesNamed } from '../../../web/src/scene/file_names.ts';
import { areParts, listFiles, missingOf, noChanges, pathFor, withFile, withoutFile } from '../../../web/src/scene/scene_files.ts';

const at = (text: string | null): Moment => ({ text, files: noChanges, marks: noMarks, orbit: null, walk: null });

test('changes of one kind that follow each other are one step; others are not', () => {
  const history = new History();
  history.record('typing', at('a'), 0);
  history.record('typing', at('ab'), stepGapMs - 1);
  history.record('typing', at('abc'), 2 * stepGapMs - 3);
  history.record('camera', at('abcd'), 2 * stepGapMs - 2);
  history.record('typing', at('abcd'), 4 * stepGapMs);
  history.record('', at('abcde'), 4 * stepGapMs + 1);
  history.record('', at('abcdef'), 4 * stepGapMs + 2);
  const seen: (string | null | undefined)[] = [];
  for (let now = at('end'), before = history.undo(now); before; now = before, before = history.undo(now)) seen.push(before.text);
  assert.deepEqual(seen, ['abcdef', 'abcde', 'abcd', 'abcd', 'a']);
  assert.equal(history.undo(at('a')), null);
});

test('a gesture is one step, however long it takes, and none where it changes nothing', () => {
  const history = new History();
  history.record('dragging', at('a'), 0);
  history.beginGesture();
  history.record('dragging', at('ab'), 1);
  history.record('dragging', at('abc'), 10 * stepGapMs);
  history.endGesture(at('abcd'));
  history.record('dragging', at('abcd'), 10 * stepGapMs + 1);
  history.beginGesture();
  history.record('dragging', at('e'), 10 * stepGapMs + 2);
  history.endGesture(at('e'));
  history.beginGesture();
  history.endGesture(at('e'));
  assert.deepEqual(['abcd', 'ab', 'a'].map(() => history.undo(at('end'))?.text), ['abcd', 'ab', 'a']);
  assert.ok(!history.canUndo);
  // Nor does it take what can be redone.
  history.beginGesture();
  history.record('dragging', at('a'), 20 * stepGapMs);
  assert.ok(!history.canRedo);
  history.endGesture(at('a'));
  assert.ok(history.canRedo && !history.canUndo);
});

test('redo goes the same way back, and a new change ends it', () => {
  const history = new History();
  history.record('', at('a'), 0);
  history.record('', at('b'), 1);
  assert.equal(history.undo(at('c'))?.text, 'b');
  assert.equal(history.undo(at('b'))?.text, 'a');
  assert.ok(!history.canUndo && history.canRedo);
  assert.equal(history.redo(at('a'))?.text, 'b');
  history.record('typing', at('b'), 2);
  assert.ok(!history.canRedo);
  assert.equal(history.undo(at('x'))?.text, 'b');
});

test('a history is written with each text once, the nearest steps first where there is no room', () => {
  const history = new History(), long = (letter: string): string => letter.repeat(400_000);
  for (const text of ['a', 'b', 'b', 'c', 'd']) history.record('', at(long(text)), 0);
  history.undo(at(long('e')));
  const written = history.write();
  // d is undone to; of the past c and b fit, a does not.
  assert.deepEqual(written.texts.map((text) => text?.[0]), ['c', 'b']);
  const back = new History();
  back.read(JSON.parse(JSON.stringify({ ...written })) as typeof written);
  assert.equal(back.undo(at('now'))?.text?.[0], 'c');
  assert.equal(back.undo(at('now'))?.text?.[0], 'b');
  assert.equal(back.undo(at('now'))?.text?.[0], 'b');
  assert.equal(back.undo(at('now')), null);
});

test('files that are added, replaced and removed', () => {
  const came = [{ path: 'a.png', bytes: 3 }, { path: 'b.png', bytes: 4 }], file = new Blob(['12345']);
  const changes = withFile(withFile(noChanges, 'a.png', file), 'c/d.png', file);
  assert.deepEqual(listFiles(came, changes), [
    { path: 'a.png', bytes: 5, state: 'replaced' }, { path: 'b.png', bytes: 4, state: 'kept' }, { path: 'c/d.png', bytes: 5, state: 'added' },
  ]);
  const fewer = withoutFile(withoutFile(changes, 'a.png', true), 'c/d.png', false);
  assert.deepEqual([fewer.added, fewer.removed], [[], ['a.png']]);
  assert.deepEqual(withFile(fewer, 'a.png', file).removed, []);
});

test('names of missing files, and where a file goes to be found by them', () => {
  const finding = (message: string, code = 'asset.missing') => ({ code, severity: 'error' as const, message, line: 3 });
  const missing = missingOf([finding('there is no texture "t/wood.png"; add it'), finding('there is no texture "t/wood.png"; add it'), finding('no "x"', 'xml.unclosed')]);
  assert.deepEqual(missing.map(({ name, path }) => [name, path]), [['t/wood.png', 't/wood.png']]);
  for (const [name, path] of [['./a.png', 'a.png'], ['..\\up\\a.png', 'a.png'], ['C:\\x\\a.png', 'a.png'], ['/etc/a.png', 'a.png'], ['t\\a.png', 't/a.png'], ['a//b.png', 'b.png']])
    assert.equal(pathFor(name as string), path);
  const of = (path: string) => ({ path, file: new File([''], path) });
  assert.ok(areParts(missing, [of('x.jpg')]) && areParts([{ ...(missing[0] as (typeof missing)[number]), path: 'm/hare.obj' }], [of('Hare.obj')]));
  assert.ok(!areParts(missing, [of('hare.obj')]) && !areParts(missing, [of('x.jpg'), of('s.xml')]) && !areParts(missing, []));
});

test('a file is renamed wherever the document names it', () => {
  const text = '<world><texture file="t/a.png"/><model texture=\'./t/a.png\' file=t\\a.png /><texture file="t/b.png"/></world>';
  assert.equal(timesNamed(text, 't/a.png'), 3);
  assert.equal(renameInText(text, 't/a.png', 'x & y.png'),
    '<world><texture file="x &amp; y.png"/><model texture=\'x &amp; y.png\' file="x &amp; y.png" /><texture file="t/b.png"/></world>');
});

test('meshes: the call that a name says, and STL', () => {
  assert.deepEqual(callOf('m/sphere_1_16_8.3d'), { shape: 'sphere', args: '1,16,8' });
  for (const name of ['hare.obj', 'box_.3d', 'my_mesh.3d']) assert.equal(callOf(name), null);
  assert.equal(crc32(new TextEncoder().encode('123456789')), 0xcbf43926);
  assert.equal(stlOf('v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1/1 2/2/1 3/3/1 4/4/1\n').size, 84 + 100);
});
