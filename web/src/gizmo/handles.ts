// The handles of the selected element, and what a drag or a key does to its numbers.
import { decimalsOf } from '../scene/number_text.ts';
import type { Ring, Targets, VectorTarget } from '../scene/transform_edits.ts';
import type { Edit } from '../scene/xml.ts';
import { applyAffine, applyLinear, inverse, unit, type Affine } from '../maths/matrix.ts';
import { add, cross, degrees, dot, length, scale, sub, type Vec3 } from '../maths/vec.ts';
import { alongLine, onPlane, type Lens, type Point } from './lens.ts';

export type Tool = 'move' | 'turn' | 'scale';

/** `along`: the axes that a move or scale changes; all three of a move are those of the image's plane. */
export type Handle =
  | { id: string; tool: 'move' | 'scale'; along: readonly (0 | 1 | 2)[]; target: VectorTarget }
  | { id: string; tool: 'turn'; ring: Ring };

/** Steps of moves in units, of turns in degrees, of scales in factors; 0: none. */
export interface Steps {
  move: number;
  turn: number;
  scale: number;
}

export const axisNames = ['X', 'Y', 'Z'] as const;
const columns = (frame: Affine): readonly Vec3[] => [frame.x, frame.y, frame.z];
export const axisOf = (frame: Affine, axis: number): Vec3 => columns(frame)[axis] as Vec3;

export function handlesOf(targets: Targets, tool: Tool): Handle[] {
  if (tool === 'turn') return targets.rings.map((ring, index) => ({ id: `turn-${ring.name || 'own'}-${index}`, tool, ring }));
  const target = tool === 'move' ? targets.move : targets.scale;
  if (!target || !inverse(target.frame)) return [];
  // The last one is on top: the middle, which an arrow that points at the viewer would cover.
  const sets: readonly (readonly (0 | 1 | 2)[])[] = tool === 'move' ? [[0, 1], [1, 2], [0, 2], [0], [1], [2], [0, 1, 2]] : [[0], [1], [2], [0, 1, 2]];
  return sets.map((along) => ({ id: `${tool}-${along.map((axis) => axisNames[axis]).join('')}`, tool, along, target }));
}

/** Where the handle's tool has its middle: what it moves, or what stays where it is. */
export const centerOf = (handle: Handle): Vec3 =>
  handle.tool === 'turn' ? handle.ring.frame.origin : handle.tool === 'move' ? applyAffine(handle.target.frame, handle.target.value) : handle.target.frame.origin;

const snapped = (value: number, step: number): number => (step > 0 ? Math.round(value / step) * step : value);

const maxJump = 4; // CSS pixels that the last decimal of a dragged number may be worth

/** Decimals that a drag needs, of numbers that are `perNumber` world units each. */
const finest = (pixel: number, perNumber: number): number => Math.min(6, Math.max(0, Math.ceil(-Math.log10((maxJump * pixel) / (perNumber || 1)))));

/** Two axes of length 1 in the plane across `axis`: v is u, turned by 90 degrees about it. */
export function ringAxes(axis: Vec3): { u: Vec3; v: Vec3 } {
  const u = unit(cross(axis, Math.abs(axis[1]) > 0.9 ? [1, 0, 0] : [0, 1, 0]));
  return { u, v: cross(axis, u) };
}

/** What a drag from one point to another makes of a handle: edits of the text as it was when the drag began. */
export function drag(handle: Handle, lens: Lens, from: Point, to: Point, steps: Steps): Edit[] {
  return handle.tool === 'turn' ? dragRing(handle.ring, lens, from, to, steps.turn) : handle.tool === 'move' ? dragMove(handle, lens, from, to, steps.move) : dragScale(handle, lens, from, to, steps.scale);
}

function write(target: VectorTarget, value: readonly number[], along: readonly number[], step: number, decimals: number): Edit[] {
  const next = target.value.map((before, i) => (along.includes(i) ? snapped(value[i] as number, step) : before)) as unknown as Vec3;
  return target.write(next, step > 0 ? Math.max(decimalsOf(step), 0) : decimals);
}

type Straight = Extract<Handle, { along: readonly number[] }>;

/** Where on an axis the pointer is: the place of the axis that is nearest to it in the image, in lengths of the direction. */
function alongAxis(lens: Lens, middle: Vec3, direction: Vec3, point: Point): number | null {
  const a = lens.project(middle), b = lens.project(add(middle, scale(unit(direction), 40 * lens.pixelAt(middle))));
  if (!a || !b) return null;
  const [dx, dy] = [b.x - a.x, b.y - a.y], share = ((point.x - a.x) * dx + (point.y - a.y) * dy) / (dx * dx + dy * dy || 1);
  return alongLine(middle, direction, lens.rayAt({ x: a.x + share * dx, y: a.y + share * dy }));
}

