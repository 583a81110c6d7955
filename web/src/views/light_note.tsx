// The angles of the light that light mode turns.
import { useEffect } from 'preact/hooks';
import { cameraLightOf } from '../scene/camera_light.ts';
import type { Viewer } from '../scene/viewer.ts';
import { t } from '../words.ts';

export function LightNote({ viewer }: { viewer: Viewer }) {
  useEffect(() => {
    viewer.loadText().catch((fault: unknown) => viewer.report(fault));
  }, [viewer]);
  const light = cameraLightOf(viewer.text.value ?? '');
  return (
    <p class="light-note" role="status">
      {light ? t('Camera light: alpha {alpha}°, beta {beta}°', { alpha: light.alpha, beta: light.beta }) : t('No camera light yet: a finger, or A Z and X C, add one')}
    </p>
  );
}
