// The tree of a scene: its entries and names, what is hidden, and marks that stay with their elements.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { test } from 'node:test';
import { outlineOf } from '../../../web/src/gizmo/outline.ts';
import { elementAt, isWithin, withoutElements } from '../../../web/src/scene/hide.ts';
import { mover, moveMarks, toggled } from '../../../web/src/scene/marks.ts';
import { entryAround, groupAround, kindOf, nextSelection, treeOf, walkTree, type TreeNode } from '../../../web/src/scene/tree.ts';
import { parseXml, walkXml } from '../../../web/src/scene/xml.ts';

const course = `<world>
  <camera><position x="1"/></camera>
  <lights><light type="point" posx="1"/></lights>
  <!-- ===== Sun ===== -->
  <group>
    <models><model file="sphere_1_8_8.3d"/><model file="box_1.3d" name="Crate"/></models>
    <group name="Moon"><models><model file="sphere_1_4_4.3d"/></models></group>
  </group>
  <group/>
</world>
`;
const outlineText = (nodes: readonly TreeNode[], depth = 0): string[] =>
  nodes.flatMap((node) => [`${'  '.repeat(depth)}${node.kind} ${node.name || '-'}${node.note && ` (${node.note})`}`, ...outlineText(node.children, depth + 1)]);
const startOf = (text: string, part: string): number => {
  assert.ok(text.includes(part), part);
  return text.indexOf(part);
};

test('the tree has the names of the document: attributes, comments, shapes', () => {
  assert.deepEqual(outlineText(treeOf(course, parseXml(course))), [
    'scene -', '  camera -', '  light - (point)', '  group Sun', '    model sphere_1_8_8.3d', '    model Crate (box_1.3d)',
    '    group Moon', '      model sphere_1_4_4.3d', '  group -',
  ]);
});

test('every dialect has its tree: lists, aliases, other cases and included scenes', () => {
  const text = `<Scene><Translation X="1"/><Light TYPE="SPOT" name="Lamp"/><GROUP id="Arm"><rotate axisY="1" angle="3"/><Model command="plane 4"/>
    <xmls><xml file="ships/tie.xml"/></xmls></GROUP><skybox texture="sky.png"/></Scene>`;
  assert.deepEqual(outlineText(treeOf(text, parseXml(text))), [
    'scene -', '  light Lamp (spot)', '  group Arm', '    model plane 4', '    include - (ships/tie.xml)', '  skybox - (sky.png)',
  ]);
});

test('the tree of every scene of the project has each of its models once', () => {
  let scenes = 0;
  const files = [...readdirSync('scenes').map((name) => `scenes/${name}/scene.xml`), ...readdirSync('docs/examples').filter((name) => name.endsWith('.xml')).map((name) => `docs/examples/${name}`)];
  for (const path of files) {
    let text: string;
    try {
      text = readFileSync(path, 'utf8');
    } catch {
      continue; // not a scene's folder
    }
    const roots = parseXml(text), models = [...walkXml(roots)].filter((one) => kindOf(one) === 'model');
    const listed = [...walkTree(treeOf(text, roots))].filter((one) => one.kind === 'model').map((one) => one.element);
    assert.deepEqual(listed, models, path);
    scenes += 1;
  }
  assert.ok(scenes > 80, String(scenes));
});

