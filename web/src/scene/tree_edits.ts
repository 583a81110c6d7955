// Adding, doubling and removing parts of a scene, as its dialect writes them.
import tables from 'document:schema';
import { spellings } from './language.ts';
import { mannerOf } from './materials.ts';
import { kindOf } from './tree.ts';
import { axisName, emptyElement, ownName, vectorNames } from './writing.ts';
import { appendChild, applyEdits, attributeOf, indentUnit, insertAfter, insertBefore, parseXml, prependChild, removeElement, walkXml, type XmlElement } from './xml.ts';

/** The text after an edit, and the index of the "<" of what is new; null: nothing is. */
export interface Edited {
  text: string;
  added: number | null;
}

interface ShapeRow {
  name: string;
  takesFile: boolean;
  required: number;
  arguments: { integer: boolean }[];
}

/** The shapes that the service generates, with arguments that show them: the first number is 1, further ones are smaller. */
export const shapes: readonly { name: string; call: readonly string[] }[] = (JSON.parse(tables) as { shapes: ShapeRow[] }).shapes
  .filter(({ takesFile }) => !takesFile)
  .map((shape) => ({ name: shape.name, call: [shape.name, ...shape.arguments.slice(0, shape.required).map(({ integer }, i) => (integer ? '16' : i === 0 ? '1' : '0.5'))] }));

export function removed(text: string, element: XmlElement): Edited {
  return { text: applyEdits(text, [removeElement(text, element)]), added: null };
}

export function doubled(text: string, element: XmlElement): Edited {
  const piece = text.slice(element.start, element.end), edit = insertAfter(text, element, piece);
  return { text: applyEdits(text, [edit]), added: element.end + edit.insert.length - piece.length };
}

const isNamed = (element: XmlElement, name: string): boolean => spellings(name).some((one) => one.toLowerCase() === element.name.toLowerCase());
const inserted = (text: string, edit: { from: number; to: number; insert: string }, piece: string): Edited =>
  ({ text: applyEdits(text, [edit]), added: edit.from + edit.insert.indexOf(piece) });

/** Whether models stand in lists, as in the document's first one. */
function listsModels(roots: readonly XmlElement[]): boolean {
  const first = [...walkXml(roots)].find((one) => kindOf(one) === 'model');
  return !first?.parent || isNamed(first.parent, 'models');
}

/** A shape in a group, or in a new group of the root, where it can be moved. */
export function withShape(text: string, group: XmlElement | undefined, call: readonly string[]): Edited {
  const roots = parseXml(text), root = roots[0], unit = indentUnit(text, roots);
  if (!root) return { text, added: null };
  const [groupName, list, name] = (['group', 'models', 'model'] as const).map((kind) => ownName(roots, kind)) as [string, string, string];
  const fileNames = spellings('model', 'file'), example = [...walkXml(roots)].find((one) => kindOf(one) === 'model' && attributeOf(one, fileNames));
  const file = (example && attributeOf(example, fileNames)?.name) ?? (fileNames[0] as string);
  const model = emptyElement(text, name, mannerOf(roots) === 'engine2020' ? [['command', call.join(' ')]] : [[file, `${call.join('_')}.3d`]]);
  const listed = listsModels(roots) ? `<${list}> ${model} </${list}>` : model;
  if (!group) {
    const piece = `<${groupName}> ${listed} </${groupName}>`;
    return inserted(text, appendChild(text, root, piece, unit), piece);
  }
  const models = group.children.find((child) => isNamed(child, 'models'));
  if (models) return inserted(text, appendChild(text, models, model, unit), model);
  // Before groups within: the dialects want the models first.
  const last = group.children.filter((child) => kindOf(child) === 'model').at(-1), inner = group.children.find((child) => kindOf(child) === 'group');
  return inserted(text, last ? insertAfter(text, last, model) : inner ? insertBefore(text, inner, listed) : appendChild(text, group, listed, unit), model);
}

export function withGroup(text: string, group: XmlElement | undefined, name: string): Edited {
  const roots = parseXml(text), parent = group ?? roots[0];
  if (!parent) return { text, added: null };
  const piece = emptyElement(text, ownName(roots, 'group'), [['name', name]]);
  return inserted(text, appendChild(text, parent, piece, indentUnit(text, roots)), piece);
}

/** A light in the list of lights, which is added before the groups: the older dialects want it there. */
export function withLight(text: string, type: 'point' | 'directional' | 'spot'): Edited {
  const roots = parseXml(text), root = roots[0], unit = indentUnit(text, roots);
  if (!root) return { text, added: null };
  const example = [...walkXml(roots)].find((one) => kindOf(one) === 'light'), place = vectorNames('light', 'pos'), aim = vectorNames('light', 'dir');
  const name = (names: typeof place, axis: 'x' | 'y' | 'z'): string => (example ? axisName(example, names, axis) : names[axis][0] as string);
  const vector = (names: typeof place, [x, y, z]: readonly [string, string, string]) => [[name(names, 'x'), x], [name(names, 'y'), y], [name(names, 'z'), z]] as const;
  const piece = emptyElement(text, ownName(roots, 'light'), [
    ['type', type], ...(type === 'directional' ? [] : vector(place, ['2', '4', '2'])), ...(type === 'point' ? [] : vector(aim, type === 'spot' ? ['-2', '-4', '-2'] : ['2', '4', '2'])),
    ...(type === 'spot' ? [['cutoff', '30'] as const] : []),
  ]);
  const lights = root.children.find((child) => isNamed(child, 'lights'));
  if (lights) return inserted(text, appendChild(text, lights, piece, unit), piece);
  const own = ownName(roots, 'lights'), list = `<${own}> ${piece} </${own}>`, first = root.children.find((child) => ['group', 'models', 'model'].some((one) => isNamed(child, one)));
  return inserted(text, first ? insertBefore(text, first, list) : root.children.length > 0 ? appendChild(text, root, list, unit) : prependChild(text, root, list, unit), piece);
}
