// Handles over the image: they move, turn and scale the selected element by its own numbers.
import { useEffect, useRef, useState } from 'preact/hooks';
import { axisNames, axisOf, centerOf, drag, handlesOf, nudge, ringAxes, valueText, type Handle, type Tool } from '../gizmo/handles.ts';
import { Lens, type Point } from '../gizmo/lens.ts';
import { snapping, stepsNow } from '../gizmo/settings.ts';
import { applyLinear, unit } from '../maths/matrix.ts';
import { add, length, scale, type Vec3 } from '../maths/vec.ts';
import { isWithin } from '../scene/hide.ts';
import { pickModel } from '../scene/pick.ts';
import { movedBy, targetsOf, type Targets } from '../scene/transform_edits.ts';
import { entryAt } from '../scene/tree.ts';
import type { Viewer } from '../scene/viewer.ts';
import { applyEdits, parseXml, type Edit } from '../scene/xml.ts';
import { t } from '../words.ts';
import { focusStage } from './stage.tsx';

const armLength = 92; // CSS pixels
const minArm = 28; // CSS pixels, as it is seen
const segments = 64; // of a ring
const minDrag = 3; // CSS pixels

interface Drag {
  handle: Handle;
  text: string; // as it was when the drag began
  from: Point;
  pointer: number;
  isDrag: boolean; // false: a press so far, with a trembling hand
}

/** What handles would change, and the text that they belong to. */
export function targetsNow(viewer: Viewer): { text: string; targets: Targets; isLocked: boolean } | null {
  const text = viewer.text.value, roots = parseXml(text ?? ''), entry = entryAt(roots, viewer.selected.value), element = entry && movedBy(entry);
  if (text === null || !entry || !element) return null;
  const isLocked = isWithin(entry, viewer.marks.value.locked);
  return { text, isLocked, targets: targetsOf({ text, roots }, element, viewer.clock.time.value) };
}

/** Applies edits to an earlier text: later changes of it are undone. */
export function editFrom(viewer: Viewer, text: string, edits: readonly Edit[], how: 'dragging' | 'done'): void {
  viewer.edit(applyEdits(text, edits), how);
}

const pathOf = (points: readonly (Point | null)[]): string =>
  points.map((point, i) => (point ? `${i === 0 || !points[i - 1] ? 'M' : 'L'}${point.x.toFixed(1)} ${point.y.toFixed(1)}` : '')).join('');

/** The shapes of a handle: lines, a filled part, and where its letter is. */
interface Shape {
  line: string;
  back: string; // the far half of a ring
  fill: string;
  label: Point | null;
}

