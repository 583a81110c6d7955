// The tools for what is selected, over the left edge of the image.
import { useState } from 'preact/hooks';
import type { SceneTool, Viewer } from '../scene/viewer.ts';
import { setSnapping, snapping } from '../gizmo/settings.ts';
import { lineOf } from '../scene/xml.ts';
import { msg, number, t } from '../words.ts';
import type { IconName } from './icons.tsx';
import { targetsNow } from './gizmo.tsx';
import { Tool, toolbarKeys } from './ui.tsx';
import { openPanel } from './viewer_page.tsx';

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
  if (tool === 'turn' && now.targets.rings.length === 0) return t('This light shines in all directions.');
  return '';
}

/** What goes on with time: handles leave it as it is, so each has its line. */
function Motions({ viewer }: { viewer: Viewer }) {
  const now = targetsNow(viewer);
  if (!now || now.isLocked) return null;
  return (
    <>
      {now.targets.motions.map(({ kind, seconds, element }) => {
        const line = lineOf(now.text, element.start), values = { seconds: number(Math.abs(seconds), { maximumFractionDigits: 3 }) };
        return (
          <p key={element.start} class="gizmo-note">
            {kind === 'turn' ? t('It turns with time, once in {seconds} s. Handles leave that as it is: its time and axis are in the XML,', values)
              : t('It moves along its curve, once in {seconds} s. Handles move all points together: each point and the time are in the XML,', values)}{' '}
            <button type="button" class="link" onClick={() => {
              openPanel('xml');
              viewer.reveal.value = { line, column: 1 };
            }}>{t('line {line}', { line })}</button>
          </p>
        );
      })}
    </>
  );
}

export function GizmoBar({ viewer }: { viewer: Viewer }) {
  const [focused, setFocused] = useState<number | null>(null); // the one stop of Tab; first the tool that is chosen
  const stop = focused ?? tools.findIndex(([tool]) => tool === viewer.tool.value), stopAt = (index: number): 0 | -1 => (index === stop ? 0 : -1);
  const { isOn, steps } = snapping.value, hasHandles = !['select', 'measure'].includes(viewer.tool.value), why = hasHandles ? whyNoHandles(viewer) : '';
  return (
    <>
      <div class="gizmo-bar" role="toolbar" aria-label={t('Handles of what is selected')} aria-orientation="vertical" onKeyDown={toolbarKeys}
        onFocusCapture={(event) => setFocused([...event.currentTarget.querySelectorAll('button')].indexOf(event.target as HTMLButtonElement))}>
        {tools.map(([tool, icon, label, key], index) => (
          <Tool key={tool} icon={icon} label={t(label)} keys={key} tabIndex={stopAt(index)} pressed={viewer.tool.value === tool} onClick={() => (viewer.tool.value = tool)} />
        ))}
        <Tool icon="magnet" label={t('Snap to steps of {move}, {turn}°, {scale}', { ...steps })} keys="Shift" tabIndex={stopAt(tools.length)} pressed={isOn} onClick={() => setSnapping({ steps, isOn: !isOn })} />
      </div>
      <div class="gizmo-notes" role="status">
        {why && <p class="gizmo-note">{why}</p>}
        {hasHandles && <Motions viewer={viewer} />}
      </div>
    </>
  );
}
