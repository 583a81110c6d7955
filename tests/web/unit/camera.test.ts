import assert from 'node:assert/strict';
import { test } from 'node:test';
import {
  fitFov, orbitEye, orbitOf, panOrbit, slideOrbit, stepWalk, turnOrbit, turnWalk, walkOf, walkTarget, wrapDegrees, zoomOrbit, type Orbit,
} from '../../../web/src/maths/camera.ts';
import { length, sub, type Vec3 } from '../../../web/src/maths/vec.ts';

const near = (a: Vec3, b: readonly number[], tolerance = 1e-9): void =>
  a.forEach((x, i) => assert.ok(Math.abs(x - (b[i] as number)) <= tolerance, `${a} is not ${b}`));
const orbit: Orbit = { azimuth: 0, elevation: 0, distance: 5, target: [1, 2, 3] };

test('the eye of an orbit: azimuth 0 is +Z, 90 is +X, elevation is up', () => {
  near(orbitEye(orbit), [1, 2, 8]);
  near(orbitEye({ ...orbit, azimuth: 90 }), [6, 2, 3]);
  near(orbitEye({ ...orbit, elevation: 30 }), [1, 4.5, 3 + 5 * Math.cos(Math.PI / 6)]);
});

test('an orbit and its eye lead to each other', () => {
  for (const azimuth of [-170, -90, 0, 33, 179])
    for (const elevation of [-80, -10, 0, 45, 88]) {
      const one = { azimuth, elevation, distance: 7, target: [1, -2, 0.5] as Vec3 };
      const back = orbitOf({ eye: orbitEye(one), target: one.target });
      assert.ok(Math.abs(back.azimuth - azimuth) < 1e-9 && Math.abs(back.elevation - elevation) < 1e-9 && Math.abs(back.distance - 7) < 1e-9);
    }
});

test('turning keeps the distance, wraps round and stops before the poles', () => {
  const turned = turnOrbit({ ...orbit, azimuth: 170 }, 30, 500);
  assert.equal(turned.azimuth, -160);
  assert.equal(turned.elevation, 89);
  assert.ok(Math.abs(length(sub(orbitEye(turned), turned.target)) - 5) < 1e-9);
  assert.equal(wrapDegrees(-540), -180);
  assert.equal(zoomOrbit(orbit, 0.5).distance, 2.5);
  assert.ok(zoomOrbit(orbit, 1e-30).distance > 0);
});

test('panning moves the target with the picture, across the view', () => {
  // At 90 degrees and 200 px of height, the distance is half the height: 5/100 a pixel.
  near(panOrbit(orbit, 100, 0, 90, 200).target, [1 - 5, 2, 3]);
  near(panOrbit(orbit, 0, 100, 90, 200).target, [1, 2 + 5, 3]);
  const high = { ...orbit, azimuth: 40, elevation: 50 };
  const moved = sub(panOrbit(high, 30, -20, 60, 400).target, high.target), view = sub(orbitEye(high), high.target);
  assert.ok(Math.abs(moved[0] * view[0] + moved[1] * view[1] + moved[2] * view[2]) < 1e-9);
});

test('sliding stays on the ground', () => {
  near(slideOrbit(orbit, 0.1, 0).target, [1, 2, 2.5]);
  near(slideOrbit(orbit, 0, 0.1).target, [1.5, 2, 3]);
  near(slideOrbit({ ...orbit, azimuth: 90, elevation: 60 }, 0.1, 0).target, [0.5, 2, 3]);
});

test('walking: yaw 0 looks along +Z, left is towards +X', () => {
  const walk = walkOf({ eye: [0, 1, 0], target: [0, 1, 5] });
  assert.equal(walk.yaw, 0);
  near(walkTarget(walk), [0, 1, 1]);
  near(walkTarget(turnWalk(walk, 90, 0)), [1, 1, 0]);
  near(stepWalk(walk, 2, 0).eye, [0, 1, 2]);
  near(stepWalk(walk, 0, 2).eye, [-2, 1, 0]);
  assert.equal(turnWalk(walk, 0, 400).pitch, 89);
});

test('a narrow stage keeps the width of the window', () => {
  assert.equal(fitFov(60, 4 / 3, 2), 60);
  const fov = fitFov(60, 2, 1);
  assert.ok(Math.abs(Math.tan((fov * Math.PI) / 360) - 2 * Math.tan(Math.PI / 6)) < 1e-12);
});
