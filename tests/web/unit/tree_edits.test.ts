// Adding, doubling and removing parts, in the manner of the document.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { elementAt } from '../../../web/src/scene/hide.ts';
import { doubled, removed, shapes, withGroup, withLight, withShape } from '../../../web/src/scene/tree_edits.ts';
import { kindOf } from '../../../web/src/scene/tree.ts';
import { parseXml, walkXml, type XmlElement } from '../../../web/src/scene/xml.ts';

const course = '<world>\n  <group name="a">\n    <models>\n      <model file="box_1.3d" />\n    </models>\n  </group>\n</world>\n';
const first = (text: string, kind: string): XmlElement => [...walkXml(parseXml(text))].find((one) => kindOf(one) === kind) as XmlElement;

test('a shape goes into the group’s list, into a new list, or into a group of its own', () => {
  const inGroup = withShape(course, first(course, 'group'), ['sphere', '1']);
  assert.equal(inGroup.text, course.replace('<model file="box_1.3d" />', '<model file="box_1.3d" />\n      <model file="sphere_1.3d" />'));
  assert.equal(elementAt(parseXml(inGroup.text), inGroup.added ?? -1)?.name, 'model');
  const own = withShape(course, undefined, ['cone', '1', '0.5']);
  assert.equal(own.text, course.replace('  </group>\n</world>', '  </group>\n  <group> <models> <model file="cone_1_0.5.3d" /> </models> </group>\n</world>'));
  assert.equal(elementAt(parseXml(own.text), own.added ?? -1)?.name, 'group');
  const named = '<scene><colors/><group><model command="box 1"/></group></scene>';
  assert.equal(withShape(named, first(named, 'group'), ['sphere', '1']).text, named.replace('</group>', ' <model command="sphere 1"/></group>'));
  // In the names, quotes and order of the document, whose models stand in no list.
  const old = "<scene>\n\t<Group name='a'>\n\t\t<Model FILE='box_1.3d' diffR='1'/>\n\t\t<Group name='b'/>\n\t</Group>\n</scene>\n", outer = first(old, 'group');
  assert.equal(withShape(old, outer, ['sphere', '1']).text, old.replace("diffR='1'/>", "diffR='1'/>\n\t\t<Model FILE='sphere_1.3d'/>"));
  assert.equal(withShape(old, outer.children[1], ['sphere', '1']).text, old.replace("<Group name='b'/>", "<Group name='b'>\n\t\t\t<Model FILE='sphere_1.3d'/>\n\t\t</Group>"));
  assert.equal(withShape(old, undefined, ['sphere', '1']).text, old.replace('</Group>\n</scene>', "</Group>\n\t<Group> <Model FILE='sphere_1.3d'/> </Group>\n</scene>"));
  assert.ok(shapes.length > 8 && shapes.every(({ name, call }) => call[0] === name && call.length > 1));
});

test('a light is spelled like the others, in their list or in one before the groups', () => {
  const none = withLight(course, 'point');
  assert.equal(none.text, course.replace('  <group', '  <lights> <light type="point" posX="2" posY="4" posZ="2" /> </lights>\n  <group'));
  const some = "<world><lights><light type='point' posx='1'/></lights></world>", added = withLight(some, 'spot');
  assert.equal(added.text, some.replace("posx='1'/>", "posx='1'/> <light type='spot' posx='2' posy='4' posz='2' dirX='-2' dirY='-4' dirZ='-2' cutoff='30'/>"));
  assert.equal(elementAt(parseXml(added.text), added.added ?? -1)?.name, 'light');
});

test('a part is doubled beside itself and removed with its line', () => {
  const group = first(course, 'group'), two = doubled(course, group), piece = course.slice(group.start, group.end);
  assert.equal(two.text, course.replace(piece, `${piece}\n  ${piece}`));
  assert.equal(two.added, course.replace(piece, `${piece}\n  `).indexOf('</world>') - 1);
  assert.equal(removed(course, group).text, '<world>\n</world>\n');
  assert.equal(withGroup(course, group, 'b').text, course.replace('    </models>\n', '    </models>\n    <group name="b" />\n'));
});
