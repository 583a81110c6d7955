// What is added to the scene, doubled or removed, beside the tree.
import { chooseFiles } from '../files.ts';
import { findingsOf, sentence } from '../api.ts';
import { isWithin } from '../scene/hide.ts';
import { setTexture } from '../scene/materials.ts';
import { pathFor, withFile } from '../scene/scene_files.ts';
import { groupAround, kindOf } from '../scene/tree.ts';
import { doubled, removed, shapes, withGroup, withLight, withShape, type Edited } from '../scene/tree_edits.ts';
import type { Viewer } from '../scene/viewer.ts';
import { parseXml, walkXml, type XmlElement } from '../scene/xml.ts';
import { t } from '../words.ts';
import { say, Tool } from './ui.tsx';

const lights = ['point', 'directional', 'spot'] as const;

function apply(viewer: Viewer, { text, added }: Edited): void {
  viewer.edit(text, 'done');
  if (added !== null) viewer.selected.value = added;
}

const canChange = (viewer: Viewer, element: XmlElement | undefined): element is XmlElement => {
  const kind = element && kindOf(element);
  if (!element || kind === 'scene') return false;
  if (!isWithin(element, viewer.marks.value.locked)) return true;
  say(t('This part is locked.'));
  return false;
};

export function double(viewer: Viewer, element: XmlElement | undefined): void {
  if (canChange(viewer, element)) apply(viewer, doubled(viewer.text.peek() ?? '', element));
}

export function remove(viewer: Viewer, element: XmlElement | undefined): void {
  if (!canChange(viewer, element)) return;
  const above = groupAround(element);
  apply(viewer, removed(viewer.text.peek() ?? '', element));
  viewer.selected.value = above?.start ?? null;
}

async function addTexture(viewer: Viewer, model: XmlElement): Promise<void> {
  const [image] = await chooseFiles(false);
  if (!image) return;
  const index = [...walkXml(parseXml(viewer.text.peek() ?? ''))].filter((one) => kindOf(one) === 'model').findIndex((one) => one.start === model.start);
  await viewer.changeFiles((text, files) => ({ text: setTexture(text, index, pathFor(image.path)), changes: withFile(files, pathFor(image.path), image.file) }));
}

export function TreeTools({ viewer, element }: { viewer: Viewer; element: XmlElement | undefined }) {
  const kind = element && kindOf(element), group = kind === 'group' ? element : element && groupAround(element);
  const add = (what: string): void => {
    const text = viewer.text.peek() ?? '', shape = shapes.find((one) => one.name === what), light = lights.find((one) => `light ${one}` === what);
    if (group && isWithin(group, viewer.marks.value.locked)) return say(t('This part is locked.'));
    if (shape) apply(viewer, withShape(text, group, shape.call));
    else if (light) apply(viewer, withLight(text, light));
    else if (what === 'group') apply(viewer, withGroup(text, group, t('New group')));
    else if (what === 'texture' && element) void addTexture(viewer, element).catch((fault: unknown) => say(findingsOf(fault).map((one) => sentence(one)).join(' ')));
  };
  return (
    <>
      <select class="tree-add" aria-label={t('Add to the scene')} value="" onChange={(event) => {
        add(event.currentTarget.value);
        event.currentTarget.value = '';
      }}>
        <option value="" selected>{t('Add…')}</option>
        <option value="group">{t('Group')}</option>
        {kind === 'model' && <option value="texture">{t('Texture…')}</option>}
        <optgroup label={t('Shapes')}>{shapes.map(({ name }) => <option key={name} value={name}>{name}</option>)}</optgroup>
        <optgroup label={t('Lights')}>{lights.map((light) => <option key={light} value={`light ${light}`}>{light}</option>)}</optgroup>
      </select>
      <Tool icon="plus" label={t('Duplicate')} keys="Ctrl+D" disabled={!element || kind === 'scene'} onClick={() => double(viewer, element)} />
      <Tool icon="close" label={t('Delete')} keys="Delete" disabled={!element || kind === 'scene'} onClick={() => remove(viewer, element)} />
    </>
  );
}
