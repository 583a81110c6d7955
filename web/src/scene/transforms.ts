// The transforms of a scene as its document writes them, and the frames that they make (scene/animation.cpp).
import { alignedFrame, catmullRom, lapAt } from '../maths/curve.ts';
import { applyAffine, identity, multiply, rotation, scaling, translation, type Affine } from '../maths/matrix.ts';
import type { Vec3 } from '../maths/vec.ts';
import { spellings } from './language.ts';
import { parseNumber } from './number_text.ts';
import { kindOf } from './tree.ts';
import { attributeOf, type XmlElement } from './xml.ts';

export type TransformKind = 'translate' | 'rotate' | 'scale';
export const axes = ['x', 'y', 'z'] as const;
export type Axis = (typeof axes)[number];

/** `curve` and `spin` move with time. */
export interface Transform {
  kind: TransformKind;
  form: 'still' | 'curve' | 'spin';
  element: XmlElement;
  vector: Vec3; // offset, axis or factors
  angle: number; // degrees, of a still rotation
  seconds: number; // a lap or a turn
  points: readonly Vec3[]; // of a curve
  isAligned: boolean;
}

const kinds = new Map<string, TransformKind>();
for (const kind of ['translate', 'rotate', 'scale'] as const) for (const name of spellings(kind)) kinds.set(name.toLowerCase(), kind);
const wrappers = new Set(spellings('transform').map((name) => name.toLowerCase()));
const pointNames = new Set(spellings('point').map((name) => name.toLowerCase()));

export const isTransforms = (element: XmlElement): boolean => wrappers.has(element.name.toLowerCase());
export const transformKind = (element: XmlElement): TransformKind | undefined => kinds.get(element.name.toLowerCase());

export const numberAt = (element: XmlElement, names: readonly string[]): number | undefined => {
  const found = attributeOf(element, names);
  return found && parseNumber(found.value);
};
export const pointsOf = (translate: XmlElement): XmlElement[] => translate.children.filter((one) => pointNames.has(one.name.toLowerCase()));
const vectorOf = (element: XmlElement, kind: 'translate' | 'rotate' | 'scale' | 'point', otherwise: number): Vec3 =>
  axes.map((axis) => numberAt(element, spellings(kind, axis)) ?? otherwise) as unknown as Vec3;
const isTrue = (text: string | undefined): boolean => /^(true|1|yes|on)$/i.test(text?.trim() ?? '');

/** Null for what the service skips: no points, no angle, no axis. */
function read(element: XmlElement, kind: TransformKind): Transform | null {
  const seconds = numberAt(element, spellings(kind === 'scale' ? 'rotate' : kind, 'time'));
  const still = { kind, element, form: 'still' as const, angle: 0, seconds: 0, points: [], isAligned: false, vector: vectorOf(element, kind, kind === 'scale' ? 1 : 0) };
  if (kind === 'scale') return still;
  if (kind === 'rotate') {
    const angle = numberAt(element, spellings('rotate', 'angle'));
    if (seconds !== undefined) return seconds === 0 ? null : { ...still, form: 'spin', seconds };
    return angle === undefined ? null : { ...still, angle };
  }
  const points = pointsOf(element).map((point) => vectorOf(point, 'point', 0));
  if (points.length === 0) return seconds === undefined ? still : null;
  if (seconds === 0) return { ...still, vector: points[0] as Vec3, points };
  return { ...still, form: 'curve', seconds: seconds ?? 1, points, isAligned: isTrue(attributeOf(element, spellings('translate', 'align'))?.value) };
}

/** The transforms of a group or of the root, in the order in which they apply. */
export function transformsOf(group: XmlElement): Transform[] {
  const elements = group.children.flatMap((child) => (isTransforms(child) ? child.children : [child]));
  return elements.flatMap((element) => {
    const kind = transformKind(element), transform = kind && read(element, kind);
    return transform ? [transform] : [];
  });
}

export function matrixOf(transform: Transform, timeS: number): Affine {
  const { kind, form, vector, angle, seconds, points, isAligned } = transform;
  if (kind === 'scale') return scaling(vector);
  if (kind === 'rotate') return rotation(vector, form === 'spin' ? Math.sign(seconds) * 360 * lapAt(timeS, Math.abs(seconds)) : angle);
  if (form === 'still') return translation(vector);
  const u = lapAt(timeS, seconds), origin = catmullRom(points, u).position;
  return isAligned ? { ...alignedFrame(points, u), origin } : translation(origin);
}

export const productOf = (transforms: readonly Transform[], timeS: number): Affine =>
  transforms.reduce((product, one) => multiply(product, matrixOf(one, timeS)), identity);

/** The frame in which the children of an element are placed, in the world. */
export function frameOf(element: XmlElement | null, timeS: number): Affine {
  if (!element) return identity;
  const own = kindOf(element) === 'group' || kindOf(element) === 'scene' ? productOf(transformsOf(element), timeS) : identity;
  return multiply(frameOf(element.parent, timeS), own);
}

/** Where the origin of a group or the place of what stands in it is. */
export const originOf = (element: XmlElement, timeS: number): Vec3 => applyAffine(frameOf(element, timeS), [0, 0, 0]);
