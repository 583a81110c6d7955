// What lies over the image: the outline and the handles of what is selected, and a measurement.
import { useEffect, useRef } from 'preact/hooks';
import { elementsDrawn, idImage } from '../scene/id_image.ts';
import { isWithin } from '../scene/hide.ts';
import { outlineOf } from '../gizmo/outline.ts';
import type { Viewer } from '../scene/viewer.ts';
import { Gizmo } from './gizmo.tsx';
import { GizmoBar } from './gizmo_bar.tsx';
import { MeasureLayer } from './measure_layer.tsx';

/** The outline of the view on show; null where nothing of the element is visible. */
async function outline(viewer: Viewer, selected: number, ratio: number): Promise<ImageData | null> {
  const [image, elements] = await Promise.all([idImage(viewer), elementsDrawn(viewer)]);
  if (!image) return null;
  const chosen = new Set<number>();
  elements.forEach((element, index) => {
    if (element && isWithin(element, [selected])) chosen.add(index + 1);
  });
  const pixels = outlineOf(image.numbers, image.width, image.height, chosen, Math.max(2, Math.round(2 * ratio)));
  return pixels && new ImageData(pixels.data, pixels.width, pixels.height);
}

function Outline({ viewer }: { viewer: Viewer }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const selected = viewer.selected.value, still = viewer.still.value, marks = viewer.marks.value, isMoving = viewer.frame.value?.moving ?? true;
  useEffect(() => {
    const surface = canvas.current;
    if (!surface) return;
    surface.dataset['of'] = '';
    surface.getContext('2d')?.clearRect(0, 0, surface.width, surface.height);
    if (selected === null || isMoving) return;
    let isOld = false;
    outline(viewer, selected, viewer.canvas?.size().ratio ?? 1).then((pixels) => {
      if (isOld) return;
      surface.width = pixels?.width ?? 1;
      surface.height = pixels?.height ?? 1;
      if (pixels) surface.getContext('2d')?.putImageData(pixels, 0, 0);
      surface.dataset['of'] = String(selected);
    }, (fault: unknown) => isOld || viewer.report(fault));
    return () => {
      isOld = true;
    };
  }, [viewer, selected, still, marks, isMoving]);
  return <canvas ref={canvas} class="outline" aria-hidden="true" width={1} height={1} />;
}

export const SelectionLayer = ({ viewer }: { viewer: Viewer }) => (
  <>
    <Outline viewer={viewer} />
    <Gizmo viewer={viewer} />
    {viewer.tool.value === 'measure' && <MeasureLayer viewer={viewer} />}
    <GizmoBar viewer={viewer} />
  </>
);