test('what is hidden is blank, and the rest keeps its lines and columns in bytes', () => {
  const text = '<world><group name="é"><models><model file="ünder.3d"/><model file="b.3d"/></models></group>\n<group><models><model file="c.3d"/></models></group></world>';
  const shown = withoutElements(text, [startOf(text, '<model file="ünder')]);
  assert.ok(!shown.includes('ünder') && shown.includes('b.3d'));
  const bytes = (whole: string): number => Buffer.from(whole.slice(0, whole.indexOf('<model file="b.3d"'))).length;
  assert.equal(bytes(shown), bytes(text));
  // A group stays: places at random are counted by groups.
  const without = withoutElements(text, [startOf(text, '<group name')]);
  assert.ok(without.includes('<group name="é">') && !without.includes('b.3d') && without.includes('c.3d'));
  assert.equal(without.split('\n').length, 2);
  assert.equal(withoutElements(text, []), text);
  assert.equal(withoutElements(text, [3]), text);
  const inner = elementAt(parseXml(text), startOf(text, '<model file="b.3d"'));
  assert.ok(inner && isWithin(inner, [startOf(text, '<group name')]) && !isWithin(inner, [startOf(text, '<group><models><model file="c')]));
});

test('marks stay with their elements while the text changes', () => {
  const at = startOf(course, '<group name="Moon"');
  const typed = course.replace('<camera>', '<camera><!-- here -->');
  assert.equal(mover(course, typed)(at), startOf(typed, '<group name="Moon"'));
  // Values before and after it change in one step: the tags are counted.
  const both = course.replace('posx="1"', 'posx="123"').replace('sphere_1_4_4', 'cone_1_2_4_4');
  assert.equal(mover(course, both)(at), startOf(both, '<group name="Moon"'));
  const removed = course.replace(/\s*<group name="Moon">.*<\/group>/, '');
  assert.equal(mover(course, removed)(at), null);
  assert.deepEqual(moveMarks({ hidden: [at], locked: [0] }, mover(course, removed)), { hidden: [], locked: [0] });
  const added = course.replace('<group name="Moon"', '<group/><group name="Moon"');
  assert.equal(mover(course, added)(at), startOf(added, '<group name="Moon"'));
  assert.deepEqual(toggled(toggled([1], 2), 1), [2]);
});

test('the entry around the cursor is the innermost of the tree', () => {
  const roots = parseXml(course), nameAround = (part: string) => {
    const element = entryAround(roots, startOf(course, part) + 1);
    return element && course.slice(element.start, element.start + 12);
  };
  assert.equal(nameAround('posx'), '<light type=');
  assert.equal(nameAround('position'), '<camera><pos');
  assert.equal(nameAround('<models><model file="sphere_1_4'), '<group name=');
  assert.equal(entryAround(roots, course.length + 5), undefined);
});

test('a click goes from the model to the groups around it, and back', () => {
  const roots = parseXml(course), model = elementAt(roots, startOf(course, '<model file="sphere_1_4'));
  assert.ok(model);
  const moon = groupAround(model), sun = moon && groupAround(moon);
  const seen = [null, model.start, moon?.start, sun?.start].map((selected) => nextSelection(model, selected ?? null).start);
  assert.deepEqual(seen, [model.start, moon?.start, sun?.start, model.start]);
});

test('an outline lies around the pixels of the numbers, inside the image', () => {
  const width = 9, height = 7, numbers = new Uint32Array(width * height);
  for (const [x, y] of [[4, 3], [5, 3], [0, 0]] as const) numbers[y * width + x] = 7;
  numbers[2 * width + 4] = 8;
  const pixels = outlineOf(numbers, width, height, new Set([7]), 1);
  assert.ok(pixels);
  const alpha = (x: number, y: number): number => pixels.data[4 * (y * width + x) + 3] ?? -1;
  const brightAt = (x: number, y: number): boolean => pixels.data[4 * (y * width + x)] === 255;
  assert.deepEqual([alpha(4, 3), alpha(5, 3), alpha(0, 0)], [0, 0, 0]); // what is selected stays as it is
  assert.ok(brightAt(3, 3) && brightAt(6, 3) && brightAt(4, 2) && brightAt(5, 4) && brightAt(1, 1));
  assert.ok(!brightAt(2, 3) && alpha(2, 3) === 200 && alpha(8, 3) === 0 && alpha(8, 6) === 0);
  assert.equal(outlineOf(numbers, width, height, new Set([9]), 1), null);
});
