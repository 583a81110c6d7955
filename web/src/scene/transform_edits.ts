// What handles change: the numbers of a group's transforms and of a light's place and direction, in the document's own style.
// Each target has the frame in which its numbers are meant, and writes new ones as edits of the text.
import { applyLinear, axisAngle, multiply, rotation, unit, type Affine } from '../maths/matrix.ts';
import { catmullRom, lapAt } from '../maths/curve.ts';
import { add, dot, sub, type Vec3 } from '../maths/vec.ts';
import { spellings } from './language.ts';
import { groupAround, kindOf } from './tree.ts';
import { axes, frameOf, isTransforms, numberAt, pointsOf, productOf, transformKind, transformsOf, type Transform } from './transforms.ts';
import { newTransform, setNumberAt, setVector, vectorAt, vectorNames, wrapsTransforms } from './writing.ts';
import { attributeOf, indentUnit, insertAfter, insertBefore, prependChild, type Edit, type XmlElement } from './xml.ts';

/** A vector of the document: the place of a group or light, or the factors of a scale. */
export interface VectorTarget {
  frame: Affine; // of the numbers, in the world
  value: Vec3;
  write(value: Vec3, decimals: number): Edit[];
}

/** A turn about one axis. */
export interface Ring {
  axis: Vec3; // in the frame, of length 1
  name: string; // x, y or z, or empty for an axis of another direction
  frame: Affine;
  angle: number | null; // the number that changes, degrees; null: the turn is written as another axis and angle
  write(delta: number, decimals: number): Edit[];
}

/** A turn or a lap that goes on with time. */
export interface Motion {
  kind: 'turn' | 'lap';
  element: XmlElement;
  seconds: number; // negative: the other way round
  write(seconds: number, decimals: number): Edit[];
}

export interface Targets {
  move: VectorTarget | null;
  scale: VectorTarget | null;
  rings: readonly Ring[];
  motions: readonly Motion[];
}

interface Document {
  text: string;
  roots: readonly XmlElement[];
}

const units: readonly Vec3[] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
const none: Targets = { move: null, scale: null, rings: [], motions: [] };

/** Where a new transform goes: first, or after one that is there. */
function insertTransform({ text, roots }: Document, group: XmlElement, after: XmlElement | undefined, piece: string): Edit {
  const unitOf = indentUnit(text, roots);
  if (after) return insertAfter(text, after, piece);
  const wrapper = group.children.find(isTransforms), direct = group.children.find((child) => transformKind(child) !== undefined);
  if (wrapper) return prependChild(text, wrapper, piece, unitOf);
  if (direct) return insertBefore(text, direct, piece);
  const name = spellings('transform')[0] as string;
  return prependChild(text, group, wrapsTransforms(roots) ? `<${name}> ${piece} </${name}>` : piece, unitOf);
}

function moveTarget(document: Document, group: XmlElement, outer: Affine, transforms: readonly Transform[], timeS: number): VectorTarget {
  const index = transforms.findIndex((one) => one.kind === 'translate'), found = transforms[index];
  if (!found)
    return { frame: outer, value: [0, 0, 0], write: (value, decimals) => [insertTransform(document, group, undefined, newTransform(document.text, document.roots, 'translate', value, null, decimals))] };
  const frame = multiply(outer, productOf(transforms.slice(0, index), timeS)), names = vectorNames('point');
  if (found.form === 'still' && found.points.length === 0)
    return { frame, value: found.vector, write: (value, decimals) => setVector(found.element, vectorNames('translate'), found.vector, value, decimals) };
  // A curve moves with all its points.
  const value = found.form === 'curve' ? catmullRom(found.points, lapAt(timeS, found.seconds)).position : found.vector;
  return {
    frame, value,
    write: (next, decimals) => pointsOf(found.element).flatMap((point) => {
      const before = vectorAt(point, names);
      return setVector(point, names, before, add(before, sub(next, value)), decimals);
    }),
  };
}

function scaleTarget(document: Document, group: XmlElement, outer: Affine, transforms: readonly Transform[], timeS: number): VectorTarget {
  const index = transforms.findIndex((one) => one.kind === 'scale'), found = transforms[index], last = transforms[transforms.length - 1];
  if (found) {
    const frame = multiply(outer, productOf(transforms.slice(0, index), timeS));
    return { frame, value: found.vector, write: (value, decimals) => setVector(found.element, vectorNames('scale'), found.vector, value, decimals) };
  }
  return {
    frame: multiply(outer, productOf(transforms, timeS)), value: [1, 1, 1],
    write: (value, decimals) => [insertTransform(document, group, last?.element, newTransform(document.text, document.roots, 'scale', value, null, decimals))],
  };
}

/** Degrees within a turn of 0, as documents write them. */
const wrapped = (angle: number): number => (Math.abs(angle) > 360 ? angle % 360 : angle);
const parallel = (a: Vec3, b: Vec3): number => {
  const along = dot(unit(a), unit(b));
  return Math.abs(along) > 1 - 1e-9 ? Math.sign(along) : 0;
};

/** How a turn is added to a rotation that is there. */
function turnOf(found: Transform, axis: Vec3): Pick<Ring, 'angle' | 'write'> {
  const names = vectorNames('rotate'), angleNames = spellings('rotate', 'angle'), sign = parallel(found.vector, axis);
  if (sign !== 0)
    return { angle: found.angle * sign, write: (delta, decimals) => setNumberAt(found.element, angleNames, wrapped(found.angle + sign * delta), decimals) };
  return {
    angle: null,
    write: (delta, decimals) => {
      const turned = axisAngle(multiply(rotation(axis, delta), rotation(found.vector, found.angle))), isBack = dot(turned.axis, found.vector) < 0;
      const direction = turned.axis.map((x) => (isBack ? -x : x)) as unknown as Vec3, digits = Math.max(4, decimals);
      const rounded = direction.map((x) => Number(x.toFixed(digits))) as unknown as Vec3;
      return [...setNumberAt(found.element, angleNames, isBack ? -turned.angle : turned.angle, Math.max(2, decimals)), ...setVector(found.element, names, found.vector, rounded, digits)];
    },
  };
}

