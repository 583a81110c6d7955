// Transforms of every dialect: the frames that they make, and how handles write them, in the document's own style.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { drag, handlesOf, nudge, ringAxes, type Handle } from '../../../web/src/gizmo/handles.ts';
import { alongLine, Lens, onPlane } from '../../../web/src/gizmo/lens.ts';
import { alignedFrame, catmullRom, lapAt } from '../../../web/src/maths/curve.ts';
import { applyAffine, applyLinear, axisAngle, identity, inverse, multiply, rotation, scaling, translation, type Affine } from '../../../web/src/maths/matrix.ts';
import { dot, length, sub, type Vec3 } from '../../../web/src/maths/vec.ts';
import { decimalsOf, parseNumber, styleOf, writeNumber } from '../../../web/src/scene/number_text.ts';
import { movedBy, targetsOf } from '../../../web/src/scene/transform_edits.ts';
import { frameOf, transformsOf } from '../../../web/src/scene/transforms.ts';
import { kindOf } from '../../../web/src/scene/tree.ts';
import { applyEdits, parseXml, removeElement, walkXml, type XmlElement } from '../../../web/src/scene/xml.ts';

const near = (actual: Vec3, expected: Vec3, what = '', tolerance = 1e-9): void =>
  assert.ok(length(sub(actual, expected)) <= tolerance, `${what} ${actual.join(' ')} is not ${expected.join(' ')}`);
const first = (text: string, kind: string, at = 0): XmlElement => {
  const found = [...walkXml(parseXml(text))].filter((one) => kindOf(one) === kind)[at];
  assert.ok(found, `${kind} ${at}`);
  return found;
};
const targets = (text: string, kind = 'group', at = 0, timeS = 0) => targetsOf({ text, roots: parseXml(text) }, first(text, kind, at), timeS);

test('numbers keep their style: decimals, no zero before the point, a tail', () => {
  const write = (before: string, value: number, decimals = 0): string => writeNumber(value, styleOf(before), decimals);
  assert.deepEqual(['1.50', '2', '.5', '-.25', '1.5f', '000', '1e3', '3,5', 'x'].map((text) => write(text, 2.25, 1)), ['2.25', '2.3', '2.3', '2.25', '2.3f', '2.3', '2.3', '2.3', '2.3']);
  assert.equal(write('1.50', 2), '2.00');
  assert.equal(write('2', 3.0001, 2), '3');
  assert.equal(write('.5', 0.75, 2), '.75');
  assert.equal(write('.5', -0.75, 2), '-.75');
  assert.equal(write('1', -0.001, 2), '0');
  assert.equal(write('1.0', -0.04), '0.0');
  assert.deepEqual(['1.5', ' 2,5 ', '3.55´', '1e1', ''].map(parseNumber), [1.5, 2.5, 3.55, 10, undefined]);
  assert.deepEqual([1, 0.5, 0.25, 15, 0.1].map(decimalsOf), [0, 1, 2, 0, 1]);
});

test('matrices: products, inverses and turns', () => {
  const m = multiply(translation([1, 2, 3]), multiply(rotation([1, 2, -1], 37), scaling([2, 3, -0.5]))), p: Vec3 = [0.3, -4, 5];
  const back = inverse(m);
  assert.ok(back);
  near(applyAffine(back, applyAffine(m, p)), p, 'inverse', 1e-12);
  assert.equal(inverse(scaling([1, 0, 1])), null);
  near(applyLinear(rotation([0, 1, 0], 90), [0, 0, 1]), [1, 0, 0]);
  assert.deepEqual(rotation([0, 0, 2], 270).x.map((x) => x + 0), [0, -1, 0]);
  for (const [axis, angle] of [[[0, 1, 0], 30], [[1, 1, 0], 179.9], [[0, 0, 1], 180], [[3, -2, 1], 90]] as const) {
    const turned = axisAngle(rotation(axis, angle)), same = rotation(turned.axis, turned.angle);
    for (const column of ['x', 'y', 'z'] as const) near(same[column], rotation(axis, angle)[column], 'axis and angle', 1e-7);
  }
  assert.equal(axisAngle(identity).angle, 0);
});

test('curves: through their points, aligned frames with length 1 that close', () => {
  const points: Vec3[] = [[1, 0, 0], [0, 0, -1], [-1, 0, 0], [0, 0, 1]];
  points.forEach((point, i) => near(catmullRom(points, i / 4).position, point));
  near(catmullRom(points, 0).tangent, [0, 0, -4]);
  assert.equal(lapAt(-1, 4), 0.75);
  for (const u of [0, 0.1, 0.5, 0.999]) {
    const { x, y, z } = alignedFrame(points, u);
    for (const [a, b] of [[x, y], [y, z], [z, x]] as const) assert.ok(Math.abs(dot(a, b)) < 1e-9);
    for (const a of [x, y, z]) assert.ok(Math.abs(length(a) - 1) < 1e-9);
    near(y, [0, 1, 0], 'up', 1e-9); // a flat curve keeps its up
  }
});

