// Light mode: the light that moves with the camera, by longitude alpha and latitude beta.
import { attributeOf, appendChild, applyEdits, indentUnit, parseXml, setAttribute, walkXml, type XmlElement } from './xml.ts';
import { numberOf } from './materials.ts';
import { clamp } from '../maths/vec.ts';
import { wrapDegrees } from '../maths/camera.ts';
import type { Viewer } from './viewer.ts';

export interface CameraLight {
  alpha: number;
  beta: number;
}

const cameraSpaces = ['camera', 'eye', 'view'];
const isCameraLight = (element: XmlElement): boolean =>
  element.name.toLowerCase() === 'light' && cameraSpaces.includes(attributeOf(element, ['space'])?.value.toLowerCase() ?? '') &&
  /^(directional|direction|sun)$/i.test(attributeOf(element, ['type'])?.value ?? '');

const find = (roots: readonly XmlElement[]): XmlElement | undefined => [...walkXml(roots)].find(isCameraLight);

export function cameraLightOf(text: string): CameraLight | null {
  const light = find(parseXml(text));
  return light ? { alpha: numberOf(light, ['alpha'], 0), beta: numberOf(light, ['beta'], 0) } : null;
}

const short = (value: number): string => String(Number(value.toFixed(2)));

/** Turns the camera's light, which is added where the document has none. */
export function turnCameraLight(text: string, alpha: number, beta: number): string {
  const roots = parseXml(text), light = find(roots);
  if (light) {
    const a = wrapDegrees(numberOf(light, ['alpha'], 0) + alpha), b = clamp(numberOf(light, ['beta'], 0) + beta, -90, 90);
    return applyEdits(text, [setAttribute(light, ['alpha'], short(a)), setAttribute(light, ['beta'], short(b))]);
  }
  const root = roots[0];
  if (!root) return text;
  const added = `<light type="directional" space="camera" alpha="${short(wrapDegrees(alpha))}" beta="${short(clamp(beta, -90, 90))}" />`;
  const lights = root.children.find((child) => child.name.toLowerCase() === 'lights'), unit = indentUnit(text, roots);
  if (lights) return applyEdits(text, [appendChild(text, lights, added, unit)]);
  // Lights stand before the groups: the older dialects want it so.
  const group = root.children.find((child) => ['group', 'models', 'model'].includes(child.name.toLowerCase()));
  if (!group) return applyEdits(text, [appendChild(text, root, `<lights> ${added} </lights>`, unit)]);
  return applyEdits(text, [{ from: group.start, to: group.start, insert: `<lights>\n${unit}${unit}${added}\n${unit}</lights>\n${unit}` }]);
}

export async function turnLight(viewer: Viewer, alpha: number, beta: number): Promise<void> {
  await viewer.loadText();
  viewer.edit(turnCameraLight(viewer.text.value ?? '', alpha, beta), 'dragging');
}