function shapeOf(handle: Handle, lens: Lens): Shape | null {
  const middle = centerOf(handle), pixel = lens.pixelAt(middle), at = lens.project(middle);
  if (!at) return null;
  const circle = (radius: number): string =>
    `M${(at.x - radius).toFixed(1)} ${at.y.toFixed(1)}a${radius} ${radius} 0 1 0 ${2 * radius} 0a${radius} ${radius} 0 1 0 ${-2 * radius} 0z`;
  if (handle.tool === 'turn') {
    const { axis, frame } = handle.ring, { u, v } = ringAxes(axis), [wide, high] = [u, v].map((one) => applyLinear(frame, one)) as [Vec3, Vec3];
    const radius = (armLength * 0.9 * pixel) / (Math.max(length(wide), length(high)) || 1), depth = lens.depthOf(middle);
    const points = Array.from({ length: segments + 1 }, (_, i) => {
      const angle = (i * 2 * Math.PI) / segments;
      return add(middle, scale(add(scale(wide, Math.cos(angle)), scale(high, Math.sin(angle))), radius));
    });
    const half = (isFront: boolean): string => pathOf(points.map((point) => (lens.depthOf(point) <= depth * (1 + 1e-6) === isFront ? lens.project(point) : null)));
    return { line: half(true), back: half(false), fill: '', label: null };
  }
  const { along, target } = handle;
  const arm = (axis: number, share: number): Vec3 => scale(unit(axisOf(target.frame, axis)), share * armLength * pixel);
  if (along.length === 3) return { line: '', back: '', fill: circle(9), label: null };
  if (along.length === 2) {
    const [a, b] = along as [number, number], corners = [[0.28, 0.28], [0.5, 0.28], [0.5, 0.5], [0.28, 0.5]] as const;
    const points = corners.map(([s, r]) => lens.project(add(middle, add(arm(a, s), arm(b, r)))));
    const [p, q, , r] = points;
    // Seen from the side it is a line that lies over the arrows.
    if (!p || !q || !r || Math.abs((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x)) < 60) return null;
    return { line: '', back: '', fill: `${pathOf(points)}z`, label: null };
  }
  const end = lens.project(add(middle, arm(along[0] as number, 1)));
  if (!end) return null;
  const size = Math.hypot(end.x - at.x, end.y - at.y);
  if (size < minArm) return null; // it points at the viewer: a pixel would be far
  const [dx, dy] = [(end.x - at.x) / size, (end.y - at.y) / size], start = { x: at.x + dx * 12, y: at.y + dy * 12 };
  const tip = handle.tool === 'move'
    ? `M${end.x.toFixed(1)} ${end.y.toFixed(1)}l${(-13 * dx - 6 * dy).toFixed(1)} ${(-13 * dy + 6 * dx).toFixed(1)}l${(12 * dy).toFixed(1)} ${(-12 * dx).toFixed(1)}z`
    : `M${(end.x - 6).toFixed(1)} ${(end.y - 6).toFixed(1)}h12v12h-12z`;
  return { line: pathOf([start, end]), back: '', fill: tip, label: { x: end.x + dx * 14, y: end.y + dy * 14 } };
}

const kindOfHandle = (handle: Handle): string => {
  if (handle.tool === 'turn') return handle.ring.name || 'own';
  return handle.along.length === 1 ? (axisNames[handle.along[0] as number] as string).toLowerCase() : handle.along.length === 2 ? 'xyz'.split('').filter((_, i) => !handle.along.includes(i as 0)).join('') : 'all';
};

/** "Move along X", for those that keys reach. */
function labelOf(handle: Handle): string | null {
  if (handle.tool === 'turn') return handle.ring.name ? t('Turn about {axis}', { axis: handle.ring.name.toUpperCase() }) : t('Turn about its axis');
  if (handle.along.length > 1) return null;
  const axis = axisNames[handle.along[0] as number] as string;
  return handle.tool === 'move' ? t('Move along {axis}', { axis }) : t('Scale along {axis}', { axis });
}

const numberOfHandle = (handle: Handle): number => (handle.tool === 'turn' ? (handle.ring.angle ?? 0) : (handle.target.value[handle.along[0] as number] as number));

export function useStageSize(viewer: Viewer): { width: number; height: number } {
  const measure = () => viewer.canvas?.size() ?? { width: 1, height: 1 };
  const [size, setSize] = useState(measure);
  useEffect(() => {
    const stage = document.querySelector('.stage');
    if (!stage) return;
    const observer = new ResizeObserver(() => setSize(measure()));
    observer.observe(stage);
    return () => observer.disconnect();
  }, [viewer]);
  return size;
}