test('transforms of every dialect are read in their order: wrapped, direct, spun, along curves', () => {
  const course = '<world><group><transform><translate x="1" y="2,5" z="3"/><rotate angle="90" x="0" y="1" z="0"/><scale x="2"/></transform><models><model file="a"/></models></group></world>';
  near(applyAffine(frameOf(first(course, 'model'), 0), [1, 0, 0]), [1, 2.5, 1]);
  const old = '<scene><rotate axisY="1" angle="90"/><group><TRANSLATE X="2"/><Rotation axisX="1" time="-4"/><model file="a"/></group></scene>';
  near(applyAffine(frameOf(first(old, 'model'), 0), [0, 0, 0]), [0, 0, -2]);
  near(applyAffine(frameOf(first(old, 'model'), 1), [0, 1, 0]), [-1, 0, -2]); // a quarter back about x, then the root's turn
  const curve = '<world><group><transform><translate time="8"><point x="1"/><point y="1"/><point x="-1"/><point y="-1"/></translate></transform></group></world>';
  near(frameOf(first(curve, 'group'), 2).origin, [0, 1, 0]);
  assert.deepEqual(transformsOf(first('<world><group><rotate x="1"/><rotate time="0" y="1"/><translate time="3"/></group></world>', 'group')), []);
});

const moved = (text: string, value: Vec3, at = 0, timeS = 0): string => applyEdits(text, targets(text, 'group', at, timeS).move?.write(value, 4) ?? []);

test('a move changes the numbers that are there, in their own spelling, and nothing else', () => {
  const text = '<world>\n  <group>\n    <transform>\n      <translate x = \'1.50\' y="2" Z=".5" />\n    </transform>\n  </group>\n</world>';
  assert.equal(moved(text, [2, 2, 0.75]), text.replace("'1.50'", "'2.00'").replace('".5"', '".75"'));
  assert.equal(moved(text, [1.5, 2, 0.5]), text);
  const upper = '<scene><group><translate Z="8"/><model file="a"/></group></scene>';
  assert.equal(moved(upper, [1.25, 0, 8]), upper.replace('Z="8"/>', 'Z="8" X="1.25"/>'));
});

test('a group without a translate gets one, in the spelling of its document', () => {
  const course = '<world>\n    <group>\n        <models>\n            <model file="a"/>\n        </models>\n    </group>\n</world>\n';
  assert.equal(moved(course, [0, 1, 0]), course.replace('    <group>\n', '    <group>\n        <transform> <translate x="0" y="1" z="0"/> </transform>\n'));
  const turned = "<world>\n <group>\n  <transform>\n   <rotate angle='3' x='1' y='0' z='0' />\n  </transform>\n </group>\n</world>";
  assert.equal(moved(turned, [0, 1, 0]), turned.replace('   <rotate', "   <translate x='0' y='1' z='0' />\n   <rotate"));
  const old = '<scene>\n  <group>\n    <translate Z="8"/>\n    <group>\n      <models>\n        <model file="a"/>\n      </models>\n    </group>\n  </group>\n</scene>';
  assert.equal(moved(old, [0.5, 0, 0], 1), old.replace('    <group>\n      <models>', '    <group>\n      <translate X="0.5" Y="0" Z="0"/>\n      <models>'));
  const bare = '<world><group/></world>';
  assert.equal(moved(bare, [1, 0, 0]), '<world><group>\n    <transform> <translate x="1" y="0" z="0"/> </transform>\n</group></world>');
});

test('a curve moves with all its points, from where it is now', () => {
  const text = '<world><group><transform><translate time="8"><point x="1" y="0" z="0"/><point x="0" y="1.0" z="0"/><point x="-1" y="0" z="0"/><point x="0" y="-1" z="0"/></translate></transform></group></world>';
  near(targets(text, 'group', 0, 2).move?.value as Vec3, [0, 1, 0]);
  const after = moved(text, [0, 1, 2.5], 0, 2);
  assert.equal(after, text.replaceAll('z="0"', 'z="2.5"'));
});

