// The hierarchy of a scene as its document writes it: camera, lights, groups, models and included scenes, with names.
import { elementAt } from './hide.ts';
import { spellings } from './language.ts';
import { attributeOf, walkXml, type XmlElement } from './xml.ts';

export type NodeKind = 'scene' | 'camera' | 'light' | 'group' | 'model' | 'include' | 'skybox' | 'background' | 'entity';

export interface TreeNode {
  element: XmlElement;
  kind: NodeKind;
  name: string; // empty where the document gives none
  note: string; // its shape, type or file
  parent: TreeNode | null;
  children: TreeNode[];
}

const kindsByName = new Map<string, NodeKind>();
for (const [element, kind] of [
  ['world', 'scene'], ['camera', 'camera'], ['light', 'light'], ['group', 'group'], ['model', 'model'], ['xml', 'include'],
  ['skybox', 'skybox'], ['background', 'background'], ['entity', 'entity'],
] as const)
  for (const name of spellings(element)) kindsByName.set(name.toLowerCase(), kind);

/** Lists, whose entries belong to what is around them. */
const lists = new Set((['lights', 'models', 'xmls'] as const).flatMap((name) => spellings(name)).map((name) => name.toLowerCase()));

export const kindOf = (element: XmlElement): NodeKind | undefined => kindsByName.get(element.name.toLowerCase());

const maxNameLength = 40;
const short = (text: string): string => (text.length > maxNameLength ? `${text.slice(0, maxNameLength - 1)}…` : text);

/** The comment that ends right before an element, where it is one line of words. */
export function commentBefore(text: string, element: XmlElement): string {
  const before = text.slice(Math.max(0, element.start - 300), element.start);
  const words = /<!--((?:(?!-->)[^\n])*)-->\s*$/.exec(before)?.[1]?.replace(/^[\s\-=*#]+|[\s\-=*#]+$/g, '') ?? '';
  return /^[^<>]*[\p{L}\d][^<>]*$/u.test(words) ? short(words) : '';
}

const valueOf = (element: XmlElement, names: readonly string[]): string => attributeOf(element, names)?.value.trim() ?? '';
const shapeOf = (model: XmlElement): string => valueOf(model, [...spellings('model', 'file'), 'command']);

function labelOf(text: string, element: XmlElement, kind: NodeKind): { name: string; note: string } {
  if (kind === 'model') {
    const name = valueOf(element, ['name', 'id']), shape = shapeOf(element);
    return name ? { name, note: shape } : { name: shape, note: '' };
  }
  if (kind === 'light')
    return { name: valueOf(element, spellings('light', 'name')) || commentBefore(text, element), note: valueOf(element, ['type']).toLowerCase() };
  if (kind === 'group') {
    const name = valueOf(element, spellings('group', 'name')) || commentBefore(text, element);
    const models = name ? [] : [...walkXml(element.children)].filter((one) => kindOf(one) === 'model'), first = models[0];
    return { name, note: first ? `${short(shapeOf(first))}${models.length > 1 ? ` + ${models.length - 1}` : ''}` : '' };
  }
  const file = valueOf(element, kind === 'include' ? spellings('xml', 'file') : ['texture', 'file', 'image', 'color', 'colour']);
  return { name: '', note: kind === 'scene' || kind === 'camera' ? '' : short(file) };
}

/** The tree of a document, from its root. */
export function treeOf(text: string, roots: readonly XmlElement[]): TreeNode[] {
  const visit = (elements: readonly XmlElement[], parent: TreeNode | null): TreeNode[] => elements.flatMap((element) => {
    const kind = kindOf(element);
    if (kind === undefined) return lists.has(element.name.toLowerCase()) ? visit(element.children, parent) : [];
    const node: TreeNode = { element, kind, ...labelOf(text, element, kind), parent, children: [] };
    if (kind === 'scene' || kind === 'group') node.children = visit(element.children, node);
    return [node];
  });
  return visit(roots, null);
}

export function* walkTree(nodes: readonly TreeNode[]): Generator<TreeNode> {
  for (const node of nodes) {
    yield node;
    yield* walkTree(node.children);
  }
}

/** The innermost entry of the tree around an index of the text. */
export function entryAround(roots: readonly XmlElement[], index: number): XmlElement | undefined {
  let found: XmlElement | undefined, inside: readonly XmlElement[] = roots;
  for (;;) {
    const next = inside.find((one) => one.start <= index && index < one.end);
    if (!next) return found;
    if (kindOf(next) !== undefined) found = next;
    inside = next.children;
  }
}

/** The entry whose "<" has this index. */
export const entryAt = (roots: readonly XmlElement[], index: number | null): XmlElement | undefined => {
  const found = index === null ? undefined : elementAt(roots, index);
  return found && kindOf(found) !== undefined ? found : undefined;
};

/** The group around an element; undefined for what stands in the root. */
export function groupAround(element: XmlElement): XmlElement | undefined {
  for (let at = element.parent; at; at = at.parent) if (kindOf(at) === 'group') return at;
  return undefined;
}

/** A click on what is selected selects the group around it; after the outermost group, the model again. */
export function nextSelection(model: XmlElement, selected: number | null): XmlElement {
  for (let at: XmlElement | undefined = model; at; at = groupAround(at)) if (at.start === selected) return groupAround(at) ?? model;
  return model;
}
