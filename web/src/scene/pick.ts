// Selecting a model by a click in the image.
import { say } from '../views/ui.tsx';
import { t } from '../words.ts';
import { isWithin } from './hide.ts';
import { elementsDrawn, idImage } from './id_image.ts';
import { nextSelection } from './tree.ts';
import type { Viewer } from './viewer.ts';

/** The number at a place of the stage, in CSS pixels. */
async function numberAt(viewer: Viewer, x: number, y: number): Promise<number> {
  const stage = viewer.canvas?.size(), image = stage && (await idImage(viewer));
  if (!image) return 0;
  const px = Math.min(image.width - 1, Math.floor((x / stage.width) * image.width));
  const py = Math.min(image.height - 1, Math.floor((y / stage.height) * image.height));
  return image.numbers[py * image.width + px] ?? 0;
}

/** Selects the model under a place of the stage; nothing, where there is none. */
export async function pickModel(viewer: Viewer, x: number, y: number): Promise<void> {
  try {
    const [number, elements] = await Promise.all([numberAt(viewer, x, y), elementsDrawn(viewer)]);
    const model = number > 0 ? elements[number - 1] : undefined;
    if (number > 0 && !model) return say(t('Model {number} of this scene has no place in the document.', { number }));
    if (model && isWithin(model, viewer.marks.value.locked)) return say(t('This part is locked. Select it in the tree to unlock it.'));
    viewer.selected.value = model ? nextSelection(model, viewer.selected.value).start : null;
  } catch (fault) {
    viewer.report(fault);
  }
}