test('a turn about the axis that is there changes the angle alone; about another, axis and angle', () => {
  const text = '<world><group><transform><translate y="2"/><rotate angle="142.80" x="0" y="1" z="0"/></transform></group></world>', { rings } = targets(text);
  assert.deepEqual(rings.map(({ name, angle }) => [name, angle]), [['x', null], ['y', 142.8], ['z', null]]);
  near(rings[0]?.frame.origin as Vec3, [0, 2, 0]);
  assert.equal(applyEdits(text, rings[1]?.write(30, 1) ?? []), text.replace('142.80', '172.80'));
  const other = applyEdits(text, rings[0]?.write(90, 1) ?? []), [, rotate] = transformsOf(first(other, 'group'));
  const expected = multiply(rotation([1, 0, 0], 90), rotation([0, 1, 0], 142.8)), made = rotation(rotate?.vector as Vec3, rotate?.angle ?? 0);
  for (const column of ['x', 'y', 'z'] as const) near(made[column], expected[column], column, 2e-3);
  // An axis that points the other way: the ring's angle is the XML's with the other sign.
  const back = '<scene><group><rotate angle="10" axisX="0" axisY="-2" axisZ="0"/></group></scene>', ring = targets(back).rings[1];
  assert.equal(ring?.angle, -10);
  assert.equal(applyEdits(back, ring?.write(30, 1) ?? []), back.replace('"10"', '"-20"'));
});

test('a turn is added after the translate, with the attributes of the dialect; a slanted axis has a ring of its own', () => {
  const course = '<world>\n  <group>\n    <transform>\n      <translate y="2" />\n      <scale x="2" y="2" z="2" />\n    </transform>\n  </group>\n</world>';
  assert.equal(applyEdits(course, targets(course).rings[2]?.write(45, 1) ?? []), course.replace('      <scale', '      <rotate angle="45" x="0" y="0" z="1" />\n      <scale'));
  const old = '<scene><group><translate z="8"/><model file="a" diffR="1"/></group></scene>';
  assert.equal(applyEdits(old, targets(old).rings[1]?.write(45, 1) ?? []), old.replace('z="8"/>', 'z="8"/> <rotate angle="45" axisX="0" axisY="1" axisZ="0"/>'));
  const slanted = targets('<world><group><transform><rotate angle="20" x="1" y="1" z="0"/></transform></group></world>').rings;
  assert.deepEqual(slanted.map(({ name, angle }) => [name, angle]), [['x', null], ['y', null], ['z', null], ['', 20]]);
  // Two turns, each by its own angle.
  const two = targets('<scene><group><rotate axisX="1" angle="20"/><rotate axisY="1" angle="5"/></group></scene>').rings;
  assert.deepEqual(two.map(({ name, angle }) => [name, angle]), [['x', 20], ['y', 5]]);
  near(applyLinear(two[1]?.frame as Affine, [0, 1, 0]), applyLinear(rotation([1, 0, 0], 20), [0, 1, 0]));
});

test('a turn with time is left as it is: a still turn is added before it or changed beside it, and its time is a number', () => {
  const spun = '<scene><group><translate z="8"/><rotate axisY="1" time="5"/></group></scene>', { rings, motions } = targets(spun, 'group', 0, 1.25);
  assert.deepEqual(rings.map(({ name, angle }) => [name, angle]), [['x', 0], ['y', 0], ['z', 0]]);
  near(applyLinear(rings[0]?.frame as Affine, [1, 0, 0]), [1, 0, 0], 'the axes do not turn with it');
  assert.equal(applyEdits(spun, rings[2]?.write(30, 1) ?? []), spun.replace('z="8"/>', 'z="8"/> <rotate angle="30" axisX="0" axisY="0" axisZ="1"/>'));
  assert.deepEqual(motions.map(({ kind, seconds, element }) => [kind, seconds, element.name]), [['turn', 5, 'rotate']]);
  assert.equal(applyEdits(spun, motions[0]?.write(-7.5, 6) ?? []), spun.replace('"5"', '"-7.5"'));
  // What it carries is turned where it is.
  const planet = '<world><group><transform><rotate time="4" y="1"/><translate x="3"/></transform></group></world>', own = targets(planet, 'group', 0, 1).rings[1];
  near(own?.frame.origin as Vec3, [0, 0, -3], 'a quarter of a turn');
  assert.equal(applyEdits(planet, own?.write(20, 1) ?? []), planet.replace('x="3"/>', 'x="3"/> <rotate angle="20" x="0" y="1" z="0"/>'));
  // A still turn beside it has its handle; the one with time is not touched.
  const both = '<world><group><transform><rotate angle="15" x="0" y="0" z="1"/><rotate time="10" x="0" y="1" z="0"/></transform></group></world>', still = targets(both).rings;
  assert.deepEqual(still.map(({ name, angle }) => [name, angle]), [['x', null], ['y', null], ['z', 15]]);
  assert.equal(applyEdits(both, still[2]?.write(10, 1) ?? []), both.replace('"15"', '"25"'));
  const curve = targets('<world><group><translate time="6"><point x="1"/><point x="2"/><point x="3"/><point x="4"/></translate></group></world>');
  assert.deepEqual(curve.motions.map(({ kind, seconds }) => [kind, seconds]), [['lap', 6]]);
});