export function Gizmo({ viewer }: { viewer: Viewer }) {
  const svg = useRef<SVGSVGElement>(null), dragging = useRef<Drag | null>(null);
  const [active, setActive] = useState('');
  const { width, height } = useStageSize(viewer), camera = viewer.frame.value?.camera, tool = viewer.tool.value, now = targetsNow(viewer);
  const finish = (): void => {
    if (!dragging.current) return;
    dragging.current = null;
    setActive('');
    viewer.endGesture();
  };
  // A handle that goes away while it is dragged, as by the key of another tool, does not get the end of the drag.
  useEffect(() => {
    if (active === '') return;
    const stop = (event: PointerEvent): void => {
      if (event.pointerId === dragging.current?.pointer) finish();
    };
    window.addEventListener('pointerup', stop);
    window.addEventListener('pointercancel', stop);
    return () => {
      window.removeEventListener('pointerup', stop);
      window.removeEventListener('pointercancel', stop);
    };
  }, [active]);
  useEffect(() => finish, [viewer]);
  if (!camera || !now || now.isLocked || !['move', 'turn', 'scale'].includes(tool)) return null;
  const lens = new Lens(camera, width, height), handles = handlesOf(now.targets, tool as Tool);
  const shapes = handles.flatMap((handle) => {
    const shape = shapeOf(handle, lens);
    return shape ? [{ handle, shape }] : [];
  });
  const pointOf = (event: PointerEvent): Point => {
    const box = (svg.current as SVGSVGElement).getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const begin = (handle: Handle, event: PointerEvent): void => {
    if (event.button !== 0 || dragging.current) return;
    event.preventDefault();
    (event.currentTarget as SVGElement).focus({ preventScroll: true });
    (event.currentTarget as Element).setPointerCapture(event.pointerId);
    dragging.current = { handle, text: now.text, from: pointOf(event), pointer: event.pointerId, isDrag: false };
    setActive(handle.id);
    viewer.beginGesture();
  };
  const move = (event: PointerEvent): void => {
    const held = dragging.current;
    if (held?.pointer !== event.pointerId) return;
    const to = pointOf(event);
    held.isDrag ||= Math.hypot(to.x - held.from.x, to.y - held.from.y) >= minDrag;
    if (held.isDrag) editFrom(viewer, held.text, drag(held.handle, lens, held.from, to, stepsNow(event.shiftKey)), 'dragging');
  };
  const end = (event: PointerEvent): void => {
    const held = dragging.current;
    if (held?.pointer !== event.pointerId) return;
    if (event.type === 'pointercancel') viewer.edit(held.text, 'done');
    finish();
    // A click is for what lies below.
    if (event.type === 'pointerup' && !held.isDrag) void pickModel(viewer, held.from.x, held.from.y);
  };
  const press = (handle: Handle, event: KeyboardEvent): void => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === 'Escape') {
      const held = dragging.current;
      if (held) {
        viewer.edit(held.text, 'done');
        finish();
      } else focusStage();
      return event.preventDefault();
    }
    const count = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
    if (count === undefined) return;
    event.preventDefault();
    editFrom(viewer, now.text, nudge(handle, event.shiftKey ? count / 10 : count, snapping.value.steps), 'dragging');
  };
  return (
    <svg ref={svg} class="gizmo" width={width} height={height} viewBox={`0 0 ${width} ${height}`} role="group" aria-label={t('Handles')}>
      {shapes.map(({ handle, shape }) => {
        const label = labelOf(handle), focusable = label === null ? { 'aria-hidden': true as const } : {
          role: 'slider' as const, tabindex: 0, 'aria-label': label, 'aria-valuenow': Number(numberOfHandle(handle).toFixed(4)), 'aria-valuetext': valueText(handle) || '0',
          onKeyDown: (event: KeyboardEvent) => press(handle, event),
        };
        return (
          <g key={handle.id} class={`handle of-${kindOfHandle(handle)}${active === handle.id ? ' active' : ''}`} data-handle={handle.id} {...focusable}
            onPointerDown={(event) => begin(handle, event)} onPointerMove={move} onPointerUp={end} onPointerCancel={end}>
            {shape.back && <path class="back" d={shape.back} />}
            <path class="rim" d={shape.line + shape.fill} />
            {shape.line && <path class="line" d={shape.line} />}
            {shape.fill && <path class="fill" d={shape.fill} />}
            <path class="hit" d={shape.line + shape.back + shape.fill} />
            {shape.label && <text x={shape.label.x} y={shape.label.y}>{kindOfHandle(handle).toUpperCase()}</text>}
          </g>
        );
      })}
    </svg>
  );
}
