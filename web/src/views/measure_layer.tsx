// The measurement over the image: its places, the line between them, and its length in words.
import { useEffect } from 'preact/hooks';
import { Lens } from '../gizmo/lens.ts';
import { distanceOf, measured } from '../scene/measure.ts';
import type { Viewer } from '../scene/viewer.ts';
import { number, t } from '../words.ts';
import { useStageSize } from './gizmo.tsx';

/** So many digits that the last one is about as large as the error. */
const digitsOf = (uncertain: number): number => Math.min(6, Math.max(0, Math.ceil(-Math.log10(Math.max(uncertain, 1e-9)))));

function words(): string {
  const places = measured.value, found = distanceOf(places);
  if (!found) return places.length === 0 ? t('Click the first place to measure from.') : t('Click the second place.');
  const digits = { maximumFractionDigits: digitsOf(found.uncertain) };
  return t('Distance {distance}, off by at most {error}. Click to measure again.', {
    distance: number(found.distance, digits), error: number(found.uncertain, { maximumSignificantDigits: 1 }),
  });
}

export function MeasureLayer({ viewer }: { viewer: Viewer }) {
  const { width, height } = useStageSize(viewer), camera = viewer.frame.value?.camera;
  // The places are those of the scene as it was.
  useEffect(() => () => {
    measured.value = [];
  }, [viewer, viewer.text.value, viewer.clock.time.value]);
  if (!camera) return null;
  const lens = new Lens(camera, width, height), points = measured.value.map(({ point }) => lens.project(point)), [from, to] = points;
  return (
    <>
      <svg class="measure" aria-hidden="true" width={width} height={height}>
        {from && to && <line x1={from.x} y1={from.y} x2={to.x} y2={to.y} />}
        {points.map((at) => at && <circle cx={at.x} cy={at.y} r="4.5" />)}
      </svg>
      <p class="gizmo-note" role="status">{words()}</p>
    </>
  );
}