test('a size is changed where it is, or added last', () => {
  const text = '<world><group><transform><translate x="1"/><scale x="2" y="0.50" z="2"/></transform></group></world>', { scale } = targets(text);
  near(scale?.frame.origin as Vec3, [1, 0, 0]);
  assert.equal(applyEdits(text, scale?.write([2, 0.75, 2], 2) ?? []), text.replace('0.50', '0.75'));
  const none = '<world><group><transform><translate x="1"/></transform></group></world>';
  assert.equal(applyEdits(none, targets(none).scale?.write([2, 1, 1], 2) ?? []), none.replace('x="1"/>', 'x="1"/> <scale x="2" y="1" z="1"/>'));
});

test('lights: a place in their spelling, a direction as a vector or as angles', () => {
  const spot = '<world><lights><light type="spot" posx="1.0" posy="2" posz="3" dirx="0" diry="-1.00" dirz="0"/></lights></world>', own = targets(spot, 'light');
  assert.equal(applyEdits(spot, own.move?.write([1.5, 2, 3], 2) ?? []), spot.replace('posx="1.0"', 'posx="1.5"'));
  assert.equal(applyEdits(spot, own.rings[2]?.write(90, 1) ?? []), spot.replace('dirx="0"', 'dirx="1"').replace('diry="-1.00"', 'diry="0.00"'));
  near(own.rings[0]?.frame.origin as Vec3, [1, 2, 3]);
  const sun = '<scene><lights><light type="DIRECTIONAL" posX="0" posZ="1"/></lights></scene>';
  assert.equal(targets(sun, 'light').move, null);
  assert.equal(applyEdits(sun, targets(sun, 'light').rings[1]?.write(90, 1) ?? []), sun.replace('posX="0"', 'posX="1"').replace('posZ="1"', 'posZ="0"'));
  const angles = '<world><lights><light type="directional" alpha="-38" beta="46"/></lights></world>', [turn, lift] = targets(angles, 'light').rings;
  assert.equal(applyEdits(angles, turn?.write(8, 1) ?? []), angles.replace('-38', '-30'));
  // About that axis a positive turn lowers the light.
  assert.equal(applyEdits(angles, lift?.write(6, 1) ?? []), angles.replace('46', '40'));
  const inGroup = '<scene><group><translate x="5"/><light type="point" posX="1"/></group></scene>';
  near(targets(inGroup, 'light').move?.frame.origin as Vec3, [5, 0, 0]);
  assert.equal(targets('<world><lights><light type="point" space="camera" posx="1"/></lights></world>', 'light').move, null);
});

test('of a model its group is moved; what stands in the root has none', () => {
  const text = '<world><models><model file="a"/></models><group><models><model file="b"/></models></group></world>';
  assert.equal(movedBy(first(text, 'model')), undefined);
  assert.equal(movedBy(first(text, 'model', 1)), first(text, 'group'));
  assert.equal(movedBy(first('<world><camera/></world>', 'camera')), undefined);
});

const lens = new Lens({ eye: [0, 0, 10], target: [0, 0, 0], up: [0, 1, 0], fov: 90, near: 0.1, far: 100 }, 200, 100);

test('a lens projects as the service does, and back', () => {
  assert.deepEqual(lens.project([0, 0, 0]), { x: 100, y: 50 });
  const at = lens.project([10, 5, 0]);
  assert.ok(at && Math.abs(at.x - 150) + Math.abs(at.y - 25) < 1e-9);
  assert.equal(lens.project([0, 0, 11]), null);
  assert.ok(Math.abs(lens.pixelAt([3, 3, 0]) - 0.2) < 1e-12);
  const ray = lens.rayAt({ x: 150, y: 25 });
  near(onPlane([0, 0, 0], [0, 0, 1], ray) as Vec3, [10, 5, 0]);
  assert.ok(Math.abs((alongLine([0, 5, 0], [2, 0, 0], ray) ?? 0) - 5) < 1e-9);
  assert.equal(alongLine([0, 0, 0], [0, 0, 1], lens.rayAt({ x: 100, y: 50 })), null);
  assert.equal(onPlane([0, 0, 0], [0, 1, 0], lens.rayAt({ x: 100, y: 50 })), null);
});

