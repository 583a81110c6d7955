import assert from 'node:assert/strict';
import { test } from 'node:test';
import './dom.ts';
import { titleOf } from '../../../web/src/scene/title.ts';

test('a scene is called by its document, else by its file, and never by an id', () => {
  const stored = '~0123456789abcdef0123456789abcdef', id = stored;
  assert.equal(titleOf('torch', 'Torch', null), 'Torch');
  assert.equal(titleOf('course/phase_1', 'phase_1', null), 'phase_1');
  assert.equal(titleOf(stored, id, null), 'Untitled scene');
  assert.equal(titleOf(null, '', null), 'Untitled scene');
  // As far as the document can be read.
  assert.equal(titleOf('hand-in', 'hand-in', '<world>\n <title>Sea &amp; sky</title>\n <group'), 'Sea & sky');
  assert.equal(titleOf('hand-in', 'hand-in', '<world><title> Cut'), 'Cut');
  assert.equal(titleOf('hand-in', 'hand-in', "<?xml version='1.0'?>\n<scene camera='engine' title='Old one'><model"), 'Old one');
  assert.equal(titleOf('hand-in', 'hand-in', '<world><!-- <title>No</title> --><model title="x"/></world>'), 'hand-in');
  assert.equal(titleOf(stored, id, '<!-- Homework 1,\n Ana -->\n<world/>'), 'Homework 1, Ana');
  assert.equal(titleOf(stored, id, `<!-- ${'long '.repeat(20)} --><world/>`), 'Untitled scene');
  assert.equal(titleOf(stored, id, 'sphere { }'), 'Untitled scene');
});
