// The angles of the light that light mode turns.
import { useEffect } from 'preact/hooks';
import { cameraLightOf } from '../scene/camera_light.ts';
import type { Viewer } from '../scene/viewer.ts';

export function LightNote({ viewer }: { viewer: Viewer }) {
  useEffect(() => {
    viewer.loadText().catch((fault: unknown) => viewer.report(fault));
  }, [viewer]);
  const light = cameraLightOf(viewer.text.value ?? '');
  return (
    <p class="light-note" role="status">
      {light ? `Camera light: alpha ${light.alpha}°, beta ${light.beta}°` : 'No camera light yet: A Z, X C add one'}
    </p>
  );
}
