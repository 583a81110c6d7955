// The tools for what is selected, over the left edge of the image.
import type { SceneTool, Viewer } from '../scene/viewer.ts';
import { setSnapping, snapping } from '../gizmo/settings.ts';
import { msg, t } from '../words.ts';
import type { IconName } from './icons.tsx';
import { targetsNow } from './gizmo.tsx';
import { Tool } from './ui.tsx';

const tools: readonly (readonly [SceneTool, IconName, string, string])[] = [
  ['select', 'cursor', msg('Select without handles'), '1'], ['move', 'move', msg('Move'), '2'], ['turn', 'turn', msg('Turn'), '3'], ['scale', 'scale', msg('Scale'), '4'],
  ['measure', 'ruler', msg('Measure a distance'), '5'],
];

/** Why there are no handles; empty where there are some. */
export function whyNoHandles(viewer: Viewer): string {
  const now = targetsNow(viewer), tool = viewer.tool.value;
  if (!now) return t('This part has no place of its own: put it in a group to move it.');
  if (now.isLocked) return t('This part is locked.');
  if (tool === 'move' && !now.targets.move) return t('This light has no place to move; turn its direction.');
  if (tool === 'scale' && !now.targets.scale) return t('A light has no size.');
  if (tool === 'turn' && now.targets.rings.length === 0) return now.targets.spins ? t('This group turns with time: change its time or axis in the XML.') : t('This light shines in all directions.');
  return '';
}

export function GizmoBar({ viewer }: { viewer: Viewer }) {
  const { isOn, steps } = snapping.value, why = ['select', 'measure'].includes(viewer.tool.value) ? '' : whyNoHandles(viewer);
  return (
    <>
      <div class="gizmo-bar" role="toolbar" aria-label={t('Handles of what is selected')} aria-orientation="vertical">
        {tools.map(([tool, icon, label, key]) => (
          <Tool key={tool} icon={icon} label={t(label)} keys={key} pressed={viewer.tool.value === tool} onClick={() => (viewer.tool.value = tool)} />
        ))}
        <Tool icon="magnet" label={t('Snap to steps of {move}, {turn}°, {scale}', { ...steps })} keys="Shift" pressed={isOn} onClick={() => setSnapping({ steps, isOn: !isOn })} />
      </div>
      {why && <p class="gizmo-note" role="status">{why}</p>}
    </>
  );
}
