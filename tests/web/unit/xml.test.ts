import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';
import { changeBetween, indexOfColumn, wordLength } from '../../../web/src/editor/places.ts';
import { cameraLightOf, turnCameraLight } from '../../../web/src/scene/camera_light.ts';
import {
  colorOf, elementOf, mannerOf, partsOf, setColor, setNumber, setShininess, setTexture, shininessOf, textureOf, toHex,
} from '../../../web/src/scene/materials.ts';
import { applyEdits, attributeOf, parseXml, setAttribute, walkXml } from '../../../web/src/scene/xml.ts';

const course = `<world>
  <group>
    <!-- <model file="not.3d"/> -->
    <models>
      <model file="a.3d">
        <color><diffuse R="10" G='20' B=30 /></color>
      </model>
      <model file="b.3d"/>
    </models>
  </group>
</world>
`;

const lines = (text: string): string[] => text.split('\n');
/** The lines that differ, by number from 1. */
function changedLines(before: string, after: string): number[] {
  const [a, b] = [lines(before), lines(after)];
  assert.equal(a.length, b.length);
  return a.flatMap((line, i) => (line === b[i] ? [] : [i + 1]));
}

test('elements and attributes are found in tidy and in broken text', () => {
  const roots = parseXml(course);
  assert.deepEqual(partsOf(course, roots).map(({ label, line }) => [label, line]), [['a.3d', 5], ['b.3d', 8]]);
  const broken = parseXml('<world> <> stray > <group><model file=x.3d/ ><Model FILE = "y&amp;z.3d"></group> & </world');
  const models = [...walkXml(broken)].filter((one) => one.name.toLowerCase() === 'model');
  assert.deepEqual(models.map((one) => attributeOf(one, ['file'])?.value), ['x.3d/', 'y&z.3d']);
  // Where a tag holds what is no attribute it still ends, and the next one begins.
  for (const bad of ['<model file="x" = "y"/>', '<model "x"/>', '<model file="x"< y="1"/>', '<model = file="x"/>']) {
    const [world] = parseXml(`<?xml version="1.0">\n<world><models>${bad}<model file="z"/></models></WORLD>`);
    assert.deepEqual(world?.children[0]?.children.map((one) => one.name), ['model', 'model'], bad);
    assert.equal(attributeOf(world?.children[0]?.children[1] as never, ['file'])?.value, 'z', bad);
  }
  for (const text of ['<', '<a', '<a b', '<a b=', '<a b="', '</', '</a>', '<!--', '<![CDATA[', '<a b=c/', '']) parseXml(text);
});

test('every part of an example is found again by its place', () => {
  const folder = 'scenes';
  let found = 0;
  for (const name of readdirSync(folder)) {
    let text: string;
    try {
      text = readFileSync(`${folder}/${name}/scene.xml`, 'utf8');
    } catch {
      continue; // not a scene's folder
    }
    for (const part of partsOf(text, parseXml(text))) {
      assert.match(lines(text)[part.line - 1] ?? '', part.kind === 'model' ? /<model/i : /<light/i);
      found += 1;
    }
  }
  assert.ok(found > 100);
});

test('a colour is written where it stands, and nothing else changes', () => {
  const after = setColor(course, 'model', 0, 'diffuse', [1, 0.5, 0]);
  assert.deepEqual(changedLines(course, after), [6]);
  assert.equal(lines(after)[5], `        <color><diffuse R="255" G='128' B="0" /></color>`);
  const added = setColor(after, 'model', 0, 'specular', [1, 1, 1]);
  assert.equal(lines(added)[5], `        <color><diffuse R="255" G='128' B="0" /> <specular R="255" G="255" B="255" /></color>`);
});