function dragMove({ target, along }: Straight, lens: Lens, from: Point, to: Point, step: number): Edit[] {
  const { frame, value } = target, middle = applyAffine(frame, value), pixel = lens.pixelAt(middle), back = inverse(frame);
  if (!back) return [];
  let delta: Vec3;
  if (along.length === 1) {
    const direction = axisOf(frame, along[0] as number), [a, b] = [from, to].map((point) => alongAxis(lens, middle, direction, point));
    if (a === null || b === null || a === undefined || b === undefined) return [];
    delta = [0, 1, 2].map((i) => (i === along[0] ? b - a : 0)) as unknown as Vec3;
  } else {
    const normal = along.length === 3 ? lens.view.forward : cross(axisOf(frame, along[0] as number), axisOf(frame, along[1] as number));
    const [a, b] = [from, to].map((point) => onPlane(middle, normal, lens.rayAt(point)));
    if (!a || !b) return [];
    delta = applyLinear(back, sub(b, a));
  }
  const perNumber = Math.max(...along.map((axis) => length(axisOf(frame, axis))));
  return write(target, add(value, delta), along, step, finest(pixel, perNumber));
}

function dragScale({ target, along }: Straight, lens: Lens, from: Point, to: Point, step: number): Edit[] {
  const { frame, value } = target, middle = frame.origin;
  let factor: number;
  if (along.length === 1) {
    const direction = axisOf(frame, along[0] as number), [a, b] = [from, to].map((point) => alongAxis(lens, middle, direction, point));
    if (!a || b === null || b === undefined) return [];
    factor = b / a;
  } else factor = Math.exp((to.x - from.x - (to.y - from.y)) / 150);
  const next = value.map((x) => (x === 0 ? factor - 1 : x * factor));
  return write(target, next, along, step, 3);
}

function dragRing(ring: Ring, lens: Lens, from: Point, to: Point, step: number): Edit[] {
  const delta = ringAngle(ring, lens, from, to);
  return delta === null ? [] : turn(ring, delta, step);
}

const turn = (ring: Ring, delta: number, step: number): Edit[] =>
  ring.write(ring.angle === null ? snapped(delta, step) : snapped(ring.angle + delta, step) - ring.angle, step > 0 ? decimalsOf(step) : 1);

/** The degrees of the turn that takes one point of the stage to another. */
function ringAngle({ axis, frame }: Ring, lens: Lens, from: Point, to: Point): number | null {
  const back = inverse(frame);
  if (!back) return null;
  const { u, v } = ringAxes(axis), world = { u: applyLinear(frame, u), v: applyLinear(frame, v) }, normal = cross(world.u, world.v);
  const facing = Math.abs(dot(unit(normal), unit(sub(frame.origin, lens.camera.eye))));
  if (facing > 0.15) {
    const [a, b] = [from, to].map((point) => {
      const hit = onPlane(frame.origin, normal, lens.rayAt(point)), local = hit && applyAffine(back, hit);
      return local ? Math.atan2(dot(local, v), dot(local, u)) : null;
    });
    if (a === null || b === null || a === undefined || b === undefined) return null;
    return ((((b - a) * degrees + 540) % 360) + 360) % 360 - 180;
  }
  // Seen from the side: by the way along the line that the ring is then.
  const middle = lens.project(frame.origin), toEye = sub(lens.camera.eye, frame.origin);
  const near = add(scale(u, dot(toEye, world.u)), scale(v, dot(toEye, world.v))), tangent = applyLinear(frame, cross(axis, unit(near)));
  const ahead = lens.project(add(frame.origin, scale(tangent, lens.pixelAt(frame.origin) / (length(tangent) || 1))));
  if (!middle || !ahead) return null;
  const size = Math.hypot(ahead.x - middle.x, ahead.y - middle.y) || 1;
  return (((to.x - from.x) * (ahead.x - middle.x) + (to.y - from.y) * (ahead.y - middle.y)) / size) * 0.6;
}

/** What a key does: so many steps along the handle's first axis, or degrees about its ring. */
export function nudge(handle: Handle, count: number, steps: Steps): Edit[] {
  if (handle.tool === 'turn') return turn(handle.ring, count * (steps.turn || 1), 0);
  const { target, along } = handle, step = handle.tool === 'move' ? steps.move || 0.1 : steps.scale || 0.1;
  const next = target.value.map((x, i) => (along.includes(i as 0 | 1 | 2) ? x + count * step : x));
  return write(target, next, along, 0, Math.max(decimalsOf(step), 3));
}

/** The numbers of a handle, as a screen reader says them. */
export function valueText(handle: Handle): string {
  if (handle.tool === 'turn') return handle.ring.angle === null ? '' : `${Number(handle.ring.angle.toFixed(2))}°`;
  return handle.along.map((axis) => `${(axisNames[axis] as string).toLowerCase()} ${Number((handle.target.value[axis] as number).toFixed(4))}`).join(', ');
}