const noSteps = { move: 0, turn: 0, scale: 0 };
const handle = (text: string, tool: 'move' | 'turn' | 'scale', id: string): Handle => {
  const found = handlesOf(targets(text), tool).find((one) => one.id === id);
  assert.ok(found, id);
  return found;
};

test('drags follow the pointer along an axis, in a plane and in the image’s plane, and snap', () => {
  const text = '<world><group><transform><translate x="1" y="0" z="0"/></transform></group></world>', at = { x: 105, y: 50 };
  const after = (id: string, to: { x: number; y: number }, steps = noSteps): string => applyEdits(text, drag(handle(text, 'move', id), lens, at, to, steps));
  assert.equal(after('move-X', { x: 125, y: 80 }), text.replace('x="1"', 'x="5"'));
  assert.equal(after('move-XY', { x: 125, y: 40 }), text.replace('x="1" y="0"', 'x="5" y="2"'));
  assert.equal(after('move-XYZ', { x: 125, y: 40 }), text.replace('x="1" y="0"', 'x="5" y="2"'));
  assert.equal(after('move-X', { x: 126, y: 50 }, { ...noSteps, move: 0.5 }), text.replace('x="1"', 'x="5"'));
  assert.equal(after('move-X', at), text);
  assert.equal(applyEdits(text, nudge(handle(text, 'move', 'move-Y'), -2, { ...noSteps, move: 0.25 })), text.replace('y="0"', 'y="-0.5"'));
  // In a frame that is turned and twice as large the numbers are half, along its own axes.
  const inside = '<world><group><transform><rotate angle="90" x="0" y="0" z="1"/><scale x="2" y="2" z="2"/></transform><group><transform><translate x="0" y="0" z="0"/></transform></group></group></world>';
  const inner = handlesOf(targets(inside, 'group', 1), 'move').find((one) => one.id === 'move-X') as Handle;
  assert.equal(applyEdits(inside, drag(inner, lens, { x: 100, y: 50 }, { x: 100, y: 30 }, noSteps)), inside.replace('<translate x="0"', '<translate x="2"'));
});

test('drags turn and scale, and snap to steps of the numbers', () => {
  const turned = '<world><group><transform><rotate angle="10" x="0" y="0" z="1"/></transform></group></world>', ring = handle(turned, 'turn', 'turn-z-2');
  assert.equal(applyEdits(turned, drag(ring, lens, { x: 150, y: 50 }, { x: 100, y: 10 }, noSteps)), turned.replace('"10"', '"100"'));
  assert.equal(applyEdits(turned, drag(ring, lens, { x: 150, y: 50 }, { x: 100, y: 10 }, { ...noSteps, turn: 45 })), turned.replace('"10"', '"90"'));
  assert.equal(applyEdits(turned, nudge(ring, 1, { ...noSteps, turn: 15 })), turned.replace('"10"', '"25"'));
  // A ring that is seen from the side turns by the way along it.
  const side = drag(handle(turned, 'turn', 'turn-x-0'), lens, { x: 100, y: 50 }, { x: 100, y: 80 }, noSteps);
  assert.notEqual(applyEdits(turned, side), turned);
  const sized = '<world><group><transform><scale x="1" y="1" z="1"/></transform></group></world>';
  assert.equal(applyEdits(sized, drag(handle(sized, 'scale', 'scale-X'), lens, { x: 120, y: 50 }, { x: 140, y: 50 }, noSteps)), sized.replace('x="1"', 'x="2"'));
  const all = applyEdits(sized, drag(handle(sized, 'scale', 'scale-XYZ'), lens, { x: 100, y: 50 }, { x: 175, y: 50 }, { ...noSteps, scale: 0.25 }));
  assert.equal(all, sized.replaceAll('"1"', '"1.75"'));
  assert.deepEqual(handlesOf(targets('<world><group><transform><scale x="0" y="0" z="0"/></transform><group/></group></world>', 'group', 1), 'move'), []);
  const { u, v } = ringAxes([0, 1, 0]);
  assert.ok(Math.abs(dot(u, v)) < 1e-12 && Math.abs(length(u) - 1) < 1e-12);
});

test('an element is removed with its line', () => {
  const text = '<world>\n  <group/>\n  <group name="b"/> <group/>\n</world>', removed = (at: number): string => applyEdits(text, [removeElement(text, first(text, 'group', at))]);
  assert.equal(removed(0), '<world>\n  <group name="b"/> <group/>\n</world>');
  assert.equal(removed(1), '<world>\n  <group/>\n   <group/>\n</world>');
});
