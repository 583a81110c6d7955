import assert from 'node:assert/strict';
import { File } from 'node:buffer'; // no global before Node.js 20
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { curesOf } from '../../../web/derive/cures.ts';
import { schemaOf } from '../../../web/derive/schema.ts';
import { faultOf, type SceneFacts } from '../../../web/src/api.ts';
import { bundleOf, mainScene, stripCommonFolder } from '../../../web/src/scene/bundle.ts';
import { animatedWebpOf, apngOf, frameCount, frameTime } from '../../../web/src/scene/animation.ts';
import { lapTime } from '../../../web/src/scene/clock.ts';
import { keysOf, moversOf } from '../../../web/src/scene/motion.ts';

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
  const { elements } = schemaOf(readFileSync('api/schema.json', 'utf8'));
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
  const bundle = await bundleOf([file('f/s.xml'), file('f/t/x.png'), file('f/.DS_Store'), file('f/__MACOSX/y')]);
  assert.ok('body' in bundle);
  const { body } = bundle.body();
  assert.deepEqual([...(body as FormData)].map(([name, value]) => [name, (value as File).name]), [['scene', 's.xml'], ['file', 't/x.png']]);
  const mesh = await bundleOf([file('hare.ply')]);
  assert.ok('body' in mesh);
  const scene = (mesh.body().body as FormData).get('scene') as File;
  assert.match(await scene.text(), /<model file="hare.ply"\/>/);
  const both = await bundleOf([file('m/a&b.stl'), file('m/c.3DB'), file('m/notes.txt')]);
  assert.ok('body' in both);
  const together = await ((both.body().body as FormData).get('scene') as File).text();
  assert.match(together, /<title>a&amp;b.stl and 1 more<\/title>/);
  assert.deepEqual(together.match(/<model file="[^"]*"/g), ['<model file="a&amp;b.stl"', '<model file="c.3DB"']);
  assert.ok('message' in await bundleOf([file('x.pdf')]));
  assert.ok('message' in await bundleOf([file('s.xml', 17 * 1024 * 1024)]));
});

test('of a whole project only what its scenes need is sent', async () => {
  const file = (path: string, text = '') => ({ path, file: new File([text], path) });
  const needed = [
    file('p/s.xml', '<world><model file="M/hare.OBJ"/><texture file=\'my%20skin.png\'/><model file=bezier_comet_3.3d/></world>'),
    file('p/m/Hare.obj', 'mtllib hare.mtl'), file('p/m/hare.mtl', 'map_Kd fur.png'), file('p/t/fur.png'), file('p/t/my skin.png'),
    file('p/comet.patch'),
  ];
  const build = Array.from({ length: 400 }, (_, i) => file(`p/build/o${i}.o`, 'object'));
  const bundle = await bundleOf([...build, ...needed]);
  assert.ok('body' in bundle);
  const sent = [...(bundle.body().body as FormData)].map(([, value]) => (value as File).name);
  assert.deepEqual(sent.sort(), needed.map(({ path }) => path.slice(2)).sort());
});

test('time runs in laps', () => {
  assert.equal(lapTime(12, 0, 10), 2);
  assert.equal(lapTime(-1, 0, 10), 9);
  assert.equal(lapTime(5, 5, 10), 5);
});

test('why a scene cannot be rendered is told with its place, or without one', () => {
  const facts = { id: 'a', valid: false, title: '', description: '', links: { self: '', source: '', image: '', thumbnail: '' } };
  const error = { code: 'xml.unclosed', severity: 'error' as const, message: 'm', line: 3 }, crash = { code: 'worker.crashed', message: 'c' };
  const of = (rest: Pick<SceneFacts, 'diagnostics' | 'problem'>) => faultOf({ ...facts, ...rest });
  assert.equal(of({ diagnostics: [error], problem: { code: 'xml.unclosed', message: 'm' } }), error);
  assert.deepEqual(of({ diagnostics: [], problem: crash }), { ...crash, severity: 'error' });
  assert.deepEqual(of({ diagnostics: [error], problem: crash }), { ...crash, severity: 'error' });
  assert.equal(of({ diagnostics: [error] }), error);
});

test('the timeline has a key wherever something is where it began', () => {
  const text = `<world><group name="Earth"><transform><rotate time="4" y="1"/><translate time="6"><point/><point/><point/><point/></translate></transform>
    <group><transform><rotate seconds="-8" x="1"/><rotate angle="30"/><translate time="3" x="1"/></transform></group></group></world>`;
  const movers = moversOf(text);
  assert.deepEqual(movers, [{ kind: 'turn', name: 'Earth', seconds: 4 }, { kind: 'lap', name: 'Earth', seconds: 6 }, { kind: 'turn', name: 'Earth', seconds: 8 }]);
  const keys = keysOf(movers, 0, 12);
  assert.deepEqual(keys.map(({ time }) => time), [0, 4, 6, 8, 12]);
  assert.deepEqual(keys[3]?.movers.map(({ mover, count }) => [mover.seconds, count]), [[4, 2], [8, 1]]);
  assert.deepEqual(keysOf(movers, 5, 4).map(({ time }) => time), [6, 8], 'a range that begins later');
  assert.deepEqual(keysOf([{ kind: 'turn', name: '', seconds: 0.001 }], 0, 60), [], 'too many to see');
  assert.deepEqual(moversOf('<world><rotate time="0"/><rotate time="x"/><rotate time="1e999"'), []);
});

test('an animation has the frames, moments and length that were chosen', () => {
  const plan = { format: 'apng', width: 4, height: 3, fps: 10, from: 2, seconds: 6, speed: 2 } as const;
  assert.equal(frameCount(plan), 30);
  assert.deepEqual([0, 1, 29].map((index) => frameTime(plan, index)), [2, 2.2, 7.8]);
});

test('frames that are no images, or of other sizes, are no animation', () => {
  assert.throws(() => apngOf([new Uint8Array(40)], 10));
  assert.throws(() => animatedWebpOf([new TextEncoder().encode('RIFF0000WEBPVP8 \xff\xff\xff\xff')], 10, { width: 1, height: 1 }));
  const png = (width: number): Uint8Array => {
    const head = Buffer.alloc(25);
    head.writeUInt32BE(13, 0);
    head.write('IHDR', 4, 'latin1');
    head.writeUInt32BE(width, 8);
    head.writeUInt32BE(1, 12);
    const data = Buffer.from([0, 0, 0, 1, 0x49, 0x44, 0x41, 0x54, 7, 0, 0, 0, 0]);
    return new Uint8Array(Buffer.concat([Buffer.from([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10]), head, data]));
  };
  assert.throws(() => apngOf([png(1), png(2)], 10));
  assert.ok(apngOf([png(1), png(1)], 10).size > 100);
});