function ringsOf(document: Document, group: XmlElement, outer: Affine, transforms: readonly Transform[], timeS: number): Ring[] {
  const still = transforms.filter((one) => one.kind === 'rotate' && one.form === 'still');
  const frameBefore = (index: number): Affine => multiply(outer, productOf(transforms.slice(0, index), timeS));
  const nameOf = (axis: Vec3): string => axes[units.findIndex((one) => parallel(axis, one) !== 0)] ?? '';
  const ownRing = (one: Transform): Ring => ({ axis: unit(one.vector), name: nameOf(one.vector), frame: frameBefore(transforms.indexOf(one)), ...turnOf(one, unit(one.vector)) });
  const turning = still.filter((one) => dot(one.vector, one.vector) > 0), found = turning[0];
  // Several turns, each by its own angle.
  if (turning.length > 1) return turning.map(ownRing);
  if (found) {
    const frame = frameBefore(transforms.indexOf(found)), own = ownRing(found);
    const rings = units.map((axis, i): Ring => ({ axis, name: axes[i] as string, frame, ...turnOf(found, axis) }));
    return own.name === '' ? [...rings, own] : rings;
  }
  // Before a turn with time, which is turned as a whole, or after the place that it carries.
  const index = transforms.map((one) => one.kind).lastIndexOf('translate'), after = transforms[index]?.element, frame = frameBefore(index + 1);
  return units.map((axis, i) => ({
    axis, name: axes[i] as string, frame, angle: 0,
    write: (delta, decimals) => [insertTransform(document, group, after, newTransform(document.text, document.roots, 'rotate', axis, wrapped(delta), decimals))],
  }));
}

function motionOf({ form, element, seconds }: Transform): Motion[] {
  if (form === 'still') return [];
  const names = spellings(form === 'spin' ? 'rotate' : 'translate', 'time');
  return [{ kind: form === 'spin' ? 'turn' : 'lap', element, seconds, write: (next, decimals) => setNumberAt(element, names, next, decimals) }];
}

const isDirectional = (light: XmlElement): boolean => /^(dir|sun)/i.test(attributeOf(light, spellings('light', 'type'))?.value.trim() ?? '');
const hasAny = (light: XmlElement, prefix: 'pos' | 'dir'): boolean => axes.some((axis) => attributeOf(light, vectorNames('light', prefix)[axis]));

function lightTargets(light: XmlElement, frame: Affine): Targets {
  if (/^(camera|eye|view)$/i.test(attributeOf(light, spellings('light', 'space'))?.value.trim() ?? '')) return none;
  const place = vectorNames('light', 'pos'), directional = isDirectional(light), value = vectorAt(light, place);
  const move = directional ? null : { frame, value, write: (next: Vec3, decimals: number) => setVector(light, place, value, next, decimals) };
  const alpha = numberAt(light, spellings('light', 'alpha')), beta = numberAt(light, spellings('light', 'beta'));
  const origin: Affine = { ...frame, origin: directional ? frame.origin : add(frame.origin, applyLinear(frame, value)) };
  if (directional && (alpha !== undefined || beta !== undefined)) {
    const turn = rotation([0, 1, 0], alpha ?? 0);
    return {
      ...none, rings: [
        { axis: [0, 1, 0], name: 'y', frame: origin, angle: alpha ?? 0, write: (delta, decimals) => setNumberAt(light, spellings('light', 'alpha'), wrapped((alpha ?? 0) + delta), decimals) },
        { axis: turn.x, name: 'x', frame: origin, angle: -(beta ?? 0), write: (delta, decimals) => setNumberAt(light, spellings('light', 'beta'), Math.min(90, Math.max(-90, (beta ?? 0) - delta)), decimals) },
      ],
    };
  }
  const isAimed = directional || hasAny(light, 'dir'), aim = vectorNames('light', directional && !hasAny(light, 'dir') ? 'pos' : 'dir'), direction = vectorAt(light, aim);
  if (!isAimed || dot(direction, direction) === 0) return { ...none, move };
  const rings = units.map((axis, i): Ring => ({
    axis, name: axes[i] as string, frame: origin, angle: null,
    write: (delta, decimals) => setVector(light, aim, direction, applyLinear(rotation(axis, delta), direction).map((x) => Number(x.toFixed(Math.max(3, decimals)))) as unknown as Vec3, Math.max(3, decimals)),
  }));
  return { ...none, move, rings };
}

/** What is moved where an element is selected: itself, or the group of a model. Undefined: nothing can be. */
export function movedBy(element: XmlElement): XmlElement | undefined {
  const kind = kindOf(element);
  if (kind === 'light' || kind === 'group') return element;
  return kind === 'model' || kind === 'include' ? groupAround(element) : undefined;
}

/** The targets of a group or light at a time of the animation. */
export function targetsOf(document: Document, element: XmlElement, timeS: number): Targets {
  const outer = frameOf(element.parent, timeS);
  if (kindOf(element) === 'light') return lightTargets(element, outer);
  if (kindOf(element) !== 'group') return none;
  const transforms = transformsOf(element);
  return {
    move: moveTarget(document, element, outer, transforms, timeS), scale: scaleTarget(document, element, outer, transforms, timeS),
    rings: ringsOf(document, element, outer, transforms, timeS), motions: transforms.flatMap(motionOf),
  };
}

