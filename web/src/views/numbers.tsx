// The place, turn and size of what is selected as numbers to type, and the steps that handles snap to.
import { axisNames, type Steps } from '../gizmo/handles.ts';
import { setStep, snapping } from '../gizmo/settings.ts';
import type { VectorTarget } from '../scene/transform_edits.ts';
import type { Viewer } from '../scene/viewer.ts';
import { msg, t } from '../words.ts';
import { editFrom, targetsNow } from './gizmo.tsx';

const shown = (value: number): string => String(Number(value.toFixed(4)));
const maxDecimals = 6;

function NumberField({ axis, label, value, step, disabled, isNever0 = false, onValue }: {
  axis: string; label: string; value: number; step: number; disabled: boolean; isNever0?: boolean; onValue: (value: number) => void;
}) {
  return (
    <label class={`of-${axis}`}>
      <span aria-hidden="true">{axis.toUpperCase()}</span>
      <input type="number" step="any" inputMode="decimal" aria-label={label} value={shown(value)} disabled={disabled}
        onChange={(event) => {
          const next = event.currentTarget.valueAsNumber;
          if (Number.isFinite(next) && !(isNever0 && next === 0)) onValue(next);
          else event.currentTarget.value = shown(value);
        }}
        onKeyDown={(event) => {
          const count = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
          if (count === undefined) return;
          event.preventDefault();
          const next = Number((value + count * step).toFixed(maxDecimals));
          if (!(isNever0 && next === 0)) onValue(next);
        }} />
    </label>
  );
}

const stepLabels: readonly (readonly [keyof Steps, string])[] = [['move', msg('Step of moves')], ['turn', msg('Step of turns, degrees')], ['scale', msg('Step of scales')]];

export function Numbers({ viewer }: { viewer: Viewer }) {
  const now = targetsNow(viewer), { steps } = snapping.value;
  if (!now) return null;
  const { text, targets, isLocked } = now;
  const vector = (legend: string, target: VectorTarget, step: number) => (
    <fieldset class="numbers">
      <legend>{legend}</legend>
      {axisNames.map((axis, i) => (
        <NumberField key={axis} axis={axis.toLowerCase()} label={`${legend} ${axis}`} value={target.value[i] as number} step={step} disabled={isLocked}
          onValue={(value) => editFrom(viewer, text, target.write(target.value.map((x, k) => (k === i ? value : x)) as unknown as VectorTarget['value'], maxDecimals), 'done')} />
      ))}
    </fieldset>
  );
  return (
    <>
      {targets.move && vector(t('Position'), targets.move, steps.move)}
      {targets.rings.length > 0 && (
        <fieldset class="numbers">
          <legend>{t('Angle')}</legend>
          {targets.rings.map((ring, index) => (
            <NumberField key={index} axis={ring.name || 'n'} step={steps.turn} disabled={isLocked} value={ring.angle ?? 0}
              label={ring.name ? t('Angle about {axis}', { axis: ring.name.toUpperCase() }) : t('Angle about its axis')}
              onValue={(value) => editFrom(viewer, text, ring.write(value - (ring.angle ?? 0), maxDecimals), 'done')} />
          ))}
        </fieldset>
      )}
      {targets.motions.length > 0 && (
        <fieldset class="numbers">
          <legend>{t('Time')}</legend>
          {targets.motions.map(({ kind, seconds, write }, index) => (
            <NumberField key={index} axis="s" step={1} disabled={isLocked} isNever0 value={seconds}
              label={kind === 'turn' ? t('Seconds a turn') : t('Seconds a lap')} onValue={(value) => editFrom(viewer, text, write(value, maxDecimals), 'done')} />
          ))}
        </fieldset>
      )}
      {targets.scale && vector(t('Size'), targets.scale, steps.scale)}
      <fieldset class="numbers">
        <legend>{t('Steps')}</legend>
        {stepLabels.map(([name, label]) => (
          <label key={name}>
            <input type="number" min="0" step="any" inputMode="decimal" aria-label={t(label)} title={t(label)} value={steps[name]}
              onChange={(event) => setStep(name, event.currentTarget.valueAsNumber)} />
          </label>
        ))}
      </fieldset>
    </>
  );
}