test('what is not there yet is added in the manner of the document', () => {
  const one = setColor(course, 'model', 1, 'diffuse', [1, 0, 0]);
  assert.ok(one.includes(`      <model file="b.3d">\n        <color> <diffuse R="255" G="0" B="0"/> </color>\n      </model>\n`), one);
  const shiny = setShininess(one, 1, 32);
  assert.equal(shininessOf(elementOf(parseXml(shiny), 'model', 1) as never), 32);
  const old = '<scene><group><translate x="1"/><models><model file="a.3d" diffR="0.5" diffG=".2" diffB="1"/></models></group></scene>';
  assert.equal(mannerOf(parseXml(old)), 'engine2017');
  const red = setColor(old, 'model', 0, 'diffuse', [1, 0, 0.25]);
  assert.ok(red.includes('diffR="1" diffG="0" diffB="0.25"'), red);
  const spec = setColor(old, 'model', 0, 'specular', [1, 0, 0.5]);
  assert.ok(spec.includes('diffB="1" specR="1" specG="0" specB="0.5"/>'), spec);
  const newer = '<scene><colors><color name="sand" r="1" g="0.5" b="0"/></colors><models><model command="plane 4" diffuse="sand"/></models></scene>';
  assert.equal(mannerOf(parseXml(newer)), 'engine2020');
  assert.equal(toHex(colorOf(parseXml(newer), elementOf(parseXml(newer), 'model', 0) as never, 'diffuse')), '#ff8000');
  assert.ok(setColor(newer, 'model', 0, 'diffuse', [0, 0, 1]).includes('diffuse="#0000ff"'));
});

test('lights and textures', () => {
  const text = '<world>\n\t<lights>\n\t\t<light type="point" posx="1" posY=2 z="3"/>\n\t</lights>\n\t<group><models><model file="m.3d"/></models></group>\n</world>';
  const moved = setNumber(text, 'light', 0, ['posX', 'x', 'positionX'], -4.5);
  assert.ok(moved.includes('posx="-4.5" posY=2 z="3"/>'), moved);
  assert.ok(setNumber(text, 'light', 0, ['posZ', 'z', 'positionZ'], 7).includes('z="7"'));
  assert.ok(setNumber(text, 'light', 0, ['linear', 'lin'], 0.5).includes('z="3" linear="0.5"/>'));
  const textured = setTexture(text, 0, 'a "b".png');
  assert.equal(textureOf(elementOf(parseXml(textured), 'model', 0) as never), 'a "b".png');
  assert.ok(setTexture(textured, 0, 'c.png').includes('<texture file="c.png"/>'));
});

test('the camera light is added once and then turned', () => {
  const one = turnCameraLight(course, 5, 0);
  assert.deepEqual(cameraLightOf(one), { alpha: 5, beta: 0 });
  const two = turnCameraLight(turnCameraLight(one, 0, 5), 5, 0);
  assert.deepEqual(cameraLightOf(two), { alpha: 10, beta: 5 });
  assert.equal([...walkXml(parseXml(two))].filter((element) => element.name === 'light').length, 1);
  assert.equal(lines(two).length, lines(one).length);
  for (let i = 0, text = two; i < 40; ++i, text = turnCameraLight(text, 0, 5)) assert.ok((cameraLightOf(text)?.beta ?? 99) <= 90);
});

test('attributes keep their quotes and get them where they had none', () => {
  const text = `<a b='1' c=2 d>`;
  const element = parseXml(text)[0] as never;
  assert.equal(applyEdits(text, [setAttribute(element, ['b'], 'x')]), `<a b='x' c=2 d>`);
  assert.equal(applyEdits(text, [setAttribute(element, ['C'], 'x')]), `<a b='1' c="x" d>`);
  assert.equal(applyEdits(text, [setAttribute(element, ['e'], '<"&')]), `<a b='1' c=2 e="&lt;&quot;&amp;" d>`);
  assert.equal(applyEdits(text, [setAttribute(element, ['b'], "it's")]), `<a b='it&apos;s' c=2 d>`);
  const single = `<a b='1'>`;
  assert.equal(applyEdits(single, [setAttribute(parseXml(single)[0] as never, ['c'], "it's")]), `<a b='1' c='it&apos;s'>`);
});

test('columns are bytes, places are characters', () => {
  assert.equal(indexOfColumn('<a é="x">', 4), 3);
  assert.equal(indexOfColumn('<a é="x">', 6), 4);
  assert.equal(indexOfColumn('<a 😀="x">', 8), 5);
  assert.equal(indexOfColumn('ab', 99), 2);
  assert.equal(wordLength('<model file="a b"/>', 0), 6);
  assert.equal(wordLength('<model file="a b"/>', 12), 5);
  assert.equal(wordLength('<model file="a b"/>', 7), 4);
  assert.deepEqual(changeBetween('abcdef', 'abXdef'), { from: 2, to: 3, insert: 'X' });
  assert.deepEqual(changeBetween('aaa', 'aaaa'), { from: 3, to: 3, insert: 'a' });
});
