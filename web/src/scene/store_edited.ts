// An edited scene becomes a scene of its own on the server: unlisted, with a link to share.
import { query, request, type SceneFacts } from '../api.ts';
import { formatView, scenePlace } from '../router.ts';
import { bodyOf } from './frame.ts';
import type { Viewer } from './viewer.ts';

export async function storeEdited(viewer: Viewer): Promise<void> {
  try {
    const base: Record<string, string> = viewer.id === null ? {} : { base: viewer.id };
    const response = await request(`v1/scenes?${query(base)}`, {
      method: 'POST', ...bodyOf({ ...viewer.document(), text: viewer.written() }),
    });
    const scene = (await response.json()) as SceneFacts;
    const view = {
      orbit: viewer.orbit.value, walk: viewer.walk.value, time: viewer.clock.time.value, options: viewer.options.value,
    };
    viewer.forgetDraft();
    location.hash = scenePlace(scene.id, formatView(view));
  } catch (fault) {
    viewer.report(fault);
  }
}
